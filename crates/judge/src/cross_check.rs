//! Compares an answer with that of clarabel, in impulses and in motion.
//!
//! If contacts are redundant, x is not unique but w and the velocities u are; so each is compared
//! separately.

use super::residual::Rows;
use super::{Certificate, Demand, judge};
use crate::reference;
use lcplab_lcp::Lcp;

/// The comparison of an answer with the box QP's.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossCheck {
    /// The reference's x, with entries moved onto the bounds that their w push them to.
    pub x: Vec<f64>,
    /// Clarabel's optimal value.
    pub objective: f64,
    /// The judge's certificate of that x at [`REFERENCE_TOLERANCE`].
    pub certificate: Certificate,
    /// Clarabel's own status.
    pub status: String,
    /// Why the judge rejects the reference's x, if it does.
    pub failure: Option<String>,
    /// max_i |x_i − x_i'|, in the unit of x.
    pub x_difference: f64,
    /// max_i |w_i − w_i'|, in the unit of w.
    pub w_difference: f64,
}

/// The reference is judged like any other answer.
pub const REFERENCE_TOLERANCE: f64 = 1e-8;

/// Compares x with the solution of the box QP; the bounds of coupled rows are those at x. `None` if
/// the problem is not a QP (A is not symmetric).
///
/// ```
/// use lcplab_judge::cross_check::cross_check;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // The minimum of x² − 2x is −1, at x = 1.
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// let check = cross_check(&lcp, &[1.0]).expect("A is symmetric");
/// assert!(check.x_difference < 1e-8 && (check.objective + 1.0).abs() < 1e-8);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn cross_check(lcp: &Lcp, x: &[f64]) -> Option<CrossCheck> {
    let frozen = lcp.frozen_at(x);
    let reference = reference::box_qp(&frozen)?;
    let point = onto_bounds(&frozen, &reference.point);
    let demand = Demand { tolerance: REFERENCE_TOLERANCE, prove_up_to: 0 };
    let certificate = judge(&frozen, &point, &demand);
    let verdict = &certificate.verdict;
    let failure = (!verdict.is_solution())
        .then(|| format!("clarabel ended with the status {}; {verdict}", reference.status));
    Some(CrossCheck {
        failure,
        x_difference: max_difference(x, &point),
        w_difference: max_difference(&lcp.w(x), &certificate.w),
        certificate,
        x: point,
        objective: reference.objective,
        status: reference.status,
    })
}

/// Moves x_i onto the bound where Π_i(x_i − w_i/s_i) is: where Newton's steps do not converge, the
/// interior point lies slightly inside.
fn onto_bounds(lcp: &Lcp, x: &[f64]) -> Vec<f64> {
    let at = Rows::at(lcp, x);
    let snap = |i: usize| {
        let (lo, hi) = (lcp.lo()[i], lcp.hi()[i]);
        let target = x[i] - (at.rows[i].w / at.rows[i].scale).value();
        if target <= lo {
            lo
        } else if target >= hi {
            hi
        } else {
            x[i].max(lo).min(hi)
        }
    };
    (0..x.len()).map(snap).collect()
}

/// max_i |a_i − b_i|.
///
/// ```
/// use lcplab_judge::cross_check::max_difference;
///
/// assert_eq!(max_difference(&[1.0, 2.0], &[1.5, 0.0]), 2.0);
/// ```
pub fn max_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
