//! Points of a section, a register of them at a time, and γ there.

use super::differentiate::{Fibre, Level};
use super::places::{Coordinate, Places};
use super::response::{PointRates, Points, Reference, Request};
use super::sums::Block;
use crate::scalar::Lane;

/// Some points of a section.
#[derive(Clone, Copy)]
pub struct Span<'a> {
    x: &'a [f64],
    y: &'a [f64],
    weight: &'a [f64],
    rates: Option<[&'a [f64]; 3]>,
}

impl<'a> Span<'a> {
    /// At most `count` points from the one numbered `first` on.
    #[inline(always)]
    pub(super) fn of(points: &'a Points, first: usize, count: usize) -> Self {
        let end = (first + count).min(points.len());
        let some = first..end;
        let rates = match &points.rates {
            Some(PointRates { x, y, weight }) => {
                Some([&x[some.clone()], &y[some.clone()], &weight[some.clone()]])
            }
            None => None,
        };
        Self { x: &points.x[some.clone()], y: &points.y[some.clone()], weight: &points.weight[some], rates }
    }

    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.weight.len()
    }

    /// Where they are, for the law.
    #[inline(always)]
    pub(super) fn places(&self, s: f64) -> Places<'a> {
        let position_rate = match self.rates {
            Some([x, y, _]) => [Coordinate::of(x), Coordinate::of(y)],
            None => [Coordinate::constant(0.0); 2],
        };
        Places {
            len: self.len(),
            position: [Coordinate::of(self.x), Coordinate::of(self.y)],
            position_rate,
            s: Coordinate::constant(s),
        }
    }

    /// A register of points, filled up with copies of its first one at no weight.
    #[inline(always)]
    pub(super) fn block<L: Lane, O: Level>(&self, q: usize, reference: &Reference, curved: bool) -> Block<L> {
        let [x, y, weight] = load_three(self.x, self.y, self.weight, q);
        let mut block = Block::at(x, y, weight);
        if let (true, Some([x, y, weight])) = (O::REQUEST >= Request::Rate, self.rates) {
            [block.x_rate, block.y_rate, block.weight_rate] = load_three(x, y, weight, q);
        }
        if curved {
            block.volume = volume(&splat6(&reference.twist.to_array()), x, y);
            block.inverse_volume = L::splat(1.0) / block.volume;
            block.weight_of_energy = weight * block.volume;
            block.weight_of_stiffness = weight * block.inverse_volume;
        }
        block
    }
}

/// A block of two coordinates and a weight.
#[inline(always)]
fn load_three<L: Lane>(x: &[f64], y: &[f64], w: &[f64], q: usize) -> [L; 3] {
    let (x, y, w) = (&x[q..], &y[q..], &w[q..]);
    if x.len() >= L::LANES && y.len() >= L::LANES && w.len() >= L::LANES {
        return [L::load(x), L::load(y), L::load(w)];
    }
    [L::load_or(x, x[0]), L::load_or(y, y[0]), L::load_or(w, 0.0)]
}

#[inline(always)]
pub(super) fn splat6<L: Lane>(v: &[f64; 6]) -> [L; 6] {
    [L::splat(v[0]), L::splat(v[1]), L::splat(v[2]), L::splat(v[3]), L::splat(v[4]), L::splat(v[5])]
}

/// j = γ*·e₃ = ν*_z + ω*_x y − ω*_y x.
#[inline(always)]
pub(super) fn volume<L: Lane>(xi: &[L; 6], x: L, y: L) -> L {
    xi[0].mul_add(y, xi[5] - xi[1] * x)
}

/// B(x, y) Δξ.
#[inline(always)]
pub(super) fn column<L: Lane>(xi: &[L; 6], x: L, y: L) -> [L; 3] {
    let [o_x, o_y, o_z, n_x, n_y, n_z] = *xi;
    [n_x - o_z * y, o_z.mul_add(x, n_y), o_x.mul_add(y, n_z - o_y * x)]
}

/// γ = B Δξ / j at a block of points, and its derivative in s at fixed Δξ: (B′ Δξ − γ j′) / j.
#[inline(always)]
pub(super) fn fibre<L: Lane, O: Level>(
    xi: &[L; 6],
    s: L,
    reference: &Reference,
    curved: bool,
    p: &Block<L>,
) -> Fibre<L> {
    let zero = L::splat(0.0);
    let mut gamma = column(xi, p.x, p.y);
    if curved {
        let inverse = p.inverse_volume;
        gamma = [gamma[0] * inverse, gamma[1] * inverse, gamma[2] * inverse];
    }
    let mut gamma_rate = [zero; 3];
    if O::REQUEST >= Request::Rate {
        let moving = [xi[0], xi[1], xi[2], zero, zero, zero];
        gamma_rate = column(&moving, p.x_rate, p.y_rate);
        if curved {
            let turned = splat6(&reference.twist.to_array());
            let turned = [turned[0], turned[1], turned[2], zero, zero, zero];
            let d_volume =
                volume(&turned, p.x_rate, p.y_rate) + volume(&splat6(&reference.rate.to_array()), p.x, p.y);
            for i in 0..3 {
                gamma_rate[i] = (gamma_rate[i] - gamma[i] * d_volume) * p.inverse_volume;
            }
        }
    }
    Fibre { position: [p.x, p.y], position_rate: [p.x_rate, p.y_rate], s, gamma, gamma_rate }
}
