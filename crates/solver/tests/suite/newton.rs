use lcplab_lcp::{Coupling, Lcp, Matrix, library, merit};
use lcplab_solver::{Equations, Fallback, Newton, Pgs, Settings, Solver, Start, Status};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use lcplab_testing::{
    INF, assert_certified, assert_proved, boxed, cases, chain, contacts, iterates, manufactured,
    stack,
};

fn both() -> [Newton; 2] {
    [Equations::MinimumMap, Equations::FischerBurmeister]
        .map(|equations| Newton { equations, settings: Settings::default() })
}

#[test]
fn a_linear_system_takes_one_step_of_the_minimum_map() {
    // and a second one for the last digits, because of the damping
    let solution = both()[0].solve(&chain(20), &Start::default(), &mut ());
    assert_eq!(solution.status, Status::Solved);
    assert!(solution.iterations <= 2);
}

#[test]
fn the_number_of_correct_digits_doubles() {
    // 20 bodies, mass ratio 1; all contacts close, so that the solution is not degenerate.
    for solver in both() {
        let residual: Vec<f64> = iterates(&solver, &stack(20))
            .iter()
            .map(|x| merit::natural_residual(&stack(20), x))
            .collect();
        let [.., before, last] = residual[..] else { panic!("{residual:?}") };
        assert!(last <= before.powf(1.5), "{residual:?}");
    }
}

#[test]
fn fischer_burmeister_needs_few_steps_where_the_minimum_map_adds_contact_by_contact() {
    let [minimum, fischer] = both().map(|s| s.solve(&stack(40), &Start::default(), &mut ()));
    assert_eq!((minimum.status, fischer.status), (Status::Solved, Status::Solved));
    assert_eq!(minimum.iterations, 40);
    assert!(fischer.iterations < 10);
}

#[test]
fn a_matrix_that_is_not_symmetric_is_solved() {
    let a: [&[f64]; 3] = [&[1.0, 2.0, 0.0], &[0.0, 1.0, 2.0], &[2.0, 0.0, 1.0]];
    for solver in both() {
        let lcp = contacts(&a, &[-1.0; 3]);
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved, "{}", solver.name());
        assert_proved(&lcp, &solution.x);
    }
}

#[test]
fn redundant_contacts_share_the_load() {
    // E10: a box on its four corners. The least change from 0 is the even one.
    let a: [&[f64]; 4] = [
        &[4.0, 1.0, 1.0, -2.0],
        &[1.0, 4.0, -2.0, 1.0],
        &[1.0, -2.0, 4.0, 1.0],
        &[-2.0, 1.0, 1.0, 4.0],
    ];
    for solver in both() {
        let solution = solver.solve(&contacts(&a, &[-1.0; 4]), &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved, "{}", solver.name());
        assert!(solution.x.iter().all(|x| (x - 0.25).abs() < 1e-7), "{:?}", solution.x);
    }
}

/// Whole steps alone get stuck at kinks and among loads that are not unique; with proximal steps a
/// few tens of steps suffice.
#[test]
fn redundant_contacts_with_friction_are_solved_in_few_steps_some_of_them_proximal() {
    let fallbacks = [10.0, 20.0, 50.0].map(|boxes| {
        let family = library::by_name("box-stack").unwrap();
        let lcp = family.generate(&[("boxes", boxes), ("mu", 0.5)]).unwrap().lcp;
        let solution = both()[0].solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        assert_certified(&lcp, &solution.x);
        assert!(solution.iterations <= 60, "{boxes} boxes: {}", solution.iterations);
        solution.fallback
    });
    assert!(fallbacks.contains(&Some(Fallback::Proximal)), "{fallbacks:?}");
}

/// A falling column closes contact by contact: |H|² is the same from one step to the next, and each
/// step is right.
#[test]
fn steps_that_leave_the_sum_of_squares_as_it_is_are_taken_while_they_lead_on() {
    for n in [3, 10, 60] {
        let solution = both()[0].solve(&stack(n), &Start::default(), &mut ());
        assert_eq!((solution.status, solution.iterations), (Status::Solved, n));
    }
}

