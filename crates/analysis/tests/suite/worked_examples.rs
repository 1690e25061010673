//! The chapter's two worked examples, checked by hand and then pinned.

use lcplab_lcp::Lcp;
use lcplab_page::number::significant;
use lcplab_solver::{Options, Registry, Settings, Start};

use lcplab_testing::{assert_certified, assert_proved, contacts};

/// Status, iterations, active set (L, F, U) and x of a solver's answer, after the judge accepted
/// it.
fn certified(lcp: &Lcp, solver: &str) -> String {
    let settings = Settings::default().with_tolerance(1e-10);
    let solver = Registry::standard()
        .entry(solver)
        .unwrap()
        .build(&Options::default().with_settings(settings));
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    assert_certified(lcp, &solution.x);
    let side = |(i, &x): (usize, &f64)| match x {
        x if x == lcp.lo()[i] => 'L',
        x if x == lcp.hi()[i] => 'U',
        _ => 'F',
    };
    let sides: String = solution.x.iter().enumerate().map(side).collect();
    let x: Vec<String> = solution.x.iter().map(|&x| significant(x, 6)).collect();
    format!("{} after {}, {sides}, x = {}", solution.status, solution.iterations, x.join(" "))
}

#[test]
fn figure_6_the_object_is_stopped_by_its_weight_and_its_momentum() {
    // One unit mass on the ground, v = −1, g = 9.81, dt = 1/60: b = J u* = −1 − g/60, A = 1, so
    // x = 1 + 9.81/60 = 1.1635 N s.
    let lcp = contacts(&[&[1.0]], &[-1.0 - 9.81 / 60.0]);
    for entry in Registry::standard().entries() {
        let solver = entry.build(&Options::default());
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        assert!((solution.x[0] - 1.1635).abs() < 1e-7, "{}", entry.name);
    }
}

#[test]
fn figure_7_the_stack_takes_up_the_blow() {
    // Three unit masses, the middle one at −1, g = dt = 1. u* = (−1, −2, −1), b = J u* = (−1, −1,
    // 1), A x = −b: x3 = 1 from the top mass, x2 − x3 = 2 from the middle, x1 − x2 = 1 from the
    // bottom: x = (4, 3, 1).
    let a: [&[f64]; 3] = [&[1.0, -1.0, 0.0], &[-1.0, 2.0, -1.0], &[0.0, -1.0, 2.0]];
    let lcp = contacts(&a, &[-1.0, -1.0, 1.0]);
    assert_proved(&lcp, &[4.0, 3.0, 1.0]);
    for entry in Registry::standard().entries() {
        let settings = Settings::default().with_tolerance(1e-12);
        let solver = entry.build(&Options::default().with_settings(settings));
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        for (found, x) in solution.x.iter().zip([4.0, 3.0, 1.0]) {
            assert!((found - x).abs() < 1e-9, "{}: {:?}", entry.name, solution.x);
        }
    }
}

#[test]
fn figure_7_as_each_solver_reaches_it() {
    // By hand: x = (4, 3, 1). Gauss-Seidel multiplies the error by cos²(π/6) = 3/4 a sweep, so the
    // residual is 1e-10 of the terms after about ln(1e-10)/ln(3/4) = 80 sweeps; Dantzig drives
    // three rows.
    let a: [&[f64]; 3] = [&[1.0, -1.0, 0.0], &[-1.0, 2.0, -1.0], &[0.0, -1.0, 2.0]];
    let lcp = contacts(&a, &[-1.0, -1.0, 1.0]);
    insta::assert_snapshot!(certified(&lcp, "pgs"), @"solved after 73, FFF, x = 4.00000 3.00000 1.00000");
    insta::assert_snapshot!(certified(&lcp, "sor"), @"solved after 30, FFF, x = 4.00000 3.00000 1.00000");
    insta::assert_snapshot!(certified(&lcp, "dantzig"), @"solved after 3, FFF, x = 4.00000 3.00000 1.00000");
}

#[test]
fn figure_7_with_the_middle_body_moving_up_parts_two_contacts() {
    // Without gravity the middle body leaves the bottom one at 1 m/s and meets the top one: by
    // momentum both go on at 1/2, so x = (0, 0, 1/2) and w = (0, 1/2, 0): row 1 is degenerate.
    let a: [&[f64]; 3] = [&[1.0, -1.0, 0.0], &[-1.0, 2.0, -1.0], &[0.0, -1.0, 2.0]];
    let lcp = contacts(&a, &[0.0, 1.0, -1.0]);
    assert_proved(&lcp, &[0.0, 0.0, 0.5]);
    insta::assert_snapshot!(certified(&lcp, "pgs"), @"solved after 1, LLF, x = 0 0 0.500000");
    insta::assert_snapshot!(certified(&lcp, "dantzig"), @"solved after 1, LLF, x = 0 0 0.500000");
}

#[test]
fn figure_6_as_each_solver_reaches_it() {
    // By hand: x = 2; one row, so Gauss-Seidel is exact after one sweep, and SOR with ω = 1.3
    // multiplies the error by −0.3.
    let lcp = contacts(&[&[1.0]], &[-2.0]);
    insta::assert_snapshot!(certified(&lcp, "pgs"), @"solved after 1, F, x = 2.00000");
    insta::assert_snapshot!(certified(&lcp, "sor"), @"solved after 19, F, x = 2.00000");
    insta::assert_snapshot!(certified(&lcp, "dantzig"), @"solved after 1, F, x = 2.00000");
}
