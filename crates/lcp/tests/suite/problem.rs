use lcplab_lcp::{Coupling, Lcp, Matrix};

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

/// A row without friction, then a contact with its normal last.
fn with_contact() -> Lcp {
    let rows: [&[f64]; 4] = [
        &[9.0, 0.0, 0.0, 1.0],
        &[0.0, 2.0, 0.5, 0.0],
        &[0.0, 0.5, 3.0, 0.0],
        &[1.0, 0.0, 0.0, 4.0],
    ];
    let lcp = boxed(&rows, &[1.0, 2.0, 3.0, 4.0], &[-5.0, -INF, -INF, 0.0], &[5.0, INF, INF, INF]);
    let index = vec![None, Some(3), Some(3), None];
    let coupling = Coupling::new(index, vec![0.0, 0.25, 0.25, 0.0]).unwrap();
    lcp.with_coupling(coupling).unwrap().with_scale(1e-3).unwrap()
}

#[test]
fn a_part_keeps_the_entries_the_contact_and_the_scale_of_its_rows() {
    let part = with_contact().part(&[3, 1, 2]);
    assert_eq!(part.w(&[1.0, 1.0, 1.0]), [8.0, 4.5, 6.5]);
    assert_eq!(part.bounds(2, &[8.0, 0.0, 0.0]), (-2.0, 2.0));
    assert_eq!(part.contacts().iter().map(|own| own.rows).collect::<Vec<_>>(), [[0, 1, 2]]);
    assert_eq!(part.scale(), 1e-3);
}

#[test]
fn a_friction_row_without_its_normal_row_is_free() {
    let part = with_contact().part(&[1, 2]);
    assert_eq!(part.bounds(0, &[0.0, 0.0]), (-INF, INF));
    assert!(part.coupling().is_none() && part.contacts().is_empty());
}

#[test]
fn other_numbers_leave_the_contact_and_the_scale() {
    let lcp = with_contact();
    let matrix = lcp.with_matrix(Matrix::dense(4, &[1.0; 16])).unwrap();
    assert_eq!(matrix.w(&[1.0; 4]), [5.0, 6.0, 7.0, 8.0]);
    let bounds = lcp.with_bounds(vec![0.0, -INF, -INF, 0.0], vec![INF; 4]).unwrap();
    assert_eq!(bounds.bounds(0, &[0.0; 4]), (0.0, INF));
    let mu = lcp.coupling().unwrap().with_mu(|t, normal, mu| mu * (t + normal) as f64).unwrap();
    assert_eq!([mu.mu(1), mu.mu(2)], [1.0, 1.25]);
    for other in [matrix, bounds] {
        assert_eq!((other.contacts(), other.scale()), (lcp.contacts(), 1e-3));
    }
    // The limit of friction would not be of this contact: its normal force could pull.
    assert!(lcp.with_bounds(vec![-1.0, -INF, -INF, -1.0], vec![INF; 4]).is_err());
}
