//! Lemke's complementary pivoting: follows a path of almost-solutions, for any square A.
//!
//! A covering variable z₀ makes every w big enough:
//!
//! ```text
//! w = A x + b + z₀ e,   x, w, z₀ ≥ 0,   x_i w_i = 0        e = (1, …, 1)
//! ```
//!
//! (Bounds are 0 and ∞ here: a boxed problem is first brought into this form, see
//! `standard_form.rs`. Where the units of the rows are far apart, e_i is that of
//! w_i.) At x = 0 the least z₀ that works has some w_r = 0. From there the partner of whatever has
//! just become zero is raised, until the next variable becomes zero: a *pivot*. The path never
//! forks, so it cannot return, and it ends in one of two ways:
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
//! At the end x is computed afresh from the active set. Rounding piles up: a path of more than 50
//! pivots, or with a very small one, that ends at no solution is followed once more, with a tableau
//! that is made anew every 50 pivots; its pivots are counted on, and the solution says so ([`Fallback`]).
//!
//! Lemke 1965; Cottle, Pang & Stone 1992, algorithm 4.4.5. Coupled rows: see
//! [`frozen`].

use std::ops::ControlFlow;

use super::active_set::{ROUNDING, claim};
use super::dictionary::Dictionary;
use super::standard_form::{StandardForm, Variable};
use super::{
    Event, Fallback, Iterate, Observer, Part, Settings, Solution, Solver, Start, Status, Tableau,
    frozen, pivoting,
};
use crate::lcp::{Lcp, merit};
use crate::memory::Memory;

/// A pivot below this part of its row may be rounding.
const DOUBTFUL: f64 = 1e-10;
/// A path of more pivots may be followed a second time; then the tableau is made anew after each so
/// many pivots.
const PIVOTS_TO_RENEWAL: usize = 50;
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
        if let Some(status) = pivoting::at_once(lcp, &x, tableaux(lcp), &self.settings, observer) {
            return Solution::new(lcp, x, status, 0);
        }
        frozen::solve(lcp, x, &self.settings, |frozen, _, before| {
            frozen::tell(lcp, frozen, observer);
            let lcp = frozen;
            let mut path = Path::new(lcp, before);
            let (x, status) = path.solve(&self.settings, observer);
            let is_long = path.is_doubtful || path.pivots - before > PIVOTS_TO_RENEWAL;
            if !(is_long && matches!(status, Status::Ray { .. } | Status::Inaccurate)) {
                return Solution::new(lcp, x, status, path.pivots);
            }
            let mut path = Path::new(lcp, path.pivots).with_renewals();
            let (x, status) = path.solve(&self.settings, observer);
            let solution = Solution::new(lcp, x, status, path.pivots);
            solution.with_fallback(Some(Fallback::SecondPath))
        })
    }
}

struct Path<'a> {
    lcp: &'a Lcp,
    form: StandardForm,
    /// The tableau before the first pivot. The columns of its basic variables are B⁻¹.
    first: Dictionary<Variable>,
    renews: bool,
    /// Whether some pivot may have been nothing but rounding.
    is_doubtful: bool,
    /// x after the last pivot.
    x: Vec<f64>,
    pivots: usize,
}

impl<'a> Path<'a> {
    /// The start of the path, after so many pivots on other ones.
    fn new(lcp: &'a Lcp, pivots: usize) -> Self {
        let mut form = StandardForm::of(lcp);
        let cover: Vec<f64> = form.dictionary.basic.iter().map(|&v| form.cover(lcp, v)).collect();
        form.dictionary.add_column(Variable::Cover, |r| cover[r]);
        let (x, first) = (form.x(lcp), form.dictionary.clone());
        form.dictionary.forgives = 0.0;
        Path { lcp, form, first, renews: false, is_doubtful: false, x, pivots }
    }

    /// The same, with a fresh tableau now and then and generous zeros.
    fn with_renewals(mut self) -> Self {
        self.form.dictionary.forgives = self.first.forgives;
        Path { renews: true, ..self }
    }

    /// x at the end of the path, and what it is worth.
    fn solve(&mut self, settings: &Settings, observer: &mut dyn Observer) -> (Vec<f64>, Status) {
        let end = self.follow(settings.max_iterations, observer);
        let x = self.refined();
        match (claim(self.lcp, &x, settings), end) {
            (status, ControlFlow::Continue(())) => (x, status),
            // z₀ was zero but for rounding
            (Status::Solved, ControlFlow::Break(Status::Ray { .. })) => (x, Status::Solved),
            (_, ControlFlow::Break(status)) => (self.x.clone(), status),
        }
    }

    /// Pivots until the covering variable has left again.
    fn follow(&mut self, limit: usize, observer: &mut dyn Observer) -> ControlFlow<Status> {
        let start = self.pivots;
        if self.form.dictionary.constant[..self.form.pairs].iter().all(|&c| c >= 0.0) {
            return ControlFlow::Continue(());
        }
        let mut entering = Variable::Cover;
        let mut leaving = self.lexicographic_minimum(|r| self.cover(r));
        loop {
            let column = self.form.dictionary.column_of(entering);
            let Some(c) = column else { return ControlFlow::Break(Status::Stalled) };
            self.tell(Some(c), leaving, observer);
            let Some(r) = leaving else { return ControlFlow::Break(self.ray(c)) };
            if self.pivots >= limit {
                return ControlFlow::Break(Status::IterationLimit);
            }
            let left = self.pivot(r, c, observer)?;
            if left == Variable::Cover {
                self.tell(None, None, observer);
                return ControlFlow::Continue(());
            }
            if self.renews && (self.pivots - start).is_multiple_of(PIVOTS_TO_RENEWAL) {
                self.renew();
            }
            entering = left.partner();
            let column = self.form.dictionary.column_of(entering);
            leaving = column.and_then(|c| self.blocking(c));
        }
    }

