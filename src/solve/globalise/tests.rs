//! Models of the energy under heavy compression.

use nalgebra::{Matrix3, vector};

use crate::body::Constraint;
use crate::lie::{Strain, Wrench};
use crate::rod::Support;
use crate::section::Stiffness;
use crate::solve::equilibrium::Configuration;
use crate::solve::globalise::descend::{descend, turned_aside};
use crate::solve::globalise::elsewhere::elsewhere;
use crate::solve::linear::Buffers;
use crate::solve::mesh::Mesh;
use crate::solve::newton::scale;
use crate::solve::scale::Scale;
use crate::solve::stability::{Verdict, chain};
use crate::solve::unknowns::Unknowns;
use crate::{Body, Pose, Rod};

#[test]
fn a_stiff_enough_model_of_a_heavily_compressed_rod_is_convex_on_any_mesh() {
    let section = Stiffness::diagonal([1.0, 1.5, 1.0, 1e5, 1e5, 3e5]).unwrap();
    let far = Pose::new(Matrix3::identity(), vector![0.0, 0.0, 0.9]);
    let body = Body::new(1.0, section).unwrap();
    let rod = Rod::between(body, Support::clamped(Pose::identity()), Support::clamped(far));
    for elements in [8, 20, 33, 64] {
        let mesh = Mesh::<_, 3>::uniform(&rod, elements);
        let strain = Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, -0.1]);
        let tip = Wrench::new(vector![0.0, 0.0, 0.0], vector![0.0, 0.0, -3e4]);
        let unknowns = Unknowns { strains: vec![[strain; 3]; elements], tip, ..Unknowns::at_rest(&mesh) };
        let mut state = Configuration::default();
        mesh.configure(&unknowns, &mut state).unwrap();
        let scale = scale(&mesh, &state);
        // (2π)² (1 + μ) > P (1 + P/GA …) ≈ 4e4
        for mu in [0.0, 1e2, 1.2e3, 1e4, 1e6, 1e9, 1e14] {
            let mut model = state.clone();
            model.response.iter_mut().flatten().for_each(|response| response.tangent *= 1.0 + mu);
            let mut buffers = Buffers::<3>::default();
            buffers.condense(&mesh, &unknowns, &model).unwrap();
            let scale = Scale { force: scale.force * (1.0 + mu), ..scale };
            let verdict = chain(&mesh, &model, &buffers.condensed, &scale).unwrap().verdict(1e-11);
            if mu > 1e3 {
                assert!(
                    matches!(verdict, Verdict::Index { unstable: 0, .. }),
                    "{elements}, {mu:e}: {verdict:?}"
                );
            }
        }
    }
}

#[test]
fn a_compressed_rod_goes_down_to_its_buckled_shape() {
    let section = Stiffness::diagonal([1.0, 1.5, 1.0, 1e5, 1e5, 3e5]).unwrap();
    let far = Pose::new(Matrix3::identity(), vector![0.0, 0.0, 0.9]);
    let body = Body::new(1.0, section).unwrap();
    let rod = Rod::between(body, Support::clamped(Pose::identity()), Support::clamped(far));
    for elements in [16, 33] {
        let mesh = Mesh::<_, 3>::uniform(&rod, elements);
        let strain = Strain::from_array([0.0, 0.0, 0.0, 0.0, 0.0, -0.1]);
        let tip = Wrench::new(vector![0.0, 0.0, 0.0], vector![0.0, 0.0, -3e4]);
        let straight = Unknowns { strains: vec![[strain; 3]; elements], tip, ..Unknowns::at_rest(&mesh) };
        let (mut buffers, mut history) = (Buffers::<3>::default(), Vec::new());
        let found = descend(&mesh, &turned_aside(&mesh, &straight), 50, &mut buffers, &mut history);
        assert!(found.is_some(), "{elements}: {} iterations", history.len());
    }
}

#[test]
fn a_rod_bent_a_little_at_rest_is_found_buckled_from_any_start() {
    let section = Stiffness::diagonal([1.0, 1.5, 1.0, 1e5, 1e5, 3e5]).unwrap();
    let far = Pose::new(Matrix3::identity(), vector![0.0, 0.0, 0.9]);
    for imperfection in [1e-4, 0.0] {
        let bent = crate::Twist::from_array([8.0 * imperfection, 0.0, 0.0, 0.0, 0.0, 1.0]);
        let body = Body::new(1.0, section).unwrap().with_reference_strain(bent).unwrap();
        let rod = Rod::between(body, Support::clamped(Pose::identity()), Support::clamped(far));
        let solution = crate::Statics::to(1e-8)
            .solve(&rod)
            .unwrap_or_else(|e| panic!("{imperfection}: {e} {:?}", e.report.rungs));
        assert!(!solution.report().stability.is_unstable());
    }
}

#[test]
fn no_start_has_a_strain_that_is_fixed() {
    for mask in 0..64 {
        let fixed: [bool; 6] = std::array::from_fn(|j| mask & (1 << j) != 0);
        let section = Stiffness::diagonal([1.0, 1.5, 1.0, 1e5, 1e5, 3e5]).unwrap();
        let body = Body::new(1.0, section).unwrap().with_constraint(Constraint::fixing(fixed));
        let rod = Rod::clamped(body, Pose::identity());
        let mesh = Mesh::<_, 3>::uniform(&rod, 4);
        for start in [elsewhere(&mesh, 1), turned_aside(&mesh, &Unknowns::at_rest(&mesh))] {
            let bent =
                start.strains.iter().flatten().flat_map(|strain| strain.to_array().into_iter().zip(fixed));
            assert!(bent.clone().all(|(strain, fixed)| !fixed || strain == 0.0), "{fixed:?}");
            // and what can be bent, is
            assert!(fixed[0] || bent.clone().any(|(strain, _)| strain != 0.0), "{fixed:?}");
        }
    }
}
