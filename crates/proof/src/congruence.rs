//! Positive definiteness by a congruence that makes the matrix diagonally dominant.
//!
//! For a regular G, a symmetric S is positive definite if and only if B = G S Gᵀ is. With G near
//! the inverse of the Cholesky factor L of S, B is near the identity, and if
//!
//! ```text
//! b_ii > Σ_{j ≠ i} |b_ij|    for each row i
//! ```
//!
//! all eigenvalues of B are positive (Gershgorin). G is computed in floating point and then rounded
//! to integers over a power of two; B is exact. So an error in G can make the comparison fail, but
//! never succeed for an S that is not definite. The numbers of an elimination over the integers
//! grow with each row; here all numbers are short.

use dashu_int::IBig;
use dashu_int::ops::Abs;

use lcplab_lcp::exact::dyadic::{Dyadic, exponent, integers};

/// The entries of G are multiples of 2⁻³²: with a unit diagonal of S, rounding them changes b_ij by
/// about n 2⁻³² at most.
const UNIT: f64 = (1_u64 << 32) as f64;

/// Whether the congruence shows that S, symmetric with n rows, is positive definite. `false` means
/// only that it does not show it.
pub fn shows_definite(s: &[Dyadic], n: usize) -> bool {
    let Some(s) = scaled(s, n) else { return false };
    let floats: Vec<f64> = s.iter().map(|s| s.to_f64().value()).collect();
    let Some(g) = inverse_factor(&floats, n) else { return false };
    let is_regular = g.iter().all(|row| row.last() != Some(&IBig::ZERO));
    is_regular && is_dominant(&congruent(&integers(&s), &g))
}

/// D S D for a diagonal D of powers of two, with diagonal entries between ½ and 2; `None` if a
/// diagonal entry is not positive.
fn scaled(s: &[Dyadic], n: usize) -> Option<Vec<Dyadic>> {
    let shift = |i: usize| {
        let own = &s[i * n + i];
        (*own > Dyadic::ZERO).then(|| exponent(own)).flatten().map(|e| -e.div_euclid(2))
    };
    let shifts = (0..n).map(shift).collect::<Option<Vec<isize>>>()?;
    Some((0..n * n).map(|k| s[k].clone() << (shifts[k / n] + shifts[k % n])).collect())
}

/// G = L⁻¹ with S = L Lᵀ, times 2³² and rounded: row i has the i + 1 entries up to the diagonal.
/// `None` if the factorization fails.
fn inverse_factor(s: &[f64], n: usize) -> Option<Vec<Vec<IBig>>> {
    let (mut l, mut g) = (vec![0.0; n * n], vec![0.0; n * n]);
    for i in 0..n {
        // l_ij = (s_ij − Σ_k l_ik l_jk) / l_jj
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| l[i * n + k] * l[j * n + k]).sum();
            let rest = s[i * n + j] - sum;
            l[i * n + j] = if i == j { rest.sqrt() } else { rest / l[j * n + j] };
        }
        if !(l[i * n + i] > 0.0) {
            return None;
        }
        // g_ij = (δ_ij − Σ_k l_ik g_kj) / l_ii
        for j in 0..=i {
            let sum: f64 = (j..i).map(|k| l[i * n + k] * g[k * n + j]).sum();
            let unit = if i == j { 1.0 } else { 0.0 };
            g[i * n + j] = (unit - sum) / l[i * n + i];
        }
    }
    let rounded = |g: &f64| IBig::try_from((g * UNIT).round()).ok();
    (0..n).map(|i| g[i * n..=i * n + i].iter().map(rounded).collect()).collect()
}

/// The lower triangle of G S Gᵀ, row by row.
fn congruent(s: &[IBig], g: &[Vec<IBig>]) -> Vec<Vec<IBig>> {
    let n = g.len();
    // The columns of S Gᵀ.
    let columns: Vec<Vec<IBig>> =
        g.iter().map(|g| (0..n).map(|i| dot(&s[i * n..i * n + g.len()], g)).collect()).collect();
    (0..n).map(|i| (0..=i).map(|j| dot(&g[i], &columns[j][..=i])).collect()).collect()
}

fn dot(a: &[IBig], b: &[IBig]) -> IBig {
    a.iter().zip(b).fold(IBig::ZERO, |sum, (a, b)| sum + a * b)
}

/// Whether each diagonal entry of a symmetric matrix exceeds the sum of the absolute values of the
/// others in its row.
fn is_dominant(lower: &[Vec<IBig>]) -> bool {
    let mut sums = vec![IBig::ZERO; lower.len()];
    for (i, row) in lower.iter().enumerate() {
        for (j, entry) in row[..i].iter().enumerate() {
            let size = entry.abs();
            sums[i] += &size;
            sums[j] += size;
        }
    }
    lower.iter().zip(sums).all(|(row, sum)| row.last().is_some_and(|diagonal| *diagonal > sum))
}