    /// Tells an observer that asks of the tableau, and of what will enter and leave.
    fn tell(&self, entering: Option<usize>, leaving: Option<usize>, observer: &mut dyn Observer) {
        if observer.asks_for_parts() {
            let d = &self.form.dictionary;
            observer.part(&Part::Tableau(Tableau {
                basic: &d.basic,
                nonbasic: &d.nonbasic,
                constant: &d.constant,
                rows: &d.rows,
                pairs: self.form.pairs,
                entering,
                leaving,
            }));
        }
    }

    /// One pivot; returns the variable that has become zero.
    fn pivot(
        &mut self,
        r: usize,
        c: usize,
        observer: &mut dyn Observer,
    ) -> ControlFlow<Status, Variable> {
        let (entering, left) = (self.form.dictionary.nonbasic[c], self.form.dictionary.basic[r]);
        self.is_doubtful |= self.part_of_row(r, c) <= DOUBTFUL;
        self.form.dictionary.pivot(r, c);
        self.pivots += 1;
        let x = self.form.x(self.lcp);
        if x.iter().any(|x| !x.is_finite()) {
            return ControlFlow::Break(Status::NotFinite);
        }
        self.x = x;
        let driven = entering.row().or(left.row()).unwrap_or(0);
        let event = Event::Pivot { driven, blocking: left.row().unwrap_or(driven) };
        let iterate = Iterate { iteration: self.pivots, x: &self.x, event };
        if observer.observe(&iterate).is_break() {
            return ControlFlow::Break(Status::Stopped);
        }
        ControlFlow::Continue(left)
    }

    /// e_r, while the covering variable is nonbasic.
    fn cover(&self, r: usize) -> f64 {
        self.form.cover(self.lcp, self.form.dictionary.basic[r])
    }

    /// Makes the tableau of the present basis anew from the first one.
    fn renew(&mut self) {
        let now = &self.form.dictionary;
        let mut renewed = self.first.clone();
        renewed.exchange(|v| now.column_of(v).is_some(), |v| now.row_of(v).is_some());
        if renewed.basic.iter().all(|&v| now.row_of(v).is_some()) {
            self.form.dictionary = renewed;
        }
    }

    /// The pair variable that becomes zero first when that of column c grows.
    fn blocking(&self, c: usize) -> Option<usize> {
        let is_zero = |r: usize| self.renews && self.part_of_row(r, c) <= DOUBTFUL;
        let rate = |r: usize| self.form.dictionary.rows[r][c];
        self.lexicographic_minimum(|r| if is_zero(r) { 0.0 } else { -rate(r) })
    }

    /// An entry of the tableau beside the largest of its row.
    fn part_of_row(&self, r: usize, c: usize) -> f64 {
        let row = &self.form.dictionary.rows[r];
        row[c].abs() / row.iter().fold(0.0, |largest, entry| f64::max(largest, entry.abs()))
    }

    /// The row r with the lexicographically least (c_r, B⁻¹_r) / weight_r among positive weights.
    fn lexicographic_minimum(&self, weight: impl Fn(usize) -> f64) -> Option<usize> {
        let d = &self.form.dictionary;
        let mut tied: Vec<usize> = (0..self.form.pairs).filter(|&r| weight(r) > 0.0).collect();
        keep_least(&mut tied, |r| d.constant[r] / weight(r));
        if let Some(&cover) = tied.iter().find(|&&r| d.basic[r] == Variable::Cover) {
            return Some(cover);
        }
        for &v in &self.first.basic[..self.form.pairs] {
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

    /// x at the end of the path without the rounding of the path: from a fresh factorisation of the
    /// active set, first with the free rows at a bound that are there but for rounding.
    fn refined(&self) -> Vec<f64> {
        let (lcp, x) = (self.lcp, &self.x);
        let set = self.form.active_set();
        let tight = set.tightened(lcp, x);
        let moved = tight.moved_to_bounds(lcp, x);
        let candidates = [tight.point(lcp).ok(), Some(moved), set.point(lcp).ok(), Some(x.clone())];
        let residual = |x: &Vec<f64>| merit::scaled_residual(lcp, x).max(ROUNDING);
        let better = |a: &Vec<f64>, b: &Vec<f64>| residual(a).total_cmp(&residual(b));
        candidates.into_iter().flatten().min_by(better).unwrap_or_default() // the first of equals
    }
}

/// Room for three tableaux: the first, the one that is pivoted, and one to make that anew. A row with
/// two bounds has two rows in them, and a coupled one has two bounds.
fn tableaux(lcp: &Lcp) -> Memory {
    let is_coupled = |i: usize| lcp.coupling().is_some_and(|coupling| coupling.index(i).is_some());
    let is_boxed =
        |&i: &usize| is_coupled(i) || (lcp.lo()[i].is_finite() && lcp.hi()[i].is_finite());
    let rows = lcp.len() + (0..lcp.len()).filter(is_boxed).count();
    Memory::square(rows + 1).times(3)
}

/// Keeps the rows whose key is least, ties included.
fn keep_least(rows: &mut Vec<usize>, key: impl Fn(usize) -> f64) {
    let least = rows.iter().map(|&r| key(r)).fold(f64::INFINITY, f64::min);
    rows.retain(|&r| key(r) - least <= TIE * key(r).abs().max(least.abs()));
}
