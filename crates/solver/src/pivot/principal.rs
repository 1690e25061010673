//! The loop of the principal pivoting methods, from one active set to the next.

use std::borrow::Cow;
use std::ops::ControlFlow;

use super::active_set::{ActiveSet, Side};
use super::opening;
use crate::kernel::{Width, terms};
use crate::{Event, Fallback, Iterate, Observer, Settings, Solution, Start, Status, frozen};
use lcplab_lcp::Lcp;
use lcplab_lcp::memory::Memory;
use lcplab_lcp::merit::{self, RowResidual, RowTerms};

/// Which of the unsatisfied rows change sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Change {
    /// The one with the least index.
    Least,
    /// All of them.
    All,
    /// None: the search stops.
    None,
}

/// An x with the terms of its rows.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) x: Vec<f64>,
    pub(crate) terms: Vec<RowTerms>,
    row_residuals: Vec<RowResidual>,
}

impl Point {
    pub(crate) fn at(lcp: &Lcp, x: Vec<f64>) -> Self {
        let terms = terms(lcp, &x, Width::widest());
        Point { row_residuals: merit::row_residuals(lcp, &x, &terms), terms, x }
    }

    /// Whether x is a solution within the tolerance.
    pub(crate) fn is_solution(&self, lcp: &Lcp, tolerance: f64) -> bool {
        merit::is_solution_by(lcp, &self.x, &self.row_residuals, tolerance)
    }

    /// The status of a method that stops at x.
    pub(crate) fn claim(&self, lcp: &Lcp, tolerance: f64) -> Status {
        if self.is_solution(lcp, tolerance) { Status::Solved } else { Status::Inaccurate }
    }

    /// r_i.
    pub(crate) fn residual(&self, i: usize) -> f64 {
        self.row_residuals[i].residual
    }

    /// max_i r_i; ∞ if x is not finite.
    pub(crate) fn largest_residual(&self) -> f64 {
        let residuals = self.row_residuals.iter().map(|row_residual| row_residual.residual);
        residuals.fold(0.0, |most, r| if r.is_nan() { f64::INFINITY } else { f64::max(most, r) })
    }

    /// max_i |x_i − Π(x_i − w_i/s_i)| √s_i: the distance of x from a solution, in the unit of √(x
    /// w).
    pub(crate) fn largest_miss(&self) -> f64 {
        let row_residual = |row_residual: &RowResidual| {
            libm::ldexp(row_residual.size / row_residual.scale.sqrt(), row_residual.exponent)
        };
        self.row_residuals.iter().map(row_residual).fold(0.0, f64::max)
    }

    /// The solution with this x.
    pub(crate) fn solution(self, status: Status, iterations: usize) -> Solution {
        let w = self.terms.iter().map(RowTerms::w).collect();
        Solution { x: self.x, w, status, iterations, fallback: None, is_claim_implied: false }
    }
}

/// A search through active sets.
pub(crate) struct Search<'a> {
    pub(crate) settings: &'a Settings,
    pub(crate) observer: &'a mut dyn Observer,
    pub(crate) set: ActiveSet,
    /// The x that the method starts from.
    pub(crate) start: Vec<f64>,
    /// The last point; `None` before the first.
    pub(crate) point: Option<Point>,
    /// The number of changes so far.
    pub(crate) count: usize,
    /// The fallback that was used.
    pub(crate) fallback: Option<Fallback>,
    /// The fallback to report if the rule exchanges single rows.
    pub(crate) safeguard: Option<Fallback>,
}

impl<'a> Search<'a> {
    /// A search from this active set and start, after this number of changes.
    pub(crate) fn new(
        set: ActiveSet,
        start: Vec<f64>,
        count: usize,
        settings: &'a Settings,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let (point, fallback, safeguard) = (None, None, None);
        Search { settings, observer, set, start, point, count, fallback, safeguard }
    }

