//! An independent solver: strains as the state of an initial value problem, the classical Runge–Kutta method, and a search for the strain at the base.
//!
//! It knows linear elasticity and formulas written out by hand, and nothing of collocation, energies or dual numbers.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// (R, p, Δξ) at one arc length.
#[derive(Clone, Copy, Debug)]
pub struct State {
    pub rotation: Matrix3<f64>,
    pub position: Vector3<f64>,
    pub strain: Vector6<f64>,
}

impl State {
    fn plus(&self, slope: &State, h: f64) -> State {
        State {
            rotation: self.rotation + slope.rotation * h,
            position: self.position + slope.position * h,
            strain: self.strain + slope.strain * h,
        }
    }

    /// ω of a straight reference.
    pub fn omega(&self) -> Vector3<f64> {
        self.strain.fixed_rows::<3>(0).into()
    }

    /// ν of a straight reference.
    pub fn nu(&self) -> Vector3<f64> {
        self.strain.fixed_rows::<3>(3) + Vector3::z()
    }
}

/// v × as a matrix.
pub fn hat(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// (a, b) as six numbers.
pub fn join(a: Vector3<f64>, b: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

/// −(ω×m + ν×n, ω×n).
pub fn ad_transpose(state: &State, wrench: &Vector6<f64>) -> Vector6<f64> {
    let (m, n) = (wrench.fixed_rows::<3>(0), wrench.fixed_rows::<3>(3));
    let (omega, nu) = (state.omega(), state.nu());
    join(-omega.cross(&m) - nu.cross(&n), -omega.cross(&n))
}

/// A boundary value problem on a straight rod clamped at the origin along +Z.
pub struct Shooting<'a> {
    /// Arc lengths between which everything is smooth, from 0 to L.
    pub pieces: &'a [f64],
    /// Runge–Kutta steps in each.
    pub steps: usize,
    /// Δξ′ within a piece.
    pub slope: &'a dyn Fn(f64, &State, usize) -> Vector6<f64>,
    /// Δξ after a node between pieces (its number, from 1) from that before.
    pub jump: &'a dyn Fn(usize, &State) -> Vector6<f64>,
    /// What must vanish at the tip.
    pub tip: &'a dyn Fn(&State) -> Vector6<f64>,
}

impl Shooting<'_> {
    fn run(&self, base: &Vector6<f64>) -> State {
        let mut state = State { rotation: Matrix3::identity(), position: Vector3::zeros(), strain: *base };
        for (piece, ends) in self.pieces.windows(2).enumerate() {
            if piece > 0 {
                state.strain = (self.jump)(piece, &state);
            }
            let h = (ends[1] - ends[0]) / self.steps as f64;
            let slope = |s: f64, state: &State| State {
                rotation: state.rotation * hat(&state.omega()),
                position: state.rotation * state.nu(),
                strain: (self.slope)(s, state, piece),
            };
            for i in 0..self.steps {
                let s = ends[0] + i as f64 * h;
                let a = slope(s, &state);
                let b = slope(s + 0.5 * h, &state.plus(&a, 0.5 * h));
                let c = slope(s + 0.5 * h, &state.plus(&b, 0.5 * h));
                let d = slope(s + h, &state.plus(&c, h));
                state = state.plus(&a, h / 6.0).plus(&b, h / 3.0).plus(&c, h / 3.0).plus(&d, h / 6.0);
            }
        }
        state
    }

    /// The state at the tip, from a guess of the strain at the base: Newton's method with central differences.
    pub fn solve(&self, guess: Vector6<f64>) -> State {
        let mut base = guess;
        for _ in 0..12 {
            let residual = (self.tip)(&self.run(&base));
            let jacobian = Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|k| {
                let mut step = Vector6::zeros();
                step[k] = 1e-6;
                ((self.tip)(&self.run(&(base + step))) - (self.tip)(&self.run(&(base - step)))) / 2e-6
            }));
            let step = jacobian.lu().solve(&residual).unwrap();
            base -= step;
            if step.norm() < 1e-12 * (1.0 + base.norm()) {
                return self.run(&base);
            }
        }
        panic!("the shooting did not converge: {base:?}");
    }
}
