use super::differentiate::{
    Fibre, FibreResponse, Level, TwoWays, isotropic_response, isotropic_two_ways, local_response,
    local_two_ways,
};
use super::gradient::{GradientResponse, GradientSite, isotropic_gradient_response, local_gradient_response};
use super::kinematics::{Deformation, Invariants, Point};
use super::response::Response;
use super::stress_free::WithoutPressure;
use super::task::Task;
use super::three::Three;
use crate::error::Result;
use crate::lie::Strain;
use crate::scalar::{Jet, Lane, Scalar};

/// An energy density that depends on the invariants of the deformation alone: u(I₁−3, I₂−3, J−1), J/m³.
///
/// The cheapest level: two variables are differentiated instead of six. `at` is the point, for laws graded over the section or along the
/// rod; most ignore it.
///
/// ```
/// use hyperrod::Scalar;
/// use hyperrod::material::{Invariants, Isotropic, Point};
///
/// struct Rubber { c1: f64, c2: f64 }
///
/// impl Isotropic for Rubber {
///     #[inline(always)]
///     fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
///         i.i1() * self.c1 + i.i2() * self.c2
///     }
/// }
/// ```
pub trait Isotropic: Send + Sync {
    /// The strain energy per reference volume, J/m³.
    ///
    /// **Mark it `#[inline(always)]`**, and functions of your own that it calls: it then runs on the vector registers of the machine. A function that is
    /// called and not inlined is compiled for the oldest machine there is, and is more than ten times slower.
    fn energy_density<D: Scalar>(&self, invariants: &Invariants<D>, at: &Point<D>) -> D;

    /// The degree of the energy density as a polynomial in the strain, and in x and y for a law graded over the section; `None` where it
    /// is not one.
    fn degree(&self) -> Option<usize> {
        None
    }

    /// Whether the energy density is the same at every s, that is, ignores `at.s`. A uniform quadratic one is integrated once and for all.
    fn is_uniform(&self) -> bool {
        false
    }

    /// Whether the energy density is the same everywhere in a section, that is, ignores `at.x` and `at.y`. Bending in a plane then takes as many points as
    /// there are different places across it: half of them or fewer.
    fn is_homogeneous(&self) -> bool {
        false
    }

    /// Where the law is defined, in words for an error message.
    fn domain(&self) -> &'static str {
        "where the energy density is finite"
    }

    /// The energy density with the pressure taken off that the law has at rest, u − p(J−1), with p = ∂u/∂J at rest, where it can be written without
    /// cancellation; `None`, the default, where the difference is to be taken. [`ReferencePressure`](super::ReferencePressure) asks for it.
    #[inline(always)]
    fn stress_free_energy_density<D: Scalar>(&self, invariants: &Invariants<D>, at: &Point<D>) -> Option<D> {
        let _ = (invariants, at);
        None
    }

    /// The energy density in the numbers of the engine. The library's business.
    #[doc(hidden)]
    #[inline(always)]
    fn evaluate<L: Lane, const N: usize, const M: usize>(
        &self,
        invariants: &Invariants<Jet<L, N, M>>,
        at: &Point<Jet<L, N, M>>,
    ) -> Jet<L, N, M> {
        self.energy_density(invariants, at)
    }

    /// The sums over a section. The library's business: its own laws have it compiled with it (`compiled_here`).
    #[doc(hidden)]
    fn perform(&self, task: &mut Task<'_>) -> Result<Response>
    where
        Self: Sized,
    {
        task.perform(self)
    }

    /// The sums of the law with the pressure taken off that it has at rest, likewise.
    #[doc(hidden)]
    fn perform_stress_free(&self, task: &mut Task<'_>) -> Result<Response>
    where
        Self: Sized,
    {
        task.perform(&WithoutPressure(self))
    }
}

/// An energy density of the deformation gradient at a point: u(F), J/m³.
///
/// Three variables are differentiated, the third column of F − I.
///
/// ```
/// use hyperrod::Scalar;
/// use hyperrod::material::{Deformation, Local, Point};
///
/// /// Fibres along the rod, twice as stiff at the upper rim (y = h) as at the middle.
/// struct Graded { young: f64, h: f64 }
///
/// impl Local for Graded {
///     #[inline(always)]
///     fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
///         let stretch = f.gamma().z;
///         stretch * stretch * (at.y / self.h + 1.0) * (0.5 * self.young)
///     }
/// }
/// ```
pub trait Local: Send + Sync {
    /// The strain energy per reference volume, J/m³.
    ///
    /// **Mark it `#[inline(always)]`**, and functions of your own that it calls: it then runs on the vector registers of the machine. A function that is
    /// called and not inlined is compiled for the oldest machine there is, and is more than ten times slower.
    fn energy_density<D: Scalar>(&self, deformation: &Deformation<D>, at: &Point<D>) -> D;

    /// The degree of the energy density as a polynomial in the strain, and in x and y for a law graded over the section; `None` where it
    /// is not one.
    fn degree(&self) -> Option<usize> {
        None
    }

    /// Whether the energy density is the same at every s, that is, ignores `at.s`. A uniform quadratic one is integrated once and for all.
    fn is_uniform(&self) -> bool {
        false
    }

    /// Whether the energy density is the same everywhere in a section, that is, ignores `at.x` and `at.y`. Bending in a plane then takes as many points as
    /// there are different places across it: half of them or fewer.
    fn is_homogeneous(&self) -> bool {
        false
    }

    /// Where the law is defined, in words for an error message.
    fn domain(&self) -> &'static str {
        "where the energy density is finite"
    }

    /// The derivatives at a block of points. The library's business, overridden by the isotropic level.
    #[doc(hidden)]
    #[inline(always)]
    fn respond<L: Lane, O: Level>(&self, fibre: &Fibre<L>) -> FibreResponse<L> {
        local_response::<Self, L, O>(self, fibre)
    }

    /// The derivatives in three strains, by two variables. The library's business, overridden by the isotropic level.
    #[doc(hidden)]
    #[inline(always)]
    fn respond_in_two_ways<L: Lane, T: Three>(&self, fibre: &Fibre<L>) -> TwoWays<L> {
        local_two_ways::<Self, L, T>(self, fibre)
    }

    /// The sums over a section. The library's business, overridden by the isotropic level.
    #[doc(hidden)]
    fn perform(&self, task: &mut Task<'_>) -> Result<Response>
    where
        Self: Sized,
    {
        task.perform(self)
    }

    /// The derivatives at a block of points whose whole deformation gradient is known. The library's business, overridden by the
    /// isotropic level.
    #[doc(hidden)]
    #[inline(always)]
    fn respond_to_gradient<L: Lane, O: Level>(&self, site: &GradientSite<L>) -> GradientResponse<L> {
        local_gradient_response::<Self, L, O>(self, site)
    }
}

impl<M: Isotropic> Local for M {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, deformation: &Deformation<D>, at: &Point<D>) -> D {
        Isotropic::energy_density(self, &deformation.invariants(), at)
    }

    fn degree(&self) -> Option<usize> {
        Isotropic::degree(self)
    }

    fn is_uniform(&self) -> bool {
        Isotropic::is_uniform(self)
    }

    fn is_homogeneous(&self) -> bool {
        Isotropic::is_homogeneous(self)
    }

    fn domain(&self) -> &'static str {
        Isotropic::domain(self)
    }

    #[inline(always)]
    fn respond<L: Lane, O: Level>(&self, fibre: &Fibre<L>) -> FibreResponse<L> {
        isotropic_response::<Self, L, O>(self, fibre)
    }

    #[inline(always)]
    fn respond_in_two_ways<L: Lane, T: Three>(&self, fibre: &Fibre<L>) -> TwoWays<L> {
        isotropic_two_ways::<Self, L, T>(self, fibre)
    }

    fn perform(&self, task: &mut Task<'_>) -> Result<Response> {
        Isotropic::perform(self, task)
    }

    #[inline(always)]
    fn respond_to_gradient<L: Lane, O: Level>(&self, site: &GradientSite<L>) -> GradientResponse<L> {
        isotropic_gradient_response::<Self, L, O>(self, site)
    }
}

