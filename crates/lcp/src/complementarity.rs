//! The common interface of boxed LCPs and cone problems.

use super::{Lcp, merit};

/// Find x in K such that w = A x + b satisfies w·(y − x) ≥ 0 for all y in K.
///
/// K is a box for an [`Lcp`], and a product of cones and intervals for a
/// [`ConeProblem`](super::friction::ConeProblem). K may depend on x (coupled rows), or w may have a
/// shift that depends on x (Coulomb's law); in the problem *frozen* at an x, both are constant.
pub trait Complementarity: Sized {
    /// A and b.
    fn lcp(&self) -> &Lcp;

    /// x ← Π_K(x).
    fn project_all(&self, x: &mut [f64]);

    /// The largest dimensionless residual, 0 exactly at the solutions.
    fn scaled_residual(&self, x: &[f64]) -> f64;

    /// Whether the residual is at most the tolerance, also in compensated sums; `first` is the row
    /// to check first, updated for the next call.
    fn is_within(&self, x: &[f64], tolerance: f64, first: &mut usize) -> bool;

    /// Whether neither K nor w's shift depends on x.
    fn is_frozen(&self) -> bool;

    /// The problem with everything that depends on x fixed at its value at this x. x solves this
    /// problem if and only if it solves the frozen one.
    fn frozen_at(&self, x: &[f64]) -> Self;

    /// Whether x + t d stays in K for all t ≥ 0, from every x in K; false if w has a shift.
    fn recedes(&self, d: &[f64]) -> bool;

    /// Whether x is closer to a solution than x = Π(0). If not, x has diverged, and its residual is
    /// small only relative to its terms.
    fn improves_on_zero(&self, _x: &[f64], _tolerance: f64) -> bool {
        true
    }
}

impl Complementarity for Lcp {
    fn lcp(&self) -> &Lcp {
        self
    }

    fn project_all(&self, x: &mut [f64]) {
        self.project_all(x);
    }

    fn scaled_residual(&self, x: &[f64]) -> f64 {
        merit::scaled_residual(self, x)
    }

    fn is_within(&self, x: &[f64], tolerance: f64, first: &mut usize) -> bool {
        merit::is_within(self, x, tolerance, first)
    }

    fn is_frozen(&self) -> bool {
        self.coupling().is_none()
    }

    fn frozen_at(&self, x: &[f64]) -> Self {
        self.frozen_at(x)
    }

    fn recedes(&self, d: &[f64]) -> bool {
        let is_open = |i: usize| match d[i] {
            d_i if self.is_coupled(i) => {
                let (lo, hi) = self.bounds(i, d);
                lo <= d_i && d_i <= hi
            }
            d if d > 0.0 => self.hi()[i].is_infinite(),
            d if d < 0.0 => self.lo()[i].is_infinite(),
            _ => true,
        };
        (0..d.len()).all(is_open)
    }

    fn improves_on_zero(&self, x: &[f64], tolerance: f64) -> bool {
        merit::improves_on_zero(self, x, tolerance)
    }
}
