//! Solutions and classes of matrices by their definitions, in rational arithmetic.

use dashu_ratio::RBig;
use lcplab_lcp::Lcp;

/// max |x − Π(x − w)| by the definition of a solution.
pub fn natural_residual(lcp: &Lcp, x: &[f64]) -> f64 {
    let n = lcp.len();
    let row = |i: usize| {
        let w = (0..n).map(|j| lcp.matrix().entry(i, j) * x[j]).sum::<f64>() + lcp.b()[i];
        let (lo, hi) = match lcp.coupled_to(i) {
            Some((k, mu)) => (-mu * x[k].max(0.0), mu * x[k].max(0.0)),
            None => (lcp.lo()[i], lcp.hi()[i]),
        };
        (x[i] - (x[i] - w).max(lo).min(hi)).abs()
    };
    (0..n).map(row).fold(0.0, f64::max)
}

/// A in rational numbers.
pub fn rational(lcp: &Lcp) -> Vec<Vec<RBig>> {
    let n = lcp.len();
    let entry = |i, j| RBig::try_from(lcp.matrix().entry(i, j)).unwrap();
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// The signs of LDLᵀ with the largest diagonal entry as the next pivot: whether a symmetric A is
/// semidefinite, and whether it is definite.
pub fn definiteness(mut a: Vec<Vec<RBig>>) -> (bool, bool) {
    let n = a.len();
    let is_symmetric = (0..n).all(|i| (0..i).all(|j| a[i][j] == a[j][i]));
    let mut left: Vec<usize> = (0..n).collect();
    while is_symmetric && !left.is_empty() {
        let at = (0..left.len()).max_by(|&p, &q| a[left[p]][left[p]].cmp(&a[left[q]][left[q]]));
        let k = left.remove(at.unwrap());
        if a[k][k] <= RBig::ZERO {
            let is_zero = |i: usize| left.iter().chain([&k]).all(|&j| a[i][j] == RBig::ZERO);
            return (is_zero(k) && left.iter().all(|&i| is_zero(i)), false);
        }
        for &i in &left {
            for &j in &left {
                a[i][j] = &a[i][j] - &a[i][k] * &a[k][j] / &a[k][k];
            }
        }
    }
    (is_symmetric, is_symmetric)
}

/// The determinant by expansion along the first row.
pub fn determinant(a: &[Vec<RBig>]) -> RBig {
    let Some((first, below)) = a.split_first() else { return RBig::ONE };
    let mut sum = RBig::ZERO;
    for (j, entry) in first.iter().enumerate() {
        let without = |row: &Vec<RBig>| {
            row.iter().enumerate().filter(|(k, _)| *k != j).map(|(_, a)| a.clone()).collect()
        };
        let minor: Vec<Vec<RBig>> = below.iter().map(without).collect();
        let term = entry * determinant(&minor);
        sum = if j % 2 == 0 { sum + term } else { sum - term };
    }
    sum
}

pub fn is_p(a: &[Vec<RBig>]) -> bool {
    let n = a.len();
    (1..1usize << n).all(|chosen| {
        let rows: Vec<usize> = (0..n).filter(|i| chosen >> i & 1 == 1).collect();
        let of = |i: &usize| rows.iter().map(|&j| a[*i][j].clone()).collect();
        determinant(&rows.iter().map(of).collect::<Vec<Vec<RBig>>>()) > RBig::ZERO
    })
}
