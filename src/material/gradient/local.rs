use nalgebra::{Matrix3, SMatrix, SVector};
use num_dual::{Derivative, Dual2SVec64};

use super::{GradientResponse, GradientSite, STIFFNESS, packed};
use crate::material::differentiate::Level;
use crate::material::kinematics::{Deformation, Point};
use crate::material::law::Local;
use crate::material::response::Request;
use crate::scalar::Lane;
use crate::scalar::lane::MAX_LANES;

/// Nine variables, one point at a time; s as a tenth where Ψ′ is wanted.
pub(in crate::material) fn local_gradient_response<M: Local + ?Sized, L: Lane, O: Level>(
    law: &M,
    site: &GradientSite<L>,
) -> GradientResponse<L> {
    let mut lanes = [[0.0; MAX_LANES]; 1 + 9 + STIFFNESS + 9];
    for lane in 0..L::LANES {
        let h: [f64; 9] = std::array::from_fn(|c| site.h[c].lane(lane));
        let [x, y] = site.position.map(|v| v.lane(lane));
        let at = Point { x, y, s: site.s.lane(lane) };
        if O::REQUEST < Request::Rate {
            let f = Deformation::from_gradient(&variables::<9>(&h));
            read(&law.energy_density(&f, &at.cast()), lane, &mut lanes);
            continue;
        }
        let [dx, dy] = site.position_rate.map(|v| v.lane(lane));
        let moving = |value: f64, rate: f64| {
            let mut v = SVector::<f64, 10>::zeros();
            v[9] = rate;
            Dual2SVec64::<10>::new(value, Derivative::some(v.transpose()), Derivative::none())
        };
        let at = Point { x: moving(at.x, dx), y: moving(at.y, dy), s: moving(at.s, 1.0) };
        let u = law.energy_density(&Deformation::from_gradient(&variables::<10>(&h)), &at);
        read(&u, lane, &mut lanes);
        let v2 = u.v2.unwrap_generic(nalgebra::Const::<10>, nalgebra::Const::<10>);
        for c in 0..9 {
            lanes[1 + 9 + STIFFNESS + c][lane] = v2[(c, 9)];
        }
    }
    let load = |c: usize| L::load(&lanes[c]);
    GradientResponse {
        energy: load(0),
        stress: std::array::from_fn(|c| load(1 + c)),
        stiffness: std::array::from_fn(|c| load(10 + c)),
        stress_rate: std::array::from_fn(|c| load(10 + STIFFNESS + c)),
    }
}

/// H with its entries as the first nine of N variables.
fn variables<const N: usize>(h: &[f64; 9]) -> Matrix3<Dual2SVec64<N>> {
    Matrix3::from_fn(|i, k| {
        let mut unit = SMatrix::<f64, 1, N>::zeros();
        unit[3 * i + k] = 1.0;
        Dual2SVec64::new(h[3 * i + k], Derivative::some(unit), Derivative::none())
    })
}

/// Reads value, gradient and Hessian in the first nine variables.
fn read<const N: usize>(u: &Dual2SVec64<N>, lane: usize, lanes: &mut [[f64; MAX_LANES]]) {
    let (one, n) = (nalgebra::Const::<1>, nalgebra::Const::<N>);
    let (v1, v2) = (u.v1.unwrap_generic(one, n), u.v2.unwrap_generic(n, n));
    lanes[0][lane] = u.re;
    for i in 0..9 {
        lanes[1 + i][lane] = v1[i];
        for k in i..9 {
            lanes[10 + packed(i, k)][lane] = v2[(i, k)];
        }
    }
}
