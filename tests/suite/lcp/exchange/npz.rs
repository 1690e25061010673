use lcplab::lcp::exchange;
use proptest::prelude::*;

use super::{again, assert_same, boxes, frictions, message, rows, sample};
use crate::common::{INF, cases};

const UPPER: [[f64; 3]; 3] = [[2.0, -1.0, 0.0], [0.0, 2.0, -1.0], [0.0, 0.0, 1.0 / 3.0]];

#[test]
fn what_numpy_stores_by_columns_is_read() {
    let problem = exchange::read(&sample("numpy.npz"), None).unwrap();
    assert_eq!(rows(problem.lcp.matrix()), UPPER);
    assert_eq!(problem.lcp.b(), [-1.0, 0.1, 3.0]);
    assert_eq!(problem.lcp.hi(), [INF, 7.0, -1.0 / 3.0]);
    assert_eq!((problem.name.as_str(), problem.warnings.len()), ("numpy", 0));
}

#[test]
fn a_compressed_sparse_matrix_of_scipy_and_a_short_big_endian_b_are_read() {
    let lcp = exchange::read(&sample("scipy.npz"), None).unwrap().lcp;
    assert_eq!(rows(lcp.matrix()), UPPER);
    assert_eq!(lcp.matrix().stored(), 5);
    assert_eq!(lcp.b(), [-1.0, f64::from(0.1f32), 3.0]);
}

#[test]
fn a_matrix_alone_is_no_problem() {
    let error = exchange::read(&sample("matrix_only.npz"), None).unwrap_err().to_string();
    assert!(error.ends_with("matrix_only.npz: b: is missing"), "{error}");
}

#[test]
fn what_is_no_archive_is_refused() {
    assert!(message("npz", "PK, but nothing else").starts_with("p: archive: "));
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn every_bit_survives_the_round_trip(problem in boxes(), friction in frictions(1)) {
        assert_same(&problem.lcp, &again(&problem, "npz").lcp);
        assert_same(&friction.lcp, &again(&friction, "npz").lcp);
    }
}
