//! Large sparse problems solved exactly: what an answer costs where A has thousands of rows and hardly an
//! entry in most places. A net is equations only; a pile has contacts, its friction bounds frozen where
//! some sweeps have led to.
//!
//! Ours and clarabel, both by rows, with A, and by velocities, with the factors of A:
//!
//! ```text
//! (A + D) dx = r      or      (1 + Ĵᵀ D⁻¹ Ĵ) v = Ĵᵀ D⁻¹ r,   A = Ĵ Ĵᵀ
//! ```
//!
//! All are given the matrices, and the time includes whatever a solver makes of them first: the order of
//! elimination, where the factors will have entries.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::contest::{Answer, Tried, clocked};
use super::sweep_speed::posed;
use super::timing::Time;
use lcplab::error::{Error, Result};
use lcplab::lcp::{Lcp, merit};
use lcplab::reference::{box_qp_to, velocity_qp_to};
use lcplab::report::study::Study;
use lcplab::report::study::settings::AtStep;
use lcplab::solver::kernel::impulses::{Row, RowByRow, System, WIDTH};
use lcplab::solver::{InteriorPoint, Settings, Solver, Start};
use lcplab::storage::Factors;

/// The name of our solver by rows.
pub const ROWS: &str = "interior-point, rows";
/// The name of our solver by velocities.
pub const VELOCITIES: &str = "interior-point, velocities";
/// The names of the yardstick, by rows and by velocities.
pub const YARDSTICK: [&str; 2] = ["clarabel, rows", "clarabel, velocities"];
/// A run longer than this (s) is not repeated.
const LONG: f64 = 10.0;

/// Which problems, and what is asked of the times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// The problems.
    pub problems: Vec<Problem>,
    /// Sweeps from x = 0 before friction bounds are frozen.
    pub sweeps: usize,
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// Problems of more rows are only solved by velocities.
    pub most_rows: usize,
    /// Seconds to spend on a problem.
    pub seconds: f64,
}

/// A step of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Problem {
    /// A shipped scene or a file.
    pub scene: String,
    /// The number of the step, from 1.
    pub step: usize,
    /// What is asked of our better time: at most so many times clarabel's better one.
    pub goal: f64,
}

impl Default for Plan {
    fn default() -> Self {
        let problem = |scene: &str, goal| Problem { scene: scene.into(), step: 3, goal };
        Plan {
            problems: vec![problem("net", 1.4), problem("tower", 1.0)],
            sweeps: 500,
            tolerance: 2e-7,
            most_rows: 2000,
            seconds: 2.0,
        }
    }
}

/// What came of a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The problem.
    pub problem: String,
    /// Its rows.
    pub rows: usize,
    /// Entries of A.
    pub stored: usize,
    /// Components of the bodies' velocities.
    pub velocities: usize,
    /// By solver and form, clarabel first.
    pub answers: Vec<Judged>,
}

/// An answer with what else is said of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Judged {
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
    /// The natural residual of its x.
    #[serde(with = "lcplab_study::number::always")]
    pub natural: f64,
    /// The gap and feasibility that clarabel was asked for.
    pub asked: Option<f64>,
}

/// The clock on a problem; only of answers that the judge accepts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The problem.
    pub problem: String,
    /// What is asked of it.
    pub goal: f64,
    /// By solver and form, clarabel first.
    pub solvers: Vec<(String, Time)>,
    /// Those without an answer.
    pub failed: Vec<String>,
}

impl Times {
    /// Our better time and clarabel's.
    pub fn better(&self) -> [Option<f64>; 2] {
        [[ROWS, VELOCITIES], YARDSTICK].map(|names| {
            let times = self.solvers.iter().filter(|(name, _)| names.contains(&name.as_str()));
            times.map(|(_, time)| time.best).reduce(f64::min)
        })
    }
}

impl Study for Plan {
    const NAME: &'static str = "sparse-speed";
    type Finding = Finding;
    type Times = Times;

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        self.problems.iter().map(|p| format!("{}, step {}", p.scene, p.step)).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let problem = self.tasks().swap_remove(task);
        let Problem { scene, step, goal } = self.problems[task].clone();
        let posed = posed(&AtStep { scene, step })?;
        let factors = Factors::of(&posed.assembly);
        let rows = factors.scaled_rows();
        let system = |lcp| {
            System::new(factors.bodies(), &rows, lcp)
                .map_err(|status| Error::invalid(Self::NAME, &*problem, status.to_string()))
        };
        let lcp = self.frozen(&posed.lcp, &system(&posed.lcp)?);
        let system = system(&lcp)?;
        let tried = self.tried(&lcp, &system, &rows);
        let (solvers, failed) = clocked(&tried, self.seconds, LONG);
        let judged = |tried: Tried| Judged {
            natural: merit::natural_residual(&lcp, &tried.x),
            asked: tried.asked,
            answer: tried.answer,
        };
        let finding = Finding {
            problem: problem.clone(),
            rows: lcp.len(),
            stored: lcp.matrix().stored(),
            velocities: WIDTH * factors.bodies(),
            answers: tried.into_iter().map(judged).collect(),
        };
        Ok((finding, Times { problem, goal, solvers, failed }))
    }
}

impl Plan {
    /// The problem with friction bounds that are plausible, not those of a solution.
    fn frozen(&self, lcp: &Lcp, system: &System) -> Lcp {
        let mut kernel = RowByRow::new(system);
        (0..self.sweeps).for_each(|_| kernel.sweep(system));
        lcp.frozen_at(kernel.x())
    }

    /// The answers, clarabel's first.
    fn tried<'a>(&self, lcp: &'a Lcp, system: &'a System, rows: &[Row]) -> Vec<Tried<'a>> {
        let settings = Settings { tolerance: self.tolerance, ..Settings::default() };
        let ours = InteriorPoint { settings };
        let (jacobian, velocities) = (entries(rows), WIDTH * system.bodies());
        let by_velocities = move |asked| velocity_qp_to(lcp, &jacobian, velocities, asked);
        let is_small = lcp.len() <= self.most_rows;
        let mut tried = Vec::new();
        if is_small {
            let by_rows = move |asked| box_qp_to(lcp, asked);
            tried.extend(Tried::yardstick(YARDSTICK[0], lcp, self.tolerance, by_rows));
        }
        tried.extend(Tried::yardstick(YARDSTICK[1], lcp, self.tolerance, by_velocities));
        if is_small {
            let ours = ours.clone();
            let by_rows = move || ours.solve(lcp, &Start::default(), &mut ());
            tried.push(Tried::of(ROWS, lcp, self.tolerance, by_rows));
        }
        let by_velocities = move || ours.solve_factored(lcp, system, &Start::default(), &mut ());
        tried.push(Tried::of(VELOCITIES, lcp, self.tolerance, by_velocities));
        tried
    }
}

/// The entries of Ĵ.
fn entries(rows: &[Row]) -> Vec<(usize, usize, f64)> {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (body, part) in row.bodies.iter().zip(&row.jacobian) {
            let nonzero = part.iter().enumerate().filter(|(_, j)| **j != 0.0);
            entries.extend(nonzero.map(|(k, &j)| (i, WIDTH * body + k, j)));
        }
    }
    entries
}
