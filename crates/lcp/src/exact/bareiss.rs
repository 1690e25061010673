//! Elimination over the integers without fractions (Bareiss 1968).
//!
//! ```text
//! a_rj ← (a_rj a_cc − a_rc a_cj) / a_c−1,c−1,   r, j > c
//! X_i = (D r_i − Σ_{j > i} a_ij X_j) / a_ii,     x = X / D,   D = ± det A
//! ```
//!
//! All divisions are exact, because every number is a determinant of entries of A and r. With more
//! than about ten rows their digits make [`modular`](super::modular) faster.

use dashu_int::IBig;

/// Eliminates column c from the rows below row c; `last` is the pivot before, at first 1. The
/// pivots are the leading principal minors, if no rows were exchanged.
///
/// ```
/// use dashu_int::IBig;
/// use lcplab_lcp::exact::bareiss::eliminate;
///
/// let mut rows: Vec<Vec<IBig>> = vec![vec![2.into(), 1.into()], vec![1.into(), 3.into()]];
/// eliminate(&mut rows, 0, &IBig::ONE);
/// assert_eq!(rows[1][1], IBig::from(5)); // 2 · 3 − 1 · 1
/// ```
pub fn eliminate(rows: &mut [Vec<IBig>], c: usize, last: &IBig) {
    let (upper, lower) = rows.split_at_mut(c + 1);
    let own = &upper[c];
    for row in lower {
        let factor = std::mem::take(&mut row[c]);
        for j in c + 1..own.len() {
            row[j] = (&row[j] * &own[c] - &factor * &own[j]) / last;
        }
    }
}

/// The solution of A x = r as numerators over one positive denominator; each row holds its entries
/// of A, then r. `None` if A is singular.
pub(super) fn solve(mut rows: Vec<Vec<IBig>>) -> Option<(Vec<IBig>, IBig)> {
    let m = rows.len();
    let mut last = IBig::ONE;
    for c in 0..m {
        let pivot = (c..m).find(|&r| rows[r][c] != IBig::ZERO)?;
        rows.swap(c, pivot);
        eliminate(&mut rows, c, &last);
        last = rows[c][c].clone();
    }
    let mut numerators = vec![IBig::ZERO; m];
    for i in (0..m).rev() {
        let known = (i + 1..m).map(|j| &rows[i][j] * &numerators[j]);
        let rest = known.fold(&last * &rows[i][m], |rest, term| rest - term);
        numerators[i] = rest / &rows[i][i];
    }
    if last < IBig::ZERO {
        numerators.iter_mut().for_each(|x| *x = -std::mem::take(x));
        last = -last;
    }
    Some((numerators, last))
}
