//! The theory, equation by equation, with the code beside it, and the three corrections to the source text.
//!
//! Conventions (order, frames, signs) are on the [page of the crate](crate#conventions). Every block below runs.
//!
//! # 1. Kinematics
//!
//! A section sits at g(s) = (R, p). Its strain twist ξ = (ω, ν) and that of the rest shape ξ* give the change Δξ the laws see:
//!
//! ```math
//! g' = g\,\hat\xi, \qquad \Delta\xi = \xi - \xi^*, \qquad g(s + h) = g(s)\,\exp(h\,\hat\xi) \ \text{ for constant } \xi
//! ```
//!
//! ```
//! use hyperrod::{Pose, Strain, Twist};
//! use std::f64::consts::PI;
//! let mut strain = Strain::zero();
//! strain.angular.y = PI / 2.0; // a quarter of a turn per metre, about y
//! let xi = Twist::straight() + strain;
//! let end = Pose::identity() * xi.exp(); // one metre further
//! assert!((end.position.x - 2.0 / PI).abs() < 1e-15); // on a circle of radius 2/π
//! ```
//!
//! # 2. Deformation of a rigid section
//!
//! ```math
//! \gamma = \Delta\nu + \Delta\omega \times (x, y, 0) = (a, b, e), \qquad F = I + \gamma \otimes e_3
//! ```
//! ```math
//! I_1 - 3 = a^2 + b^2 + e(2+e), \qquad I_2 - 3 = a^2 + b^2 + 2e(2+e), \qquad J - 1 = e
//! ```
//!
//! ```
//! use hyperrod::Strain;
//! use hyperrod::material::{Deformation, Point};
//! let strain = Strain::from_array([3.0, -2.0, 1.0, 0.1, 0.2, 0.05]);
//! let f = Deformation::of(&strain, &Point { x: 0.01, y: 0.02, s: 0.0 });
//! let (a, b) = (0.1 - 1.0 * 0.02, 0.2 + 1.0 * 0.01);
//! let e = 0.05 + 3.0 * 0.02 + 2.0 * 0.01;
//! let i = f.invariants();
//! assert!((i.i1() - (a * a + b * b + e * (2.0 + e))).abs() < 1e-15);
//! assert!((i.i2() - (a * a + b * b + 2.0 * e * (2.0 + e))).abs() < 1e-15);
//! assert!((i.j() - e).abs() < 1e-15);
//! ```
//!
//! About a rest shape that is curved, F is the same with the columns of the rest shape divided out; the crate does that exactly
//! ([`Section`](crate::section::Section)).
//!
//! # 3. From the energy to the wrench
//!
//! ```math
//! U = \int u\,dA, \qquad \Psi = \int \nabla_{\Delta\xi} u\,dA, \qquad
//! \frac{\partial\Psi}{\partial\Delta\xi} = \int \nabla^2_{\Delta\xi} u\,dA, \qquad \Psi' = \frac{\partial \Psi}{\partial s}\Big|_{\Delta\xi}
//! ```
//!
//! One call, [`CrossSection::respond`](crate::section::CrossSection::respond), gives as many of them as are asked for. Differentiation is
//! automatic; that Ψ is the slope of U is an identity to look at, not something to program:
//!
//! ```
//! use hyperrod::Strain;
//! use hyperrod::material::{NeoHookean, Request, Station};
//! use hyperrod::section::{Circle, CrossSection, Linear, Section};
//! # fn main() -> hyperrod::Result<()> {
//! let taper = Linear { from: 0.010, to: 0.006, length: 0.2 };
//! let section = Section::new(Circle::new(taper), NeoHookean::new(200e3, 300e3)?)?;
//! let at = Station::straight(0.05);
//! let xi = Strain::from_array([2.0, 1.0, 3.0, 0.05, 0.0, 0.1]);
//! let r = section.respond(&at, &xi, Request::Rate)?;
//! let direction = Strain::from_array([1.0, 0.0, 0.5, 0.0, 0.01, 0.02]);
//! let h = 1e-4;
//! let energy = |h: f64| section.energy(&at, &(xi + direction * h));
//! let slope = (energy(h)? - energy(-h)?) / (2.0 * h);
//! assert!((slope - direction.pair(&r.wrench)).abs() < 1e-7 * slope.abs());
//! // Ψ′: what the taper adds
//! let ahead = section.wrench(&Station::straight(0.05 + 1e-6), &xi)?;
//! let behind = section.wrench(&Station::straight(0.05 - 1e-6), &xi)?;
//! let rate = (ahead - behind) * 0.5e6;
//! assert!((rate - r.wrench_rate).to_vector().norm() < 1e-6 * rate.to_vector().norm());
//! # Ok(()) }
//! ```
//!
//! # 4. Balance
//!
//! ```math
//! \Lambda' = \mathrm{ad}_\xi^{\mathsf T} \Lambda - \bar f + M\dot\eta - \mathrm{ad}_\eta^{\mathsf T} M \eta, \qquad \Lambda = \Psi(s, \Delta\xi)
//! ```
//!
//! In statics the last two terms are absent. [`Wrench::ad_transpose`](crate::Wrench::ad_transpose) is the first; f̄ is what a
//! [`Load`](crate::load::Load) gives. Without loads the wrench is constant in space, whatever the shape:
//!
//! ```
//! use hyperrod::load::DeadWrench;
//! use hyperrod::section::Stiffness;
//! use hyperrod::{Body, Pose, Rod, Statics};
//! use nalgebra::vector;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let body = Body::new(1.0, Stiffness::diagonal([1.0, 1.0, 0.8, 1e4, 1e4, 3e4])?)?;
//! let force = vector![2.0, 1.0, -1.0];
//! let rod = Rod::clamped(body, Pose::identity()).with_tip_load(DeadWrench::force(force)?);
//! let solution = Statics::default().solve(&rod)?;
//! for node in solution.nodes() {
//!     assert!((node.pose.rotation * node.wrench.force - force).norm() < 1e-9);
//! }
//! # Ok(()) }
//! ```
//!
//! # 5. The strong form
//!
//! Solved for the rate of the strain, with loads that depend on that rate themselves, f̄ = −(Ā ξ′ + B̄):
//!
//! ```math
//! \xi' = \left(\frac{\partial\Psi}{\partial\Delta\xi} - \bar A\right)^{-1}
//!   \left(M\dot\eta - \mathrm{ad}_\eta^{\mathsf T} M\eta + \mathrm{ad}_\xi^{\mathsf T}\Psi - \Psi' + \frac{\partial\Psi}{\partial\Delta\xi}\,(\xi^*)' + \bar B\right)
//! ```
//!
//! The crate does not integrate this: it solves the balance by collocation in the strains
//! (`docs/decisions/001-strains-first-collocation.md` in the repository), and takes the defect of the strong form
//! between the collocation points as the measure of error that refines the mesh. Ā and B̄ of tendons and pressure are not coded either:
//! they are −∂²U/∂ξ² and what goes with it, of their [energy](crate::section::Actuator).
//!
//! # 6. The corrections
//!
//! The theory follows a text on rods with general energies, "More Complex Material and Geometric Properties". Three of its statements do not hold as
//! they stand.
//!
//! **Rest is not free of stress.** C₁(I₁−3) + C₂(I₂−3) has the slope 2C₁ + 4C₂ in J − 1 at rest, so Ψ(0) = (0, 0, 0, 0, 0, (2C₁+4C₂)A).
//! With the pressure −(2C₁+4C₂)(J−1) the law is exactly linear in this kinematics:
//!
//! ```math
//! u = (C_1 + C_2)(a^2 + b^2) + (C_1 + 2C_2)\,e^2
//! ```
//!
//! **x² and y² are swapped in the bending rows.** e = Δν_z + Δω_x y − Δω_y x, so bending about x goes with y.
//!
//! **E and G are those of a section that cannot contract.** E = 2C₁ + 4C₂ belongs to uniaxial *strain*. The rubber itself, incompressible and free to
//! contract, has
//!
//! ```math
//! E = 6(C_1 + C_2) = 3G, \qquad G = 2(C_1 + C_2)
//! ```
//!
//! All three in numbers, on a rectangle:
//!
//! ```
//! use hyperrod::Strain;
//! use hyperrod::material::{MooneyRivlin, ReferencePressure, Station};
//! use hyperrod::section::{CrossSection, Rectangle, Relaxed, Section, Warping};
//! # fn main() -> hyperrod::Result<()> {
//! let (c1, c2, width, height) = (120e3, 40e3, 0.02, 0.01);
//! let (area, at, rest) = (width * height, Station::straight(0.0), Strain::zero());
//! let law = MooneyRivlin::new(c1, c2)?;
//! let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
//!
//! let raw = Section::new(Rectangle::new(width, height), law)?;
//! close(raw.wrench(&at, &rest)?.force.z, (2.0 * c1 + 4.0 * c2) * area);
//!
//! let free = Section::new(Rectangle::new(width, height), ReferencePressure(law))?;
//! assert_eq!(free.wrench(&at, &rest)?.to_array(), [0.0; 6]);
//! let k = free.tangent(&at, &rest)?;
//! let young = 2.0 * c1 + 4.0 * c2;
//! close(k[(0, 0)], young * width * height.powi(3) / 12.0); // E ∫y² dA about x
//! close(k[(1, 1)], young * height * width.powi(3) / 12.0); // E ∫x² dA about y
//!
//! let shape = Rectangle::new(width, height);
//! let rubber = Relaxed::incompressible(shape, ReferencePressure(law))?;
//! let rubber = rubber.with_warping(Warping::CONTRACTION)?;
//! let flexible = rubber.tangent(&at, &rest)?;
//! assert!((flexible[(5, 5)] / (6.0 * (c1 + c2) * area) - 1.0).abs() < 1e-9);
//! # Ok(()) }
//! ```
//!
//! # 7. Sections that relax
//!
//! ```math
//! U(\Delta\xi) = \min_q \int u(F(\Delta\xi, q))\,dA, \qquad \frac{\partial\Psi}{\partial\Delta\xi} = U_{\xi\xi} - U_{\xi q} U_{qq}^{-1} U_{q\xi}
//! ```
//!
//! [`Relaxed`](crate::section::Relaxed): Poisson contraction, torsion constants, shear factors, Poynting's and Brazier's effects come out of u.
//! See [the choice of a section](super::sections).
