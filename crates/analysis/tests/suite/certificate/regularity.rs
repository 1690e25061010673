//! Rank, condition and dependent rows compared with matrices of known null space.

use lcplab_judge::regularity::{least_eigenvalue, regularity};
use lcplab_judge::uniqueness::free_rank;
use lcplab_lcp::Matrix;
use nalgebra::DMatrix;
use proptest::collection::vec;
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, contacts};

/// A = J Jᵀ of a plate of unit mass and inertias on four feet at (±1, ±1): heave, roll and pitch.
fn feet() -> DMatrix<f64> {
    let j = DMatrix::from_row_slice(4, 3, &[1., 1., 1., 1., 1., -1., 1., -1., -1., 1., -1., 1.]);
    &j * j.transpose()
}

#[test]
fn four_feet_depend_on_each_other_like_a_checkerboard() {
    let found = regularity(&Matrix::from(feet().as_view())).unwrap();
    assert_eq!((found.rank, found.dependencies.len()), (3, 1));
    assert_eq!(found.zero_rows, [0; 0]);
    let d = &found.dependencies[0];
    for (entry, sign) in d.iter().zip([1.0, -1.0, 1.0, -1.0]) {
        assert!((entry * d[0].signum() - sign).abs() < 1e-12, "{d:?}");
    }
    assert!((found.condition - 1.0).abs() < 1e-12); // the columns of J are orthogonal, of length 2
}

#[test]
fn copies_of_a_contact_depend_on_each_other_in_pairs() {
    let found = regularity(&Matrix::dense(3, &[1.0; 9])).unwrap();
    assert_eq!((found.rank, found.dependencies.len()), (1, 2));
    for d in &found.dependencies {
        let of_pair: Vec<f64> = d.iter().copied().filter(|entry| *entry != 0.0).collect();
        assert_eq!(of_pair.len(), 2, "{d:?}");
        assert!((of_pair[0] + of_pair[1]).abs() < 1e-12, "{d:?}");
    }
}

#[test]
fn zero_rows_and_zero_diagonals_are_seen() {
    let nothing = regularity(&Matrix::dense(0, &[])).unwrap();
    assert_eq!((nothing.rank, nothing.condition), (0, 1.0));
    let zeros = regularity(&Matrix::dense(2, &[0.0; 4])).unwrap();
    assert_eq!((zeros.rank, zeros.condition), (0, 1.0));
    assert_eq!(zeros.zero_rows, [0, 1]);
    // [[0, 4], [4, 0]] with a zero row between: scaled to [[0, 1], [1, 0]].
    let a = Matrix::dense(3, &[0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0]);
    let found = regularity(&a).unwrap();
    assert_eq!((found.rank, found.zero_rows), (2, vec![1]));
    assert!((found.condition - 1.0).abs() < 1e-14);
    assert_eq!(found.dependencies, [[0.0, 1.0, 0.0]]);
}

#[test]
fn the_least_eigenvalue_is_that_of_the_matrix_scaled_to_a_unit_diagonal() {
    // Scaled: [[1, ½], [½, 1]], eigenvalues ½ and 3/2; with 2 off the diagonal −1 and 3.
    let least = |beside: f64| {
        least_eigenvalue(&contacts(&[&[4.0, 8.0 * beside], &[8.0 * beside, 16.0]], &[0.0; 2]))
    };
    assert!((least(0.5).unwrap() - 0.5).abs() < 1e-14);
    assert!((least(2.0).unwrap() + 1.0).abs() < 1e-14);
    assert_eq!(least_eigenvalue(&contacts(&[&[1.0, 1.0], &[0.0, 1.0]], &[0.0; 2])), None);
    assert_eq!(least_eigenvalue(&contacts(&[], &[])), None);
}

#[test]
fn only_rows_strictly_between_their_bounds_decide_whether_x_is_unique() {
    let a = feet();
    let rows: Vec<Vec<f64>> = (0..4).map(|i| a.row(i).iter().copied().collect()).collect();
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let lcp = boxed(&rows, &[-1.0; 4], &[0.0; 4], &[2.0, INF, INF, INF]);
    assert_eq!(free_rank(&lcp, &[0.5; 4]), (4, 3)); // the load can be shared in many ways
    assert_eq!(free_rank(&lcp, &[0.5, 0.5, 0.0, 0.5]), (3, 3));
    assert_eq!(free_rank(&lcp, &[2.0, 0.0, 0.5, 0.0]), (1, 1));
    assert_eq!(free_rank(&lcp, &[0.0; 4]), (0, 0));
    let flat = contacts(&[&[0.0, 0.0], &[0.0, 3.0]], &[0.0; 2]);
    assert_eq!(free_rank(&flat, &[1.0, 1.0]), (2, 1));
    let far_apart = contacts(&[&[1e-20, 0.0], &[0.0, 3.0]], &[0.0; 2]); // units do not decide
    assert_eq!(free_rank(&far_apart, &[1.0, 1.0]), (2, 2));
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn units_do_not_enter_and_each_dependency_is_one(
        j in vec((-4..=4i32).prop_map(f64::from), 9 * 4), exponents in vec(-40..40i32, 9),
    ) {
        let j = DMatrix::from_vec(9, 4, j);
        let rank = j.rank(1e-9);
        let unit = DMatrix::from_fn(9, 9, |r, c| if r == c { 2f64.powi(exponents[r]) } else { 0.0 });
        let a = &unit * &j * j.transpose() * &unit;
        let found = regularity(&Matrix::from(a.as_view())).unwrap();
        prop_assert_eq!((found.rank, found.dependencies.len()), (rank, 9 - rank));
        for d in &found.dependencies {
            let largest = d.iter().fold(0.0, |most, &d| if f64::abs(d) > f64::abs(most) { d } else { most });
            prop_assert_eq!(largest, 1.0);
            for c in 0..9 {
                let terms = (0..9).map(|r| d[r] * a[(r, c)]);
                let size = (0..9).map(|r| (d[r] * (a[(r, r)] * a[(c, c)]).sqrt()).abs()).sum::<f64>();
                prop_assert!(terms.sum::<f64>().abs() <= 1e-9 * size);
            }
        }
    }
}
