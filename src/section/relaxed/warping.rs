use std::fmt;

/// How a section may deform: the degrees of the polynomials its displacement is made of.
///
/// The displacement w(x, y) of the points of a section has in-plane components of degree p and an axial one (the warping proper) of degree r,
/// without rigid motions. **Balance**: a warping of degree r changes J at second order by a field that only in-plane displacements of degree
/// r + 1 undo, so p = r + 1; less locks where the material is nearly incompressible. On a round hollow section the functions are
/// rᵏ cos mθ and rᵏ sin mθ with k, m up to the degree.
///
/// | rung | (p, r) | modes | what becomes right |
/// |---|---|---|---|
/// | [`RIGID`](Self::RIGID) | none | 0 | nothing lateral: EA = (λ+2μ)A, GJ = μ(I_x+I_y) |
/// | [`CONTRACTION`](Self::CONTRACTION) | (1, –) | 3 | stretch at any strain, EA = E·A, torsion of a circle |
/// | [`ANTICLASTIC`](Self::ANTICLASTIC) | (2, –) | 9 | EI = E·I at rest |
/// | [`BENDING`](Self::BENDING) | (4, –) | 27 | bending at finite strain, 20 % at the surface |
/// | [`SHEAR`](Self::SHEAR) | (4, 3) | 34 | shear factors at rest and at finite strain; torsion of an ellipse |
/// | [`TORSION`](Self::TORSION) | (5, 4) | 51 | torsion of squares and rectangles; the constant of a square to 1.2·10⁻³ |
/// | [`LARGE`](Self::LARGE) | (7, 6) | 94 | the same to 6·10⁻⁴; 50 % at the surface in bending and twist |
/// | [`FULL`](Self::FULL) | (9, 8) | 149 | the same with more digits |
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Warping {
    /// Degree p of the displacement in the plane of the section; 0 for none.
    pub in_plane: usize,
    /// Degree r of the displacement along the rod; 0 or 1 for none, since plane fields of degree 1 are rigid motions.
    pub axial: usize,
}

impl Warping {
    /// The section stays plane and keeps its shape.
    pub const RIGID: Self = Self { in_plane: 0, axial: 0 };
    /// It contracts and shears uniformly in its plane.
    pub const CONTRACTION: Self = Self { in_plane: 1, axial: 0 };
    /// It bends the other way as well (anticlastic curvature): Young's modulus in bending.
    pub const ANTICLASTIC: Self = Self { in_plane: 2, axial: 0 };
    /// Bending at finite strain.
    pub const BENDING: Self = Self { in_plane: 4, axial: 0 };
    /// Shear, and whatever torsion an ellipse needs.
    pub const SHEAR: Self = Self { in_plane: 4, axial: 3 };
    /// Torsion of sections with corners; the default.
    pub const TORSION: Self = Self { in_plane: 5, axial: 4 };
    /// Large bending and twist.
    pub const LARGE: Self = Self { in_plane: 7, axial: 6 };
    /// All there is on the ladder.
    pub const FULL: Self = Self { in_plane: 9, axial: 8 };

    /// The rungs from the simplest to the fullest.
    pub const LADDER: [Self; 8] = [
        Self::RIGID,
        Self::CONTRACTION,
        Self::ANTICLASTIC,
        Self::BENDING,
        Self::SHEAR,
        Self::TORSION,
        Self::LARGE,
        Self::FULL,
    ];

    /// The largest degree that can be asked for.
    pub const MAX_DEGREE: usize = 12;

    /// The degrees in balance for a warping of degree r: (r + 1, r).
    pub const fn balanced(axial: usize) -> Self {
        Self { in_plane: axial + 1, axial }
    }

    /// The larger of the two degrees.
    pub(super) fn degree(&self) -> usize {
        self.in_plane.max(self.axial)
    }
}

impl fmt::Display for Warping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match *self {
            Self::RIGID => "rigid ",
            Self::CONTRACTION => "uniform contraction ",
            Self::ANTICLASTIC => "anticlastic ",
            Self::BENDING => "bending ",
            Self::SHEAR => "shear ",
            Self::TORSION => "torsion ",
            Self::LARGE => "large ",
            Self::FULL => "full ",
            _ => "",
        };
        write!(f, "{name}({}, {})", self.in_plane, self.axial)
    }
}
