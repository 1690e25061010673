//! Merit functions: measures of how far x is from a solution, one function for each.
//!
//! For coupled rows the bounds are those at x. A measure is summed in plain floating point.
//! [Compensated sums](crate::accurate) decide whether an x counts as a solution, as in the judge,
//! because at the tolerance itself the last digit matters.

mod row;

pub(crate) use row::reach_of_friction;
pub use row::{RowResidual, RowTerms, Sum, block_scale, row_scale};
pub(super) use row::{product, relative};

use super::{Lcp, accurate};

/// max_i r_i, the dimensionless residual that every stopping test and the judge use; ∞ if x is not
/// finite.
///
/// ```text
/// terms_i = Σ_j |a_ij x_j| + |b_i|              at least s_i times the problem's scale, if it has one
/// e_i = min(terms_i / s_i, R_i)                 s_i = row_scale, R_i = RowTerms::reach
/// r_i = |x_i − Π(x_i − e_i w_i / terms_i)| / e_i,   0/0 = 0
/// ```
///
/// An x_i within rounding of a bound ±μ_i x_k counts as being at the bound.
///
/// The residual does not depend on units or on the scaling of rows and columns; rounding errors
/// alone make it about 1e-16.
///
/// If the bounds do not limit the size of x_i, e_i = terms_i / s_i, and r_i = |x_i − Π(x_i −
/// w_i/s_i)| s_i / terms_i. If they do, the step is no longer than they are, so that a small force
/// is not lost next to large terms: a motor with a limit of 1 N m and a target that would need 10⁹
/// N m is not accepted at 0 N m "to nine digits", nor a slip with large terms without friction. In
/// both cases r_i is |w_i| / terms_i for an x_i whose step ends between the bounds.
///
/// ```
/// use lcplab_lcp::merit::{is_within, scaled_residual};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// assert_eq!(scaled_residual(&lcp, &[1.0]), 0.0);
/// assert_eq!(scaled_residual(&lcp, &[3.0]), 0.5); // w = 4, of the terms 6 + 2
/// assert!(is_within(&lcp, &[1.0], 1e-8, &mut 0) && !is_within(&lcp, &[3.0], 1e-8, &mut 0));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn scaled_residual(lcp: &Lcp, x: &[f64]) -> f64 {
    worst(lcp.len(), |i| row_residual(lcp, i, x))
}

/// r_i.
fn row_residual(lcp: &Lcp, i: usize, x: &[f64]) -> f64 {
    RowTerms::at(lcp, i, x).scaled_residual(lcp, i, x)
}

/// Whether max_i r_i is at most the tolerance, in compensated sums. The search starts at row
/// `first`, where the last call found a violation, and stops at the first violation.
pub fn is_within(lcp: &Lcp, x: &[f64], tolerance: f64, first: &mut usize) -> bool {
    let n = lcp.len();
    let mut largest: f64 = 0.0;
    let mut is_outside = |&i: &usize| {
        let residual = row_residual(lcp, i, x);
        largest = largest.max(residual);
        !(residual <= tolerance)
    };
    let outside = (0..n).map(|k| (*first + k) % n).find(&mut is_outside);
    *first = outside.unwrap_or(*first);
    outside.is_none() && (largest <= tolerance - rounding(n) || holds(lcp, x, tolerance))
}

/// Upper bound on the difference of r_i between a plain and a compensated sum of n products and b:
/// each sum has an error of at most (n + 1) ε/2 relative to the terms (Higham 2002, section 3.1),
/// and the error of r_i is at most that of w_i and of the terms together.
fn rounding(n: usize) -> f64 {
    2.0 * (n as f64 + 2.0) * f64::EPSILON
}

/// Whether max_i r_i is at most the tolerance, in compensated sums.
fn holds(lcp: &Lcp, x: &[f64], tolerance: f64) -> bool {
    let residual = |i| RowTerms::summed::<accurate::Sum>(lcp, i, x).scaled_residual(lcp, i, x);
    (0..lcp.len()).all(|i| residual(i) <= tolerance)
}

/// An answer is accepted only if its step is at most this fraction of the step at Π(0).
const BETTER: f64 = 0.1;

