use lcplab_analysis::answer::proof_of_denial;
use lcplab_judge::ray::refute;
use lcplab_judge::{Demand, judge};
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{Options, Registry, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, contacts, manufactured};

#[test]
fn two_equations_that_contradict_each_other_are_refuted() {
    // x1 + x2 = 1 and 2: d = (1, −1) has A d = 0 and bᵀd = 1; −d proves it.
    let lcp = boxed(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -2.0], &[-INF; 2], &[INF; 2]);
    assert!(refute(&lcp, 1, &[-1.0, 1.0]).is_some());
    assert!(refute(&lcp, 1, &[1.0, -1.0]).is_none()); // the wrong way
}

#[test]
fn a_ray_against_a_finite_bound_proves_nothing() {
    let lcp = boxed(&[&[0.0]], &[-1.0], &[0.0], &[5.0]); // x = 5 is the solution
    assert!(refute(&lcp, 0, &[1.0]).is_none());
    assert!(refute(&contacts(&[&[0.0]], &[-1.0]), 0, &[1.0]).is_some());
}

#[test]
fn for_an_unsymmetric_matrix_the_columns_count() {
    // d = (1, 0): w1 = −x1 − 2 x2 − 1 is never ≥ 0. With the transposed matrix x = (1/5, 2/5)
    // solves.
    let lcp = contacts(&[&[-1.0, -2.0], &[3.0, 1.0]], &[-1.0, 0.0]);
    assert!(refute(&lcp, 0, &[1.0, 0.0]).is_some());
    let transposed = contacts(&[&[-1.0, 3.0], &[-2.0, 1.0]], &[-1.0, 0.0]);
    assert!(refute(&transposed, 0, &[1.0, 0.0]).is_none());
}

#[test]
fn a_direction_that_is_not_finite_or_too_short_proves_nothing() {
    let lcp = contacts(&[&[0.0]], &[-1.0]);
    for direction in [&[f64::INFINITY][..], &[f64::NAN], &[]] {
        assert!(refute(&lcp, 0, direction).is_none());
    }
}

#[test]
fn rounding_in_the_ray_is_repaired() {
    // A = vvᵀ with v = (1, 1/3 as 3 and 1): null vector (1, −3), given with noise.
    let lcp = boxed(&[&[9.0, 3.0], &[3.0, 1.0]], &[0.0, 1.0], &[-INF; 2], &[INF; 2]);
    assert!(refute(&lcp, 1, &[1.0 / 3.0 + 1e-15, -1.0]).is_some());
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn a_problem_with_a_solution_is_never_refuted(m in manufactured(5, 2, 0.0), d in proptest::collection::vec(-3i32..=3, 5)) {
        let d: Vec<f64> = d.into_iter().map(f64::from).collect();
        for row in 0..5 {
            prop_assert!(refute(&m.lcp, row, &d).is_none());
        }
    }

    #[test]
    fn dantzigs_ray_on_an_inconsistent_problem_is_a_proof(m in manufactured(5, 2, 0.0), shift in 1i32..5) {
        // All rows are equations, with b moved out of the range of A: no solution.
        let b: Vec<f64> = m.lcp.b().iter().enumerate().map(|(i, b)| b + f64::from(shift * (i as i32 * 7 % 5 - 2))).collect();
        let a: Vec<f64> = (0..25).map(|k| m.lcp.matrix().entry(k / 5, k % 5)).collect();
        let lcp = lcplab_lcp::Lcp::new(lcplab_lcp::Matrix::dense(5, &a), b, vec![-INF; 5], vec![INF; 5]).unwrap();
        let solution = Registry::standard().entry("dantzig").unwrap().build(&Options::default()).solve(&lcp, &Start::default(), &mut ());
        match solution.status {
            Status::Ray { row, direction } => prop_assert!(refute(&lcp, row, &direction).is_some()),
            status => prop_assert_eq!(status, Status::Solved),
        }
    }
}

#[test]
fn a_vector_that_proves_is_found_up_to_150_rows_and_checked_at_any_size() {
    // Pairs of walls: x_1 - x_2 >= 1 and x_2 - x_1 >= 1e-9 - 1; the rows of a pair add up to w =
    // -1e-9.
    let walls = |pairs: usize| {
        let n = 2 * pairs;
        let entries: Vec<_> = (0..pairs)
            .flat_map(|k| {
                let (i, j) = (2 * k, 2 * k + 1);
                [(i, i, 1.0), (i, j, -1.0), (j, i, -1.0), (j, j, 1.0)]
            })
            .collect();
        let b = (0..n).map(|i| if i % 2 == 0 { -1.0 } else { 1.0 - 1e-9 }).collect();
        Lcp::new(Matrix::sparse(n, &entries), b, vec![0.0; n], vec![INF; n]).unwrap()
    };
    let demand = Demand { prove_up_to: 150, ..Demand::default() };
    let x: Vec<f64> = (0..60).map(|i| f64::from(i % 2 == 0)).collect();
    assert!(!judge(&walls(30), &x, &demand).verdict.is_solution());
    let large = walls(200);
    let says = |direction: Vec<f64>| Status::Ray { row: 0, direction };
    let ones = says(vec![1.0; 400]);
    assert!(proof_of_denial(&large, &ones, &Demand::default()).is_some());
    let wrong = says((0..400).map(|i| f64::from(i % 2 == 0)).collect());
    assert!(proof_of_denial(&large, &wrong, &Demand::default()).is_none());
}
