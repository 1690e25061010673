//! Exact solutions of systems of equations: problems without bounds.

use dashu_ratio::RBig;
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::{Lcp, Matrix};
use oorandom::Rand64;

fn equations(n: usize, a: &[f64], b: &[f64]) -> Lcp {
    let (lo, hi) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
    Lcp::new(Matrix::dense(n, a), b.to_vec(), lo, hi).unwrap()
}

/// A x + b by the definition.
fn w(a: &[f64], b: &[f64], x: &[RBig]) -> Vec<RBig> {
    let exact = |value: f64| RBig::try_from(value).unwrap();
    let n = x.len();
    let sum = |i: usize| (0..n).fold(exact(b[i]), |sum, j| sum + exact(a[i * n + j]) * &x[j]);
    (0..n).map(sum).collect()
}

/// Both ways of solving them, with up to and with more than ten unknowns; every third matrix has
/// zeros on its diagonal, so that rows must be exchanged, and every second one has huge and tiny
/// entries.
#[test]
fn the_solution_of_random_equations_satisfies_every_one_exactly() {
    let (mut random, mut solved) = (Rand64::new(10), 0);
    for n in 1..=13 {
        for k in 0..12 {
            let mut entry = |i: usize| {
                let whole = random.rand_range(0..19) as f64 - 9.0;
                let scale = if k % 2 == 0 { 0 } else { random.rand_range(0..120) as i32 - 60 };
                let is_zero = k % 3 == 0 && n > 1 && i.is_multiple_of(n + 1);
                if is_zero { 0.0 } else { whole * 2f64.powi(scale) }
            };
            let a: Vec<f64> = (0..n * n).map(&mut entry).collect();
            let b: Vec<f64> = (1..=n).map(&mut entry).collect();
            let solutions = all_solutions(&equations(n, &a, &b)).unwrap();
            for x in &solutions {
                assert!(w(&a, &b, x).iter().all(|w| *w == RBig::ZERO), "{n} rows, {k}");
            }
            assert!(solutions.len() <= 1);
            solved += solutions.len();
        }
    }
    // A singular matrix is rare.
    assert!(solved >= 140, "{solved} of 156");
}

/// Row i of A is e_(i+1), the last one e_0: no pivot stands where it is needed.
#[test]
fn a_permutation_is_solved_by_exchanging_rows() {
    for n in [2, 3, 10, 11] {
        let a: Vec<f64> = (0..n * n).map(|k| f64::from(k % n == (k / n + 1) % n)).collect();
        let b: Vec<f64> = (0..n).map(|i| -(i as f64)).collect();
        let solutions = all_solutions(&equations(n, &a, &b)).unwrap();
        let expected: Vec<RBig> = (0..n).map(|i| RBig::from((i + n - 1) % n)).collect();
        assert_eq!(solutions, [expected], "{n} rows");
    }
}
