use lcplab_solver::{Pgs, Solver, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, contacts, iterates, manufactured, objectives};

fn pgs(omega: f64) -> Pgs {
    Pgs { omega, ..Pgs::default() }
}

#[test]
fn the_clamp_stands_inside_the_sweep() {
    // E06 (a), (b), (c): solved exactly by one sweep; clamping after the sweep goes elsewhere.
    type Case<'a> = (&'a [&'a [f64]], &'a [f64], &'a [f64]);
    let cases: [Case; 3] = [
        (&[&[1.0, 0.5], &[0.5, 1.0]], &[1.0, -1.0], &[0.0, 1.0]),
        (&[&[2.0, -1.0], &[-1.0, 2.0]], &[1.0, -1.0], &[0.0, 0.5]),
        (
            &[&[3.0, 1.0, 2.0], &[1.0, 4.0, 3.0], &[2.0, 3.0, 3.0]],
            &[0.0, 0.0, -1.0],
            &[0.0, 0.0, 1.0 / 3.0],
        ),
    ];
    for (a, b, x) in cases {
        let solution = pgs(1.0).solve(&contacts(a, b), &Start::default(), &mut ());
        assert_eq!((solution.x.as_slice(), solution.iterations), (x, 1));
    }
}

#[test]
fn errors_of_an_equality_pair_shrink_by_a_quarter_each_sweep() {
    // [2 −1; −1 2] with b = −(1, 1): x* = (1, 1), errors of x2 are 1/4, 1/16, … (E07).
    let lcp = boxed(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, -1.0], &[-INF; 2], &[INF; 2]);
    for (k, x) in iterates(&pgs(1.0), &lcp).iter().enumerate().skip(1).take(10) {
        assert_eq!(1.0 - x[1], 0.25f64.powi(k as i32));
    }
}

#[test]
fn a_zero_diagonal_is_named() {
    let lcp = contacts(&[&[1.0, 0.0], &[0.0, 0.0]], &[-1.0, -1.0]);
    let solution = pgs(1.0).solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::ZeroDiagonal { row: 1 });
}

#[test]
fn iterates_that_overflow_end_as_diverged_with_a_finite_x() {
    // Gauss-Seidel multiplies by 1e8 a sweep: not positive semidefinite.
    let lcp = boxed(&[&[1.0, 1e4], &[1e4, 1.0]], &[1.0, 1.0], &[-INF; 2], &[INF; 2]);
    let solution = pgs(1.0).solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::Diverged);
    assert!(solution.x.iter().all(|x| x.is_finite()));
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn no_sweep_raises_the_objective(m in manufactured(6, 4, 0.5), omega in 0.1f64..1.9) {
        for pair in objectives(&pgs(omega), &m.lcp).windows(2) {
            prop_assert!(pair[1] <= pair[0] + 1e-12 * (1.0 + pair[0].abs()), "{pair:?}");
        }
    }
}
