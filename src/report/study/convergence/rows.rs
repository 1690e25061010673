//! Where the error is: the residual of each row after each sweep, in a column of bodies on the
//! ground.
//!
//! All bodies fall at the same speed, so at first only the lowest contact closes. In a sweep from
//! the ground up each row sees the new impulse of the row below, so a change reaches the top in one
//! sweep, halved in each row; from the top down it climbs one row per sweep.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::lcp::Lcp;
use crate::report::study::posed::column;
use crate::solver::{Damping, Iterate, Jacobi, Observer, Order, Pgs, Settings, Solver, Start};

/// The column, and the duration of the record.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rows {
    /// The number of bodies.
    pub bodies: usize,
    /// The mass of the top body relative to the others.
    #[serde(default = "one")]
    pub ratio: f64,
    /// The number of sweeps.
    pub sweeps: usize,
    /// The sweep methods.
    #[serde(default = "all")]
    pub methods: Vec<Sweep>,
}

fn one() -> f64 {
    1.0
}

fn all() -> Vec<Sweep> {
    vec![Sweep::Up, Sweep::Down, Sweep::BestSor, Sweep::Jacobi]
}

/// A sweep method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Sweep {
    /// Gauss-Seidel from the ground up, the natural order.
    Up,
    /// Gauss-Seidel from the top down.
    Down,
    /// SOR from the ground up with the ω that is optimal for equal bodies.
    BestSor,
    /// Undamped Jacobi: all rows at once.
    Jacobi,
}

/// The residuals of one method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowResiduals {
    /// The sweep method.
    pub method: Sweep,
    /// ω; 1 for all methods but SOR.
    pub omega: f64,
    /// |x_i − Π(x_i − w_i)| (m/s) for each row from the ground up, then for each sweep, the start first.
    pub residuals: Vec<Vec<f64>>,
}

impl Sweep {
    /// A short name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Sweep::Up => "PGS, upward",
            Sweep::Down => "PGS, downward",
            Sweep::BestSor => "SOR, upward, ω*",
            Sweep::Jacobi => "Jacobi",
        }
    }
}

impl Rows {
    /// Sweeps the column with one method.
    ///
    /// # Errors
    /// If the number of sweeps is 0, or the library has no such column.
    pub(crate) fn run(&self, method: Sweep) -> Result<RowResiduals> {
        if self.sweeps == 0 {
            return Err(Error::invalid("convergence", "rows.sweeps", "must be at least 1, is 0"));
        }
        let lcp = column(self.bodies, self.ratio)?;
        let omega = match method {
            Sweep::BestSor => 2.0 / (1.0 + (PI / (2 * self.bodies) as f64).sin()),
            _ => 1.0,
        };
        let mut watch = Watch { lcp: &lcp, residuals: vec![Vec::new(); lcp.len()] };
        self.solver(method, omega).solve(&lcp, &Start::default(), &mut watch);
        Ok(RowResiduals { method, omega, residuals: watch.residuals })
    }

    fn solver(&self, method: Sweep, omega: f64) -> Box<dyn Solver> {
        let max_iterations = self.sweeps;
        let settings = Settings::default()
            .with_tolerance(0.0)
            .with_max_iterations(max_iterations)
            .with_check_every(max_iterations);
        match method {
            Sweep::Up | Sweep::BestSor => Box::new(Pgs { omega, order: Order::Natural, settings }),
            Sweep::Down => Box::new(Pgs { omega, order: Order::Reverse, settings }),
            Sweep::Jacobi => Box::new(Jacobi { damping: Damping::Factor(1.0), settings }),
        }
    }
}

struct Watch<'a> {
    lcp: &'a Lcp,
    residuals: Vec<Vec<f64>>,
}

impl Observer for Watch<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let (lcp, x) = (self.lcp, iterate.x);
        for (i, row) in self.residuals.iter_mut().enumerate() {
            row.push((x[i] - lcp.project(i, x[i] - lcp.row_w(i, x), x)).abs());
        }
        ControlFlow::Continue(())
    }
}
