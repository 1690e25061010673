//! The rows of L⁻¹, tested through the factorization of a growing and shrinking set.

use lcplab_lcp::Matrix;
use lcplab_solver::kernel::Width;
use lcplab_solver::linalg::ldlt::Ldlt;
use nalgebra::{DMatrix, DVector};
use proptest::collection::vec;
use proptest::prelude::*;

use lcplab_testing::assert_close;
use lcplab_testing::cases;

/// Five full eights and a partial one.
const N: usize = 45;

/// J Jᵀ + 1 where a row of J reaches at most `band` back.
fn touching(j: &[f64], band: usize) -> DMatrix<f64> {
    let entry = |r, c| if c <= r && r - c <= band { j[r * N + c] } else { 0.0 };
    let j = DMatrix::from_fn(N, N, entry);
    &j * j.transpose() + DMatrix::identity(N, N)
}

fn block(a: &DMatrix<f64>, set: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(set.len(), set.len(), |r, c| a[(set[r], set[c])])
}

fn column(a: &DMatrix<f64>, set: &[usize], i: usize) -> DVector<f64> {
    DVector::from_fn(set.len(), |k, _| a[(set[k], i)])
}

/// −A_CC⁻¹ A_Ci in the order of the set, and A_iC A_CC⁻¹ A_Ci.
fn direction(a: &DMatrix<f64>, set: &[usize], factor: &Ldlt, i: usize) -> (Vec<f64>, f64) {
    factor.eliminate(column(a, set, i).as_slice().to_vec())
}

/// A_CC⁻¹ of this vector.
fn solution(factor: &Ldlt, rhs: &[f64]) -> Vec<f64> {
    let (minus_x, _) = factor.eliminate(rhs.to_vec());
    let (minus_x, zeros) = minus_x.split_at(rhs.len());
    assert!(zeros.iter().all(|&zero| zero == 0.0));
    minus_x.iter().map(|x| -x).collect()
}

/// An existing row is removed, any other is added.
fn exchange(a: &DMatrix<f64>, set: &mut Vec<usize>, factor: &mut Ldlt, row: usize) {
    if let Some(k) = set.iter().position(|&r| r == row) {
        set.remove(k);
        factor.remove(k);
        return;
    }
    let (direction, product) = direction(a, set, factor, row);
    factor.enter(&direction, a[(row, row)] - product);
    set.push(row);
}

/// All rows in order, followed by those that are added and removed.
fn rows() -> impl Strategy<Value = Vec<usize>> {
    vec(0..N, 0..120).prop_map(|moves| (0..N).chain(moves).collect())
}

proptest! {
    #![proptest_config(cases(30))]

    #[test]
    fn rows_come_and_go_and_the_factors_are_those_of_what_is_left(
        j in vec(-1.0..1.0f64, N * N), band in prop::sample::select(vec![0, 2, 11, N]),
        rows in rows(), rhs in vec(-1.0..1.0f64, N),
    ) {
        let a = touching(&j, band);
        let (mut set, mut factor) = (Vec::new(), Ldlt::new(Width::widest()));
        for row in rows {
            exchange(&a, &mut set, &mut factor, row);
        }
        let cholesky = block(&a, &set).cholesky().unwrap();
        let rhs = &rhs[..set.len()];
        let expected = cholesky.solve(&DVector::from_column_slice(rhs));
        assert_close(&solution(&factor, rhs), expected.as_slice(), 1e-12);
        for i in 0..N {
            let column = column(&a, &set, i);
            let (_, product) = direction(&a, &set, &factor, i);
            let expected = column.dot(&cholesky.solve(&column)); // aᵀ A_CC⁻¹ a
            prop_assert!((product - expected).abs() <= 1e-12 * a[(i, i)], "{product} for {expected}");
        }
    }

    #[test]
    fn the_bits_are_the_same_with_all_instructions(
        j in vec(-1.0..1.0f64, N * N), band in prop::sample::select(vec![2, N]), rows in rows(),
    ) {
        let a = touching(&j, band);
        let of_ones = |width| {
            let (mut set, mut factor) = (Vec::new(), Ldlt::new(width));
            rows.iter().for_each(|&row| exchange(&a, &mut set, &mut factor, row));
            solution(&factor, &[1.0; N][..set.len()])
        };
        for width in Width::available() {
            prop_assert_eq!(of_ones(width), of_ones(Width::Portable), "{:?}", width);
        }
    }

    #[test]
    fn the_row_chosen_next_has_lost_the_least_of_its_diagonal_entry(
        j in vec(-1.0..1.0f64, N * N), rank in 0..20usize,
    ) {
        let j = DMatrix::from_fn(N, rank, |r, c| j[r * N + c]);
        let a = &j * j.transpose();
        let all: Vec<usize> = (0..N).collect();
        let (chosen, factor) = Ldlt::pivoted(&Matrix::from(a.as_view()), &all, 1e-9);
        // The fraction of a_ii that row i keeps with these rows: its relative Schur complement.
        let kept = |set: &[usize], i: usize| {
            let column = column(&a, set, i);
            let z = block(&a, set).cholesky().unwrap().solve(&column);
            1.0 - column.dot(&z) / a[(i, i)]
        };
        prop_assert_eq!(chosen.len(), rank);
        for (k, &row) in chosen.iter().enumerate() {
            let own = kept(&chosen[..k], row);
            for i in (0..N).filter(|i| !chosen[..k].contains(i)) {
                prop_assert!(kept(&chosen[..k], i) <= own + 1e-7, "{i} before {row}");
            }
        }
        let expected: Vec<f64> = (0..rank).map(|k| k as f64 - 3.0).collect();
        let rhs = block(&a, &chosen) * DVector::from_column_slice(&expected);
        assert_close(&solution(&factor, rhs.as_slice()), &expected, 1e-6);
    }
}
