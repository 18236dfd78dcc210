use crate::cases::{fixed, largest, release_errors, three_dimensional_errors};
use hyperrod::solve::Order;
use hyperrod::solve::dynamics::Dynamics;

/// Oracle: D2 by spectral elements, within 1e-8 m of Richardson-extrapolated differences. The start is not smooth: 1e-4 m is asked.
#[test]
fn a_suddenly_released_cantilever_falls_as_the_reference() {
    let dynamics = Dynamics { elements: 8, ..fixed(0.01) };
    let errors = release_errors(&dynamics, false, 0.3);
    println!("{errors:?}");
    assert!(largest(&errors) < 1e-4, "{errors:?}");
}

/// The same with gravity ramped up smoothly, reference to 4e-11 m.
#[test]
fn a_smoothly_released_cantilever_falls_as_the_reference() {
    let dynamics = Dynamics { elements: 16, ..fixed(0.0025) };
    let errors = release_errors(&dynamics, true, 0.3);
    println!("{errors:?}");
    assert!(largest(&errors) < 1e-7, "{errors:?}");
}

/// Oracle: D4, spatial motion of a rectangle, reference to 1e-8 m.
#[test]
fn a_rod_moves_in_space_as_the_reference() {
    let dynamics = Dynamics { elements: 12, order: Order::Six, ..fixed(0.0025) };
    let errors = three_dimensional_errors(&dynamics);
    println!("{errors:?}");
    assert!(largest(&errors) < 1e-6, "{errors:?}");
}