/// An energy density of the section's strain and the point in it: u(Δξ, x, y), J per m² of section and m of rod.
///
/// The most general level, and the dearest: six variables are differentiated. It is integrated over dA as it stands: the volume
/// of a curved reference, which the [`Local`] level accounts for, is the law's own business.
///
/// ```
/// use hyperrod::material::{Point, Sectional};
/// use hyperrod::{Scalar, Strain};
///
/// struct Stretch { young: f64 }
///
/// impl Sectional for Stretch {
///     #[inline(always)]
///     fn energy_density<D: Scalar>(&self, strain: &Strain<D>, at: &Point<D>) -> D {
///         let e = strain.linear.z + strain.angular.x * at.y - strain.angular.y * at.x;
///         e * e * (0.5 * self.young)
///     }
/// }
/// ```
pub trait Sectional: Send + Sync {
    /// The strain energy per reference area of section and length of rod, J/m³.
    ///
    /// **Mark it `#[inline(always)]`**, and functions of your own that it calls: it then runs on the vector registers of the machine. A function that is
    /// called and not inlined is compiled for the oldest machine there is, and is more than ten times slower.
    fn energy_density<D: Scalar>(&self, strain: &Strain<D>, at: &Point<D>) -> D;

    /// The degree of the energy density as a polynomial in the strain, and in x and y for a law graded over the section; `None` where it
    /// is not one.
    fn degree(&self) -> Option<usize> {
        None
    }

    /// Whether the energy density is the same at every s, that is, ignores `at.s`. A uniform quadratic one is integrated once and for all.
    fn is_uniform(&self) -> bool {
        false
    }

    /// Where the law is defined, in words for an error message.
    fn domain(&self) -> &'static str {
        "where the energy density is finite"
    }

    /// Whether the energy is one of the deformation at the point, so that J > 0 is required and the volume of a curved reference
    /// accounted for. The library's business.
    #[doc(hidden)]
    fn is_local(&self) -> bool {
        false
    }

    /// Whether the energy is one of the deformation at the point that ignores where in the section that is. The library's business.
    #[doc(hidden)]
    fn is_homogeneous(&self) -> bool {
        false
    }

    /// The sums over a section. The library's business, overridden by the cheaper levels.
    #[doc(hidden)]
    fn perform(&self, task: &mut Task<'_>) -> Result<Response>
    where
        Self: Sized,
    {
        task.perform_sectional(self)
    }
}

impl<L: Local> Sectional for L {
    #[inline(always)]
    fn energy_density<D: Scalar>(&self, strain: &Strain<D>, at: &Point<D>) -> D {
        Local::energy_density(self, &Deformation::of(strain, at), at)
    }

    fn degree(&self) -> Option<usize> {
        Local::degree(self)
    }

    fn is_uniform(&self) -> bool {
        Local::is_uniform(self)
    }

    fn is_local(&self) -> bool {
        true
    }

    fn is_homogeneous(&self) -> bool {
        Local::is_homogeneous(self)
    }

    fn domain(&self) -> &'static str {
        Local::domain(self)
    }

    fn perform(&self, task: &mut Task<'_>) -> Result<Response> {
        Local::perform(self, task)
    }
}
