//! Rates that are known in closed form, beside eigenvalues and beside sweeps that were counted.
//!
//! A frictionless column of equal bodies on the ground falls for one step: A = tridiag(−1, 2, −1)
//! with a_11 = 1, b = −g dt e_1. Jacobi's eigenvectors are cos((j − 1)π/2n), so
//!
//! ```text
//! ρ_J = cos(π/2n),   ρ_GS = ρ_J²,   ω* = 2 / (1 + sin(π/2n)),   ρ(ω*) = ω* − 1
//! ```
//!
//! and the share of the slowest eigenvector in the start, x = 0, leaves a natural residual of
//! (2/n) g dt ρ_GS^k after k sweeps. Two bodies, the upper one r times as heavy: ρ_GS = r/(1 + r), and
//! the residual is g dt ρ_GS^k exactly, the error of both rows ρ_GS^k of the solution.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::error::Result;
use crate::lcp::{Lcp, library, merit};
use crate::solver::{
    Damping, Iterate, Jacobi, Observer, Order, Pgs, Settings, Solver, Start, theory,
};

/// g dt (m/s): the speed that the bodies gain in a step of 1/60 s.
pub const BLOW: f64 = 9.81 / 60.0;
/// The natural residual (m/s) that sweeps are counted to.
pub const TARGET: f64 = 1e-8;
/// The natural residual at which a rate is no longer measured: rounding is near.
const FLOOR: f64 = 1e-11;
/// More sweeps are not made.
const MAX_SWEEPS: usize = 1_000_000;
/// After how many sweeps the error is written down: 1, 2, 5, 10, …
const LOOKS: [usize; 3] = [1, 2, 5];

/// Columns of bodies on the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Columns of so many equal bodies.
    pub bodies: Vec<usize>,
    /// Two bodies, the upper one so many times as heavy.
    pub ratios: Vec<f64>,
}

impl Study for Plan {
    const NAME: &'static str = "rates";
    type Finding = System;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let columns = self.bodies.iter().map(|n| format!("column of {n}"));
        columns.chain(self.ratios.iter().map(|r| format!("ratio {r}"))).collect()
    }

    fn run(&self, task: usize) -> Result<(System, ())> {
        let system = match self.bodies.get(task) {
            Some(&bodies) => column(bodies)?,
            None => pair(self.ratios[task - self.bodies.len()])?,
        };
        Ok((system, ()))
    }
}

/// A column of bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct System {
    /// How many bodies.
    pub bodies: usize,
    /// Mass of the top body, in masses of the others.
    pub ratio: f64,
    /// The contractions by a sweep of Jacobi's method, Gauss-Seidel and SOR with ω*, or those of
    /// them that have a closed form.
    pub rates: Vec<Rate>,
    /// Sweeps of Gauss-Seidel.
    pub sweeps: Sweeps,
    /// For two bodies: sweeps done, and the error left in parts of the solution, the worst row.
    pub errors: Vec<(usize, f64)>,
}

/// The factor by which a sweep shrinks the error, three times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// The method.
    pub method: Method,
    /// From the formula.
    pub closed_form: f64,
    /// The spectral radius of the iteration matrix.
    pub eigenvalue: f64,
    /// From the residuals of the last half of the sweeps; `None` if there are too few.
    pub measured: Option<f64>,
}

/// A splitting method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Method {
    /// Jacobi's, without damping.
    Jacobi,
    /// Gauss-Seidel.
    GaussSeidel,
    /// SOR with this ω, the best one.
    BestSor {
        /// ω*.
        omega: f64,
    },
}

/// Sweeps of Gauss-Seidel from x = 0 to a natural residual of [`TARGET`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sweeps {
    /// ln(target/b) / ln ρ: by the rate alone.
    pub by_rate: f64,
    /// The same with the share of the slowest eigenvector in the start.
    pub predicted: f64,
    /// Counted; `None` if they never got there.
    pub measured: Option<usize>,
}

/// Predicted and counted sweeps agree up to this part.
const SWEEPS_AGREE: f64 = 0.01;

impl Sweeps {
    /// Whether as many sweeps were needed as predicted.
    pub fn agree(&self) -> bool {
        self.measured
            .is_some_and(|m| (self.predicted.ceil() / m as f64 - 1.0).abs() <= SWEEPS_AGREE)
    }
}

fn column(n: usize) -> Result<System> {
    let lcp = falling(n, 1.0)?;
    let angle = PI / (2 * n) as f64;
    let (jacobi, omega) = (angle.cos(), 2.0 / (1.0 + angle.sin()));
    let gauss_seidel = jacobi * jacobi;
    let sweeps = residuals(&lcp, Method::GaussSeidel);
    let rates = [
        (Method::Jacobi, jacobi, &residuals(&lcp, Method::Jacobi)),
        (Method::GaussSeidel, gauss_seidel, &sweeps),
        (Method::BestSor { omega }, omega - 1.0, &residuals(&lcp, Method::BestSor { omega })),
    ];
    Ok(System {
        bodies: n,
        ratio: 1.0,
        rates: rates.map(|(method, rate, seen)| rate_of(&lcp, method, rate, seen)).to_vec(),
        sweeps: counted(gauss_seidel, 2.0 * BLOW / n as f64, &sweeps),
        errors: Vec::new(),
    })
}

