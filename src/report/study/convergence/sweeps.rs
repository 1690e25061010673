//! The residual after each sweep of PGS and SOR, compared with the rate that theory predicts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::lcp::Lcp;
use crate::report::study::settings::{AtStep, Given, first};
use crate::solver::{Dantzig, Options, Order, Pgs, Settings, Solver, Start, theory};
use crate::trace::Convergence;

/// An LCP with relaxation factors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepCase {
    /// A shipped scene, or the file of a scene or a problem; `problem` is an alias of this key.
    #[serde(alias = "problem")]
    pub scene: String,
    /// The number of the step, from 1; not used for a problem file.
    #[serde(default = "first")]
    pub step: usize,
    /// The relaxation factors ω; the optimal one is added if theory knows it.
    pub omegas: Vec<f64>,
}

impl SweepCase {
    /// Runs PGS and SOR on the problem.
    ///
    /// # Errors
    /// If the scene, step or file does not exist.
    pub(crate) fn run(&self) -> Result<Rates> {
        let at = AtStep { scene: self.scene.clone(), step: self.step };
        Ok(rates(at.given()?, &self.omegas))
    }
}

/// An LCP with several relaxation factors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rates {
    /// The scene or the file.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// The number of rows of the LCP.
    pub rows: usize,
    /// Whether all rows are equations, so that the rates are exact predictions from the start.
    pub equations_only: bool,
    /// The relaxation factor that is optimal for consistently ordered A, if the theory applies.
    pub optimal_omega: Option<f64>,
    /// One curve per relaxation factor.
    pub curves: Vec<Curve>,
    /// The number of pivots of Dantzig's method on the same problem.
    pub pivots: usize,
}

/// The iterates with one relaxation factor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// ω.
    pub omega: f64,
    /// How many sweeps were recorded.
    pub sweeps: usize,
    /// Sweeps, the start being 0, and the natural residual after each: at most 200 of them.
    pub residuals: Vec<(usize, f64)>,
    /// The largest modulus below 1 of an eigenvalue of the iteration matrix, on the rows that are
    /// free at the limit of the sweeps.
    pub predicted_rate: Option<f64>,
    /// The factor per sweep, measured over the last half of the curve.
    pub measured_rate: Option<f64>,
}

/// Most points of a curve that are kept, evenly spaced, and the last one.
const POINTS: usize = 200;
/// The maximum number of sweeps of a curve.
const SWEEPS: usize = 1000;
/// Residuals below this fraction of the first are rounding, not convergence.
const FLOOR: f64 = 1e-12;

fn rates(Given { name, title, lcp }: Given, omegas: &[f64]) -> Rates {
    let direct = Dantzig { settings: Settings::default().with_tolerance(1e-12) };
    let pivots = direct.solve(&lcp, &Start::default(), &mut ()).iterations;
    let unbounded = |i: usize| lcp.lo()[i].is_infinite() && lcp.hi()[i].is_infinite();
    let equations_only = lcp.coupling().is_none() && (0..lcp.len()).all(unbounded);
    let jacobi = theory::spectral_radius(&theory::jacobi_iteration_matrix(lcp.matrix(), 1.0));
    let optimal_omega = (equations_only && jacobi < 1.0).then(|| theory::optimal_omega(jacobi));
    let mut omegas = omegas.to_vec();
    omegas.extend(optimal_omega.map(|omega| (omega * 1e4).round() / 1e4));
    omegas.sort_by(f64::total_cmp);
    omegas.dedup();
    let curves = omegas.iter().map(|&omega| curve(&lcp, omega)).collect();
    let rows = lcp.len();
    Rates { scene: name, title, rows, equations_only, optimal_omega, curves, pivots }
}

fn curve(lcp: &Lcp, omega: f64) -> Curve {
    let settings = Settings::default()
        .with_tolerance(0.0)
        .with_max_iterations(SWEEPS)
        .with_check_every(SWEEPS);
    let mut trace = Convergence::of(lcp);
    trace.floor = FLOOR;
    let x = Pgs { omega, order: Order::default(), settings }
        .solve(lcp, &Start::default(), &mut trace)
        .x;
    let options = Options::default().with_omega(omega);
    let records = &trace.records;
    let every = records.len().div_ceil(POINTS - 1).max(1);
    let is_kept = |k: usize| k.is_multiple_of(every) || k + 1 == records.len();
    let kept = records.iter().enumerate().filter(|(k, _)| is_kept(*k));
    Curve {
        omega,
        measured_rate: trace.rate(),
        sweeps: records.len().saturating_sub(1),
        residuals: kept.map(|(_, record)| (record.iteration, record.natural_residual)).collect(),
        predicted_rate: theory::rate(Pgs::RELAXED, &options, lcp, &theory::rows_inside(lcp, &x)),
    }
}
