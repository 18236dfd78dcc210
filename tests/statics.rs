//! Static rods against the reference solutions.
mod reference;
use hyperrod::Statics;
use hyperrod::solve::Order;
use reference::static_cases;

#[test]
fn probe() {
    for file in [
        "B1_elastica_finite.json",
        "B2_end_moment.json",
        "B3_bend45.json",
        "B9_heavy_elastica.json",
        "C4_nh_cantilever.json",
    ] {
        for case in static_cases(file) {
            let rod = case.rod();
            for order in [Order::Two, Order::Four, Order::Six] {
                let mut last = f64::NAN;
                for elements in [8, 16, 32, 64, 128] {
                    match (Statics { elements, order, ..Default::default() }.solve(&rod)) {
                        Ok(s) => {
                            let e = case.errors(&s);
                            println!(
                                "{} {order:?} {elements}: p {:.2e} (est {:.1e}) r {:.2e} w {:.2e} x {:.1e}, ratio {:.2}, it {} {:?}",
                                case.id,
                                e.position,
                                s.report().error.position / case.length,
                                e.rotation,
                                e.wrench,
                                e.strain,
                                (last / e.worst()).log2(),
                                s.report().iterations.len(),
                                s.report().elapsed
                            );
                            last = e.worst();
                        }
                        Err(e) => println!(
                            "{} {order:?} {elements}: {e} {:?}",
                            case.id,
                            e.report.iterations.iter().map(|i| (i.step, i.fraction)).collect::<Vec<_>>()
                        ),
                    }
                }
            }
        }
    }
}
