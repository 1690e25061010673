//! A bound on the distance to the solution that remains valid under rounding.
//!
//! For symmetric positive definite A the solution x* is unique, and with the natural residual
//! r = x − Π(x − w)
//!
//! ```text
//! |x − x*|₂ ≤ (1 + |A|₂) / λ_min(A) · |r|₂
//! ```
//!
//! (Pang 1987). First the problem is scaled by powers of two to a diagonal near 1, so that the
//! constant does not depend on units. Then every quantity is bounded conservatively: |A|₂ by the
//! largest row sum; λ_min by a Cholesky factorization of A − σ, which cannot succeed in floating
//! point unless λ_min ≥ σ − 4 (n + 2) u tr A (Rump 2006; u = 2⁻⁵³); w by the error of its
//! compensated sum.

use faer::{Mat, Side};

use super::interval::{Interval, add_up, div_up, mul_up, norm_up};
use super::residual::Rows;
use lcplab_lcp::Lcp;

/// The unit roundoff: half the distance from 1 to the next number.
const U: f64 = f64::EPSILON / 2.0;
/// Terms in this range are summed without scaling.
const SAFE: std::ops::Range<f64> = 1e-250..1e250;
/// Problems with more rows are too large for a dense factorization.
const MAX_ROWS: usize = 2_000;

/// A bound on max_i |x_i − x*_i| (unit of x) for a problem without coupling; `None` if A is not
/// symmetric and verified to be positive definite, or is too large.
///
/// ```
/// use lcplab_judge::error_bound;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = Lcp::new(Matrix::dense(1, &[4.0]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// let bound = error_bound::error_bound(&lcp, &[0.5001]).unwrap(); // x* = 0.5
/// assert!(bound > 1e-4 && bound < 5e-4);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn error_bound(lcp: &Lcp, x: &[f64]) -> Option<f64> {
    let n = lcp.len();
    if n > MAX_ROWS || lcp.coupling().is_some() || !lcp.matrix().is_symmetric() {
        return None;
    }
    let d = scaling(lcp)?;
    let a = Mat::from_fn(n, n, |i, j| d[i] * lcp.matrix().entry(i, j) * d[j]);
    let least = least_eigenvalue(&a)?;
    let norm = (0..n).map(|i| (0..n).map(|j| a[(i, j)].abs()).sum::<f64>()).fold(0.0, f64::max);
    let at = Rows::at(lcp, x);
    let residual = norm_up((0..n).map(|i| Interval::around_zero(residual(&at, i, d[i]))));
    // Rounding errors of this and the sums above.
    let slack = 1.0 + 8.0 * (n as f64 + 4.0) * U;
    let bound = mul_up(mul_up(div_up(1.0 + norm, least), slack), residual);
    let largest = d.iter().copied().fold(0.0, f64::max);
    Some(mul_up(bound, largest)).filter(|bound| bound.is_finite())
}

/// Whether A is symmetric and verified to be positive definite: then x is unique, without coupled
/// rows.
///
/// ```
/// use lcplab_judge::error_bound::is_definite;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = |a| Lcp::new(Matrix::from(a), vec![-1.0; 2], vec![0.0; 2], vec![9.0; 2]);
/// assert!(is_definite(&lcp([[2.0, 1.0], [1.0, 2.0]])?));
/// assert!(!is_definite(&lcp([[1.0, 1.0], [1.0, 1.0]])?));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn is_definite(lcp: &Lcp) -> bool {
    let n = lcp.len();
    let least = |d: Vec<f64>| {
        least_eigenvalue(&Mat::from_fn(n, n, |i, j| d[i] * lcp.matrix().entry(i, j) * d[j]))
    };
    n <= MAX_ROWS && lcp.matrix().is_symmetric() && scaling(lcp).and_then(least).is_some()
}

/// Powers of two d_i with d_i² a_ii between ½ and 2; `None` if a diagonal entry is not positive.
fn scaling(lcp: &Lcp) -> Option<Vec<f64>> {
    let power = |i: usize| {
        let a = lcp.matrix().diagonal(i);
        (a > 0.0).then(|| 2f64.powi((0.5 - 0.5 * a.log2()).floor() as i32))
    };
    (0..lcp.len()).map(power).collect()
}

/// A verified lower bound on the smallest eigenvalue, if it is positive.
pub(super) fn least_eigenvalue(a: &Mat<f64>) -> Option<f64> {
    let n = a.nrows();
    let guess =
        a.self_adjoint_eigenvalues(Side::Lower).ok()?.into_iter().fold(f64::INFINITY, f64::min);
    let shift = 0.9 * guess;
    let shifted = Mat::from_fn(n, n, |i, j| a[(i, j)] - if i == j { shift } else { 0.0 });
    shifted.llt(Side::Lower).ok()?;
    let trace: f64 = (0..n).map(|i| a[(i, i)]).sum();
    let least = shift - 4.0 * (n as f64 + 2.0) * U * trace;
    (least > 0.0).then_some(least)
}

/// A bound on |x_i − Π(x_i − w_i)| of the problem scaled by d: x_i/d_i and d_i w_i.
fn residual(at: &Rows<'_>, i: usize, d: f64) -> f64 {
    let (lcp, w, terms) = (at.lcp, at.rows[i].w.value(), at.rows[i].terms.value());
    let n = lcp.len() as f64 + 2.0;
    if terms != 0.0 && !SAFE.contains(&terms) {
        // Too large or too small for unscaled numbers.
        return f64::INFINITY;
    }
    let error = U * w.abs() + (n * U) * (n * U) * terms + f64::MIN_POSITIVE;
    let (w, x) = (d * w, at.x[i] / d);
    let natural = w.min(x - lcp.lo()[i] / d).max(x - lcp.hi()[i] / d).abs();
    add_up(natural, add_up(mul_up(d, error), mul_up(U, x.abs())))
}
