use num_dual::Dual2_64;

use crate::scalar::Scalar;

/// Where in the section something runs that follows the rod, as a function of s: (x, y) = r(s), m.
///
/// A pair of numbers runs parallel to the axis. A closure is written over [`Dual2_64`], so that r′ and r″, which the tension and its
/// rate need, come with it:
///
/// ```
/// use hyperrod::num_dual::{Dual2_64, DualNum};
/// use hyperrod::section::Tendon;
///
/// // winds round the axis once every 0.2 m
/// let helix = |s: Dual2_64| {
///     let (sin, cos) = (s * (std::f64::consts::TAU / 0.2)).sin_cos();
///     [cos * 8e-3, sin * 8e-3]
/// };
/// let tendon = Tendon::new(helix, 2.0).unwrap();
/// # let _ = tendon;
/// ```
pub trait Routing: Send + Sync {
    /// (x, y) at s, m, with first and second derivatives.
    fn at(&self, s: Dual2_64) -> [Dual2_64; 2];
}

impl Routing for [f64; 2] {
    fn at(&self, _s: Dual2_64) -> [Dual2_64; 2] {
        self.map(Dual2_64::from_re)
    }
}

impl<F: Fn(Dual2_64) -> [Dual2_64; 2] + Send + Sync> Routing for F {
    fn at(&self, s: Dual2_64) -> [Dual2_64; 2] {
        self(s)
    }
}

/// Straight from one place in the section at s = 0 to another at s = length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Converging {
    /// (x, y) at s = 0, m.
    pub from: [f64; 2],
    /// (x, y) at s = `length`, m.
    pub to: [f64; 2],
    /// Where `to` is reached, m.
    pub length: f64,
}

impl Routing for Converging {
    fn at(&self, s: Dual2_64) -> [Dual2_64; 2] {
        std::array::from_fn(|i| s * ((self.to[i] - self.from[i]) / self.length) + self.from[i])
    }
}

/// A helix about the axis: r = R (cos φ, sin φ), φ = φ₀ + 2π s / pitch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helical {
    /// Distance R from the axis, m.
    pub radius: f64,
    /// Length of rod to one turn, m; negative for a left-handed helix.
    pub pitch: f64,
    /// Angle φ₀ at s = 0, from x towards y, rad.
    pub start: f64,
}

impl Routing for Helical {
    fn at(&self, s: Dual2_64) -> [Dual2_64; 2] {
        let (sin, cos) = num_dual::DualNum::sin_cos(&(s * (std::f64::consts::TAU / self.pitch) + self.start));
        [cos * self.radius, sin * self.radius]
    }
}

/// r and r′ at s as numbers of any kind: for mixed first derivatives in s, r″ is enough.
pub(super) fn path<D: Scalar>(routing: &impl Routing, s: D) -> ([D; 2], [D; 2]) {
    let step = s - s.re();
    let place = routing.at(Dual2_64::from_re(s.re()).derivative());
    (place.map(|r| step * r.v1 + r.re), place.map(|r| step * r.v2 + r.v1))
}
