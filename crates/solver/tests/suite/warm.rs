//! Warm starts from the cache of the last solve.

use lcplab_lcp::{Lcp, Matrix, library};
use lcplab_solver::{BlockPivoting, Murty, Solution, Solver, Start, Status, Warm};

use lcplab_testing::{INF, assert_certified, assert_proved, boxed, contacts};

fn warmly(solver: &dyn Solver, lcp: &Lcp, warm: &Warm) -> Solution {
    solver.solve(lcp, &Start { warm: Some(warm), ..Start::default() }, &mut ())
}

fn manufactured(n: f64) -> Lcp {
    library::by_name("manufactured").unwrap().generate(&[("n", n)]).unwrap().lcp
}

#[test]
fn a_warm_answer_is_the_cold_one_and_needs_no_exchange_where_the_set_is_the_same() {
    let lcp = manufactured(40.0);
    let next = lcp.with_b(lcp.b().iter().map(|b| 1.01 * b).collect()).unwrap();
    for solver in [&BlockPivoting::default() as &dyn Solver, &Murty::default()] {
        let warm = Warm::default();
        warmly(solver, &lcp, &warm);
        let (there, cold) =
            (warmly(solver, &next, &warm), solver.solve(&next, &Start::default(), &mut ()));
        assert_eq!((&there.status, there.iterations), (&Status::Solved, 0), "{}", solver.name());
        assert_certified(&next, &there.x);
        for (warm, cold) in there.x.iter().zip(&cold.x) {
            assert!((warm - cold).abs() < 1e-10, "{}", solver.name());
        }
    }
}

#[test]
fn the_factor_of_another_matrix_is_not_used() {
    // Twice A with the same b and the same active set: half the x.
    let a = [2.0, -1.0, -1.0, 2.0];
    let twice: Vec<f64> = a.iter().map(|a| 2.0 * a).collect();
    let problem = |a: &[f64]| {
        Lcp::new(Matrix::dense(2, a), vec![-1.0, -1.0], vec![0.0; 2], vec![INF; 2]).unwrap()
    };
    let (solver, warm) = (BlockPivoting::default(), Warm::default());
    let is = |x: &[f64], expected: f64| x.iter().all(|x| (x - expected).abs() < 1e-15);
    assert!(is(&warmly(&solver, &problem(&a), &warm).x, 1.0));
    let there = warmly(&solver, &problem(&twice), &warm);
    assert!(is(&there.x, 0.5), "{:?}", there.x);
    assert_eq!(there.iterations, 0);
}

#[test]
fn a_set_that_is_out_of_date_is_only_a_start() {
    let rows: [&[f64]; 2] = [&[2.0, -1.0], &[-1.0, 2.0]];
    let (solver, warm) = (BlockPivoting::default(), Warm::default());
    warmly(&solver, &boxed(&rows, &[1.0, -9.0], &[0.0; 2], &[1.0; 2]), &warm); // x = (0, 1)
    for lcp in [
        boxed(&rows, &[1.0, -9.0], &[-INF; 2], &[INF; 2]), // no bounds any more
        boxed(&rows, &[-9.0, 1.0], &[0.0; 2], &[1.0; 2]),  // the other bounds
        boxed(&rows, &[1.0, -9.0], &[0.5; 2], &[0.5; 2]),  // pinned
        contacts(&[&[2.0]], &[-1.0]),                      // another number of rows
    ] {
        let solution = warmly(&solver, &lcp, &warm);
        assert_eq!(solution.status, Status::Solved);
        assert_proved(&lcp, &solution.x);
    }
}

#[test]
fn no_warm_start_solves_what_has_no_solution() {
    // Two copies of a row: first x1 + x2 = 1, then 1 and 2 at once.
    let rows: [&[f64]; 2] = [&[1.0, 1.0], &[1.0, 1.0]];
    let possible = boxed(&rows, &[-1.0, -1.0], &[-INF; 2], &[INF; 2]);
    let torn = possible.with_b(vec![-1.0, -2.0]).unwrap();
    let (solver, warm) = (BlockPivoting::default(), Warm::default());
    assert_eq!(warmly(&solver, &possible, &warm).status, Status::Solved);
    let status = warmly(&solver, &torn, &warm).status;
    assert!(matches!(status, Status::Ray { .. }), "{status}");
    assert_eq!(warmly(&solver, &possible, &warm).status, Status::Solved);
}
