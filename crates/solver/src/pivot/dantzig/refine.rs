//! Final refinement: recomputes w, refines x, and returns the rows that are not satisfied.

use super::run::Run;
use super::{Side, is_unbounded};
use crate::Fallback;
use crate::linalg::ldlt::Ldlt;
use crate::pivot::principal::Point;
use crate::tolerances::{CLEANUP_LIMIT, INDEPENDENT_PIVOT, REFINED_RESIDUAL};
use lcplab_lcp::{accurate, merit};

/// Maximum number of sweeps that redistribute rounding errors between rows.
const CLEANUP_SWEEPS: usize = 200;
/// Steps of iterative refinement per round; the second removes what the first leaves.
const REFINEMENTS: usize = 2;

impl Run<'_> {
    /// Takes one step of refinement with the current factor, if necessary; returns the point if
    /// nothing is left to refine.
    pub(super) fn refine_once(&mut self) -> Option<Point> {
        self.refined().or_else(|| if self.newton_step() { None } else { self.refined() })
    }

    /// Moves x back to bounds that rounding has crossed; returns the point if nothing is left to
    /// refine.
    fn refined(&mut self) -> Option<Point> {
        self.lcp.project_all(&mut self.state.x);
        let point = self.point();
        let tolerance = self.settings.tolerance;
        let is_refined = (0..self.state.x.len()).all(|j| {
            let is_dependent = self.state.side[j] == Side::Dependent && is_unbounded(self.lcp, j);
            let most = if is_dependent { tolerance } else { tolerance.min(REFINED_RESIDUAL) };
            point.residual(j) <= most
        });
        is_refined.then_some(point)
    }

    /// Selects C again among the rows with w = 0, largest pivot first.
    fn refactor(&mut self) {
        let rows: Vec<usize> = (0..self.state.x.len())
            .filter(|&j| matches!(self.state.side[j], Side::Free | Side::Dependent))
            .collect();
        let (free, factor) = Ldlt::pivoted(self.lcp.matrix(), &rows, INDEPENDENT_PIVOT);
        for &row in &rows {
            self.state.side[row] = Side::Dependent;
        }
        for &row in &free {
            self.state.side[row] = Side::Free;
        }
        self.basis.free = free;
        self.basis.factor = factor;
    }

    /// w_j in extended precision; near the end, a step would otherwise be dominated by rounding.
    fn accurate_w(&self, j: usize) -> f64 {
        merit::RowTerms::summed::<accurate::Sum>(self.lcp, j, &self.state.x).w()
    }

    /// x_C ← x_C − t A_CC⁻¹ w_C with w recomputed: the whole step, t = 1, or as far as a bound
    /// allows. The row that reaches the bound leaves C; returns whether one did.
    fn newton_step(&mut self) -> bool {
        let w = self.basis.free.iter().map(|&j| self.accurate_w(j)).collect();
        let (step, _) = self.basis.factor.eliminate(w);
        let length = |(k, &j): (usize, &usize)| (k, self.length_to_bound(j, step[k]));
        let lengths = self.basis.free.iter().enumerate().map(length);
        let nearest = lengths.min_by(|(_, a), (_, b)| a.total_cmp(b));
        let blocked = nearest.filter(|(_, length)| *length < 1.0);
        let t = blocked.map_or(1.0, |(_, length)| length);
        for (&j, step) in self.basis.free.iter().zip(&step) {
            self.state.x[j] =
                (self.state.x[j] + t * step).max(self.lcp.lo()[j]).min(self.lcp.hi()[j]);
        }
        if let Some((k, _)) = blocked {
            let row = self.basis.free.remove(k);
            self.basis.factor.remove(k);
            let (bound, side) = match step[k] > 0.0 {
                true => (self.lcp.hi()[row], Side::Upper),
                false => (self.lcp.lo()[row], Side::Lower),
            };
            self.state.x[row] = bound;
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
