//! Records the residual of a solver at selected iterations.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::methods::MethodProgress;
use crate::lcp::{Lcp, merit};
use crate::report::study::posed::Posed;
use crate::report::study::trial::Outcome;
use crate::solver::{Entry, Group, Iterate, Observer, Options, Solution, Start};
use crate::trace::Work;

/// The state of a solver at an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// The number of sweeps, steps or pivots.
    pub iteration: usize,
    /// Multiplications ([`Work`]); NaN if they are not counted.
    #[serde(with = "lcplab_analysis::number::always")]
    pub work: f64,
    /// The scaled residual.
    #[serde(with = "lcplab_analysis::number::always")]
    pub residual: f64,
    /// The fraction of the weight that the contact forces do not balance, if the problem is that of
    /// a stack at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unsupported: Option<f64>,
    /// Whether the active set differs from that of the previous mark.
    pub changed: bool,
}

/// Solves the problem from 0; without the rate that theory predicts.
pub(super) fn run(entry: &Entry, posed: &Posed, options: &Options) -> (MethodProgress, Solution) {
    let lcp = &posed.lcp;
    let mut watch =
        Watch { posed, work: Work::of(entry, lcp), marks: Vec::new(), next: 0, active: Vec::new() };
    let solution = entry.build(options).solve(lcp, &Start::default(), &mut watch);
    let end = watch.mark(solution.iterations, &solution.x);
    let mut marks = watch.marks;
    // Of pivoting methods only the end counts.
    marks.retain(|mark| entry.group != Group::Pivoting && mark.iteration < end.iteration);
    marks.push(end);
    let outcome = Outcome::of(&solution, lcp, options.settings.tolerance);
    let solver = entry.name.to_string();
    (MethodProgress { solver, outcome, marks, rate: None }, solution)
}

/// An observer that records selected iterates.
struct Watch<'a> {
    posed: &'a Posed,
    work: Work<'a>,
    marks: Vec<Mark>,
    /// The next iteration to record.
    next: usize,
    /// The active set at the last mark.
    active: Vec<Ordering>,
}

impl Watch<'_> {
    fn mark(&mut self, iteration: usize, x: &[f64]) -> Mark {
        let active = active_set(&self.posed.lcp, x);
        let changed = !self.active.is_empty() && active != self.active;
        self.active = active;
        Mark {
            iteration,
            work: self.work.multiplications,
            residual: merit::scaled_residual(&self.posed.lcp, x),
            unsupported: self.posed.unsupported(x),
            changed,
        }
    }
}

impl Observer for Watch<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let _ = self.work.observe(iterate);
        if iterate.iteration >= self.next {
            self.next = iterate.iteration + 1 + iterate.iteration / 12;
            let mark = self.mark(iterate.iteration, iterate.x);
            self.marks.push(mark);
        }
        ControlFlow::Continue(())
    }
}

/// The side of each row in the projection of x − w/s: below, between or above its bounds.
fn active_set(lcp: &Lcp, x: &[f64]) -> Vec<Ordering> {
    let side = |i: usize| {
        let point = x[i] - lcp.row_w(i, x) / merit::row_scale(lcp, i);
        point.total_cmp(&lcp.project(i, point, x))
    };
    (0..lcp.len()).map(side).collect()
}
