//! Soft rods from one function: write a strain energy density, get the wrench, its exact tangent and the solved rod.
//!
//! hyperrod = **hyper**-dual numbers + **hyper**elastic materials + **rods**. A law is written once, over any dual number. Its
//! derivatives, summed over the cross-section, are the rod's internal wrench and tangent; with them a geometrically exact
//! (Cosserat) rod is solved by Newton's method, at rest or in motion. New here? The [`guide`] goes step by step.
//!
//! ```
//! use hyperrod::load::{DeadWrench, Gravity};
//! use hyperrod::section::{Circle, Linear, Section};
//! use hyperrod::{Body, Pose, Rod, Statics, isotropic};
//! use nalgebra::vector;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let (c10, d1) = (100e3, 200e3); // Pa; E = 2 (c10 + d1) and G = 2 c10 on a rigid section
//! let silicone = isotropic!([c10: f64, d1: f64] degree 2; |i, _at| {
//!     // c10 (I₁ − 3) + d1 (J − 1)², with the pressure that makes rest stress-free
//!     i.i1_excess() * c10 + i.j() * i.j() * d1
//! });
//! let taper = Linear { from: 0.012, to: 0.006, length: 0.25 };
//! let section = Section::new(Circle::new(taper), silicone)?;
//! let arm = Body::new(0.25, section)?.with_density(1070.0)?;
//! let rod = Rod::clamped(arm, Pose::identity()) // along +Z, so gravity along −X bends it
//!     .with_load(Gravity::new(vector![-9.81, 0.0, 0.0])?)
//!     .with_tip_load(DeadWrench::force(vector![-0.2, 0.0, 0.0])?);
//!
//! let solution = Statics::default().solve(&rod)?;
//! assert!(solution.tip().pose.position.x < -0.15);
//! assert!(solution.report().error.position < 1e-6); // m, estimated
//! # Ok(()) }
//! ```
//!
//! # From the energy to the rod
//!
//! The strain energy of the rod is the integral of u over its volume, and everything else follows by differentiation:
//!
//! ```math
//! \Psi(s, \Delta\xi) = \int \nabla_{\Delta\xi} u\,dA, \qquad
//! \frac{\partial\Psi}{\partial\Delta\xi} = \int \nabla^2_{\Delta\xi} u\,dA, \qquad
//! \Psi' = \frac{\partial}{\partial s}\int \nabla_{\Delta\xi} u\,dA \Big|_{\Delta\xi}
//! ```
//!
//! | piece | in words | where |
//! |---|---|---|
//! | u | energy density, the one function you write | [`material`] |
//! | Ψ | internal wrench | [`CrossSection::wrench`](section::CrossSection::wrench) |
//! | ∂Ψ/∂Δξ | tangent, for Newton's method | [`CrossSection::tangent`](section::CrossSection::tangent) |
//! | Ψ′ | what taper, twist and grading add | [`CrossSection::wrench_rate`](section::CrossSection::wrench_rate) |
//!
//! # Conventions
//!
//! * **Order** (angular, linear): ξ = (ω, ν), Λ = (m, n). Matrices have their rows and columns in this order.
//! * **Body frame**: strains, wrenches and loads are components in the frame of the section they belong to. The
//!   [`Pose`] g = (R, p) takes that frame to space, g′ = g ξ^.
//! * The rod lies along **e₃** of its frame: a straight rod at rest has ξ* = (0, 0, 0, 0, 0, 1). Laws see
//!   **Δξ = ξ − ξ\***, a [`Strain`]; ξ itself is a [`Twist`]. They are different types.
//! * **Λ·ξ is power**: a wrench pairs with a twist component by component. Λ·η is the power of Λ at the velocity η, Ψ·δξ the work
//!   per length in a change of strain.
//! * **Balance** of a static rod under the load f̄ = (l, f) per length of the reference, Λ being what the part beyond s does to
//!   the part before it:
//!
//! ```math
//! \Lambda' = \mathrm{ad}_\xi^{\mathsf T} \Lambda - \bar f, \qquad
//! m' = -\omega \times m - \nu \times n - l, \qquad
//! n' = -\omega \times n - f, \qquad
//! \mathrm{ad}_\xi = \begin{bmatrix} \hat\omega & 0 \\ \hat\nu & \hat\omega \end{bmatrix}
//! ```
//!
//! * A point (x, y) of a **rigid section** has one column of strain, from which all invariants follow as deviations from rest:
//!
//! ```math
//! F = I + \gamma \otimes e_3, \qquad \gamma = \Delta\nu + \Delta\omega \times (x, y, 0) = (a, b, e), \qquad
//! I_1 - 3 = a^2 + b^2 + e(2+e), \qquad I_2 - 3 = a^2 + b^2 + 2e(2+e), \qquad J - 1 = e
//! ```
//!
//! * **I_x = ∫y² dA, I_y = ∫x² dA**: I_x resists ω_x, the bending about the x axis of the section.
//! * **SI units** throughout: m, kg, s, N, Pa, rad.
//!
//! # Notation
//!
//! | symbol | type | meaning | unit |
//! |---|---|---|---|
//! | s | `f64` | arc length of the reference | m |
//! | x, y | [`Point`](material::Point) | coordinates in the section | m |
//! | g = (R, p) | [`Pose`] | rotation and position of a section | –, m |
//! | ξ = (ω, ν) | [`Twist`] | strain twist, g′ = g ξ^ | 1/m, – |
//! | ξ* | [`Reference`](material::Reference) | strain twist at rest, and ξ*′ | 1/m, – |
//! | Δξ = (Δω, Δν) | [`Strain`] | change of the strain twist from rest | 1/m, – |
//! | Λ = (m, n), Ψ | [`Wrench`] | internal wrench; Ψ as the law gives it | N m, N |
//! | u | [`Isotropic`](material::Isotropic), [`Local`](material::Local), [`Sectional`](material::Sectional) | energy density | J/m³ |
//! | U | [`Response::energy`](material::Response) | energy per length, ∫u dA | J/m |
//! | ∂Ψ/∂Δξ, K | `Matrix6<f64>` | tangent of a section | N m², N m, N |
//! | Ψ′ | [`Wrench`] | ∂Ψ/∂s at fixed Δξ | N, N/m |
//! | γ = (a, b, e) | [`Deformation`](material::Deformation) | third column of F − I | – |
//! | I₁, I₂, J | [`Invariants`](material::Invariants) | invariants of FᵀF, kept as deviations from rest | – |
//! | A, I_x, I_y | [`AreaMoments`](section::AreaMoments) | area, ∫y² dA, ∫x² dA | m², m⁴ |
//! | f̄ = (l, f) | [`Load`](load::Load) | load per length of the reference, body frame | N, N/m |
//! | ad, Ad, dexp | [`TwistMap`] | 6×6 maps [[A, 0], [B, A]] | |
//!
//! # Corrections to the source text
//!
//! The theory follows a text on rods with general energies, "More Complex Material and Geometric Properties". Three of its
//! statements are kept in a corrected form.
//!
//! 1. **Its Mooney–Rivlin energy is not free of stress at rest.** The invariants begin with a term linear in J − 1, so
//!
//!    ```math
//!    u = C_1 (I_1 - 3) + C_2 (I_2 - 3), \qquad \Psi(0) = (0, 0, 0,\; 0, 0, (2C_1 + 4C_2) A)
//!    ```
//!
//!    Ψ = K Δξ holds, and then exactly, for the energy with its reference pressure,
//!
//!    ```math
//!    u = C_1 (I_1 - 3) + C_2 (I_2 - 3) - (2C_1 + 4C_2)(J - 1)
//!    ```
//!
//!    [`ReferencePressure`](material::ReferencePressure) makes that of any isotropic law, and
//!    [`StressFree`](material::StressFree) takes Ψ(0)·Δξ off any material.
//! 2. **x² and y² are swapped in the bending rows of its matrix.** The fibre strain is e = Δν_z + Δω_x y − Δω_y x, so
//!
//!    ```math
//!    K_{11} = E \int y^2\,dA = E I_x, \qquad K_{22} = E \int x^2\,dA = E I_y
//!    ```
//!
//!    It shows on any section with I_x ≠ I_y, such as a rectangle.
//! 3. **Its E and G are those of a section that cannot contract.** For Mooney–Rivlin with its reference pressure,
//!
//!    ```math
//!    E_\text{rigid} = 2C_1 + 4C_2, \qquad E_\text{rubber} = 6(C_1 + C_2), \qquad G = 2C_1 + 2C_2
//!    ```
//!
//!    where the second is the Young's modulus of the incompressible rubber itself. A compressible law on a rigid section likewise has the axial
//!    modulus λ + 2μ instead of E = μ(3λ + 2μ)/(λ + μ). On a rigid section, choose the constants for the moduli the rod shall
//!    have; a [`Relaxed`](section::Relaxed) one takes those of the material.
//!
//! # Layers
//!
//! A module uses only those above it in this list.
//!
//! | module | what lives there |
//! |---|---|
//! | [`error`] | one error type with structured fields |
//! | [`scalar`] | [`Scalar`], the bound a law is written over; the packed [`Jet`](scalar::Jet) the engine runs it on; primitives that keep the digits of small strains |
//! | [`lie`] | SO(3) and SE(3): exp, log, Ad, ad, dexp; twists, strains and wrenches |
//! | [`quadrature`] | rules on lines and plane shapes, exact to a stated degree, with positive weights; compression |
//! | [`material`] | energy densities, the laws at hand, and their derivatives at a point and over a section |
//! | [`section`] | shapes that may vary along s, composites, resultants, [sections that relax](section::Relaxed), [actuators](section::Actuator); Δξ to U, Ψ, ∂Ψ/∂Δξ and Ψ′; [`check`](section::check) |
//! | [`body`] | length, section, reference strain, [fixed strains](body::Constraint); mass and viscosity where a scene asks for them |
//! | [`load`] | what acts per length or at a point, with exact derivatives, also by closures |
//! | [`rod`] | the scene with its supports and joints, the strong form, and the collocation element in the strains |
//! | [`solve`] | statics to an accuracy or on a mesh, stability, paths and critical loads; [dynamics](solve::dynamics) and modes; reports |
//! | [`output`] | solutions as CSV, VTK and, with the feature `serde`, JSON |
//! | [`guide`] | chapters that teach the rest |
//!
//! # Ladder of models
//!
//! Each row is a choice, with the simplest first; take the first that is true of your rod, or let [`solve::suggest`] estimate how far off a simpler
//! one is ([chapter](guide::models)). `cargo run --release --example engine_speed` prints
//! what the levels of a law, the requests and the quadratures cost, as ratios to derivatives taken by hand; the table of
//! [`material`] says how exact they are, and `cargo run --release --example material_check` what a law does in a section.
//!
//! | choice | rungs |
//! |---|---|
//! | strains | all six; fixed ones by [`Constraint`](body::Constraint): Kirchhoff, planar, any subset, exactly; what that costs against the full rod is printed by `cargo run --release --example constrained_speed` |
//! | section | [`Stiffness`](section::Stiffness): Ψ = K Δξ with numbers you measured; [`Resultants`](section::Resultants): an energy per length in Δξ, such as a [`Ribbon`](section::Ribbon); [`Section`](section::Section): an energy density on a section that stays plane and rigid; [`Composite`](section::Composite): several of them; [`Relaxed`](section::Relaxed): one that contracts, ovalises and warps, by the rungs of [`Warping`](section::Warping) (`cargo run --release --example section_ladder` has their errors) |
//! | level of the law | [`Isotropic`](material::Isotropic): u(I₁−3, I₂−3, J−1), 2 variables (a² + b² and e); [`Local`](material::Local): u(F), 3; [`Sectional`](material::Sectional): u(Δξ, x, y), 6; one more, s, for Ψ′ on a section that varies. A quadratic law that says it is uniform is integrated once, at rest |
//! | way to write it | a trait, or [`isotropic!`], [`local!`], [`sectional!`] in closure syntax; [`material::isotropic`] and its siblings: a real closure, which always pays for every variable and misses what the compiler does for a type |
//! | shape along s | a number; [`Linear`](section::Linear); a closure of s over a dual number; and any shape [`scaled`](section::Shape::scaled), [`rotated`](section::Shape::rotated) or [`shifted`](section::Shape::shifted) |
//! | reference | straight; a constant ξ*; a function of s ([`ReferenceShape`](body::ReferenceShape)) |
//! | quadrature | exact for a law with a stated degree; for another, of degree [`Section::DEFAULT_DEGREE`](section::Section::DEFAULT_DEGREE) or what [`with_degree`](section::Section::with_degree) or [`with_tolerance`](section::Section::with_tolerance) asks for |
//! | actuators | none; [`Tendon`](section::Tendon)s by tension or [by length](Statics::solve_tendon_length); [`PressureChamber`](section::PressureChamber)s; your own [`Actuator`](section::Actuator) |
//! | element | [`Order`](solve::Order) 2, 4 or 6: one, two or three Gauss stages; [`Statics::to`] chooses the mesh for an error |
//! | time | statics; [`Dynamics`](solve::dynamics::Dynamics) with [`Scheme`](solve::dynamics::Scheme) ESDIRK4(3) or generalised-α, fixed or adaptive steps |
//! | mass | none; [`with_density`](Body::with_density); [`with_mass_per_length`](Body::with_mass_per_length) |
//!
//! # What is not there yet
//!
//! * Rods joined to rods; joints inside a rod that release a freedom; contact; gradients of a solve in its parameters.
//! * Dynamics with ρ∞ = 1 under fixed strains or supports beyond the base: refused by name.
//! * Thin-walled and re-entrant sections that relax: polynomials serve them poorly.

/// The dual numbers that sizes, angles and references along s are functions of: `use hyperrod::num_dual::{Dual64, DualNum};`
#[doc(no_inline)]
pub use num_dual;

pub mod body;
/// Errors: which quantity, which value, where.
pub mod error;
pub mod guide;
pub mod lie;
pub mod load;
pub mod material;
pub mod output;
pub mod quadrature;
pub mod rod;
pub mod scalar;
pub mod section;
pub mod solve;

pub use body::Body;
pub use error::{Error, Result};
pub use lie::{Pose, Strain, Twist, TwistMap, Wrench};
pub use rod::Rod;
pub use scalar::Scalar;
pub use solve::{StaticSolution, Statics};

/// The README's examples, compiled and run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
