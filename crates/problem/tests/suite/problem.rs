use lcplab_problem::{Coupling, Lcp, Matrix};

use lcplab_testing::{INF, boxed};

#[test]
fn every_defect_is_reported_at_once() {
    let a = Matrix::dense(2, &[1.0, f64::NAN, 0.0, 1.0]);
    let error = Lcp::new(a, vec![INF, 0.0], vec![2.0, 0.0], vec![1.0, f64::NAN]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "problem: 4 defects\n  A[0][1]: must be finite, is NaN\n  b[0]: must be finite, is inf\n  \
         lo[0]: is 2, above hi[0] = 1\n  hi[1]: is NaN, no number can meet it"
    );
}

#[test]
fn lengths_that_disagree_are_named_with_both_numbers() {
    let error = Lcp::new(Matrix::dense(1, &[1.0]), vec![0.0; 2], vec![0.0], vec![1.0]).unwrap_err();
    assert_eq!(error.to_string(), "problem: b: has 2 rows, A is 1 × 1");
}

#[test]
fn a_coupled_row_is_bounded_by_mu_times_its_normal() {
    let lcp = boxed(&[&[1.0, 0.0], &[0.0, 1.0]], &[0.0; 2], &[0.0, -INF], &[INF, INF]);
    let lcp =
        lcp.with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap()).unwrap();
    assert_eq!(lcp.bounds(1, &[4.0, 0.0]), (-2.0, 2.0));
    assert_eq!(lcp.bounds(1, &[-4.0, 0.0]), (0.0, 0.0));
    assert_eq!(lcp.project(1, 3.0, &[4.0, 0.0]), 2.0);
}

#[test]
fn impossible_couplings_are_refused() {
    let message =
        |index: Vec<Option<usize>>, mu: Vec<f64>| Coupling::new(index, mu).unwrap_err().to_string();
    assert_eq!(
        message(vec![Some(0)], vec![1.0]),
        "problem: friction_index[0]: is 0: a row cannot bound itself"
    );
    assert_eq!(
        message(vec![Some(7)], vec![1.0]),
        "problem: friction_index[0]: is 7, there are only 1 rows"
    );
    assert_eq!(
        message(vec![None, Some(0)], vec![0.0, -1.0]),
        "problem: mu[1]: must be at least 0, is -1"
    );
    assert_eq!(
        message(vec![None, Some(0)], vec![f64::NAN, 0.5]), // JSON could not carry it
        "problem: mu[0]: must be finite, is NaN"
    );
    assert_eq!(
        message(vec![None, Some(0), Some(1)], vec![1.0; 3]),
        "problem: friction_index[2]: is 1, which is a friction row itself"
    );
    let lcp = boxed(&[&[1.0, 0.0], &[0.0, 1.0]], &[0.0; 2], &[-1.0, -INF], &[INF, INF]);
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap();
    let error = lcp.with_coupling(coupling).unwrap_err().to_string();
    assert_eq!(error, "problem: friction_index[1]: is 0, whose lower bound -1 is below 0");
}

#[test]
fn a_coupling_of_another_size_is_refused() {
    let error = Coupling::new(vec![None, Some(0)], vec![0.5]).unwrap_err().to_string();
    assert_eq!(error, "problem: mu: has 1 rows, friction_index has 2");
    let one = boxed(&[&[1.0]], &[0.0], &[0.0], &[INF]);
    let pair = Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap();
    let error = one.with_coupling(pair).unwrap_err().to_string();
    assert_eq!(error, "problem: friction_index: has 2 rows, A has 1");
}
