//! Records the residual of a solver at selected iterations, with the clock stopped meanwhile.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::methods::MethodProgress;
use crate::lcp::{Lcp, merit};
use crate::report::study::attempt::Outcome;
use crate::solver::{Entry, Group, Iterate, Observer, Options, Start};
use crate::trace::Work;

/// The state of a solver at an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// The number of sweeps, steps or pivots.
    pub iteration: usize,
    /// Multiplications ([`Work`]); NaN if they are not counted.
    #[serde(with = "lcplab_study::number::always")]
    pub work: f64,
    /// The scaled residual.
    #[serde(with = "lcplab_study::number::always")]
    pub residual: f64,
}

/// Solves the problem from 0: returns the solver's marks, and its time (s) and scaled residual at
/// each.
pub(super) fn run(
    entry: &Entry,
    lcp: &Lcp,
    options: &Options,
) -> (MethodProgress, (String, Vec<(f64, f64)>)) {
    let mut watch = Watch {
        lcp,
        work: Work::of(entry, lcp),
        marks: Vec::new(),
        seconds: Vec::new(),
        next: 0,
        start: Instant::now(),
        looking: Duration::ZERO,
    };
    let solution = (entry.build)(options).solve(lcp, &Start::default(), &mut watch);
    let seconds = watch.elapsed(Instant::now());
    let end = Mark {
        iteration: solution.iterations,
        work: watch.work.multiplications,
        residual: merit::scaled_residual(lcp, &solution.x),
    };
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
    (MethodProgress { solver: solver.clone(), outcome, marks }, (solver, times))
}

/// An observer that records selected iterates and stops the clock meanwhile.
struct Watch<'a> {
    lcp: &'a Lcp,
    work: Work<'a>,
    marks: Vec<Mark>,
    seconds: Vec<f64>,
    /// The next iteration to record.
    next: usize,
    start: Instant,
    looking: Duration,
}

impl Watch<'_> {
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
            self.marks.push(Mark {
                iteration: iterate.iteration,
                work: self.work.multiplications,
                residual: merit::scaled_residual(self.lcp, iterate.x),
            });
        }
        self.looking += from.elapsed();
        ControlFlow::Continue(())
    }
}