/// Whether x is at least ten times closer to a solution than x = Π(0): the longest step max_i |x_i
/// − Π(x_i − w_i/s_i)| √s_i is at most a tenth of that at Π(0). Always true if Π(0) is within the
/// tolerance.
///
/// The scaled residual alone is not sufficient: it becomes small for any x that is far enough away
/// along a direction with A d = 0.
///
/// ```
/// use lcplab_lcp::merit::{improves_on_zero, scaled_residual};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = (x_0 − x_1 − 1, x_1 − x_0 − 1) has no solution: the rows add up to −2.
/// let a = Matrix::from([[1.0, -1.0], [-1.0, 1.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let far = [1e9; 2];
/// assert!(scaled_residual(&lcp, &far) < 1e-9); // small only relative to the terms
/// assert!(!improves_on_zero(&lcp, &far, 1e-8)); // as far from a solution as x = 0
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn improves_on_zero(lcp: &Lcp, x: &[f64], tolerance: f64) -> bool {
    let terms = terms(lcp, x);
    improves_on_zero_by_residuals(lcp, x, &row_residuals(lcp, x, &terms), tolerance)
}

/// [`improves_on_zero`], given the residuals of all rows at x in plain sums. If rounding makes
/// the comparison uncertain, compensated sums decide.
fn improves_on_zero_by_residuals(
    lcp: &Lcp,
    x: &[f64],
    plain: &[RowResidual],
    tolerance: f64,
) -> bool {
    let at_zero = residuals_at_zero(lcp, plain);
    let rounding = rounding(lcp.len());
    let at_most = |row_residual: &RowResidual| RowResidual {
        size: row_residual.size + rounding * row_residual.magnitude,
        ..*row_residual
    };
    let at_most: Vec<RowResidual> = plain.iter().map(at_most).collect();
    let exactly = || {
        let terms = |i| RowTerms::summed::<accurate::Sum>(lcp, i, x);
        row_residuals(lcp, x, &(0..lcp.len()).map(terms).collect::<Vec<_>>())
    };
    is_better(&at_most, at_zero.clone(), tolerance)
        || is_better(plain, at_zero.clone(), tolerance) && is_better(&exactly(), at_zero, tolerance)
}

/// The terms of all rows.
fn terms(lcp: &Lcp, x: &[f64]) -> Vec<RowTerms> {
    (0..lcp.len()).map(|i| RowTerms::at(lcp, i, x)).collect()
}

/// The residuals of all rows at x, given their terms.
///
/// ```
/// use lcplab_lcp::merit::{RowTerms, row_residuals};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = (2 x_0 − 2, 2 x_1 − 2): row 0 is solved, row 1 is not.
/// let a = Matrix::from([[2.0, 0.0], [0.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-2.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let x = [1.0, 3.0];
/// let terms = [0, 1].map(|i| RowTerms::at(&lcp, i, &x));
/// let residuals = row_residuals(&lcp, &x, &terms);
/// assert_eq!((residuals[0].residual, residuals[1].residual), (0.0, 0.5)); // 4 of 6 + 2
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn row_residuals(lcp: &Lcp, x: &[f64], terms: &[RowTerms]) -> Vec<RowResidual> {
    terms.iter().enumerate().map(|(i, terms)| terms.row_residual(lcp, i, x)).collect()
}

/// The residuals at Π(0), row by row, with the scales of `row_residuals`.
fn residuals_at_zero(
    lcp: &Lcp,
    row_residuals: &[RowResidual],
) -> impl Iterator<Item = RowResidual> + Clone {
    let mut nothing = vec![0.0; lcp.len()];
    lcp.project_all(&mut nothing);
    let is_zero = nothing.iter().all(|&x| x == 0.0);
    row_residuals.iter().enumerate().map(move |(i, own)| {
        // w_i at x = 0
        let b = lcp.b()[i];
        let at_zero = || RowTerms::of_sums(lcp, b, b.abs(), own.scale);
        let terms = is_zero.then(at_zero).flatten();
        terms.unwrap_or_else(|| RowTerms::at(lcp, i, &nothing)).row_residual(lcp, i, &nothing)
    })
}

/// Whether the longest step of `row_residuals` is at most a tenth of the longest one at Π(0), or
/// Π(0) is within the tolerance. Evaluates only as many rows at Π(0) as the decision needs.
pub(super) fn is_better(
    row_residuals: &[RowResidual],
    mut at_zero: impl Iterator<Item = RowResidual> + Clone,
    tolerance: f64,
) -> bool {
    let (longest, mut all) = (RowResidual::longest_step(row_residuals), at_zero.clone());
    at_zero.any(|row_residual| longest <= row_residual.step() + libm::log2(BETTER))
        || all.all(|row_residual| row_residual.residual <= tolerance)
}

