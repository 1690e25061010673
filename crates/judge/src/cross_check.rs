//! How far is an answer from clarabel's, in impulses and in motion?
//!
//! Where contacts are redundant, x is not unique but w and the velocities u are; so each is
//! compared on its own.

use super::residual::Rows;
use super::{Certificate, Demand, judge};
use crate::reference;
use lcplab_problem::Lcp;

/// The answer beside the box QP's.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossCheck {
    /// Clarabel's x, moved onto the bounds that its w pushes it to.
    pub x: Vec<f64>,
    /// Clarabel's optimal value.
    pub objective: f64,
    /// What the judge says of that x at [`REFERENCE_TOLERANCE`].
    pub certificate: Certificate,
    /// Clarabel's own status.
    pub status: String,
    /// max_i |x_i − x_i'|, in the unit of x.
    pub x_difference: f64,
    /// max_i |w_i − w_i'|, in the unit of w.
    pub w_difference: f64,
}

/// An interior point stops at a small duality gap; its residual is about the root of that.
pub const REFERENCE_TOLERANCE: f64 = 1e-5;

/// Compares x with the box QP's solution; the bounds of coupled rows are those at x. `None` if the
/// problem is not a QP (A not symmetric).
pub fn cross_check(lcp: &Lcp, x: &[f64]) -> Option<CrossCheck> {
    let frozen = lcp.frozen_at(x);
    let reference = reference::box_qp(&frozen)?;
    let point = onto_bounds(&frozen, &reference.point);
    let demand = Demand { tolerance: REFERENCE_TOLERANCE, prove_up_to: 0 };
    let certificate = judge(&frozen, &point, &demand);
    Some(CrossCheck {
        x_difference: max_difference(x, &point),
        w_difference: max_difference(&lcp.w(x), &certificate.w),
        certificate,
        x: point,
        objective: reference.objective,
        status: reference.status,
    })
}

/// An interior point lies beside its bounds; puts x_i on the bound where Π_i(x_i − w_i/s_i) is.
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
pub fn max_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
