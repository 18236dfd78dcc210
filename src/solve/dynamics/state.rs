use crate::lie::{Pose, Strain, Twist};
use crate::solve::StaticSolution;

/// A rod in motion at an instant, as numbers to save: a run that goes on from it gives the bits of one that was not interrupted.
///
/// With the feature `serde` it can be written and read; use a format that keeps every bit of an `f64`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State {
    pub(super) time: f64,
    pub(super) stages: usize,
    pub(super) base_pose: [f64; 12],
    pub(super) mounts: Vec<[[f64; 6]; 4]>,
    pub(super) strain: Vec<[f64; 6]>,
    pub(super) strain_rate: Vec<[f64; 6]>,
    pub(super) strain_second: Vec<[f64; 6]>,
    pub(super) velocity: Vec<[f64; 6]>,
    pub(super) acceleration: Vec<[f64; 6]>,
    pub(super) algorithmic: Vec<[f64; 6]>,
    pub(super) dissipated: f64,
    pub(super) work: f64,
    pub(super) power: [f64; 2],
    pub(super) kept: Option<[f64; 7]>,
    pub(super) memory: Option<SavedMemory>,
}

/// What makes the next step start as it would have: the step size, the guess for its strains, and the factors at hand.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct SavedMemory {
    pub(super) next_step: f64,
    pub(super) last_step: f64,
    pub(super) rate: f64,
    /// 0 none, 1 Newmark, 2 Runge–Kutta, with its coefficients.
    pub(super) relation: (u8, f64, f64),
    pub(super) factors: Vec<f64>,
    /// Slopes of the last step, for the guess.
    pub(super) slopes: Vec<f64>,
}

impl State {
    /// The time, s.
    pub fn time(&self) -> f64 {
        self.time
    }
}

impl State {
    /// Drops what is remembered of the steps before: factors, step size and guess. A run with other steps or another scheme begins afresh.
    pub fn forget_steps(&mut self) {
        self.memory = None;
    }
}

type StrainOf = Box<dyn Fn(f64) -> Strain>;

/// How a motion begins.
///
/// ```
/// use hyperrod::solve::dynamics::Start;
/// use hyperrod::{Strain, Twist};
/// // bent to a circle of 2 m and let go, while the clamp stays
/// let bent = Start::at_rest().with_strain(|_s| Strain::from_array([0.0, 0.5, 0.0, 0.0, 0.0, 0.0]));
/// // turning about its own axis with 10 rad/s, for a rod without a clamp
/// let spun = Start::at_rest().with_base_velocity(Twist::from_array([0.0, 0.0, 10.0, 0.0, 0.0, 0.0]));
/// # let _ = (bent, spun);
/// ```
pub struct Start {
    pub(super) time: f64,
    pub(super) strain: Option<StrainOf>,
    pub(super) strain_rate: Option<StrainOf>,
    pub(super) base: Option<Pose>,
    pub(super) base_velocity: Twist,
    /// Whether the strains are to be improved to a static equilibrium.
    pub(super) balanced: bool,
}

impl Start {
    /// At rest in the reference shape, at time 0.
    pub fn at_rest() -> Self {
        Self {
            time: 0.0,
            strain: None,
            strain_rate: None,
            base: None,
            base_velocity: Twist::zero(),
            balanced: false,
        }
    }

    /// At rest in a static equilibrium, which is improved to that of the mesh of the motion.
    ///
    /// The loads are those of the scene at the time it starts: its rod's, and the timed ones with their amplitudes at that time. What was solved
    /// under other loads, a ramp at its end for instance, is thus moved to an equilibrium under those of the start; to let a rod go
    /// from a shape that its loads at the start do not hold, use [`with_strain`](Self::with_strain).
    pub fn equilibrium(solution: &StaticSolution) -> Self {
        let points: Vec<(f64, Strain)> = solution.stages().iter().map(|n| (n.s, n.strain)).collect();
        let strain = move |s: f64| {
            let next = points.partition_point(|(at, _)| *at < s).clamp(1, points.len().max(2) - 1);
            let (Some((a, left)), Some((b, right))) = (points.get(next - 1), points.get(next)) else {
                return points.first().map_or(Strain::zero(), |(_, strain)| *strain);
            };
            let tau = (s - a) / (b - a);
            *left * (1.0 - tau) + *right * tau
        };
        let base = Some(solution.base().pose);
        Self { strain: Some(Box::new(strain)), base, balanced: true, ..Self::at_rest() }
    }

    /// The same with its strains improved to a static equilibrium of the mesh of the motion, from which it then begins at rest.
    pub fn balanced(self) -> Self {
        Self { balanced: true, ..self }
    }

    /// The same at another time, s.
    pub fn at_time(self, time: f64) -> Self {
        Self { time, ..self }
    }

    /// The same with strains Δξ(s).
    pub fn with_strain(self, strain: impl Fn(f64) -> Strain + 'static) -> Self {
        Self { strain: Some(Box::new(strain)), balanced: false, ..self }
    }

    /// The same with rates of strain ξ̇(s), 1/s; velocities follow from them and from that of the base.
    pub fn with_strain_rate(self, rate: impl Fn(f64) -> Strain + 'static) -> Self {
        Self { strain_rate: Some(Box::new(rate)), ..self }
    }

    /// The same with the base in this pose, where its support leaves it free to be.
    pub fn with_base(self, pose: Pose) -> Self {
        Self { base: Some(pose), ..self }
    }

    /// The same with this velocity of a base that is free to have it, body frame.
    pub fn with_base_velocity(self, velocity: Twist) -> Self {
        Self { base_velocity: velocity, ..self }
    }
}

impl std::fmt::Debug for Start {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Start").field("time", &self.time).finish_non_exhaustive()
    }
}
