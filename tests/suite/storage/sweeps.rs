use lcplab::lcp::{Lcp, Matrix};
use lcplab::solver::{Order, Pgs, Settings, Solver, Start};
use lcplab::storage::{ALL, Entry, MapOfMaps, sweep};
use nalgebra::DMatrix;
use proptest::prelude::*;

use lcplab_testing::{Iterates, cases};

/// The nonzero entries of B Bᵀ + 1, row by row; a third of B's entries are zero.
fn definite(n: usize) -> impl Strategy<Value = Vec<Entry>> {
    let value = prop_oneof![1 => Just(0.0), 2 => -3.0..3.0f64];
    proptest::collection::vec(value, n * n).prop_map(move |values| {
        let b = DMatrix::from_row_slice(n, n, &values);
        let a = &b * b.transpose() + DMatrix::identity(n, n);
        let entries = (0..n * n).map(|k| (k / n, k % n, a[(k / n, k % n)]));
        entries.filter(|(.., value)| *value != 0.0).collect()
    })
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn sweeps_have_the_same_bits_in_every_storage_and_in_the_solver(
        entries in definite(8),
        b in proptest::collection::vec(-2.0..2.0f64, 8),
    ) {
        let n = b.len();
        let (lo, hi) = (vec![0.0; n], vec![f64::INFINITY; n]);
        let lcp = Lcp::new(Matrix::sparse(n, &entries), b, lo, hi).unwrap();
        let settings =
            Settings::default().with_tolerance(0.0).with_max_iterations(7).with_check_every(1);
        let solver = Pgs { omega: 1.0, order: Order::Natural, settings };
        let mut iterates = Iterates::default();
        solver.solve(&lcp, &Start::default(), &mut iterates);
        for kind in &ALL {
            let a = (kind.of)(n, n, &entries);
            let mut x = vec![0.0; n];
            for expected in iterates.0.iter().skip(1) {
                sweep(&lcp, a.as_ref(), &mut x).unwrap();
                prop_assert_eq!(&x, expected, "{}", kind.name);
            }
        }
    }
}

#[test]
fn a_row_without_a_diagonal_stops_the_sweep_unless_it_is_pinned() {
    let a = MapOfMaps::of(2, 2, &[(0, 0, 1.0)]);
    let lcp = |hi: f64| {
        let matrix = Matrix::dense(2, &[1.0, 0.0, 0.0, 0.0]);
        Lcp::new(matrix, vec![-1.0, -1.0], vec![0.0; 2], vec![f64::INFINITY, hi]).unwrap()
    };
    let mut x = [0.0; 2];
    let zero = sweep(&lcp(1.0), &a, &mut x).unwrap_err().to_string();
    assert_eq!(zero, "matrix: diagonal of row 1: must be positive, is 0");
    assert_eq!(sweep(&lcp(0.0), &a, &mut x), Ok(()));
    assert_eq!(x, [1.0, 0.0]);
}
