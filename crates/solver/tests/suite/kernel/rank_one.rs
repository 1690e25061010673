//! y ← y + f x, tested through elimination.

use lcplab_solver::linalg::elimination::{Lu, difference};
use nalgebra::{DMatrix, DVector};
use proptest::collection::vec;
use proptest::prelude::*;

use lcplab_testing::cases;

const MOST: usize = 40;

/// The n × n part of these numbers.
fn square(n: usize, entries: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |r, c| entries[r * MOST + c])
}

fn factor(a: &DMatrix<f64>) -> Result<Lu, usize> {
    Lu::of(a.nrows(), |r, c| a[(r, c)])
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn elimination_leaves_a_residual_of_rounding_whatever_the_length_of_a_row(
        n in 0..MOST, entries in vec(-1.0..1.0f64, MOST * MOST), b in vec(-1.0..1.0f64, MOST),
    ) {
        let (a, b) = (square(n, &entries), DVector::from_column_slice(&b[..n]));
        let mut z = b.clone();
        factor(&a).unwrap().solve(z.as_mut_slice());
        let residual = (&a * &z - &b).amax();
        prop_assert!(n == 0 || residual <= 1e-12 * (1.0 + a.abs().row_sum().amax() * z.amax()));
    }

    #[test]
    fn a_matrix_of_rank_r_has_r_pivots(
        n in 1..MOST, part in 0.0..1.0f64, entries in vec(-1.0..1.0f64, MOST * MOST),
    ) {
        // The first r rows have a large diagonal; the others repeat them in other units.
        let rank = (part * n as f64) as usize;
        let mut a = square(n, &entries);
        (0..rank).for_each(|i| a[(i, i)] += n as f64);
        for i in rank..n {
            let copy = if rank == 0 { DMatrix::zeros(1, n) } else { a.rows(i % rank, 1) * 4.0 };
            a.set_row(i, &copy.row(0));
        }
        prop_assert_eq!(factor(&a).unwrap_err(), rank);
    }

    #[test]
    fn a_difference_is_zero_where_a_ten_trillionth_of_its_terms_is_left(
        a in -1e3..1e3f64, sign in prop::sample::select(vec![-1.0, 1.0]),
    ) {
        let [near, apart] = [1.9e-13, 2.1e-13].map(|part| a * (1.0 + sign * part));
        prop_assert_eq!(difference(a, near), 0.0);
        prop_assert_eq!(difference(a, apart), a - apart);
    }
}
