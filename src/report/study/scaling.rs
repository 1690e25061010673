//! Cost against size: a frictionless column of n equal bodies, taller and taller.
//!
//! After k sweeps of Gauss-Seidel the slowest eigenvector is left, in the ground's row by (2/n) b ρ^k
//! with ρ = cos²(π/2n), and that row's terms add up to 2 n b; so the scaled residual is ε after
//!
//! ```text
//! k = ln(ε n²) / ln cos²(π/2n) ≈ (4/π²) n² ln(1/(ε n²))
//! ```
//!
//! sweeps: four times as many for twice the bodies. SOR with ω* = 2/(1 + sin(π/2n)) has ρ = ω* − 1 and
//! needs about n ln(1/ε)/π, methods with memory a number that grows like √κ, also as n; the condition
//! number κ of A grows as n².

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::attempt::{Attempt, attempt, entries, options};
use super::posed::column;
use crate::error::Result;
use crate::solver::Options;

/// Which columns and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Columns of so many bodies, rising.
    pub bodies: Vec<usize>,
    /// The solvers; `sor` has the optimal ω of each column.
    pub solvers: Vec<String>,
    /// The scaled residual asked for.
    #[serde(default = "target")]
    pub tolerance: f64,
    /// More sweeps, steps or pivots are not made.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

fn target() -> f64 {
    1e-8
}

fn limit() -> usize {
    1_000_000
}

/// What a column cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// The number of bodies n.
    pub bodies: usize,
    /// Sweeps of Gauss-Seidel by the formula.
    pub gauss_seidel: f64,
    /// Sweeps of SOR with ω*, by the rate alone.
    pub best_sor: f64,
    /// By solver.
    pub attempts: Vec<Attempt>,
}

/// Wall times on a column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// The number of bodies.
    pub bodies: usize,
    /// By solver: name and time (s); nothing where it failed.
    pub solvers: Vec<(String, Option<f64>)>,
}

impl Study for Plan {
    const NAME: &'static str = "scaling";
    const ALONE: bool = true;
    type Finding = Column;
    type Times = Seconds;

    fn tasks(&self) -> Vec<String> {
        self.bodies.iter().map(|n| format!("column of {n}")).collect()
    }

    fn run(&self, task: usize) -> Result<(Column, Seconds)> {
        let bodies = self.bodies[task];
        let lcp = column(bodies, 1.0)?;
        let n = bodies as f64;
        let omega = 2.0 / (1.0 + (PI / (2.0 * n)).sin());
        let options = Options { omega, ..options(self.tolerance, self.max_iterations) };
        let (mut attempts, mut seconds) = (Vec::new(), Vec::new());
        for entry in entries(&self.solvers)? {
            let tried = attempt(&entry, &lcp, &options);
            let time = tried.attempt.outcome.is_solved().then_some(tried.seconds);
            seconds.push((entry.name.to_string(), time));
            attempts.push(tried.attempt);
        }
        let rate = (PI / (2.0 * n)).cos().powi(2);
        let gauss_seidel = (self.tolerance * n * n).ln() / rate.ln();
        let best_sor = self.tolerance.ln() / (omega - 1.0).ln();
        Ok((
            Column { bodies, gauss_seidel, best_sor, attempts },
            Seconds { bodies, solvers: seconds },
        ))
    }
}
