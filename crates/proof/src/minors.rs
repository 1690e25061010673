//! Signs of principal minors, by elimination over the integers.

use dashu_int::IBig;

use lcplab_lcp::Lcp;
use lcplab_lcp::exact::bareiss::eliminate;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, integers};

use crate::congruence;

/// Whether A + Aᵀ is positive definite: shown by a [congruence](congruence), or because all its
/// leading principal minors are positive (Sylvester).
pub fn is_definite(lcp: &Lcp) -> bool {
    let n = lcp.len();
    let a = |i, j| dyadic(lcp.matrix().entry(i, j));
    let sums: Vec<Dyadic> = (0..n).flat_map(|i| (0..n).map(move |j| a(i, j) + a(j, i))).collect();
    if congruence::shows_definite(&sums, n) {
        return true;
    }
    let sums = integers(&sums);
    has_positive_leading_minors(sums.chunks(n.max(1)).map(<[IBig]>::to_vec).collect())
}

/// Whether all principal minors of A are positive.
pub fn is_p(lcp: &Lcp) -> bool {
    let n = lcp.len();
    let a: Vec<Dyadic> =
        (0..n).flat_map(|i| (0..n).map(move |j| dyadic(lcp.matrix().entry(i, j)))).collect();
    let a = integers(&a);
    // Each bit of `set` stands for a row.
    (1_usize..1 << n).all(|set| {
        let rows: Vec<usize> = (0..n).filter(|i| set >> i & 1 == 1).collect();
        let row = |&i: &usize| rows.iter().map(|&j| a[i * n + j].clone()).collect();
        determinant_is_positive(rows.iter().map(row).collect())
    })
}

/// Elimination without row exchanges: its pivots are the leading principal minors.
fn has_positive_leading_minors(mut m: Vec<Vec<IBig>>) -> bool {
    let mut last = IBig::ONE;
    for c in 0..m.len() {
        if m[c][c] <= IBig::ZERO {
            return false;
        }
        eliminate(&mut m, c, &last);
        last = m[c][c].clone();
    }
    true
}

/// Whether a determinant is positive; rows are exchanged if a pivot is 0.
fn determinant_is_positive(mut m: Vec<Vec<IBig>>) -> bool {
    let (mut last, mut is_positive) = (IBig::ONE, true);
    for c in 0..m.len() {
        let Some(row) = (c..m.len()).find(|&r| m[r][c] != IBig::ZERO) else { return false };
        if row != c {
            m.swap(row, c);
            is_positive = !is_positive;
        }
        eliminate(&mut m, c, &last);
        last = m[c][c].clone();
    }
    (last > IBig::ZERO) == is_positive
}
