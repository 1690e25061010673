//! Final refinement: recomputes w, refines x, and returns the rows that are not satisfied.

use super::blocking::End;
use super::run::Run;
use super::{Side, is_unbounded};
use crate::Fallback;
use crate::linalg::ldlt::Ldlt;
use crate::tolerances::{CLEANUP_LIMIT, INDEPENDENT_PIVOT, REFINED_RESIDUAL, UNDERFLOW};
use lcplab_lcp::{accurate, merit};

/// Maximum number of sweeps that redistribute rounding errors between rows.
const CLEANUP_SWEEPS: usize = 200;
/// Steps of iterative refinement per round; the second removes what the first leaves.
const REFINEMENTS: usize = 2;

impl Run<'_> {
    /// Takes one step of refinement with the current factor, if necessary; returns whether nothing
    /// is left to refine.
    pub(super) fn refine_once(&mut self) -> bool {
        self.project_and_measure() || !self.newton_step() && self.project_and_measure()
    }

    /// Moves x back to bounds that rounding has crossed, and recomputes w; returns whether nothing
    /// is left to refine.
    fn project_and_measure(&mut self) -> bool {
        self.lcp.project_all(&mut self.state.x);
        self.state.w = self.lcp.w(&self.state.x);
        let tolerance = self.settings.tolerance;
        (0..self.state.x.len()).all(|j| {
            let is_dependent = self.state.side[j] == Side::Dependent && is_unbounded(self.lcp, j);
            let most = if is_dependent { tolerance } else { tolerance.min(REFINED_RESIDUAL) };
            let b = self.lcp.b()[j];
            // at most Σ |a_jk x_k| + |b_j|, and usually large enough
            let magnitude = (self.state.w[j] - b).abs() + b.abs();
            let scale = self.lcp.matrix().diagonal(j);
            let terms = merit::RowTerms { w: self.state.w[j], magnitude, scale, exponent: 0 };
            let is_within =
                |terms: merit::RowTerms| terms.scaled_residual(self.lcp, j, &self.state.x) <= most;
            scale > 0.0 && magnitude > UNDERFLOW && is_within(terms)
                || is_within(merit::RowTerms::at(self.lcp, j, &self.state.x))
        })
    }

    /// Selects C again among the rows with w = 0, largest pivot first.
    fn refactor(&mut self) {
        let rows: Vec<usize> = (0..self.state.x.len())
            .filter(|&j| matches!(self.state.side[j], Side::Free | Side::Dependent))
            .collect();
        let (order, factor) = Ldlt::pivoted(rows.len(), INDEPENDENT_PIVOT, |r, c| {
            self.lcp.matrix().entry(rows[r], rows[c])
        });
        for &row in &rows {
            self.state.side[row] = Side::Dependent;
        }
        self.basis.free = order.into_iter().map(|r| rows[r]).collect();
        for &row in &self.basis.free {
            self.state.side[row] = Side::Free;
        }
        self.basis.factor = factor;
    }

    /// w_j in extended precision; near the end, a step would otherwise be dominated by rounding.
    fn accurate_w(&self, j: usize) -> f64 {
        merit::RowTerms::summed::<accurate::Sum>(self.lcp, j, &self.state.x).w()
    }

    /// x_C ← x_C − t A_CC⁻¹ w_C with w recomputed: the whole step, t = 1, or as far as a bound
    /// allows. The row that reaches the bound leaves C; returns whether one did.
    fn newton_step(&mut self) -> bool {
        let mut step: Vec<f64> = self.basis.free.iter().map(|&j| -self.accurate_w(j)).collect();
        self.basis.factor.solve(&mut step);
        let end = |(k, &j): (usize, &usize)| (k, self.end_at_bound(j, step[k]));
        let ends = self.basis.free.iter().enumerate().map(end);
        let nearest = ends.min_by(|(_, a), (_, b)| a.length.total_cmp(&b.length));
        let blocked = nearest.filter(|(_, end)| end.length < 1.0);
        let t = blocked.map_or(1.0, |(_, end)| end.length);
        for (&j, step) in self.basis.free.iter().zip(&step) {
            self.state.x[j] =
                (self.state.x[j] + t * step).max(self.lcp.lo()[j]).min(self.lcp.hi()[j]);
        }
        if let Some((k, End { row, side, .. })) = blocked {
            self.basis.free.remove(k);
            self.basis.factor.remove(k);
            self.state.x[row] =
                if side == Side::Lower { self.lcp.lo()[row] } else { self.lcp.hi()[row] };
            self.put(row, side);
        }
        blocked.is_some()
    }

    /// Computes a fresh factor and a refined x with w recomputed; returns the rows that are still
    /// not satisfied.
    pub(super) fn refine(&mut self) -> Vec<usize> {
        self.refactor();
        let mut steps = 0;
        while steps < REFINEMENTS {
            let crossed = self.newton_step();
            steps = if crossed { 0 } else { steps + 1 };
        }
        self.state.w = self.lcp.w(&self.state.x);
        let unsatisfied: Vec<usize> = (0..self.state.x.len())
            .filter(|&j| {
                let terms = merit::RowTerms::at(self.lcp, j, &self.state.x);
                !(terms.scaled_residual(self.lcp, j, &self.state.x) <= self.settings.tolerance)
            })
            .collect();
        for &j in &unsatisfied {
            if self.state.side[j] != Side::Free {
                // It is processed once more.
                self.put(j, Side::Unprocessed);
            }
        }
        unsatisfied
    }

    /// Sweeps of projected Gauss-Seidel, for errors that are only rounding. The equations of C hold
    /// up to the rounding of their own terms, which is a lot for a row with small terms if bodies
    /// of very different mass touch. A sweep moves only x whose last digits are small enough.
    pub(super) fn gauss_seidel_cleanup(&mut self) {
        let mut x = self.state.x.clone();
        let mut least = merit::scaled_residual(self.lcp, &x);
        if least > CLEANUP_LIMIT {
            return;
        }
        for _ in 0..CLEANUP_SWEEPS {
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
                self.state.x.clone_from(&x);
                self.fallback = Some(Fallback::Sweeps);
            }
            if least <= self.settings.tolerance {
                break;
            }
        }
    }
}