fn pair(ratio: f64) -> Result<System> {
    let lcp = falling(2, ratio)?;
    let rate = ratio / (1.0 + ratio);
    let exact = [BLOW * (1.0 + ratio), BLOW * ratio]; // each contact carries what is above it
    let mut watch = Watch { lcp: &lcp, exact: Some(exact), residuals: Vec::new(), errors: vec![] };
    solver(Method::GaussSeidel).solve(&lcp, &Start::default(), &mut watch);
    Ok(System {
        bodies: 2,
        ratio,
        rates: vec![rate_of(&lcp, Method::GaussSeidel, rate, &watch.residuals)],
        sweeps: counted(rate, BLOW, &watch.residuals),
        errors: watch.errors,
    })
}

/// The library's stack after a step of free fall.
fn falling(bodies: usize, ratio: f64) -> Result<Lcp> {
    let given = [("n", bodies as f64), ("ratio", ratio)];
    let lcp = library::by_name("stack")?.generate(&given)?.lcp;
    let b = lcp.b().iter().map(|b| b * BLOW).collect();
    lcp.with_b(b)
}

fn solver(method: Method) -> Box<dyn Solver> {
    let settings = Settings {
        tolerance: 0.0,
        max_iterations: MAX_SWEEPS,
        check_every: MAX_SWEEPS,
        ..Settings::default()
    };
    let relaxed = |omega| Pgs { omega, order: Order::Natural, settings: settings.clone() };
    match method {
        Method::Jacobi => Box::new(Jacobi { damping: Damping::Factor(1.0), settings }),
        Method::GaussSeidel => Box::new(relaxed(1.0)),
        Method::BestSor { omega } => Box::new(relaxed(omega)),
    }
}

/// Writes down natural residuals, and errors now and then, until the residuals are rounding.
struct Watch<'a> {
    lcp: &'a Lcp,
    exact: Option<[f64; 2]>,
    residuals: Vec<f64>,
    errors: Vec<(usize, f64)>,
}

impl Observer for Watch<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let Iterate { iteration: k, x, .. } = *iterate;
        let residual = merit::natural_residual(self.lcp, x);
        self.residuals.push(residual);
        let decade = 10usize.pow(k.max(1).ilog10());
        let looked_at = LOOKS.iter().any(|look| look * decade == k);
        if let Some(exact) = self.exact.filter(|_| looked_at) {
            let parts = exact.iter().zip(x).map(|(exact, x)| (x - exact).abs() / exact);
            self.errors.push((k, parts.fold(0.0, f64::max)));
        }
        if residual > FLOOR { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

/// The natural residuals of the start and of each sweep.
fn residuals(lcp: &Lcp, method: Method) -> Vec<f64> {
    let mut watch = Watch { lcp, exact: None, residuals: Vec::new(), errors: Vec::new() };
    solver(method).solve(lcp, &Start::default(), &mut watch);
    watch.residuals
}

fn rate_of(lcp: &Lcp, method: Method, closed_form: f64, residuals: &[f64]) -> Rate {
    let matrix = match method {
        Method::Jacobi => theory::jacobi_iteration_matrix(lcp.matrix(), 1.0),
        Method::GaussSeidel => theory::sor_iteration_matrix(lcp.matrix(), 1.0),
        Method::BestSor { omega } => theory::sor_iteration_matrix(lcp.matrix(), omega),
    };
    let eigenvalue = theory::spectral_radius(&matrix);
    Rate { method, closed_form, eigenvalue, measured: slope(residuals) }
}

/// The factor a sweep over the last half of the residuals above the floor. Over an even number of
/// sweeps: Jacobi's eigenvalues come in pairs ±ρ, so its residuals go down two steps at a time.
fn slope(residuals: &[f64]) -> Option<f64> {
    let last = residuals.iter().rposition(|r| *r > FLOOR).filter(|last| *last >= 10)?;
    let sweeps = last / 4 * 2;
    Some((residuals[last] / residuals[last - sweeps]).powf(1.0 / sweeps as f64))
}

/// The residual after k sweeps is predicted as `share` ρ^k.
fn counted(rate: f64, share: f64, residuals: &[f64]) -> Sweeps {
    Sweeps {
        by_rate: theory::sweeps_to(TARGET / BLOW, rate),
        predicted: theory::sweeps_to(TARGET / share, rate),
        measured: residuals.iter().position(|r| *r <= TARGET),
    }
}
