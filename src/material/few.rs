//! The response of several strains at once, a lane each, in three components: what is summed, and where it goes.

use super::blocks::{Eight, set_parts};
use super::differentiate::TwoWays;
use super::response::{Points, Response, Station};
use super::task::{Many, one_by_one};
use super::three::Set;
use crate::error::Result;
use crate::lie::Strain;
use crate::scalar::Lane;
use crate::scalar::lane::MAX_LANES;

/// U, Ψ and the upper triangle of ∂Ψ/∂Δξ by rows, in the order of a [`Three`](super::three::Three).
pub(super) const ENTRIES: usize = 10;

/// The entries, a strain a lane.
pub type Entries = [Eight; ENTRIES];

/// Several strains on the same points, in the components of a set.
pub struct Few<'a> {
    pub(super) set: Set,
    pub(super) points: &'a Points,
    /// Strains and arc lengths.
    pub(super) xi: [Eight; 6],
    pub(super) s: Eight,
}

impl<'a> Few<'a> {
    /// Of at most eight sites; the lanes left over repeat the first.
    fn of(set: Set, points: &'a Points, sites: &[(Station, Strain)]) -> Self {
        let (mut xi, mut s) = ([Eight::ZERO; 6], Eight::ZERO);
        for i in 0..MAX_LANES {
            let Some((at, strain)) = sites.get(i).or(sites.first()) else { break };
            s.0[i] = at.s;
            for (component, value) in xi.iter_mut().zip(strain.to_array()) {
                component.0[i] = value;
            }
        }
        Self { set, points, xi, s }
    }
}

/// Fills in the responses, eight at a time, by what sums the entries and says whether they are right; one by one what is left over, and eight of which
/// one is inadmissible.
pub(super) fn in_lanes(
    set: Set,
    many: &mut Many<'_>,
    sum: &dyn Fn(&Few<'_>, &mut Entries) -> bool,
    alone: &dyn Fn(&Station, &Strain) -> Result<Response>,
) -> Result<()> {
    /// So many strains are worth the lanes that are left empty.
    const ENOUGH: usize = 3;
    for (sites, out) in many.sites.chunks(MAX_LANES).zip(many.out.chunks_mut(MAX_LANES)) {
        let sites = &sites[..sites.len().min(out.len())];
        let mut entries = [Eight::ZERO; ENTRIES];
        if sites.len() >= ENOUGH
            && sum(&Few::of(set, many.points, sites), &mut entries)
            && are_finite(&entries)
        {
            write(&entries, set.places(), &mut out[..sites.len()]);
        } else {
            one_by_one(sites, out, alone)?;
        }
    }
    Ok(())
}

/// Sums over the points.
#[derive(Clone, Copy)]
pub(super) struct Sums<L>([L; ENTRIES]);

impl<L: Lane> Sums<L> {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self([L::splat(0.0); ENTRIES])
    }

    /// Adds a point of weight w where e has these derivatives in the two strains that stretch.
    #[inline(always)]
    pub(super) fn add_two_ways(&mut self, [p, q]: [L; 2], w: L, two: &TwoWays<L>) {
        let ([d, e], [dd, de, ee], sums) = (two.stress, two.stiffness, &mut self.0);
        let (e, de, ee) = (e * w, de * w, ee * w);
        let (p_ee, q_ee) = (p * ee, q * ee);
        sums[0] = w.mul_add(two.energy, sums[0]);
        sums[1] = w.mul_add(d, sums[1]);
        sums[2] = p.mul_add(e, sums[2]);
        sums[3] = q.mul_add(e, sums[3]);
        sums[4] = w.mul_add(dd, sums[4]);
        sums[5] = p.mul_add(de, sums[5]);
        sums[6] = q.mul_add(de, sums[6]);
        sums[7] = p.mul_add(p_ee, sums[7]);
        sums[8] = p.mul_add(q_ee, sums[8]);
        sums[9] = q.mul_add(q_ee, sums[9]);
    }

    /// Adds w times each entry.
    #[inline(always)]
    pub(super) fn add(&mut self, w: L, entries: &[L; ENTRIES]) {
        for i in 0..ENTRIES {
            self.0[i] = w.mul_add(entries[i], self.0[i]);
        }
    }

    /// Writes the sums, a strain a lane, with something added to the energy.
    #[inline(always)]
    pub(super) fn write(mut self, energy: L, part: usize, entries: &mut Entries) {
        self.0[0] = self.0[0] + energy;
        set_parts(entries, part, &self.0);
    }
}

/// Whether every number is finite.
fn are_finite(entries: &Entries) -> bool {
    let mut sum = [0.0; MAX_LANES];
    for entry in entries {
        for (sum, value) in sum.iter_mut().zip(&entry.0) {
            // 0 x is 0 where x is finite and NaN elsewhere
            *sum += 0.0 * value;
        }
    }
    sum == [0.0; MAX_LANES]
}

/// Writes energy, and wrench and tangent in these components, where each strain has its response.
fn write(entries: &Entries, [p, q, r]: [usize; 3], out: &mut [Response]) {
    for (i, out) in out.iter_mut().enumerate() {
        let [energy, m_p, m_q, m_r, pp, pq, pr, qq, qr, rr] =
            entries.each_ref().map(|entry| entry.0[i % MAX_LANES]);
        out.energy = energy;
        out.wrench_rate = Response::ZERO.wrench_rate;
        for (place, value) in [(p, m_p), (q, m_q), (r, m_r)] {
            let half = if place < 3 { &mut out.wrench.moment } else { &mut out.wrench.force };
            half[place % 3] = value;
        }
        for (row, column, value) in [(p, p, pp), (p, q, pq), (p, r, pr), (q, q, qq), (q, r, qr), (r, r, rr)] {
            (out.tangent[(row, column)], out.tangent[(column, row)]) = (value, value);
        }
    }
}
