use crate::error::Result;

/// Area and first and second moments of a section about the axis of the rod.
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

impl AreaMoments {
    /// The polar moment J = I_x + I_y, m⁴: the torsion constant of a section that cannot warp.
    pub fn polar(&self) -> f64 {
        self.i_x + self.i_y
    }
}

/// A section that knows its area: what gravity and inertia ask for.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no geometry, so its mass cannot be computed from a density",
    note = "a `Section` has one; for a `Stiffness`, give the body a mass per length instead"
)]
pub trait Geometry: Send + Sync {
    /// Area and moments at arc length s, by the quadrature of the section itself.
    ///
    /// # Errors
    /// Where a size of the section is not what it must be.
    fn moments(&self, s: f64) -> Result<AreaMoments>;
}
