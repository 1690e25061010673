//! The end: w is recomputed from x, x refined, and what is not satisfied is named.

use super::{Run, Side};
use crate::Fallback;
use crate::ldlt::Ldlt;
use lcplab_problem::{accurate, merit};

/// A row whose pivot is below this part of its diagonal entry depends on those before.
const INDEPENDENT: f64 = 1e-14;
/// A scaled residual below this is no more than rounding leaves.
const EXACT: f64 = 1e-14;
/// Below this, sums lose digits to the end of the range of numbers.
const TINY: f64 = 1e-280;
/// A scaled residual below this may be rounding.
const SETTLED_FROM: f64 = 1e-3;
/// The most sweeps that take rounding from one row to another.
const SETTLING_SWEEPS: usize = 200;
/// Steps of iterative refinement in a round: the second takes what the first has left.
const REFINEMENTS: usize = 2;

impl Run<'_> {
    /// Whether nothing is left to refine, at the latest after a step with the factor at hand.
    pub(super) fn is_refined(&mut self) -> bool {
        self.is_exact() || !self.newton_step() && self.is_exact()
    }

    /// Whether w, recomputed, leaves nothing to refine. What rounding has put beyond a bound is moved
    /// back to it first.
    fn is_exact(&mut self) -> bool {
        self.lcp.project_all(&mut self.x);
        self.w = self.lcp.w(&self.x);
        let most = self.settings.tolerance.min(EXACT);
        (0..self.x.len()).all(|j| {
            let b = self.lcp.b()[j];
            // at most Σ |a_jk x_k| + |b_j|, and enough in most cases
            let magnitude = (self.w[j] - b).abs() + b.abs();
            let scale = self.lcp.matrix().diagonal(j);
            let terms = merit::RowTerms { w: self.w[j], magnitude, scale, exponent: 0 };
            let is_within =
                |terms: merit::RowTerms| terms.scaled_residual(self.lcp, j, &self.x) <= most;
            scale > 0.0 && magnitude > TINY && is_within(terms)
                || is_within(merit::RowTerms::at(self.lcp, j, &self.x))
        })
    }

    /// Chooses C anew among the rows with w = 0, the largest pivot first.
    fn refactor(&mut self) {
        let rows: Vec<usize> = (0..self.x.len())
            .filter(|&j| matches!(self.side[j], Side::Free | Side::Idle))
            .collect();
        let (order, factor) = Ldlt::pivoted(rows.len(), INDEPENDENT, |r, c| {
            self.lcp.matrix().entry(rows[r], rows[c])
        });
        for &row in &rows {
            self.side[row] = Side::Idle;
        }
        self.free = order.into_iter().map(|r| rows[r]).collect();
        for &row in &self.free {
            self.side[row] = Side::Free;
        }
        self.factor = factor;
    }

    /// w_j without the rounding of its sum, of which a step would be full near the end.
    fn accurate_w(&self, j: usize) -> f64 {
        merit::RowTerms::summed::<accurate::Sum>(self.lcp, j, &self.x).w()
    }

    /// x_C ← x_C − t A_CC⁻¹ w_C with w recomputed: the whole step, t = 1, or as far as a bound lets
    /// it go. The row that meets the bound leaves C; returns whether one did.
    fn newton_step(&mut self) -> bool {
        let mut step: Vec<f64> = self.free.iter().map(|&j| -self.accurate_w(j)).collect();
        self.factor.solve(&mut step);
        let reach = |(k, &j): (usize, &usize)| {
            let (length, side) = self.distance_to_bound(j, step[k]);
            (length.max(0.0), k, side)
        };
        let nearest = self.free.iter().enumerate().map(reach).min_by(|a, b| a.0.total_cmp(&b.0));
        let blocked = nearest.filter(|&(length, ..)| length < 1.0);
        let t = blocked.map_or(1.0, |(length, ..)| length);
        for (&j, step) in self.free.iter().zip(&step) {
            self.x[j] = (self.x[j] + t * step).max(self.lcp.lo()[j]).min(self.lcp.hi()[j]);
        }
        if let Some((_, k, side)) = blocked {
            let row = self.free.remove(k);
            self.factor.remove(k);
            self.x[row] = if side == Side::Lower { self.lcp.lo()[row] } else { self.lcp.hi()[row] };
            self.put(row, side);
        }
        blocked.is_some()
    }

    /// A fresh factor and a refined x with w recomputed; returns the rows that are still not satisfied.
    pub(super) fn refine(&mut self) -> Vec<usize> {
        self.refactor();
        let mut steps = 0;
        while steps < REFINEMENTS {
            let crossed = self.newton_step();
            steps = if crossed { 0 } else { steps + 1 };
        }
        self.w = self.lcp.w(&self.x);
        let unsatisfied: Vec<usize> = (0..self.x.len())
            .filter(|&j| {
                let terms = merit::RowTerms::at(self.lcp, j, &self.x);
                !(terms.scaled_residual(self.lcp, j, &self.x) <= self.settings.tolerance)
            })
            .collect();
        for &j in &unsatisfied {
            if self.side[j] != Side::Free {
                self.put(j, Side::Waiting); // to be driven once more
            }
        }
        unsatisfied
    }

    /// Sweeps of projected Gauss-Seidel, where all that is left is rounding. C's equations hold to
    /// the rounding of their own terms, and where bodies of very different mass touch that is a
    /// lot for a row with small ones; a sweep moves only x whose last digits are small enough.
    pub(super) fn settle(&mut self) {
        let mut x = self.x.clone();
        let mut least = merit::scaled_residual(self.lcp, &x);
        if least > SETTLED_FROM {
            return;
        }
        for _ in 0..SETTLING_SWEEPS {
            for i in 0..x.len() {
                let a_ii = self.lcp.matrix().diagonal(i);
                if a_ii > 0.0 {
                    let w = merit::RowTerms::summed::<accurate::Sum>(self.lcp, i, &x).w();
                    x[i] = self.lcp.project(i, x[i] - w / a_ii, &x);
                }
            }
            let residual = merit::scaled_residual(self.lcp, &x);
            if residual < least {
                least = residual;
                self.x.clone_from(&x);
                self.fallback = Some(Fallback::Sweeps);
            }
            if least <= self.settings.tolerance {
                break;
            }
        }
    }
}
