use nalgebra::Matrix6;

use super::response::Response;
use crate::lie::Wrench;

/// Which of the six strains of a section can vary, in the order (ω_x, ω_y, ω_z, ν_x, ν_y, ν_z).
///
/// A rod that [cannot have some of its strains](crate::body::Constraint) asks for nothing else, and a response in few strains costs less than one in all:
/// the wrench and the tangent are those of the full response in the rows and columns of these strains. **The other entries are not to be relied on**:
/// they may be those of the full response, or whatever was there.
///
/// ```
/// use hyperrod::material::{Active, Request, Response, Station};
/// use hyperrod::section::{Circle, CrossSection, Section};
/// use hyperrod::{Strain, material::NeoHookean};
/// # fn main() -> hyperrod::Result<()> {
/// let section = Section::new(Circle::new(0.01), NeoHookean::new(170e3, 400e3)?)?;
/// let mut bent = Strain::zero();
/// bent.angular.y = 5.0;
/// let plane = Active::of([false, true, false, true, false, true]); // ω_y, ν_x and ν_z
/// let mut out = [Response::zero(); 1];
/// section.respond_active(&[(Station::straight(0.0), bent)], plane, Request::Tangent, &mut out)?;
/// let full = section.tangent(&Station::straight(0.0), &bent)?;
/// assert!((out[0].tangent[(1, 1)] / full[(1, 1)] - 1.0).abs() < 1e-13);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Active {
    strains: [bool; 6],
}

impl Active {
    /// All six.
    pub const fn all() -> Self {
        Self::of([true; 6])
    }

    /// Any set.
    pub const fn of(strains: [bool; 6]) -> Self {
        Self { strains }
    }

    /// Whether strain number `i` is one of them.
    pub const fn contains(self, i: usize) -> bool {
        i < 6 && self.strains[i]
    }

    /// How many they are.
    pub fn count(self) -> usize {
        self.places().count()
    }

    /// Whether they are all six.
    pub fn is_all(self) -> bool {
        self == Self::all()
    }

    /// Writes wrench and tangent in the rows and columns of these strains; zero where there is none, since it was not asked for.
    #[inline]
    pub(crate) fn write(self, wrench: Option<&Wrench>, tangent: Option<&Matrix6<f64>>, out: &mut Response) {
        let (wrench, tangent) = (wrench.unwrap_or(&ZERO.wrench), tangent.unwrap_or(&ZERO.tangent));
        if self.is_all() {
            out.wrench = *wrench;
            // what is the same as before need not go back to memory
            if !is_same(&out.tangent, tangent) {
                out.tangent = *tangent;
            }
            return;
        }
        for i in self.places() {
            let (to, from) = match i {
                0..3 => (&mut out.wrench.moment[i], wrench.moment[i]),
                _ => (&mut out.wrench.force[i - 3], wrench.force[i - 3]),
            };
            *to = from;
            out.tangent.column_mut(i).copy_from(&tangent.column(i));
        }
    }

    /// Their numbers.
    pub(crate) fn places(self) -> impl Iterator<Item = usize> + Clone {
        (0..6).filter(move |&i| self.strains[i])
    }
}

static ZERO: Response = Response::ZERO;

/// Whether two matrices are equal, entry by entry without a branch.
#[inline(always)]
fn is_same(a: &Matrix6<f64>, b: &Matrix6<f64>) -> bool {
    a.as_slice().iter().zip(b.as_slice()).fold(true, |same, (a, b)| same & (a == b))
}
