//! The Cholesky factor of a principal submatrix.

use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::linalg::cholesky::Cholesky;
use nalgebra::{DMatrix, DVector};
use proptest::collection::vec;
use proptest::prelude::*;

use lcplab_testing::{INF, cases};

const N: usize = 24;

fn problem(a: &DMatrix<f64>) -> Lcp {
    let n = a.nrows();
    Lcp::new(Matrix::from(a.as_view()), vec![0.0; n], vec![0.0; n], vec![INF; n]).unwrap()
}

fn sparse(a: &DMatrix<f64>) -> Lcp {
    let n = a.nrows();
    let entries: Vec<_> = (0..n * n).map(|k| (k / n, k % n, a[(k / n, k % n)])).collect();
    Lcp::new(Matrix::sparse(n, &entries), vec![0.0; n], vec![0.0; n], vec![INF; n]).unwrap()
}

/// J Jᵀ + shift, where J has `columns` columns.
fn product(j: &[f64], columns: usize, shift: f64) -> DMatrix<f64> {
    let j = DMatrix::from_fn(N, columns, |r, c| j[r * N + c]);
    &j * j.transpose() + DMatrix::identity(N, N) * shift
}

fn chosen(is_chosen: &[bool]) -> Vec<usize> {
    (0..N).filter(|&i| is_chosen[i]).collect()
}

fn solve(factor: &Cholesky, rhs: &[f64]) -> Vec<f64> {
    let mut z = rhs.to_vec();
    factor.solve(&mut z);
    z
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn blocks_of_any_size_one_after_the_other_are_solved_as_nalgebra_solves_them(
        j in vec(-1.0..1.0f64, N * N), sets in vec(vec(any::<bool>(), N), 3),
        rhs in vec(-1.0..1.0f64, N),
    ) {
        let a = product(&j, N, 1.0);
        for lcp in [problem(&a), sparse(&a)] {
            let mut factor = Cholesky::default();
            for rows in sets.iter().map(|set| chosen(set)) {
                let f = rows.len();
                prop_assert_eq!(factor.factor(&lcp, &rows), Ok(()));
                let z = DVector::from_vec(solve(&factor, &rhs[..f]));
                let block = DMatrix::from_fn(f, f, |r, c| a[(rows[r], rows[c])]);
                let rhs = DVector::from_column_slice(&rhs[..f]);
                let expected = block.cholesky().unwrap().solve(&rhs);
                prop_assert!((&z - &expected).amax() <= 1e-13 * expected.amax().max(1e-300));
            }
        }
    }

    #[test]
    fn units_change_no_bit(
        j in vec(-1.0..1.0f64, N * N), exponents in vec(-200..200i32, N),
        rhs in vec(-1.0..1.0f64, N),
    ) {
        let a = product(&j, N, 1.0);
        let unit: Vec<f64> = exponents.iter().map(|&k| 2f64.powi(k)).collect();
        let scaled = DMatrix::from_fn(N, N, |r, c| unit[r] * a[(r, c)] * unit[c]);
        let (rows, mut factor) = ((0..N).collect::<Vec<_>>(), Cholesky::default());
        factor.factor(&problem(&a), &rows).unwrap();
        let plain = solve(&factor, &rhs);
        factor.factor(&problem(&scaled), &rows).unwrap();
        let scaled_rhs: Vec<f64> = (0..N).map(|i| unit[i] * rhs[i]).collect();
        let other = solve(&factor, &scaled_rhs);
        for i in 0..N {
            prop_assert_eq!(unit[i] * other[i], plain[i]);
        }
    }

    #[test]
    fn the_first_row_that_depends_on_those_before_is_named(
        j in vec(-1.0..1.0f64, N * N), first in 1..N,
    ) {
        // From row `first` on, each row is half an earlier one.
        let entry = |r: usize, c: usize| if r == c { 3.0 } else { j[r * N + c] / N as f64 };
        let j = DMatrix::from_fn(N, N, |r, c| match r < first {
            true => entry(r, c),
            false => 0.5 * entry(r % first, c),
        });
        let a = &j * j.transpose();
        let rows: Vec<usize> = (0..N).collect();
        prop_assert_eq!(Cholesky::default().factor(&problem(&a), &rows), Err(first));
        prop_assert_eq!(Cholesky::default().factor(&problem(&a), &rows[..first]), Ok(()));
    }
}

#[test]
fn a_negative_pivot_is_named_by_its_row_of_the_problem() {
    // Rows 1 and 3 alone are [[1, 2], [2, 1]]: the second pivot is 1 − 4.
    let a = DMatrix::from_row_slice(
        4,
        4,
        &[9., 0., 0., 0., 0., 1., 0., 2., 0., 0., 9., 0., 0., 2., 0., 1.],
    );
    assert_eq!(Cholesky::default().factor(&problem(&a), &[1, 3]), Err(3));
    assert_eq!(Cholesky::default().factor(&problem(&a), &[0, 2]), Ok(()));
}

#[test]
fn no_rows_have_a_factor() {
    let mut factor = Cholesky::default();
    assert_eq!(factor.factor(&problem(&DMatrix::identity(2, 2)), &[]), Ok(()));
    assert!(solve(&factor, &[]).is_empty());
}
