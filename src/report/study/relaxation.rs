//! What the relaxation factor does: sweeps and contraction of SOR against ω, beside Young's theory.
//!
//! The frictionless column of n equal bodies is consistently ordered, with ρ_J = cos(π/2n). Young
//! (1950) ties the eigenvalues of SOR to it:
//!
//! ```text
//! ω* = 2 / (1 + √(1 − ρ_J²))
//! ω ≤ ω*:  ρ(ω) = ¼ (ω ρ_J + √(ω² ρ_J² − 4 (ω − 1)))²
//! ω ≥ ω*:  ρ(ω) = ω − 1
//! ```
//!
//! Below ω* the largest eigenvalue is real, above it all of them lie on a circle of radius ω − 1.

use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::posed::{BLOW, column};
use crate::error::{Error, Result};
use crate::lcp::{Lcp, merit};
use crate::solver::{Iterate, Observer, Order, Pgs, Settings, Solver, Start, theory};

/// Columns and relaxation factors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Columns of so many bodies.
    pub bodies: Vec<usize>,
    /// The relaxation factors, each above 0 and below 2; the optimal one is added.
    pub omegas: Vec<f64>,
    /// The natural residual (m/s) that sweeps are counted to.
    #[serde(default = "target")]
    pub target: f64,
    /// More sweeps are not made.
    #[serde(default = "limit")]
    pub max_sweeps: usize,
}

fn target() -> f64 {
    1e-8
}

fn limit() -> usize {
    50_000
}

/// One column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// The number of bodies n.
    pub bodies: usize,
    /// cos(π/2n).
    pub jacobi: f64,
    /// ω*.
    pub best: f64,
    /// By rising ω.
    pub points: Vec<Point>,
}

/// One relaxation factor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// ω.
    pub omega: f64,
    /// ρ(ω) by Young's formula.
    pub closed_form: f64,
    /// ρ(ω) as an eigenvalue of the iteration matrix.
    pub eigenvalue: f64,
    /// The contraction measured over the last half of the sweeps; `None` if there are too few.
    pub measured: Option<f64>,
    /// ln(target/b) / ln ρ(ω).
    pub expected: f64,
    /// Sweeps counted; `None` if they never got there.
    pub sweeps: Option<usize>,
}

impl Study for Plan {
    const NAME: &'static str = "relaxation";
    type Finding = Column;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.bodies.iter().map(|n| format!("column of {n}")).collect()
    }

    fn run(&self, task: usize) -> Result<(Column, ())> {
        let bodies = self.bodies[task];
        let lcp = column(bodies, 1.0)?;
        let jacobi = theory::column_radius(bodies);
        let best = theory::optimal_omega(jacobi);
        if let Some(wrong) = self.omegas.iter().find(|omega| !(0.0 < **omega && **omega < 2.0)) {
            let reason = format!("must lie between 0 and 2, is {wrong}");
            return Err(Error::invalid("relaxation", "omegas", reason));
        }
        let mut omegas = self.omegas.clone();
        omegas.push(best);
        omegas.sort_by(f64::total_cmp);
        omegas.dedup();
        let points = omegas.iter().map(|&omega| self.point(&lcp, jacobi, omega)).collect();
        Ok((Column { bodies, jacobi, best, points }, ()))
    }
}

impl Plan {
    fn point(&self, lcp: &Lcp, jacobi: f64, omega: f64) -> Point {
        let residuals = self.residuals(lcp, omega);
        let closed_form = theory::sor_radius(jacobi, omega);
        let matrix = theory::sor_iteration_matrix(lcp.matrix(), omega);
        Point {
            omega,
            closed_form,
            eigenvalue: theory::spectral_radius(&matrix),
            measured: contraction(&residuals),
            expected: theory::sweeps_to(self.target / BLOW, closed_form),
            sweeps: residuals.iter().position(|residual| *residual <= self.target),
        }
    }

    /// The natural residuals of the start and of each sweep, to a hundredth of the target.
    fn residuals(&self, lcp: &Lcp, omega: f64) -> Vec<f64> {
        let max_iterations = self.max_sweeps;
        let settings = Settings {
            tolerance: 0.0,
            max_iterations,
            check_every: max_iterations.max(1),
            ..Settings::default()
        };
        let mut watch = Watch { lcp, least: 1e-2 * self.target, residuals: Vec::new() };
        Pgs { omega, order: Order::Natural, settings }.solve(lcp, &Start::default(), &mut watch);
        watch.residuals
    }
}

struct Watch<'a> {
    lcp: &'a Lcp,
    least: f64,
    residuals: Vec<f64>,
}

impl Observer for Watch<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let residual = merit::natural_residual(self.lcp, iterate.x);
        self.residuals.push(residual);
        if residual > self.least { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

/// The factor a sweep over the last half, of the largest residual still to come: above ω* the
/// residual itself goes up and down.
fn contraction(residuals: &[f64]) -> Option<f64> {
    let ahead = |k: usize| residuals[k..].iter().copied().fold(0.0, f64::max);
    let last = residuals.len().checked_sub(1).filter(|last| *last >= 10)?;
    // The envelope needs some sweeps to come: an eighth of them.
    let (from, to) = (last / 2, last - last / 8);
    Some((ahead(to) / ahead(from)).powf(1.0 / (to - from) as f64))
}
