//! The chapter's two worked examples, checked by hand and then pinned.

use lcplab::solver::{ALL, Options, Settings, Start, by_name};

use crate::common::{assert_proved, contacts};

#[test]
fn figure_6_the_object_is_stopped_by_its_weight_and_its_momentum() {
    // One unit mass on the ground, v = −1, g = 9.81, dt = 1/60: b = J u* = −1 − g/60, A = 1, so
    // x = 1 + 9.81/60 = 1.1635 N s.
    let lcp = contacts(&[&[1.0]], &[-1.0 - 9.81 / 60.0]);
    for entry in ALL {
        let solver = by_name(entry.name, &Options::default()).unwrap();
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        assert!((solution.x[0] - 1.1635).abs() < 1e-7, "{}", entry.name);
    }
}

#[test]
fn figure_7_the_stack_takes_up_the_blow() {
    // Three unit masses, the middle one at −1, g = dt = 1. u* = (−1, −2, −1), b = J u* = (−1, −1, 1),
    // A x = −b: x3 = 1 from the top mass, x2 − x3 = 2 from the middle, x1 − x2 = 1 from the bottom:
    // x = (4, 3, 1).
    let a: [&[f64]; 3] = [&[1.0, -1.0, 0.0], &[-1.0, 2.0, -1.0], &[0.0, -1.0, 2.0]];
    let lcp = contacts(&a, &[-1.0, -1.0, 1.0]);
    assert_proved(&lcp, &[4.0, 3.0, 1.0]);
    for entry in ALL {
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let solver = by_name(entry.name, &Options { settings, ..Options::default() }).unwrap();
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        for (found, x) in solution.x.iter().zip([4.0, 3.0, 1.0]) {
            assert!((found - x).abs() < 1e-9, "{}: {:?}", entry.name, solution.x);
        }
    }
}
