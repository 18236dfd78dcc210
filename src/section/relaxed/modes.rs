//! The displacements a section may take: three components over a [`Space`], without rigid motions.

use nalgebra::{DMatrix, DVector, Matrix4, Matrix4x3, Vector4};

use super::space::{self, Raw, Space};
use super::warping::Warping;
use crate::error::Result;
use crate::material::Points;

/// The points of a section at one arc length and the displacements there.
#[derive(Clone, Debug)]
pub(super) struct Modes {
    pub(super) points: Points,
    pub(super) space: Space,
    degree: usize,
    /// How many functions each component has: in the plane twice, along the rod once.
    pub(super) counts: [usize; 3],
    /// Whether the plane deforms at all.
    in_plane: bool,
    /// The three modes and the one rotation made of the linear functions of both in-plane components.
    linear: Matrix4x3<f64>,
    rotation: Vector4<f64>,
}

/// How many modes there are, from the functions of an in-plane and of the axial component.
fn len(in_plane: bool, plane: usize, axial: usize) -> usize {
    let plane = if in_plane { 3 + 2 * (plane - 3) } else { 0 };
    plane + axial - 3
}

/// How many modes a rung has, on a round tube or on any other shape.
pub(super) fn count(warping: Warping, ring: bool) -> usize {
    let [plane, axial] = [warping.in_plane, warping.axial].map(|d| space::count(ring, d));
    len(warping.in_plane > 0, plane, axial)
}

impl Modes {
    pub(super) fn new(points: Points, ring: bool, warping: Warping) -> Result<Self> {
        let degree = warping.degree();
        let raw = Raw::new(&points, ring);
        let space = Space::new(raw, &points, degree)?;
        let counts = [warping.in_plane, warping.in_plane, warping.axial].map(|d| raw.count(d));
        let rotation = rotation(&points, &space);
        // the reflection that takes the rotation to the first axis takes the other three axes to its complement
        let mirror = rotation + Vector4::ith(0, if rotation[0] < 0.0 { -1.0 } else { 1.0 });
        let reflection = Matrix4::identity() - mirror * mirror.transpose() * (2.0 / mirror.norm_squared());
        let linear = reflection.fixed_columns::<3>(1).into_owned();
        Ok(Self { points, space, degree, counts, in_plane: warping.in_plane > 0, linear, rotation })
    }

    /// How many modes there are.
    pub(super) fn len(&self) -> usize {
        len(self.in_plane, self.counts[0], self.counts[2])
    }

    /// The largest degree of the functions.
    pub(super) fn degree(&self) -> usize {
        self.degree
    }

    /// How many coefficients: the modes and six rigid motions, and what a plane that does not deform leaves.
    pub(super) fn full(&self) -> usize {
        self.counts.iter().sum()
    }

    /// Where a component's coefficients begin.
    pub(super) fn start(&self, component: usize) -> usize {
        self.counts[..component].iter().sum()
    }

    /// Places of the four linear in-plane coefficients.
    fn linear_places(&self) -> [usize; 4] {
        let second = self.counts[0];
        [1, 2, second + 1, second + 2]
    }

    /// The higher coefficients, which are modes themselves.
    fn higher(&self) -> impl Iterator<Item = usize> + '_ {
        (0..3).flat_map(move |component| {
            let start = self.start(component);
            (start + 3)..(start + self.counts[component])
        })
    }

    /// The coefficients of a displacement given by its modes.
    pub(super) fn expand(&self, q: &DVector<f64>) -> DVector<f64> {
        let mut full = DVector::zeros(self.full());
        let mut next = 0;
        if self.in_plane {
            let four = self.linear * q.fixed_rows::<3>(0);
            for (place, value) in self.linear_places().into_iter().zip(four.iter()) {
                full[place] = *value;
            }
            next = 3;
        }
        for place in self.higher() {
            full[place] = q[next];
            next += 1;
        }
        full
    }

    /// Rows of the coefficients made rows of the modes.
    pub(super) fn reduce(&self, full: &DMatrix<f64>) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(self.len(), full.ncols());
        let mut next = 0;
        if self.in_plane {
            for k in 0..3 {
                for (place, row) in self.linear_places().into_iter().zip(0..4) {
                    let factor = self.linear[(row, k)];
                    if factor != 0.0 {
                        for c in 0..full.ncols() {
                            out[(k, c)] += factor * full[(place, c)];
                        }
                    }
                }
            }
            next = 3;
        }
        for place in self.higher() {
            for c in 0..full.ncols() {
                out[(next, c)] = full[(place, c)];
            }
            next += 1;
        }
        out
    }

    /// Rows of the coefficients made rows of the six rigid motions: three translations, two turns out of the plane, one in it.
    pub(super) fn rigid(&self, full: &DMatrix<f64>) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(6, full.ncols());
        let [second, third] = [self.start(1), self.start(2)];
        for c in 0..full.ncols() {
            for (row, place) in [0, second, third, third + 1, third + 2].into_iter().enumerate() {
                out[(row, c)] = full[(place, c)];
            }
            let four = self.linear_places();
            out[(5, c)] = (0..4).map(|k| self.rotation[k] * full[(four[k], c)]).sum();
        }
        out
    }

    /// In words, the mode that weighs most in a direction of the modes.
    pub(super) fn describe(&self, direction: &DVector<f64>) -> String {
        let full = self.expand(direction);
        let place = full.iamax();
        let component = (0..3).rev().find(|&k| place >= self.start(k)).unwrap_or(0);
        let index = place - self.start(component);
        let degree = (0..=self.degree).find(|&d| self.space.count(d) > index).unwrap_or(self.degree).max(1);
        let share = full[place].powi(2) / full.norm_squared() * 100.0;
        let along = ["x", "y", "z"][component];
        format!("displacement along {along} of degree {degree} ({share:.0} % of it)")
    }

    /// Displacement and its gradient at any point: ∂w/∂x, ∂w/∂y, w.
    pub(super) fn at(&self, x: f64, y: f64, full: &DVector<f64>) -> [[f64; 3]; 3] {
        let table = self.space.at(x, y, self.degree);
        std::array::from_fn(|block| {
            std::array::from_fn(|component| {
                let start = self.start(component);
                (0..self.counts[component]).map(|l| table[(block, l)] * full[start + l]).sum()
            })
        })
    }
}

/// The unit vector c of the condition ∫(x w₂ − y w₁) = c · (linear coefficients of w₁ and w₂) = 0.
fn rotation(points: &Points, space: &Space) -> Vector4<f64> {
    let n = points.len();
    let mut c = Vector4::zeros();
    for q in 0..n {
        let w = points.weight[q];
        for l in 0..2 {
            let value = space.table[(2 * n + q, 1 + l)];
            c[l] -= w * points.y[q] * value;
            c[2 + l] += w * points.x[q] * value;
        }
    }
    c.normalize()
}
