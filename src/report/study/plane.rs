//! The path of one row through the plane of x_i and w_i, to the graph on which solutions lie.

use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::attempt::entries;
use super::posed::Source;
use crate::error::{Error, Result};
use crate::lcp::Lcp;
use crate::solver::{Iterate, Observer, Options, Settings, Start, Status};

/// Which rows, and whose paths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Rows of problems.
    pub rows: Vec<Chosen>,
    /// The solvers.
    pub solvers: Vec<String>,
    /// ω of SOR.
    #[serde(default = "relaxed")]
    pub omega: f64,
    /// The scaled residual asked for.
    #[serde(default = "target")]
    pub tolerance: f64,
    /// Of longer paths only the points that can be told apart are kept.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

fn relaxed() -> f64 {
    1.5
}

fn target() -> f64 {
    1e-8
}

fn limit() -> usize {
    5_000
}

/// A row of a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Chosen {
    /// The problem.
    pub problem: Source,
    /// The row, from 0.
    pub row: usize,
    /// What the row is, in a few words.
    pub what: String,
}

/// The paths in the plane of a row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The problem.
    pub problem: String,
    /// The row, from 0.
    pub row: usize,
    /// What it is.
    pub what: String,
    /// Its bounds at the last answer.
    pub bounds: [Option<f64>; 2],
    /// One a solver.
    pub paths: Vec<Path>,
}

/// The path of a solver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// The solver.
    pub solver: String,
    /// Sweeps, steps or pivots.
    pub iterations: usize,
    /// Its own word on the answer.
    pub status: String,
    /// (x_i, w_i), without those that lie where the one before does.
    pub points: Vec<(f64, f64)>,
}

impl Study for Plan {
    const NAME: &'static str = "plane";
    type Finding = Row;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let name = |chosen: &Chosen| format!("{}, row {}", chosen.problem.name(), chosen.row);
        self.rows.iter().map(name).collect()
    }

    fn run(&self, task: usize) -> Result<(Row, ())> {
        let Chosen { problem, row, what } = &self.rows[task];
        let lcp = problem.lcp()?;
        if *row >= lcp.len() {
            let reason = format!("the problem has {} rows, this is {row}", lcp.len());
            return Err(Error::invalid(problem.name(), "row", reason));
        }
        let settings = Settings {
            tolerance: self.tolerance,
            max_iterations: self.max_iterations,
            ..Settings::default()
        };
        let options = Options { settings, omega: self.omega, ..Options::default() };
        let (mut paths, mut answer) = (Vec::new(), None);
        for entry in entries(&self.solvers)? {
            let mut watch = Watch { lcp: &lcp, row: *row, points: Vec::new() };
            let solution = (entry.build)(&options).solve(&lcp, &Start::default(), &mut watch);
            let mut points = watch.points;
            points.push((solution.x[*row], solution.w[*row]));
            let path = Path {
                solver: entry.name.to_string(),
                iterations: solution.iterations,
                status: solution.status.to_string(),
                points: apart(points),
            };
            if solution.status == Status::Solved {
                answer = Some(solution.x);
            }
            paths.push(path);
        }
        let at = answer.unwrap_or_else(|| vec![0.0; lcp.len()]);
        let (lo, hi) = lcp.bounds(*row, &at);
        let bounds = [lo, hi].map(|bound| Some(bound).filter(|bound| bound.is_finite()));
        let (problem, what) = (problem.name(), what.clone());
        Ok((Row { problem, row: *row, what, bounds, paths }, ()))
    }
}

struct Watch<'a> {
    lcp: &'a Lcp,
    row: usize,
    points: Vec<(f64, f64)>,
}

impl Observer for Watch<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let x = iterate.x;
        self.points.push((x[self.row], self.lcp.row_w(self.row, x)));
        ControlFlow::Continue(())
    }
}

/// The part of the plane that a picture can show: points nearer than this to the one before are left
/// out.
const RESOLUTION: f64 = 2e-3;

fn apart(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let size = |at: fn(&(f64, f64)) -> f64| {
        let values = points.iter().map(at).filter(|value| value.is_finite());
        let (lo, hi) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
        f64::max(hi - lo, f64::MIN_POSITIVE)
    };
    let (wide, high) = (size(|p| p.0), size(|p| p.1));
    let last = points.last().copied();
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for (x, w) in points.into_iter().filter(|(x, w)| x.is_finite() && w.is_finite()) {
        let far = kept.last().is_none_or(|(x0, w0)| {
            ((x - x0) / wide).abs() > RESOLUTION || ((w - w0) / high).abs() > RESOLUTION
        });
        if far {
            kept.push((x, w));
        }
    }
    if let Some(last) = last.filter(|last| kept.last() != Some(last)) {
        kept.push(last);
    }
    kept
}