    /// Changes sides until all rows are satisfied. `point` computes the point of an active set;
    /// `rule` chooses, given the number of unsatisfied rows. `arrival` is the event of the first
    /// point, if it is to be reported to an observer.
    pub(crate) fn run(
        &mut self,
        lcp: &Lcp,
        mut point: impl FnMut(&ActiveSet) -> Result<Point, Status>,
        mut rule: impl FnMut(usize) -> Change,
        arrival: Option<Event>,
    ) -> ControlFlow<Status> {
        let mut event = arrival;
        loop {
            let point = match point(&self.set) {
                Ok(point) => self.point.insert(point),
                Err(status) => return ControlFlow::Break(status),
            };
            let better = |i| Some((i, self.set.better_side(lcp, i, point)?));
            let wrong: Vec<(usize, Side)> = (0..lcp.len()).filter_map(better).collect();
            if let Some(event) = event {
                self.observe(event)?;
            }
            let Some(&(least, _)) = wrong.first() else {
                return ControlFlow::Continue(());
            };
            let (rows, change) = match rule(wrong.len()) {
                Change::Least => {
                    self.fallback = self.fallback.or(self.safeguard);
                    (1, Event::Pivot { driven: least, blocking: least })
                }
                Change::All => (wrong.len(), Event::Exchange { rows: wrong.len() }),
                Change::None => return ControlFlow::Break(Status::Stalled),
            };
            self.count_change()?;
            for &(row, side) in &wrong[..rows] {
                self.set.0[row] = side;
            }
            event = Some(change);
        }
    }

    /// Counts another change, unless the limit is reached.
    pub(crate) fn count_change(&mut self) -> ControlFlow<Status> {
        if self.count >= self.settings.max_iterations {
            return ControlFlow::Break(Status::IterationLimit);
        }
        self.count += 1;
        ControlFlow::Continue(())
    }

    fn observe(&mut self, event: Event) -> ControlFlow<Status> {
        let x = self.point.as_ref().map_or(&self.start, |point| &point.x);
        let iterate = Iterate { iteration: self.count, x, event };
        self.observer.observe(&iterate).map_break(|()| Status::Stopped)
    }

    /// The last point; before the first, that of the start.
    pub(crate) fn last(&self, lcp: &Lcp) -> Cow<'_, Point> {
        let at_start = || Cow::Owned(Point::at(lcp, self.start.clone()));
        self.point.as_ref().map_or_else(at_start, Cow::Borrowed)
    }

    /// The status for the last point.
    pub(crate) fn claim(&self, lcp: &Lcp) -> Status {
        self.last(lcp).claim(lcp, self.settings.tolerance)
    }

    /// The last point as a solution; ends the search.
    pub(crate) fn solution(&mut self, lcp: &Lcp, status: Status) -> Solution {
        let point = self.point.take().unwrap_or_else(|| Point::at(lcp, self.start.clone()));
        point.solution(status, self.count).with_fallback(self.fallback)
    }
}

/// Solves a problem by a method that moves between active sets, `method(problem, search)`; if
/// bounds depend on x, by frozen bounds. It starts from the cached set, if that fits, and stores
/// its last set there. `needs` is the memory of its factor, `None` if that would take too long.
pub(crate) fn solve(
    lcp: &Lcp,
    start: &Start<'_>,
    set: &mut Option<ActiveSet>,
    needs: Option<Memory>,
    settings: &Settings,
    observer: &mut dyn Observer,
    mut method: impl FnMut(&Lcp, &mut Search<'_>) -> Solution,
) -> Solution {
    let x = start.point(lcp);
    *set = set.take().and_then(|set| set.fitted(lcp));
    let at_once = match needs {
        Some(needs) => opening::start(&x, needs, settings, observer),
        None => Some(opening::TOO_LARGE),
    };
    // With a set, its point may cost less than evaluating x.
    let at_once = match set {
        Some(_) => at_once,
        None => at_once.or_else(|| opening::is_solved(lcp, &x, settings)),
    };
    if let Some(status) = at_once {
        return Solution::new(lcp, x, status, 0);
    }
    let is_pinned = |i: usize| lcp.lo()[i] == lcp.hi()[i];
    if (0..lcp.len()).any(|i| !is_pinned(i) && !(lcp.matrix().diagonal(i) > 0.0)) {
        let reason = "A is not a P-matrix: a diagonal entry is not positive";
        return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
    }
    frozen::solve(lcp, x, settings, |lcp, x, count| {
        let first = set.take().and_then(|set| set.fitted(lcp));
        let first = first.unwrap_or_else(|| ActiveSet::initial(lcp, start, &x));
        let mut search = Search::new(first, x, count, settings, observer);
        let solution = method(lcp, &mut search);
        *set = Some(search.set);
        solution
    })
}
