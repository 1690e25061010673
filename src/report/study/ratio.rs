//! A stack with a heavy load on top: who carries it, and at what cost.
//!
//! Two systems for each mass ratio r. *Two bodies* without friction, the upper one r times as heavy:
//! Gauss-Seidel leaves r/(1 + r) of the error in a sweep, exactly. And a stack of *boxes* with
//! friction and four contacts a layer, the top box r times as heavy: A is singular, since three
//! contacts would do.
//!
//! Theory says how many sweeps lie between two precisions ε₁ > ε₂, whatever the start:
//!
//! ```text
//! k = ln(ε₂/ε₁) / ln ρ,   ρ the largest eigenvalue below 1 of the iteration matrix
//! ```
//!
//! while no row changes between bound and interior, as at rest none does. For the boxes that is the most
//! that may lie between: the slowest component of the error, in which the load rocks, has little share in
//! a start from which nothing rocks. For the two bodies all is known: their scaled residual after k sweeps
//! is ρ^k / (2 (1 + r)), nearly.

use crate::simulation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::attempt::{Attempt, attempt, entries, options};
use super::posed::{BLOW, Loaded, column};
use crate::error::Result;
use crate::lcp::Lcp;
use crate::solver::{Options, theory};

/// Which stacks and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The boxes of the stack, the load among them: at least 2.
    pub boxes: usize,
    /// The mass of the load, in masses of the other bodies.
    pub ratios: Vec<f64>,
    /// The ratio that the words at the end are about.
    pub about: f64,
    /// The solvers; all without it.
    #[serde(default)]
    pub solvers: Vec<String>,
    /// The scaled residuals asked for, falling.
    #[serde(default = "ladder")]
    pub tolerances: Vec<f64>,
    /// More sweeps, steps or pivots are not made.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

fn ladder() -> Vec<f64> {
    vec![1e-4, 1e-8]
}

fn limit() -> usize {
    200_000
}

/// What is stacked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum System {
    /// Two point masses without friction.
    TwoBodies,
    /// Boxes with friction.
    Boxes,
}

/// A stack and what the solvers made of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stack {
    /// What is stacked.
    pub system: System,
    /// The mass ratio r.
    pub ratio: f64,
    /// Rows of the LCP.
    pub rows: usize,
    /// By solver.
    pub tried: Vec<Tried>,
}

/// What a solver made of a stack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    /// The eigenvalue by which a sweep multiplies the error in the long run; `None` for methods that
    /// are no linear iteration.
    pub rate: Option<f64>,
    /// By tolerance.
    pub attempts: Vec<Attempt>,
    /// By tolerance: the part of the weight that the ground does not carry; `None` if the answer is
    /// beyond all bounds.
    pub missing: Vec<Option<f64>>,
}

/// Wall times (s) on a stack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// What is stacked.
    pub system: System,
    /// The mass ratio.
    pub ratio: f64,
    /// By solver: its name, and the time by tolerance.
    pub solvers: Vec<(String, Vec<f64>)>,
}

/// A problem with the rows that carry all of the weight.
pub struct Posed {
    /// The problem.
    pub lcp: Lcp,
    ground: Vec<usize>,
    /// N s.
    weight: f64,
}

impl Study for Plan {
    const NAME: &'static str = "mass-ratio";
    type Finding = Stack;
    type Times = Seconds;

    fn tasks(&self) -> Vec<String> {
        let two = self.ratios.iter().map(|r| format!("two bodies, ratio {r}"));
        let boxes = self.ratios.iter().map(|r| format!("{} boxes, ratio {r}", self.boxes));
        two.chain(boxes).collect()
    }

    fn run(&self, task: usize) -> Result<(Stack, Seconds)> {
        let (system, ratio) = self.stack(task);
        let posed = self.posed(task)?;
        let all: Vec<usize> = (0..posed.lcp.len()).collect(); // at rest every row is free
        let (mut tried, mut seconds) = (Vec::new(), Vec::new());
        for entry in entries(&self.solvers)? {
            let mut found = Tried {
                rate: theory::rate(entry.name, &Options::default(), &posed.lcp, &all),
                attempts: Vec::new(),
                missing: Vec::new(),
            };
            let mut times = Vec::new();
            for tolerance in &self.tolerances {
                let options = options(*tolerance, self.max_iterations);
                let attempted = attempt(&entry, &posed.lcp, &options);
                let carried: f64 = posed.ground.iter().map(|&i| attempted.x[i]).sum();
                let missing = (posed.weight - carried) / posed.weight;
                found.missing.push(Some(missing).filter(|missing| missing.is_finite()));
                found.attempts.push(attempted.attempt);
                times.push(attempted.seconds);
            }
            seconds.push((entry.name.to_string(), times));
            tried.push(found);
        }
        let stack = Stack { system, ratio, rows: posed.lcp.len(), tried };
        Ok((stack, Seconds { system, ratio, solvers: seconds }))
    }
}

impl Plan {
    /// What is stacked in a task, and its mass ratio.
    pub fn stack(&self, task: usize) -> (System, f64) {
        let system = if task < self.ratios.len() { System::TwoBodies } else { System::Boxes };
        (system, self.ratios[task % self.ratios.len()])
    }

    /// The problem of a task.
    ///
    /// # Errors
    /// If the stack cannot be built.
    pub fn posed(&self, task: usize) -> Result<Posed> {
        match self.stack(task) {
            (System::TwoBodies, ratio) => two_bodies(ratio),
            (System::Boxes, ratio) => boxes(self.boxes, ratio),
        }
    }
}

fn two_bodies(ratio: f64) -> Result<Posed> {
    Ok(Posed { lcp: column(2, ratio)?, ground: vec![0], weight: (1.0 + ratio) * BLOW })
}

fn boxes(boxes: usize, ratio: f64) -> Result<Posed> {
    let scene = Loaded { boxes, ratio }.scene()?;
    let ground = scene.body("ground");
    let mass = (boxes - 1) as f64 + ratio;
    let weight = mass * scene.gravity.norm() * scene.step.dt;
    let problem = simulation::problem_of(&scene, 1)?;
    let rows = problem.assembly.rows.iter().enumerate();
    let carries = rows.filter(|(_, row)| row.id.component == 0 && row.bodies.contains(&ground));
    let ground = carries.map(|(i, _)| i).collect();
    Ok(Posed { ground, weight, lcp: problem.lcp })
}
