//! Several methods on one problem: how the residual falls by iteration, by multiplication and by
//! second. An iteration of one method is not one of another; a multiplication nearly is.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::attempt::{Outcome, entries};
use super::posed::Source;
use crate::error::Result;
use crate::lcp::{Lcp, merit};
use crate::solver::{Entry, Group, Iterate, Observer, Options, Settings, Start};
use crate::trace::Work;

/// Which problems and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The problems.
    pub problems: Vec<Source>,
    /// The solvers; all without it.
    #[serde(default)]
    pub solvers: Vec<String>,
    /// The scaled residual asked for.
    #[serde(default = "target")]
    pub tolerance: f64,
    /// ω of SOR.
    #[serde(default = "relaxed")]
    pub omega: f64,
    /// More sweeps, steps or pivots are not made.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

fn target() -> f64 {
    1e-10
}

fn relaxed() -> f64 {
    1.7
}

fn limit() -> usize {
    100_000
}

/// The race on a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Race {
    /// The problem.
    pub problem: String,
    /// Its rows.
    pub rows: usize,
    /// Stored entries of A.
    pub stored: usize,
    /// ω of SOR.
    pub omega: f64,
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// By solver.
    pub runners: Vec<Runner>,
}

/// A solver in it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Runner {
    /// The solver.
    pub solver: String,
    /// What came of it.
    pub outcome: Outcome,
    /// Now and then, the end included; of pivoting methods the end alone.
    pub marks: Vec<Mark>,
}

/// Where a solver stands.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Sweeps, steps or pivots.
    pub iteration: usize,
    /// Multiplications ([`Work`]); NaN where nobody counts them.
    #[serde(with = "lcplab_study::number::always")]
    pub work: f64,
    /// The scaled residual.
    #[serde(with = "lcplab_study::number::always")]
    pub residual: f64,
}

/// The clock at the marks of a race.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// The problem.
    pub problem: String,
    /// By solver: its name, and (s, scaled residual) at each mark.
    pub runners: Vec<(String, Vec<(f64, f64)>)>,
}

impl Study for Plan {
    const NAME: &'static str = "race";
    type Finding = Race;
    type Times = Clock;

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        self.problems.iter().map(Source::name).collect()
    }

    fn run(&self, task: usize) -> Result<(Race, Clock)> {
        let problem = &self.problems[task];
        let lcp = problem.lcp()?;
        let settings = Settings {
            tolerance: self.tolerance,
            max_iterations: self.max_iterations,
            ..Settings::default()
        };
        let options = Options { settings, omega: self.omega, ..Options::default() };
        let runs = entries(&self.solvers)?;
        let (runners, clock) = runs.iter().map(|entry| run(entry, &lcp, &options)).unzip();
        let race = Race {
            problem: problem.name(),
            rows: lcp.len(),
            stored: lcp.matrix().stored(),
            omega: self.omega,
            tolerance: self.tolerance,
            runners,
        };
        Ok((race, Clock { problem: problem.name(), runners: clock }))
    }
}

fn run(entry: &Entry, lcp: &Lcp, options: &Options) -> (Runner, (String, Vec<(f64, f64)>)) {
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
    (Runner { solver: solver.clone(), outcome, marks }, (solver, times))
}

/// Looks at some iterates, and stops the clock meanwhile.
struct Watch<'a> {
    lcp: &'a Lcp,
    work: Work<'a>,
    marks: Vec<Mark>,
    seconds: Vec<f64>,
    /// The iteration that is looked at next.
    next: usize,
    start: Instant,
    looking: Duration,
}

impl Watch<'_> {
    /// The time that the solver has had until now.
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