#[test]
fn friction_bounds_are_part_of_the_equations() {
    let a: [&[f64]; 3] = [&[2.0, 0.5, 0.25], &[0.5, 1.5, 0.5], &[0.25, 0.5, 1.0]];
    let lcp = boxed(&a, &[-2.0, -3.0, 0.25], &[0.0, -INF, -INF], &[INF; 3]);
    let coupling = Coupling::new(vec![None, Some(0), Some(0)], vec![0.0, 0.5, 0.5]).unwrap();
    let lcp = lcp.with_coupling(coupling).unwrap();
    let settings = Settings::default().with_tolerance(1e-12);
    let pgs = Pgs { settings, ..Pgs::default() }.solve(&lcp, &Start::default(), &mut ());
    for solver in both() {
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        assert!(solution.iterations <= 8, "{}", solution.iterations);
        for (x, y) in solution.x.iter().zip(&pgs.x) {
            assert!((x - y).abs() < 1e-7);
        }
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn cholesky_and_least_squares_take_the_same_step(
        m in manufactured(12, 12, 1.0), k in proptest::collection::vec(1..9i32, 12),
    ) {
        // Equations, and the same ones multiplied by different numbers: w̃, H and its Jacobian are
        // unchanged, but A is no longer symmetric and there is no Cholesky factor.
        let n = m.lcp.len();
        let times = |factor: &dyn Fn(usize) -> f64| {
            let entry = |e: usize| factor(e / n) * m.lcp.matrix().entry(e / n, e % n);
            let a: Vec<f64> = (0..n * n).map(entry).collect();
            let b = (0..n).map(|i| factor(i) * m.lcp.b()[i]).collect();
            Lcp::new(Matrix::dense(n, &a), b, vec![-INF; n], vec![INF; n]).unwrap()
        };
        let [newton, _] = both();
        let here = iterates(&newton, &times(&|_| 1.0));
        let there = iterates(&newton, &times(&|i| f64::from(k[i])));
        prop_assume!(here.len() > 1 && there.len() > 1);
        let size = here[1].iter().fold(0.0, |size, x| f64::max(size, x.abs()));
        for (x, y) in here[1].iter().zip(&there[1]) {
            prop_assert!((x - y).abs() < 1e-5 * size, "{:?} {:?}", here[1], there[1]);
        }
    }
}

#[test]
fn nearly_all_singular_problems_with_a_solution_are_solved() {
    // No theorem guarantees this for all: the steps of a singular system may cycle.
    let mut runner = TestRunner::deterministic();
    let mut problem = || manufactured(8, 4, 0.0).new_tree(&mut runner).unwrap().current().lcp;
    let problems: Vec<Lcp> = (0..500).map(|_| problem()).collect();
    let is_regular_row = |lcp: &Lcp| (0..8).all(|i| lcp.matrix().diagonal(i) > 0.0);
    let problems: Vec<&Lcp> = problems.iter().filter(|lcp| is_regular_row(lcp)).collect();
    for solver in both() {
        let is_solved =
            |lcp: &&&Lcp| solver.solve(lcp, &Start::default(), &mut ()).status == Status::Solved;
        let solved = problems.iter().filter(is_solved).count();
        assert!(100 * solved >= 99 * problems.len(), "{}: {solved}", solver.name());
    }
}

/// Two equal rows contradict each other by 1: the first is an equation, so the second must be at
/// its bound a. The slope of the Fischer-Burmeister function towards it is (w/a)²/2: among many
/// steps none finds a distant bound, and none is claimed.
#[test]
fn fischer_burmeister_finds_a_bound_that_contradicting_rows_need_only_if_it_is_not_far() {
    for (a, is_found) in [(1.0, true), (1e3, true), (1e8, false)] {
        let rows: [&[f64]; 2] = [&[1.0, 1.0], &[1.0, 1.0]];
        let lcp = boxed(&rows, &[-1.0, -2.0], &[-INF, -a], &[INF, a]);
        let [minimum, fischer] = both().map(|s| s.solve(&lcp, &Start::default(), &mut ()));
        assert_eq!(minimum.status, Status::Solved, "{a}");
        assert_proved(&lcp, &minimum.x);
        assert_eq!(fischer.status == Status::Solved, is_found, "{a}: {:?}", fischer.x);
    }
}
