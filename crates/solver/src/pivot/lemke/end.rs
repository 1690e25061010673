//! The end of a path: a ray, or x without the rounding errors of the path.

use super::path::Path;
use crate::Status;
use crate::pivot::active_set::ActiveSet;
use crate::pivot::principal::Point;
use crate::tolerances::{RELATIVE_ZERO, RESIDUAL_ROUNDING};
use lcplab_lcp::Lcp;

impl Path<'_> {
    /// The status if no variable becomes zero. Along a ray d no x_i w_i changes, so dᵀA d ≤ 0; if
    /// dᵀA d is larger, some variable does become zero, but only beyond the largest number.
    pub(super) fn endless(&self, c: usize) -> Status {
        let direction = self.form.direction(c);
        let (mut product, mut size) = (0.0, 0.0);
        for (i, d_i) in direction.iter().enumerate().filter(|(_, d)| **d != 0.0) {
            for (j, a_ij) in self.lcp.matrix().row(i).iter() {
                let term = d_i * a_ij * direction[j];
                product += term;
                size += term.abs();
            }
        }
        if product > RELATIVE_ZERO * size {
            return Status::NotFinite;
        }
        let size = |&i: &usize| direction[i].abs();
        let row = (0..direction.len()).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(0);
        Status::Ray { row, direction }
    }
}

/// x at the end of a path without the rounding errors of the path: from a fresh factorization of
/// the active set, first with free rows that are at a bound up to rounding moved to that bound.
pub(super) fn from_active_set(lcp: &Lcp, set: &ActiveSet, x: &[f64]) -> Point {
    let tight = set.tightened(lcp, x);
    let mut best = Point::at(lcp, x.to_vec());
    for set in [&tight, set] {
        let points = [set.point(lcp).ok(), Some(set.moved_to_bounds(lcp, x))];
        for x in points.into_iter().flatten() {
            let point = Point::at(lcp, x);
            if point.largest_residual() < best.largest_residual() {
                best = point;
            }
        }
        if best.largest_residual() <= RESIDUAL_ROUNDING {
            // No other is better by more than rounding.
            break;
        }
    }
    best
}
