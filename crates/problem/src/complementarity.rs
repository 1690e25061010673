//! What boxed LCPs and cone problems have in common.

use super::{Lcp, merit};

/// Find x in K with w = A x + b pointing out of K nowhere: w·(y − x) ≥ 0 for all y in K.
///
/// K is a box for an [`Lcp`], a product of cones and intervals for a
/// [`ConeProblem`](super::friction::ConeProblem). K may depend on x (coupled rows), or w may be
/// shifted by something that depends on x (Coulomb's law); *frozen* at an x, neither does.
pub trait Complementarity: Sized {
    /// A and b.
    fn lcp(&self) -> &Lcp;

    /// x ← Π_K(x).
    fn project_all(&self, x: &mut [f64]);

    /// The largest dimensionless residual, 0 exactly at the solutions.
    fn scaled_residual(&self, x: &[f64]) -> f64;

    /// Whether that is at most the tolerance, in compensated sums too; `first` is a hint where to
    /// look first, and kept from one look to the next.
    fn is_within(&self, x: &[f64], tolerance: f64, first: &mut usize) -> bool;

    /// Whether neither K nor w's shift depends on x.
    fn is_frozen(&self) -> bool;

    /// The problem with what depends on x fixed as it is at this x. x solves this one if and only
    /// if it solves that one.
    fn frozen_at(&self, x: &[f64]) -> Self;

    /// Whether x + t d stays in K for all t ≥ 0, from every x in K; never where w is shifted.
    fn recedes(&self, d: &[f64]) -> bool;

    /// Whether x is nearer to a solution than x = Π(0): else it has run off, and its residual is
    /// small only beside its terms.
    fn is_worth_something(&self, _x: &[f64], _tolerance: f64) -> bool {
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

    fn is_worth_something(&self, x: &[f64], tolerance: f64) -> bool {
        merit::is_worth_something(self, x, tolerance)
    }
}
