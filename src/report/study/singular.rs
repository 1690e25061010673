//! Redundant contacts: what an exact answer costs where A is singular. Stacks of cubes with a contact at
//! each corner, with and without friction (its bounds frozen), as they are and with a little of
//! the mean diagonal added to A, beside clarabel's interior point.
//!
//! Both sides must arrive: a solver's claim is judged, and clarabel is asked for no more than it needs
//! to reach the same scaled residual, 1e-8 of gap and feasibility at first.

use serde::{Deserialize, Serialize};

use super::Study;
use super::attempt::entries;
use super::contest::{Answer, Tried, clocked};
use super::timing::Time;
use crate::error::{Error, Result};
use crate::lcp::{Lcp, Matrix, library};
use crate::reference::box_qp_to;
use crate::solver::{Entry, Options, Settings, Start};

/// The name of the yardstick.
pub const YARDSTICK: &str = "clarabel";
/// A run longer than this (s) is not repeated.
const LONG: f64 = 0.1;

/// Which stacks and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Stacks of so many cubes.
    pub boxes: Vec<usize>,
    /// Coefficients of friction.
    pub friction: Vec<f64>,
    /// Parts of the mean diagonal that are added to the diagonal: 0 leaves A singular.
    pub compliance: Vec<f64>,
    /// The solvers.
    pub solvers: Vec<String>,
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// Seconds to spend on a problem.
    pub seconds: f64,
    /// What is asked of the times: at most so many times clarabel's.
    pub goal: f64,
}

impl Default for Plan {
    fn default() -> Self {
        Plan {
            boxes: vec![5, 10, 20, 50],
            friction: vec![0.0, 0.5],
            compliance: vec![0.0, 1e-8],
            solvers: ["interior-point", "dantzig", "lemke"].map(String::from).to_vec(),
            tolerance: 1e-9,
            seconds: 0.5,
            goal: 2.0,
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
    /// The gap and feasibility that clarabel was asked for.
    pub asked: f64,
    /// Clarabel first, then the solvers.
    pub answers: Vec<Answer>,
}

/// The clock on a problem; only of answers that the judge accepts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The problem.
    pub problem: String,
    /// Its rows.
    pub rows: usize,
    /// By solver, clarabel first.
    pub solvers: Vec<(String, Time)>,
    /// Those without an answer.
    pub failed: Vec<String>,
}

impl Times {
    /// What clarabel took.
    pub fn yardstick(&self) -> Option<Time> {
        self.of(YARDSTICK)
    }

    /// What a solver took.
    pub fn of(&self, solver: &str) -> Option<Time> {
        self.solvers.iter().find(|(name, _)| name == solver).map(|(_, time)| *time)
    }
}

/// A stack.
struct Stack {
    boxes: usize,
    friction: f64,
    compliance: f64,
}

impl Plan {
    fn stacks(&self) -> Vec<Stack> {
        let mut stacks = Vec::new();
        for &compliance in &self.compliance {
            for &friction in &self.friction {
                let stack = |&boxes: &usize| Stack { boxes, friction, compliance };
                stacks.extend(self.boxes.iter().map(stack));
            }
        }
        stacks
    }
}

impl Study for Plan {
    const NAME: &'static str = "singular";
    const ALONE: bool = true;
    type Finding = Finding;
    type Times = Times;

    fn tasks(&self) -> Vec<String> {
        self.stacks().iter().map(Stack::name).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let stack = self.stacks().swap_remove(task);
        let (problem, lcp) = (stack.name(), stack.lcp()?);
        let settings = Settings { tolerance: self.tolerance, ..Settings::default() };
        let options = Options { settings, ..Options::default() };
        let refused = || Error::invalid(Self::NAME, YARDSTICK, "no quadratic program over a box");
        let ask = |asked| box_qp_to(&lcp, asked);
        let yardstick =
            Tried::yardstick(YARDSTICK, &lcp, self.tolerance, ask).ok_or_else(refused)?;
        let asked = yardstick.asked.unwrap_or_default();
        let entries = entries(&self.solvers)?;
        let ours = entries.iter().map(|entry| by(entry, &lcp, &options));
        let tried: Vec<Tried> = [yardstick].into_iter().chain(ours).collect();
        let (solvers, failed) = clocked(&tried, self.seconds, LONG);
        let answers = tried.into_iter().map(|tried| tried.answer).collect();
        let rows = lcp.len();
        Ok((
            Finding { problem: problem.clone(), rows, asked, answers },
            Times { problem, rows, solvers, failed },
        ))
    }
}

fn by<'a>(entry: &Entry, lcp: &'a Lcp, options: &Options) -> Tried<'a> {
    let solver = (entry.build)(options);
    let run = move || solver.solve(lcp, &Start::default(), &mut ());
    Tried::of(entry.name, lcp, options.settings.tolerance, run)
}

impl Stack {
    fn name(&self) -> String {
        let kind = if self.friction > 0.0 { "friction" } else { "stack" };
        let name = format!("{kind} {}", self.boxes);
        if self.compliance > 0.0 { format!("{name}, regularised") } else { name }
    }

    fn lcp(&self) -> Result<Lcp> {
        let given = [("boxes", self.boxes as f64), ("mu", self.friction)];
        let lcp = library::by_name("box-stack")?.generate(&given)?.lcp;
        if self.compliance > 0.0 { softened(&lcp, self.compliance) } else { Ok(lcp) }
    }
}

/// A with this part of its mean diagonal added to the diagonal.
fn softened(lcp: &Lcp, part: f64) -> Result<Lcp> {
    let n = lcp.len();
    let gamma = part * (0..n).map(|i| lcp.matrix().diagonal(i)).sum::<f64>() / n as f64;
    let entries = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let added = (0..n).map(|i| (i, i, gamma));
    let matrix = Matrix::sparse(n, &entries.chain(added).collect::<Vec<_>>());
    Lcp::new(matrix, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec())
}
