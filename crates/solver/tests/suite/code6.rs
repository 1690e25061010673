//! The known-wrong variant: its limit instead of the solution (E06).

use lcplab_judge::{Demand, judge};
use lcplab_solver::{Code6, Pgs, Settings, Solver, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{cases, chain, contacts, iterates, manufactured};

#[test]
fn a_the_limit_is_not_the_solution() {
    let lcp = contacts(&[&[1.0, 0.5], &[0.5, 1.0]], &[1.0, -1.0]);
    let solution = Code6::default().solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::IterationLimit);
    assert_eq!(solution.x, [0.0, 2.0]); // 1.5 / (1 − 1/4); the solution is (0, 1)
    let exchanged = contacts(&[&[1.0, 0.5], &[0.5, 1.0]], &[-1.0, 1.0]);
    let solution = Code6::default().solve(&exchanged, &Start::default(), &mut ());
    assert_eq!((solution.status, solution.x), (Status::Solved, vec![1.0, 0.0]));
}

#[test]
fn b_the_hitting_pair_keeps_closing_at_a_third() {
    let lcp = contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[1.0, -1.0]);
    let solution = Code6::default().solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::IterationLimit);
    assert!((solution.x[1] - 1.0 / 3.0).abs() < 1e-15 && solution.x[0] == 0.0);
    assert!((solution.w[1] + 1.0 / 3.0).abs() < 1e-15);
}

#[test]
fn c_it_diverges_on_a_definite_matrix() {
    let a: [&[f64]; 3] = [&[3.0, 1.0, 2.0], &[1.0, 4.0, 3.0], &[2.0, 3.0, 3.0]];
    let lcp = contacts(&a, &[0.0, 0.0, -1.0]);
    // The first sweep ends at the solution and the next one leaves it: test only every 1001 sweeps.
    let settings = Settings::default().with_check_every(1001);
    let path = iterates(&Code6 { settings }, &lcp);
    assert_eq!(path[1], [0.0, 0.0, 1.0 / 3.0]);
    for (k, x) in path.iter().take(1001).enumerate().skip(1) {
        let expected = 1.0 / 3.0 + 37.0 / 36.0 * path[k - 1][2];
        assert!((x[2] - expected).abs() <= 1e-14 * expected, "sweep {k}: {x:?}");
    }
    for (k, x) in [(1, 0.333), (2, 0.676), (10, 3.78), (100, 174.0), (1000, 9.5e12)] {
        assert!((path[k][2] / x - 1.0).abs() < 6e-3, "sweep {k}: {}", path[k][2]);
    }
}

#[test]
fn without_bounds_it_is_gauss_seidel() {
    let lcp = chain(6);
    let (code6, pgs) = (iterates(&Code6::default(), &lcp), iterates(&Pgs::default(), &lcp));
    for (x, y) in code6.iter().zip(&pgs) {
        assert!(x.iter().zip(y).all(|(x, y)| (x - y).abs() < 1e-13));
    }
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn it_never_claims_what_the_judge_refutes(m in manufactured(5, 5, 0.5)) {
        let solution = Code6::default().solve(&m.lcp, &Start::default(), &mut ());
        if solution.status == Status::Solved {
            prop_assert!(judge(&m.lcp, &solution.x, &Demand::default()).verdict.is_solution());
        }
    }
}
