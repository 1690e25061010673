//! Sums of rows, tested through the pivots of Dantzig's method.

use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{Dantzig, Solver, Start, Status};
use proptest::prelude::*;

use lcplab_testing::assert_close;
use lcplab_testing::{Manufactured, cases, manufactured};

const N: usize = 37;

/// Selects the entries of A to keep.
type Pattern = fn(usize, usize) -> bool;

const PATTERNS: [(&str, Pattern); 5] = [
    ("full", |_, _| true),
    ("band", |i, j| i.abs_diff(j) < 4),
    ("band with gaps", |i, j| [0, 2, 9].contains(&i.abs_diff(j))),
    ("arrow", |i, j| i == j || i.max(j) == N - 1),
    ("blocks", |i, j| i / 9 == j / 9),
];

/// The problem with the same solution and only these entries, dense and sparse; the diagonal is
/// increased so that A stays definite (Gershgorin).
fn cut(m: &Manufactured, keep: Pattern) -> [Lcp; 2] {
    let mut a = m.lcp.matrix().to_dense();
    for (i, j) in (0..N * N).map(|k| (k / N, k % N)).filter(|&(i, j)| !keep(i, j)) {
        a[(i, j)] = 0.0;
    }
    for i in 0..N {
        a[(i, i)] += a.row(i).iter().map(|a| a.abs()).sum::<f64>();
    }
    let entries: Vec<_> = (0..N * N).map(|k| (k / N, k % N, a[(k / N, k % N)])).collect();
    let stored: Vec<_> = entries.iter().copied().filter(|entry| entry.2 != 0.0).collect();
    [Matrix::from(a.as_view()), Matrix::sparse(N, &stored)].map(|matrix| {
        // Exact: the entries of x and A are multiples of 1/4.
        let b = (0..N).map(|i| m.w[i] - matrix.row_dot(i, &m.x)).collect();
        Lcp::new(matrix, b, m.lcp.lo().to_vec(), m.lcp.hi().to_vec()).unwrap()
    })
}

proptest! {
    #![proptest_config(cases(30))]

    #[test]
    fn where_the_zeros_of_a_row_lie_changes_no_solution(m in manufactured(N, N, 1.0)) {
        for (name, keep) in PATTERNS {
            for lcp in cut(&m, keep) {
                let solution = Dantzig::default().solve(&lcp, &Start::default(), &mut ());
                prop_assert_eq!(&solution.status, &Status::Solved, "{}", name);
                assert_close(&solution.x, &m.x, 1e-13);
            }
        }
    }
}
