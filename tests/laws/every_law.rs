//! Every law of the library, and the wrappers that bring one to each level.

use hyperrod::material::*;
use hyperrod::{Scalar, Strain};

/// What is done with each law.
pub trait Visitor {
    fn visit<L: Local + Clone + 'static>(&mut self, name: &str, law: &L);
}

const MU: f64 = 170e3;
const LAMBDA: f64 = 400e3;
const KAPPA: f64 = 500e3;
const POLY: [Coefficient; 5] =
    [((1, 0), 100e3), ((0, 1), 30e3), ((2, 0), 20e3), ((1, 1), -5e3), ((0, 2), 1.5e3)];

/// All of them but the one that is written at section level, [`LinearElastic`].
pub fn every_local_law(v: &mut impl Visitor) {
    let polynomial = Polynomial::new(&POLY, &[500e3, 200e3]).unwrap();
    let yarn = Fibres::new(Twisted::new(40.0).unwrap(), 80e3, 1.2).unwrap();
    let neo_hookean = NeoHookean::new(MU, LAMBDA).unwrap();
    v.visit("Mooney-Rivlin", &MooneyRivlin::new(120e3, 40e3).unwrap());
    v.visit("Mooney-Rivlin with pressure", &ReferencePressure(MooneyRivlin::new(120e3, 40e3).unwrap()));
    v.visit("neo-Hookean", &neo_hookean);
    v.visit("neo-Hookean with pressure", &ReferencePressure(neo_hookean));
    v.visit("isochoric neo-Hookean", &IsochoricNeoHookean::new(MU, KAPPA).unwrap());
    v.visit("polynomial", &polynomial);
    v.visit("polynomial with pressure", &ReferencePressure(polynomial));
    v.visit("isochoric polynomial", &IsochoricPolynomial::new(&POLY, &[500e3, 200e3]).unwrap());
    v.visit("Yeoh", &Yeoh::new([85e3, -4e3, 1e3], [250e3, 1e3, 0.0]).unwrap());
    v.visit("Gent", &Gent::new(MU, LAMBDA, 30.0).unwrap());
    v.visit("Arruda-Boyce", &ArrudaBoyce::new(MU, KAPPA, 3.0).unwrap());
    v.visit("Ogden", &Ogden::new(&[(100e3, 1.3), (2e3, 5.0), (-40e3, -2.0)], LAMBDA).unwrap());
    v.visit("Fung", &Fung::new(MU, KAPPA, 2.5).unwrap());
    v.visit("Saint Venant-Kirchhoff", &SaintVenantKirchhoff::new(MU, LAMBDA).unwrap());
    v.visit("Hencky", &Hencky::new(MU, LAMBDA).unwrap());
    v.visit("Blatz-Ko", &BlatzKo::new(MU, 0.3, 0.4).unwrap());
    v.visit("Blatz-Ko foam", &BlatzKo::foam(MU).unwrap());
    v.visit("Holzapfel-Gasser-Ogden", &HolzapfelGasserOgden::artery([MU, KAPPA], [80e3, 1.2], 0.5).unwrap());
    v.visit("yarn", &Sum(neo_hookean, yarn));
    v.visit("fibres alone", &Fibres::new(Straight::axial(), 80e3, 1.2).unwrap());
    v.visit("scaled", &Scaled::new(0.25, neo_hookean).unwrap());
}

/// A law differentiated in γ, whatever level it is written at.
#[derive(Clone)]
pub struct AtLocalLevel<L>(pub L);

impl<L: Local> Local for AtLocalLevel<L> {
    fn energy_density<D: Scalar>(&self, f: &Deformation<D>, at: &Point<D>) -> D {
        self.0.energy_density(f, at)
    }

    // a law less to compile for few strains
    fn perform(&self, task: &mut Task<'_>) -> hyperrod::Result<Response> {
        task.perform_in_all(self)
    }
}

/// A law differentiated in Δξ, whatever level it is written at.
#[derive(Clone)]
pub struct AtSectionLevel<L>(pub L);

impl<L: Local> Sectional for AtSectionLevel<L> {
    fn energy_density<D: Scalar>(&self, strain: &Strain<D>, at: &Point<D>) -> D {
        self.0.energy_density(&Deformation::of(strain, at), at)
    }

    fn perform(&self, task: &mut Task<'_>) -> hyperrod::Result<Response> {
        task.perform_sectional_in_all(self)
    }
}

/// The law as a closure of the deformation, and of the strain.
pub fn as_closures<L: Local + Clone + 'static>(law: &L) -> [Box<dyn Material>; 2] {
    let (a, b) = (law.clone(), law.clone());
    [
        Box::new(local(move |f, at| a.energy_density(f, at))),
        Box::new(sectional(move |xi, at| b.energy_density(&Deformation::of(xi, at), at))),
    ]
}
