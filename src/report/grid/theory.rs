//! Closed forms that a grid can be drawn beside.

use super::plan::Task;
use crate::lcp::{Lcp, Matrix};
use crate::scene::Solver;
use crate::solver::theory::{column_radius, optimal_omega, sor_radius};

/// A closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Theory {
    /// Young (1950), SOR on a column of n equal masses, standing on the ground or hung at one end:
    ///
    /// ```text
    /// ρ_J = cos(π/2n),   ω* = 2/(1 + √(1 − ρ_J²)),   ρ(ω) = ω − 1 for ω ≥ ω*,
    /// ρ(ω) = ((ω ρ_J + √(ω² ρ_J² − 4(ω − 1)))/2)² below
    /// ```
    ///
    /// It predicts iterations: ln(tolerance)/ln ρ(ω) sweeps, the optimum ω*. Applies where A is a
    /// multiple of tridiag(−1, 2, −1) with 1 in the first place, and the solver is SOR or PGS.
    Young,
    /// Gauss-Seidel on two bodies, the upper one r times as heavy (the family `stack` with n = 2): it
    /// predicts the error after k sweeps, (r/(1 + r))^k.
    MassRatio,
}

/// What a closed form says of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// The value of [`Theory::measure`].
    pub value: f64,
    /// Where along the first axis its least value is, if that is known.
    pub optimum: Option<f64>,
}

impl Theory {
    /// All of them.
    pub const ALL: [Theory; 2] = [Theory::Young, Theory::MassRatio];

    /// Its name in grid files.
    pub fn name(self) -> &'static str {
        match self {
            Theory::Young => "young",
            Theory::MassRatio => "mass-ratio",
        }
    }

    /// The one of this name.
    pub fn by_name(name: &str) -> Option<Self> {
        Theory::ALL.into_iter().find(|theory| theory.name() == name)
    }

    /// The measure that it predicts.
    pub fn measure(self) -> &'static str {
        match self {
            Theory::Young => "iterations",
            Theory::MassRatio => "error",
        }
    }

    /// What it says of a task's problem, solved in so many iterations; `None` where it does not apply.
    pub(super) fn predict(
        self,
        task: &Task,
        lcp: &Lcp,
        solver: &Solver,
        iterations: f64,
    ) -> Option<Prediction> {
        match self {
            Theory::Young => {
                let omega = match solver.name.as_str() {
                    "sor" => solver.omega,
                    "pgs" => 1.0,
                    _ => return None,
                };
                let jacobi = radius_of_column(lcp.matrix())?;
                let value = libm::log(solver.tolerance) / libm::log(sor_radius(jacobi, omega));
                let optimum = optimal_omega(jacobi);
                Some(Prediction { value, optimum: Some(optimum) })
            }
            Theory::MassRatio => {
                let pair = task.text("family") == Some("stack") && lcp.len() == 2;
                let ratio = task.number("ratio").unwrap_or(1.0);
                let value = libm::pow(ratio / (1.0 + ratio), iterations);
                (pair && solver.name == "pgs").then_some(Prediction { value, optimum: None })
            }
        }
    }
}

/// ρ_J = cos(π/2n) of a column; `None` for another matrix.
fn radius_of_column(a: &Matrix) -> Option<f64> {
    let n = a.len();
    let unit = if n > 0 { a.diagonal(0) } else { return None };
    let expected = |i: usize, j: usize| match i.abs_diff(j) {
        0 if i == 0 => 1.0,
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    };
    let fits = |i: usize, j: usize| (a.entry(i, j) / unit - expected(i, j)).abs() <= 1e-9;
    let stored = |i: usize| a.row(i).iter().all(|(j, _)| fits(i, j));
    let is_column = (0..n).all(|i| stored(i) && fits(i, i) && (i == 0 || fits(i, i - 1)));
    is_column.then(|| column_radius(n))
}
