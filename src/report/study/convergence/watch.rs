//! Records the residual of a solver at selected iterations, with the clock stopped meanwhile.

use std::cmp::Ordering;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::methods::MethodProgress;
use crate::formulation::Problem;
use crate::lcp::{Lcp, merit};
use crate::report::study::clock;
use crate::report::study::trial::Outcome;
use crate::solver::{Entry, Group, Iterate, Observer, Options, Start, theory};
use crate::trace::Work;

/// Gravity in the stacks (m/s²).
const GRAVITY: f64 = 9.81;

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

/// An LCP, and the problem of mechanics that it comes from if that is a stack at rest.
pub(super) struct Posed {
    pub lcp: Lcp,
    pub stack: Option<Problem>,
}

impl Posed {
    /// The fraction of the weight that the contact forces x do not balance: the vertical momentum
    /// after the step, divided by the weight times dt.
    fn unsupported(&self, x: &[f64]) -> Option<f64> {
        let Problem { assembly, dt, .. } = self.stack.as_ref()?;
        let u = self.stack.as_ref()?.next_velocity(x, *dt);
        let falls = assembly.blocks.iter().map(|own| own.mass * u[own.offset + 2].abs());
        let weight: f64 = assembly.blocks.iter().map(|own| own.mass * GRAVITY * dt).sum();
        Some(falls.sum::<f64>() / weight)
    }

    /// The side of each row in the projection of x − w/s: below, between or above its bounds.
    fn active_set(&self, x: &[f64]) -> Vec<Ordering> {
        let lcp = &self.lcp;
        let side = |i: usize| {
            let point = x[i] - lcp.row_w(i, x) / merit::row_scale(lcp, i);
            point.total_cmp(&lcp.project(i, point, x))
        };
        (0..lcp.len()).map(side).collect()
    }
}

/// A solver's marks, and its time (s) and scaled residual at each.
pub(super) type Run = (MethodProgress, (String, Vec<(f64, f64)>));

/// Solves the problem from 0, several times: each mark has its least time.
pub(super) fn timed(entry: &Entry, posed: &Posed, options: &Options) -> Run {
    let (progress, (solver, mut times)) = run(entry, posed, options);
    let end = |times: &[(f64, f64)]| times.last().map_or(0.0, |(seconds, _)| *seconds);
    clock::repeat(end(&times), || {
        let (_, (_, again)) = run(entry, posed, options);
        let seconds = end(&again);
        // A solver is deterministic: the marks are the same.
        times.iter_mut().zip(again).for_each(|(own, other)| own.0 = own.0.min(other.0));
        seconds
    });
    (progress, (solver, times))
}

/// Solves the problem from 0.
pub(super) fn run(entry: &Entry, posed: &Posed, options: &Options) -> Run {
    let lcp = &posed.lcp;
    let mut watch = Watch {
        posed,
        work: Work::of(entry, lcp),
        marks: Vec::new(),
        seconds: Vec::new(),
        next: 0,
        start: Instant::now(),
        looking: Duration::ZERO,
        active: Vec::new(),
    };
    let solution = entry.build(options).solve(lcp, &Start::default(), &mut watch);
    let seconds = watch.elapsed(Instant::now());
    let end = watch.mark(solution.iterations, &solution.x);
    let Watch { mut marks, seconds: mut times, .. } = watch;
    if entry.group == Group::Pivoting {
        (marks, times) = (Vec::new(), Vec::new());
    } else if marks.last().is_some_and(|mark| mark.iteration == end.iteration) {
        marks.pop();
        times.pop();
    }
    marks.push(end);
    times.push(seconds);
    let outcome = Outcome::of(&solution, lcp, options.settings.tolerance);
    let times = times.into_iter().zip(marks.iter().map(|mark| mark.residual)).collect();
    let solver = entry.name.to_string();
    let rate = theory::rate(&entry.name, options, lcp, &theory::rows_inside(lcp, &solution.x));
    (MethodProgress { solver: solver.clone(), outcome, marks, rate }, (solver, times))
}

/// An observer that records selected iterates and stops the clock meanwhile.
struct Watch<'a> {
    posed: &'a Posed,
    work: Work<'a>,
    marks: Vec<Mark>,
    seconds: Vec<f64>,
    /// The next iteration to record.
    next: usize,
    start: Instant,
    looking: Duration,
    /// The active set at the last mark.
    active: Vec<Ordering>,
}

impl Watch<'_> {
    fn mark(&mut self, iteration: usize, x: &[f64]) -> Mark {
        let active = self.posed.active_set(x);
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

    /// The time used by the solver so far.
    fn elapsed(&self, now: Instant) -> f64 {
        (now - self.start).saturating_sub(self.looking).as_secs_f64()
    }
}

impl Observer for Watch<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let from = Instant::now();
        let seconds = self.elapsed(from);
        let _ = self.work.observe(iterate);
        if iterate.iteration >= self.next {
            self.next = iterate.iteration + 1 + iterate.iteration / 12;
            self.seconds.push(seconds);
            let mark = self.mark(iterate.iteration, iterate.x);
            self.marks.push(mark);
        }
        self.looking += from.elapsed();
        ControlFlow::Continue(())
    }
}
