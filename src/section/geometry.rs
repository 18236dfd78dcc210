use crate::error::Result;
use crate::material::Points;

/// Area and first and second moments of a section about the axis of the rod.
///
/// ```
/// use hyperrod::material::LinearElastic;
/// use hyperrod::section::{Geometry, Rectangle, Section, Shape};
/// # fn main() -> hyperrod::Result<()> {
/// let angle_iron = Rectangle::new(30e-3, 4e-3).shifted(15e-3, 2e-3);
/// let section = Section::new(angle_iron, LinearElastic::new(200e9, 80e9)?)?;
/// let moments = section.moments(0.0)?;
/// let [x, y] = moments.centroid();
/// assert!((x - 15e-3).abs() < 1e-16 && (y - 2e-3).abs() < 1e-17);
/// let axes = moments.about_centroid().principal_axes();
/// assert!((axes.angle.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-12); // stiffest about y
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AreaMoments {
    /// A = ∫dA, m².
    pub area: f64,
    /// (∫x dA, ∫y dA), m³: zero where the axis runs through the centroid.
    pub first: [f64; 2],
    /// I_x = ∫y² dA, m⁴: resists bending about x.
    pub i_x: f64,
    /// I_y = ∫x² dA, m⁴: resists bending about y.
    pub i_y: f64,
    /// I_xy = ∫xy dA, m⁴: zero about principal axes.
    pub i_xy: f64,
}

/// The axes about which a section's second moment is largest and smallest, at right angles to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalAxes {
    /// Angle from x towards y of the axis of the largest moment, in (−π/2, π/2]; 0 where all axes are principal.
    pub angle: f64,
    /// The second moment about that axis, m⁴.
    pub largest: f64,
    /// The second moment about the axis at right angles to it, m⁴.
    pub smallest: f64,
}

impl AreaMoments {
    /// The sums over points and weights.
    pub(super) fn of(points: &Points) -> Self {
        let mut sum = Self::default();
        for ((&x, &y), &w) in points.x.iter().zip(&points.y).zip(&points.weight) {
            sum.area += w;
            sum.first[0] += w * x;
            sum.first[1] += w * y;
            sum.i_x += w * y * y;
            sum.i_y += w * x * x;
            sum.i_xy += w * x * y;
        }
        sum.without_rounding()
    }

    /// With first moments and a product of inertia of exactly zero where they are no more than the rounding of the sums: a section that is symmetric hangs
    /// in its plane, and its weight acts on the axis.
    pub(super) fn without_rounding(mut self) -> Self {
        /// Some tens of roundings of points and weights; of Σ w |x| ≤ √(A I_y).
        const ROUNDING: f64 = 64.0 * f64::EPSILON;
        let nothing = |sum: f64, size: f64| sum.abs() <= ROUNDING * size;
        for (first, second) in self.first.iter_mut().zip([self.i_y, self.i_x]) {
            if nothing(*first, (self.area * second).abs().sqrt()) {
                *first = 0.0;
            }
        }
        if nothing(self.i_xy, (self.i_x * self.i_y).abs().sqrt()) {
            self.i_xy = 0.0;
        }
        self
    }

    /// (∫x³, ∫x²y, ∫xy², ∫y³) dA over points and weights.
    pub(super) fn third(points: &Points) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for ((&x, &y), &w) in points.x.iter().zip(&points.y).zip(&points.weight) {
            let products = [x * x * x, x * x * y, x * y * y, y * y * y];
            sum = std::array::from_fn(|i| sum[i] + w * products[i]);
        }
        sum
    }

    /// The polar moment J = I_x + I_y, m⁴: the torsion constant of a section that cannot warp.
    pub fn polar(&self) -> f64 {
        self.i_x + self.i_y
    }

    /// The centroid (∫x dA, ∫y dA)/A, m.
    pub fn centroid(&self) -> [f64; 2] {
        self.first.map(|first| first / self.area)
    }

    /// The moments about parallel axes through the centroid (Huygens–Steiner).
    ///
    /// ```math
    /// I_x^c = I_x - A y_c^2, \qquad I_y^c = I_y - A x_c^2, \qquad I_{xy}^c = I_{xy} - A x_c y_c
    /// ```
    ///
    /// A section whose centroid is far off the axis, d against a radius of gyration i, loses 2 log₁₀(d/i) digits.
    pub fn about_centroid(&self) -> Self {
        let [x, y] = self.centroid();
        Self {
            area: self.area,
            first: [0.0; 2],
            i_x: self.i_x - self.first[1] * y,
            i_y: self.i_y - self.first[0] * x,
            i_xy: self.i_xy - self.first[0] * y,
        }
    }

    /// The principal axes through the point these moments are about.
    ///
    /// ```math
    /// \tan 2\varphi = \frac{-2 I_{xy}}{I_x - I_y}, \qquad
    /// I_{1,2} = \frac{I_x + I_y}{2} \pm \sqrt{\left(\frac{I_x - I_y}{2}\right)^2 + I_{xy}^2}
    /// ```
    pub fn principal_axes(&self) -> PrincipalAxes {
        let (mean, half) = (0.5 * (self.i_x + self.i_y), 0.5 * (self.i_x - self.i_y));
        let radius = half.hypot(self.i_xy);
        // Below the rounding of the sums over the points there is no direction left.
        let round = radius <= 16.0 * f64::EPSILON * mean;
        let angle = if round { 0.0 } else { 0.5 * (-self.i_xy).atan2(half) };
        PrincipalAxes { angle, largest: mean + radius, smallest: mean - radius }
    }
}

impl std::ops::AddAssign for AreaMoments {
    fn add_assign(&mut self, other: Self) {
        self.area += other.area;
        self.first[0] += other.first[0];
        self.first[1] += other.first[1];
        self.i_x += other.i_x;
        self.i_y += other.i_y;
        self.i_xy += other.i_xy;
    }
}

impl std::ops::Mul<f64> for AreaMoments {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            area: self.area * factor,
            first: self.first.map(|first| first * factor),
            i_x: self.i_x * factor,
            i_y: self.i_y * factor,
            i_xy: self.i_xy * factor,
        }
    }
}

/// A section that knows its area: what gravity and inertia ask for.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no shape, and its area is needed",
    label = "needs a section with a shape",
    note = "a `Section` has one: `Section::new(shape, material)?`",
    note = "for gravity on a section without one, give the body a mass per length: `with_mass_per_length(kg_per_m)?`"
)]
pub trait Geometry: Send + Sync {
    /// Area and moments at arc length s, by the quadrature of the section itself.
    ///
    /// # Errors
    /// Where a size of the section is not what it must be.
    fn moments(&self, s: f64) -> Result<AreaMoments>;

    /// The same with each part weighted by its relative density: what a body's density multiplies.
    ///
    /// # Errors
    /// As [`moments`](Self::moments).
    fn weighted_moments(&self, s: f64) -> Result<AreaMoments> {
        self.moments(s)
    }

    /// The third moments (∫x³, ∫x²y, ∫xy², ∫y³) dA with each part weighted by its relative density, m⁵: zero for a section symmetric about
    /// both axes. The rotary inertia of a body with a curved reference asks for them.
    ///
    /// # Errors
    /// As [`moments`](Self::moments).
    fn weighted_third_moments(&self, s: f64) -> Result<[f64; 4]>;
}
