//! What boxed LCPs and cone problems have in common.

use super::merit::RowTerms;
use super::{Lcp, merit};

/// Find x in K with w = A x + b pointing out of K nowhere: w·(y − x) ≥ 0 for all y in K.
///
/// K is a box for an [`Lcp`], a product of cones and intervals for a
/// [`ConeProblem`](super::friction::ConeProblem). K may depend on x (coupled rows), or w may be shifted
/// by something that depends on x (Coulomb's law); *frozen* at an x, neither does.
pub trait Complementarity: Sized {
    /// A and b.
    fn lcp(&self) -> &Lcp;

    /// x ← Π_K(x).
    fn project_all(&self, x: &mut [f64]);

    /// The largest dimensionless residual, 0 exactly at the solutions.
    fn scaled_residual(&self, x: &[f64]) -> f64;

    /// Whether that is at most the tolerance; `first` is a hint where to look first, and kept from one
    /// look to the next.
    fn is_within(&self, x: &[f64], tolerance: f64, _first: &mut usize) -> bool {
        self.scaled_residual(x) <= tolerance
    }

    /// Whether neither K nor w's shift depends on x.
    fn is_frozen(&self) -> bool;

    /// The problem with what depends on x fixed as it is at this x. x solves this one if and only if
    /// it solves that one.
    fn frozen_at(&self, x: &[f64]) -> Self;

    /// Whether x + t d stays in K for all t ≥ 0, from every x in K; never where w is shifted.
    fn recedes(&self, d: &[f64]) -> bool;

    /// Whether the residual itself, not only its size beside a large x, is well below that of
    /// x = Π(0): else x has run off.
    fn is_better_than_nothing(&self, _x: &[f64]) -> bool {
        true
    }
}

/// An answer whose residual is not below this part of that of doing nothing is none.
const BETTER: f64 = 0.1;

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
            d_i if self.coupling().is_some_and(|c| c.index(i).is_some()) => {
                let (lo, hi) = self.bounds(i, d);
                lo <= d_i && d_i <= hi
            }
            d if d > 0.0 => self.hi()[i].is_infinite(),
            d if d < 0.0 => self.lo()[i].is_infinite(),
            _ => true,
        };
        (0..d.len()).all(is_open)
    }

    fn is_better_than_nothing(&self, x: &[f64]) -> bool {
        let residual = |x: &[f64]| {
            let row = |i: usize| {
                let (terms, (lo, hi)) = (RowTerms::at(self, i, x), self.bounds(i, x));
                let scale = if terms.scale > 0.0 { terms.scale } else { 1.0 };
                terms.scaled_residual(x[i], lo, hi) * terms.magnitude / scale.sqrt()
            };
            (0..x.len()).map(row).fold(0.0, f64::max)
        };
        let mut nothing = vec![0.0; x.len()];
        self.project_all(&mut nothing);
        residual(x) <= BETTER * residual(&nothing)
    }
}
