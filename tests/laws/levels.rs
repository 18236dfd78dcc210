//! The answers of every law at every level, for every request, against num-dual; to 50 digits they are held in `reference`.

use hyperrod::Strain;
use hyperrod::material::*;
use proptest::prelude::*;

use crate::every_law::{AtLocalLevel, AtSectionLevel, Visitor, as_closures, every_local_law};
use crate::oracle::*;

/// Some tens of operations a law, each rounded twice (num-dual rounds as well), on numbers up to ten times what they leave.
const ROUNDING: f64 = 1e-13;

/// The law at its own level and at those above, and as closures, against num-dual.
pub struct AtEveryLevel {
    pub points: Points,
    pub strain: Strain,
    pub worst: (f64, String),
}

impl AtEveryLevel {
    pub fn new(points: Points, strain: Strain) -> Self {
        Self { points, strain, worst: (0.0, String::new()) }
    }

    fn hold(&mut self, name: &str, law: &dyn Material, at: &Station, expected: &Expected, exact: bool) {
        for request in REQUESTS {
            let answer = law.integrate(&self.points, at, &self.strain, request).unwrap();
            if exact {
                assert_nothing_more(&answer, request);
            }
            let error = expected.error_of(&answer, request);
            if !(error <= self.worst.0) {
                self.worst = (error, format!("{name}, {request:?}"));
            }
        }
    }
}

impl AtEveryLevel {
    /// On a straight reference and on a curved one.
    fn hold_both(
        &mut self,
        name: &str,
        law: &dyn Material,
        on_a_line: &dyn Density,
        on_a_curve: &dyn Density,
    ) {
        let values = expected(on_a_line, &self.points, &straight(), &self.strain);
        self.hold(name, law, &straight(), &values, true);
        let values = expected(on_a_curve, &self.points, &curved(), &self.strain);
        self.hold(&format!("{name}, curved"), law, &curved(), &values, true);
    }
}

/// Every law at its own level: compiling each at all levels takes ten minutes.
impl Visitor for AtEveryLevel {
    fn visit<L: Local + Clone + 'static>(&mut self, name: &str, law: &L) {
        self.hold_both(name, law, &crate::oracle::Straight(law), &Curved(law));
    }
}

impl AtEveryLevel {
    /// A law at the levels above its own, and as closures.
    pub fn visit_above<L: Local + Clone + 'static>(&mut self, name: &str, law: &L) {
        let [local_closure, sectional_closure] = as_closures(law);
        let at = straight();
        let values = expected(&crate::oracle::Straight(law), &self.points, &at, &self.strain);
        self.hold(&format!("{name}, local"), &AtLocalLevel(law.clone()), &at, &values, true);
        self.hold(&format!("{name}, sectional"), &AtSectionLevel(law.clone()), &at, &values, true);
        self.hold(&format!("{name}, local closure"), &*local_closure, &at, &values, false);
        self.hold(&format!("{name}, sectional closure"), &*sectional_closure, &at, &values, false);
        let at = curved();
        let values = expected(&Curved(law), &self.points, &at, &self.strain);
        self.hold(&format!("{name}, curved, local"), &AtLocalLevel(law.clone()), &at, &values, true);
        self.hold(&format!("{name}, curved, local closure"), &*local_closure, &at, &values, false);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..Default::default() })]

    #[test]
    fn every_law_has_the_derivatives_of_num_dual_at_every_level(
        direction in prop::array::uniform6(-1.0..1.0),
        exponent in -9.0..-0.7,
        count in 1..18_usize,
        moving: bool,
    ) {
        let strain = strain(direction, 10.0_f64.powf(exponent));
        let mut check = AtEveryLevel::new(points(count, moving), strain);
        every_local_law(&mut check);
        check.visit_above("neo-Hookean", &NeoHookean::new(170e3, 400e3).unwrap());
        prop_assert!(check.worst.0 <= ROUNDING, "{:.1e}: {}", check.worst.0, check.worst.1);
        let law = LinearElastic::new(1e6, 3e5).unwrap();
        let values = expected(&crate::oracle::Straight(&law), &check.points, &straight(), &strain);
        check.hold("linear elastic", &law, &straight(), &values, true);
        prop_assert!(check.worst.0 <= ROUNDING, "{:.1e}: {}", check.worst.0, check.worst.1);
    }
}

/// The oracle sees an error of one part in 10¹².
#[test]
fn a_law_off_by_one_part_in_a_trillion_is_seen() {
    let (points, strain) = (points(5, true), strain([0.5, -0.3, 0.7, 0.2, -0.4, 0.3], 0.1));
    let values = expected(
        &crate::oracle::Straight(&NeoHookean::new(1e5, 2e5).unwrap()),
        &points,
        &straight(),
        &strain,
    );
    let wrong = NeoHookean::new(1e5 * (1.0 + 1e-12), 2e5).unwrap();
    for request in REQUESTS {
        let answer = wrong.integrate(&points, &straight(), &strain, request).unwrap();
        assert!(values.error_of(&answer, request) > ROUNDING);
    }
}
