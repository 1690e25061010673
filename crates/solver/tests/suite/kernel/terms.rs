use lcplab_lcp::merit::RowTerms;
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::kernel::{Width, terms};
use nalgebra::{DMatrix, DVector};
use proptest::collection::vec;
use proptest::prelude::*;

use lcplab_testing::{INF, cases, contacts};

const MOST: usize = 35;

/// The same problem with A dense and sparse; every fourth entry is zero.
fn problems(n: usize, entries: &[f64], b: &[f64]) -> [Lcp; 2] {
    let entry = |k: usize| if k % 4 == 1 { 0.0 } else { entries[k] };
    let dense: Vec<f64> = (0..n * n).map(entry).collect();
    let stored: Vec<_> = (0..n * n).map(|k| (k / n, k % n, dense[k])).collect();
    let stored: Vec<_> = stored.into_iter().filter(|entry| entry.2 != 0.0).collect();
    [Matrix::dense(n, &dense), Matrix::sparse(n, &stored)]
        .map(|a| Lcp::new(a, b[..n].to_vec(), vec![0.0; n], vec![INF; n]).unwrap())
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn the_sums_are_those_of_the_definition_with_all_instructions(
        n in 0..MOST, entries in vec(-1.0..1.0f64, MOST * MOST),
        b in vec(-1.0..1.0f64, MOST), x in vec(-1.0..1.0f64, MOST),
    ) {
        let x = &x[..n];
        for lcp in problems(n, &entries, &b) {
            let (a, column) = (lcp.matrix().to_dense(), DVector::from_column_slice(x));
            let b = DVector::from_column_slice(lcp.b());
            let (w, size) = (&a * &column + &b, a.abs() * column.abs() + b.abs());
            for width in Width::available() {
                let terms = terms(&lcp, x, width);
                prop_assert_eq!(terms.len(), n);
                for (i, term) in terms.iter().enumerate() {
                    prop_assert_eq!(term.w, lcp.row_w(i, x), "row {} with {:?}", i, width);
                    prop_assert!((term.w - w[i]).abs() <= 1e-15 * n as f64 * size[i]);
                    prop_assert!((term.magnitude - size[i]).abs() <= 1e-15 * n as f64 * size[i]);
                    let scale = match a[(i, i)].abs() {
                        0.0 => a.row(i).amax(),
                        diagonal => diagonal,
                    };
                    prop_assert_eq!((term.scale, term.exponent), (scale, 0));
                }
            }
        }
    }
}

#[test]
fn at_zero_only_b_is_left() {
    let b = [3.0, -4.0];
    for lcp in problems(2, &[2.0, 1.0, 1.0, 2.0], &b) {
        let found = terms(&lcp, &[0.0; 2], Width::widest());
        let found: Vec<_> = found.iter().map(|term| (term.w, term.magnitude, term.scale)).collect();
        assert_eq!(found, [(3.0, 3.0, 2.0), (-4.0, 4.0, 2.0)]);
    }
}

#[test]
fn terms_beyond_the_range_of_floating_point_keep_their_ratio() {
    // w = 2^k (3 − 1) where 2^k overflows or vanishes.
    for k in [1400, -1400] {
        let unit = 2f64.powi(k / 2);
        let a = DMatrix::from_row_slice(2, 2, &[3.0 * unit, -unit, 0.0, unit]);
        let lcps = problems(2, &[0.0; 4], &[0.0; 2]);
        let stored = [(0, 0, 3.0 * unit), (0, 1, -unit), (1, 1, unit)];
        for (lcp, a) in lcps.iter().zip([Matrix::from(a.as_view()), Matrix::sparse(2, &stored)]) {
            let lcp = Lcp::new(a, lcp.b().to_vec(), vec![0.0; 2], vec![INF; 2]).unwrap();
            let RowTerms { w, magnitude, scale, exponent } =
                terms(&lcp, &[unit; 2], Width::widest())[0];
            assert_eq!((w.log2() + f64::from(exponent), scale), (f64::from(k) + 1.0, 3.0 * unit));
            assert_eq!(magnitude, 2.0 * w);
        }
    }
}

#[test]
fn a_row_with_nothing_on_its_diagonal_is_scaled_by_its_largest_entry() {
    let lcp = contacts(&[&[0.0, -5.0], &[1.0, 2.0]], &[1.0, 1.0]);
    let sparse = Matrix::sparse(2, &[(0, 1, -5.0), (1, 0, 1.0), (1, 1, 2.0)]);
    let sparse = Lcp::new(sparse, vec![1.0; 2], vec![0.0; 2], vec![INF; 2]).unwrap();
    for lcp in [lcp, sparse] {
        let term = terms(&lcp, &[1.0, 2.0], Width::widest())[0];
        assert_eq!((term.w, term.magnitude, term.scale), (-9.0, 11.0, 5.0));
    }
}
