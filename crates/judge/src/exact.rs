//! Proof that an active set carries a solution, in exact arithmetic.
//!
//! Floating-point numbers are exact rationals. From x and w the active set is read off: row i is at
//! its lower bound, at its upper bound or free according to Π_i(x_i − w_i/s_i), where a coupled row has
//! the bounds ±μ x_k of x. Then the equations of these sides are solved over the rationals
//! ([`lcp::exact`](lcplab_problem::exact)), and the point is held against the problem as it was posed: every
//! bound, that of a coupled row with the x_k of the point itself, and every sign of w is decided exactly.
//! Where the equations are singular, the unknowns that they leave open keep the value they have in x.
//!
//! A failed proof refutes nothing: the active set may have been misread where x_i − w_i/s_i lies
//! within rounding of a bound.

use dashu_ratio::RBig;

use lcplab_problem::Lcp;
use lcplab_problem::exact::{Exact, Side};
use lcplab_problem::merit::row_scale;

/// A solution that exists exactly, near the x it was read off from.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// The exact solution.
    pub x: Vec<RBig>,
    /// max_i |x_i − x*_i|, rounded up.
    pub distance: f64,
    /// A direction d with A d = 0 among rows strictly between their bounds, if there is one: x* can
    /// be moved along it without moving any w, so it is not the only solution. Rows that slide follow
    /// the row that bounds them.
    pub null_direction: Option<Vec<RBig>>,
}

/// Proves that the active set of x carries a solution of the problem, if it does.
///
/// `w` is A x + b; it only serves to read the active set. Costs one exact linear solve.
pub fn prove(lcp: &Lcp, x: &[f64], w: &[f64]) -> Option<Proof> {
    let exact = Exact::new(lcp);
    let sides = sides(lcp, x, w);
    let inside: Vec<f64> = (0..x.len()).map(|i| lcp.project(i, x[i], x)).collect();
    let (point, null) = exact.point(&sides, &inside)?;
    if !exact.is_solved_by(&point) {
        return None;
    }
    let null = null.filter(|d| exact.is_free_along(d, &point, &sides));
    Some(Proof {
        distance: point.distance(x),
        x: point.entries(),
        null_direction: null.map(|d| d.entries()),
    })
}

/// Where Π(x − w/s) lies, row by row.
pub(super) fn sides(lcp: &Lcp, x: &[f64], w: &[f64]) -> Vec<Side> {
    let side = |i: usize| {
        let (lo, hi) = lcp.bounds(i, x);
        let scale = match row_scale(lcp, i) {
            0.0 => 1.0,
            scale => scale,
        };
        let target = x[i] - w[i] / scale;
        if lo == hi || target <= lo {
            Side::Lower
        } else if target >= hi {
            Side::Upper
        } else {
            Side::Free
        }
    };
    (0..lcp.len()).map(side).collect()
}
