//! Closed forms for comparison with a grid.

use serde::{Deserialize, Serialize};

use super::plan::Task;
use crate::lcp::{Lcp, Matrix};
use crate::solver::theory::{column_radius, optimal_omega, sor_radius, sweeps_to};
use crate::solver::{Damping, Jacobi, Options, Order, Pgs};

/// A closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Theory {
    /// Young (1950): sweeps on a column of n equal masses, standing on the ground or hanging from
    /// one end:
    ///
    /// ```text
    /// ρ_J = cos(π/2n),   ρ_GS = ρ_J²,   ω* = 2/(1 + √(1 − ρ_J²)),   ρ(ω) = ω − 1 for ω ≥ ω*,
    /// ρ(ω) = ((ω ρ_J + √(ω² ρ_J² − 4(ω − 1)))/2)² below
    /// ```
    ///
    /// It predicts the rate, and from the rate the iterations, ln(tolerance)/ln ρ sweeps: a rule of
    /// thumb, since the start may contain more or less of the slowest error component. If the
    /// column falls onto the ground (b is 0 except in the first row), Gauss-Seidel leaves (2/n) b
    /// ρᵏ in the ground's row, whose terms add up to 2 n b: the scaled residual is ε after ln(ε
    /// n²)/ln ρ sweeps. Applies if A is a multiple of tridiag(−1, 2, −1) with 1 in the first place,
    /// and the solver is SOR, PGS or Jacobi's method without damping.
    Young,
    /// Gauss-Seidel on two bodies, the upper one r times as heavy (the family `stack` with n = 2):
    /// a sweep reduces the error by the factor ρ = r/(1 + r), and the scaled residual after k
    /// sweeps is ρᵏ/(2 (1 + r)).
    MassRatio,
}

/// The prediction of a closed form for a measure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Predicted {
    /// The measure.
    pub measure: String,
    /// Its value.
    pub value: f64,
    /// The allowed difference of the measured value; `None` for a rule of thumb, which is not a
    /// claim.
    pub slack: Option<f64>,
}

/// The predictions of a closed form for a point.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Prediction {
    /// By measure.
    pub values: Vec<Predicted>,
    /// The position of the minimum rate along the first axis, if it is known.
    pub optimum: Option<f64>,
}

/// The accuracy of eigenvalues: where two of them coincide, at ω*, only the square root of the
/// precision.
const EIGENVALUE: f64 = 1e-5;
/// The counted sweeps and those of the slowest error component differ by at most this fraction plus
/// one sweep.
const SWEEPS: f64 = 0.05;
/// The rounding error of an error of size 1.
const ROUNDING: f64 = 1e-12;
/// The scaled residual below which the solver claims a solution for two bodies; above it, it
/// withdraws the claim.
const SMALL: f64 = 0.05;

impl Theory {
    /// All closed forms.
    pub const ALL: [Theory; 2] = [Theory::Young, Theory::MassRatio];

    /// Its name in grid files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Theory::Young => "young",
            Theory::MassRatio => "mass-ratio",
        }
    }

    /// The closed form with this name.
    pub(crate) fn by_name(name: &str) -> Option<Self> {
        Theory::ALL.into_iter().find(|theory| theory.name() == name)
    }

    /// The predictions for a task's problem, solved by this solver in this number of iterations;
    /// `None` if it does not apply.
    pub(super) fn predict(
        self,
        task: &Task,
        lcp: &Lcp,
        solver: &str,
        options: &Options,
        iterations: f64,
    ) -> Prediction {
        let predicted = match self {
            Theory::Young => young(lcp, solver, options),
            Theory::MassRatio => mass_ratio(task, lcp, solver, options, iterations),
        };
        predicted.unwrap_or_default()
    }
}

fn young(lcp: &Lcp, solver: &str, options: &Options) -> Option<Prediction> {
    let jacobi = radius_of_column(lcp.matrix())?;
    let (rate, optimum) = match (solver, options.damping) {
        (Pgs::RELAXED, _) => (sor_radius(jacobi, options.omega), Some(optimal_omega(jacobi))),
        (Pgs::NAME, _) => (jacobi * jacobi, None),
        (Jacobi::NAME, Damping::Factor(1.0)) => (jacobi, None),
        _ => return None,
    };
    let tolerance = options.settings.tolerance;
    let squared = (lcp.len() * lcp.len()) as f64;
    let falls = lcp.b().iter().skip(1).all(|b| *b == 0.0);
    let is_plain = solver == Pgs::NAME && options.order == Order::Natural;
    let sweeps = match falls && is_plain && tolerance * squared < 1.0 {
        true => claimed_sweeps(sweeps_to(tolerance * squared, rate)),
        false => Predicted::thumb("iterations", sweeps_to(tolerance, rate)),
    };
    Some(Prediction { values: rates(rate).into_iter().chain([sweeps]).collect(), optimum })
}

fn mass_ratio(
    task: &Task,
    lcp: &Lcp,
    solver: &str,
    options: &Options,
    iterations: f64,
) -> Option<Prediction> {
    let is_pair = task.text("family") == Some("stack") && lcp.len() == 2 && solver == Pgs::NAME;
    let ratio = is_pair.then(|| task.number("ratio").unwrap_or(1.0))?;
    let rate = ratio / (1.0 + ratio);
    let error = libm::pow(rate, iterations);
    let mut values = rates(rate).to_vec();
    values.push(Predicted::within("error", error, ROUNDING));
    let left = 2.0 * (1.0 + ratio) * options.settings.tolerance;
    if 0.0 < left && left < SMALL {
        values.push(claimed_sweeps(sweeps_to(left, rate)));
    }
    Some(Prediction { values, optimum: None })
}

/// A rate, measured and as an eigenvalue; the rate measured over a few sweeps is not a claim.
fn rates(rate: f64) -> [Predicted; 2] {
    [Predicted::thumb("rate", rate), Predicted::within("eigenvalue", rate, EIGENVALUE)]
}

fn claimed_sweeps(sweeps: f64) -> Predicted {
    let whole = sweeps.ceil();
    Predicted::within("iterations", whole, f64::max(1.0, SWEEPS * whole))
}

impl Predicted {
    fn within(measure: &str, value: f64, slack: f64) -> Self {
        Predicted { measure: measure.into(), value, slack: Some(slack) }
    }

    fn thumb(measure: &str, value: f64) -> Self {
        Predicted { measure: measure.into(), value, slack: None }
    }

    /// Whether the measured value agrees with the claim; `None` if there is no claim.
    pub fn holds(&self, measured: f64) -> Option<bool> {
        self.slack.map(|slack| (measured - self.value).abs() <= slack)
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
