use num_dual::Dual64;

/// A size, angle or factor that may vary along the rod: a number, a [`Linear`] taper, or a closure of s.
///
/// A closure is written over [`Dual64`], so that its slope, which Ψ′ needs, comes with its value:
///
/// ```
/// use hyperrod::section::Circle;
/// use hyperrod::num_dual::{Dual64, DualNum};
///
/// let bulge = Circle::new(|s: Dual64| (s * 12.0).sin() * 0.002 + 0.010);
/// # let _ = bulge;
/// ```
pub trait Profile: Send + Sync {
    /// Its value at arc length s: m for a size or shift, rad for an angle.
    fn at(&self, s: Dual64) -> Dual64;

    /// Whether it is the same everywhere, so that nothing need be computed twice.
    fn is_constant(&self) -> bool {
        false
    }
}

impl Profile for f64 {
    fn at(&self, _s: Dual64) -> Dual64 {
        Dual64::from_re(*self)
    }

    fn is_constant(&self) -> bool {
        true
    }
}

impl<F: Fn(Dual64) -> Dual64 + Send + Sync> Profile for F {
    fn at(&self, s: Dual64) -> Dual64 {
        self(s)
    }
}

/// A size that goes linearly from one value at s = 0 to another at s = length.
///
/// ```
/// use hyperrod::section::{Circle, Linear};
///
/// let arm = Circle::new(Linear { from: 0.012, to: 0.006, length: 0.25 });
/// # let _ = arm;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Size at s = 0, m.
    pub from: f64,
    /// Size at s = `length`, m.
    pub to: f64,
    /// Where `to` is reached, m.
    pub length: f64,
}

impl Profile for Linear {
    fn at(&self, s: Dual64) -> Dual64 {
        s * ((self.to - self.from) / self.length) + self.from
    }
}
