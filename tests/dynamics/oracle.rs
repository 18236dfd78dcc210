//! The frequency equation of a Timoshenko beam with any ends, as a determinant: an oracle apart from the rod's own formulation.

use nalgebra::{Matrix2, Matrix2x4, Matrix4, Matrix4x2};

/// Stiffness and inertia per length of a uniform beam that bends in one plane.
#[derive(Clone, Copy, Debug)]
pub struct Timoshenko {
    pub bending: f64,
    pub shear: f64,
    pub mass: f64,
    pub rotary: f64,
    pub length: f64,
}

/// Two conditions on (u, θ, m, n) at one end, at the circular frequency ω: of a clamp.
pub fn clamped(_: f64) -> Matrix2x4<f64> {
    Matrix2x4::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
}

pub fn pinned(_: f64) -> Matrix2x4<f64> {
    Matrix2x4::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
}

pub fn free(_: f64) -> Matrix2x4<f64> {
    Matrix2x4::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
}

impl Timoshenko {
    pub fn circle(radius: f64, length: f64, [e, g, density]: [f64; 3]) -> Self {
        let area = std::f64::consts::PI * radius * radius;
        let second = 0.25 * area * radius * radius;
        Self { bending: e * second, shear: g * area, mass: density * area, rotary: density * second, length }
    }

    /// exp(A L) of u' = θ + n/GA, θ' = m/EI, m' = −n − ω² ρI θ, n' = −ω² ρA u, in units that make A L of size one per wave.
    fn transfer(&self, omega: f64) -> Matrix4<f64> {
        let (l, w) = (self.length, omega * omega);
        // u/L, θ, m L/EI, n L²/EI
        let stretch = self.bending / (self.shear * l * l);
        let (rotary, mass) =
            (w * self.rotary * l * l / self.bending, w * self.mass * l.powi(4) / self.bending);
        #[rustfmt::skip]
        let a = Matrix4::new(
            0.0, 1.0, 0.0, stretch,
            0.0, 0.0, 1.0, 0.0,
            0.0, -rotary, 0.0, -1.0,
            -mass, 0.0, 0.0, 0.0,
        );
        a.exp()
    }

    /// Scales a condition on (u, θ, m, n) to these units.
    fn scaled(&self, rows: Matrix2x4<f64>) -> Matrix2x4<f64> {
        let moment = self.bending / self.length;
        let mut rows = rows;
        for (c, unit) in [self.length, 1.0, moment, moment / self.length].into_iter().enumerate() {
            rows.column_mut(c).scale_mut(unit);
        }
        for r in 0..2 {
            let size = rows.row(r).amax();
            rows.row_mut(r).scale_mut(1.0 / size);
        }
        rows
    }

    /// Zero at a natural frequency.
    pub fn determinant(
        &self,
        omega: f64,
        base: &dyn Fn(f64) -> Matrix2x4<f64>,
        tip: &dyn Fn(f64) -> Matrix2x4<f64>,
    ) -> f64 {
        // what the conditions at the base leave, by their orthogonal complement
        let rows = self.scaled(base(omega));
        let projector =
            Matrix4::identity() - rows.transpose() * (rows * rows.transpose()).try_inverse().unwrap() * rows;
        let svd = projector.svd(true, false);
        let u = svd.u.unwrap();
        let start = Matrix4x2::from_columns(&[u.column(0).into_owned(), u.column(1).into_owned()]);
        let closing: Matrix2<f64> = self.scaled(tip(omega)) * self.transfer(omega) * start;
        closing.determinant()
    }
}