/// Whether x counts as a solution: the scaled residual is within the tolerance, and x is ten times
/// closer to a solution than Π(0).
///
/// ```
/// use lcplab_lcp::merit::is_solution;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// assert!(is_solution(&lcp, &[1.0], 1e-8));
/// assert!(!is_solution(&lcp, &[0.9], 1e-8));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn is_solution(lcp: &Lcp, x: &[f64], tolerance: f64) -> bool {
    is_solution_by(lcp, x, &row_residuals(lcp, x, &terms(lcp, x)), tolerance)
}

/// [`is_solution`], given the residuals of all rows at x in plain sums. If rounding makes the
/// decision uncertain, compensated sums decide.
pub fn is_solution_by(lcp: &Lcp, x: &[f64], row_residuals: &[RowResidual], tolerance: f64) -> bool {
    let surely = tolerance - rounding(lcp.len());
    let is_within = row_residuals.iter().all(|row_residual| row_residual.residual <= surely)
        || holds(lcp, x, tolerance);
    is_within && improves_on_zero_by_residuals(lcp, x, row_residuals, tolerance)
}

/// max_i |x_i − Π(x_i − w_i)|: zero exactly at the solutions; it mixes the units of x and w.
///
/// ```
/// use lcplab_lcp::merit::natural_residual;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// assert_eq!(natural_residual(&lcp, &[0.5]), 1.0); // w = −1, so x − w = 1.5
/// assert_eq!(natural_residual(&lcp, &[1.0]), 0.0);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn natural_residual(lcp: &Lcp, x: &[f64]) -> f64 {
    worst(lcp.len(), |i| x[i] - lcp.project(i, x[i] - lcp.row_w(i, x), x))
}

/// max_i |φ_i| with the Fischer-Burmeister function φ(a, b) = a + b − √(a² + b²) of the distance to
/// each bound and the w that pushes toward it (Billups' form for two finite bounds).
///
/// ```
/// use lcplab_lcp::merit::fischer_burmeister;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = Lcp::new(Matrix::from([[1.0]]), vec![1.0], vec![0.0], vec![f64::INFINITY])?;
/// assert_eq!(fischer_burmeister(&lcp, &[3.0]), 2.0); // x = 3, w = 4: 3 + 4 − 5
/// assert_eq!(fischer_burmeister(&lcp, &[0.0]), 0.0);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn fischer_burmeister(lcp: &Lcp, x: &[f64]) -> f64 {
    let phi = |a: f64, b: f64| if a.is_infinite() { b } else { a + b - crate::hypot(a, b) };
    worst(lcp.len(), |i| {
        let ((lo, hi), w) = (lcp.bounds(i, x), lcp.row_w(i, x));
        phi(x[i] - lo, -phi(hi - x[i], -w))
    })
}

/// ½ xᵀ A x + bᵀ x; an LCP with symmetric positive semidefinite A is solved by its minimum. For
/// impulses and velocities its unit is the joule.
///
/// ```
/// use lcplab_lcp::merit::objective;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// assert_eq!(objective(&lcp, &[3.0]), 3.0); // x² − 2x
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn objective(lcp: &Lcp, x: &[f64]) -> f64 {
    (0..lcp.len()).map(|i| x[i] * (0.5 * lcp.matrix().row_dot(i, x) + lcp.b()[i])).sum()
}

/// |A x + b|₂ / |b|₂, the chapter's stopping test, K&M (4). A known-wrong variant: at a solution
/// with an active bound it is not zero, because w is not (E04).
///
/// ```
/// use lcplab_lcp::merit::km4;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A body that leaves the ground: x = 0 is the solution, and w = b.
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![1.0], vec![0.0], vec![f64::INFINITY])?;
/// assert_eq!(km4(&lcp, &[0.0]), 1.0); // the test fails at the solution
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn km4(lcp: &Lcp, x: &[f64]) -> f64 {
    euclidean(&lcp.w(x)) / euclidean(lcp.b())
}

/// The number of rows whose x lies strictly between its bounds.
///
/// ```
/// use lcplab_lcp::merit::free_rows;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// assert_eq!(free_rows(&lcp, &[0.5, 0.0]), 1);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn free_rows(lcp: &Lcp, x: &[f64]) -> usize {
    (0..lcp.len())
        .filter(|&i| {
            let (lo, hi) = lcp.bounds(i, x);
            lo < x[i] && x[i] < hi
        })
        .count()
}

/// |v|₂.
fn euclidean(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn worst(n: usize, row: impl Fn(usize) -> f64) -> f64 {
    (0..n)
        .map(|i| row(i).abs())
        .fold(0.0, |worst, r| if r.is_nan() { f64::INFINITY } else { worst.max(r) })
}
