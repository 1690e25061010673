//! Lemke's complementary pivoting: follows a path of almost-solutions, for any square A.
//!
//! A covering variable z₀, the same for all rows, makes every w big enough:
//!
//! ```text
//! w = A x + b + z₀ e,   x, w, z₀ ≥ 0,   x_i w_i = 0        e = (1, …, 1)
//! ```
//!
//! (for bounds 0 and ∞; a boxed problem is first brought into this form, see
//! [`standard_form`](super::standard_form).) At x = 0 the least z₀ that works has some w_r = 0. From
//! there the partner of whatever variable has just become zero is raised, until the next one becomes
//! zero: a *pivot*. The path never forks, so it cannot return, and it ends in one of two ways:
//!
//! - z₀ becomes zero: x is a solution;
//! - nothing becomes zero: a *ray*, `Ray`. For copositive-plus A, which includes every positive
//!   semidefinite A, symmetric or not, this happens only if no x ≥ 0 has A x + b ≥ 0, hence if no
//!   solution exists. If A is symmetric too, the ray's x is a Farkas vector d, A d = 0 and bᵀd < 0,
//!   which the judge can check. For other A a ray says nothing about solvability.
//!
//! It also solves every problem whose A is a P-matrix and every problem with all bounds finite
//! (there z̃ = 0 on a ray, so a second ray does not exist). Ties in "which one becomes zero" are
//! broken lexicographically: c is perturbed by (ε, ε², …), which is read off the columns of the
//! first basis, so degenerate problems do not cycle; z₀ itself leaves whenever it can. The number of
//! pivots is about 2 n as a rule and 2ⁿ for Murty's matrix; each costs O(n²) on a condensed tableau.
//! At the end x is computed afresh from the active set.
//!
//! Lemke 1965; Cottle, Pang & Stone 1992, algorithm 4.4.5. Coupled rows: see
//! [`frozen`](super::frozen).

use super::active_set::claim;
use super::standard_form::{StandardForm, Variable};
use super::{
    Event, Iterate, Observer, Settings, Solution, Solver, Start, Status, frozen, pivoting,
};
use crate::lcp::{Lcp, merit};

/// Two ratios that differ by less than this part of them are tied.
const TIE: f64 = 1e-12;

/// Lemke's method with lexicographic ties.
#[derive(Debug, Clone, Default)]
pub struct Lemke {
    /// The common settings; an iteration is a pivot, the entry of the covering variable included.
    pub settings: Settings,
}

impl Solver for Lemke {
    fn name(&self) -> &'static str {
        "lemke"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if let Some(status) = pivoting::at_once(lcp, &x, &self.settings, observer) {
            return Solution::new(lcp, x, status, 0);
        }
        frozen::solve(lcp, x, &self.settings, |lcp, _, pivots| {
            let mut path = Path::new(lcp);
            match path.follow(pivots, self.settings.max_iterations, observer) {
                Status::Solved => {
                    let x = path.refined(lcp);
                    let status = claim(lcp, &x, &self.settings);
                    Solution::new(lcp, x, status, path.pivots)
                }
                status => Solution::new(lcp, path.form.x(lcp), status, path.pivots),
            }
        })
    }
}

struct Path<'a> {
    lcp: &'a Lcp,
    form: StandardForm,
    /// The basic variables of the pairs before the first pivot: their columns are B⁻¹.
    first_basis: Vec<Variable>,
    pivots: usize,
}

impl<'a> Path<'a> {
    fn new(lcp: &'a Lcp) -> Self {
        let form = StandardForm::of(lcp);
        let first_basis = form.dictionary.basic[..form.pairs].to_vec();
        Path { lcp, form, first_basis, pivots: 0 }
    }

    /// Pivots until the covering variable has left again (`Solved`) or something else ends the path.
    fn follow(&mut self, before: usize, limit: usize, observer: &mut dyn Observer) -> Status {
        self.pivots = before;
        let pairs = self.form.pairs;
        if self.form.dictionary.constant[..pairs].iter().all(|&c| c >= 0.0) {
            return Status::Solved;
        }
        let mut entering = Variable::Cover;
        let mut leaving = self.add_cover();
        loop {
            let d = &mut self.form.dictionary;
            let Some(c) = d.column_of(entering) else { return Status::Stalled };
            let Some(r) = leaving else { return self.ray(c) };
            if self.pivots >= limit {
                return Status::IterationLimit;
            }
            let left = d.basic[r];
            d.pivot(r, c);
            self.pivots += 1;
            let x = self.form.x(self.lcp);
            let driven = entering.row().or(left.row()).unwrap_or(0);
            let event = Event::Pivot { driven, blocking: left.row().unwrap_or(driven) };
            let iterate = Iterate { iteration: self.pivots, x: &x, event };
            if observer.observe(&iterate).is_break() {
                return Status::Stopped;
            }
            if left == Variable::Cover {
                return Status::Solved;
            }
            entering = left.partner();
            leaving = self.form.dictionary.column_of(entering).and_then(|c| self.blocking(c));
        }
    }

    /// Lets the covering variable in as a nonbasic one; returns the row that it has to leave by.
    fn add_cover(&mut self) -> Option<usize> {
        let covered: Vec<bool> =
            self.form.dictionary.basic.iter().map(|&v| self.form.needs_cover(v)).collect();
        self.form.dictionary.add_column(Variable::Cover, |r| f64::from(covered[r]));
        self.lexicographic_minimum(|r| f64::from(covered[r]))
    }

    /// The pair variable that becomes zero first when that of column c grows.
    fn blocking(&self, c: usize) -> Option<usize> {
        self.lexicographic_minimum(|r| -self.form.dictionary.rows[r][c])
    }

    /// The row r with the lexicographically least (c_r, B⁻¹_r) / weight_r among positive weights.
    fn lexicographic_minimum(&self, weight: impl Fn(usize) -> f64) -> Option<usize> {
        let d = &self.form.dictionary;
        let mut tied: Vec<usize> = (0..self.form.pairs).filter(|&r| weight(r) > 0.0).collect();
        keep_least(&mut tied, |r| d.constant[r] / weight(r));
        if let Some(&cover) = tied.iter().find(|&&r| d.basic[r] == Variable::Cover) {
            return Some(cover);
        }
        for &v in &self.first_basis {
            if tied.len() <= 1 {
                break;
            }
            match d.column_of(v) {
                Some(c) => keep_least(&mut tied, |r| -d.rows[r][c] / weight(r)),
                None => keep_least(&mut tied, |r| f64::from(d.basic[r] == v) / weight(r)),
            }
        }
        tied.first().copied()
    }

    fn ray(&self, c: usize) -> Status {
        let direction = self.form.direction(c);
        let size = |&i: &usize| direction[i].abs();
        let row = (0..direction.len()).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(0);
        Status::Ray { row, direction }
    }

    /// x from a fresh factorisation of the active set, unless the tableau's own is better.
    fn refined(&self, lcp: &Lcp) -> Vec<f64> {
        let x = self.form.x(lcp);
        let residual = |x: &[f64]| merit::scaled_residual(lcp, x);
        match self.form.active_set().point(lcp) {
            Ok(point) if residual(&point) <= residual(&x) => point,
            _ => x,
        }
    }
}

/// Keeps the rows whose key is least, ties included.
fn keep_least(rows: &mut Vec<usize>, key: impl Fn(usize) -> f64) {
    let least = rows.iter().map(|&r| key(r)).fold(f64::INFINITY, f64::min);
    rows.retain(|&r| key(r) - least <= TIE * key(r).abs().max(least.abs()));
}
