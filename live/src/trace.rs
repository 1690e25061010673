//! The steps of a solver on a problem.

use std::ops::ControlFlow;

use lcplab_judge::{Demand, judge};
use lcplab_lcp::Lcp;
use lcplab_lcp::file::{Problem, number};
use lcplab_lcp::merit::{self, RowTerms};
use lcplab_solver::theory::{principal_submatrix, sor_iteration_matrix};
use lcplab_solver::{
    Damping, Dantzig, Event, Iterate, Jacobi, Lemke, Murty, Observer, Order, Pgs, RowUpdate,
    Settings, Solver, Start, StepDetail,
};
use nalgebra::DMatrix;
use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::Answer;

/// Maximum number of rows; larger problems need the program itself.
const MOST_ROWS: usize = 60;
/// Maximum number of steps that are shown.
const MOST_STEPS: usize = 10_000;

/// The solver, and the problem.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// A problem file.
    problem: Map<String, Value>,
    /// `pgs`, `sor`, `jacobi`, `murty`, `dantzig` or `lemke`.
    solver: String,
    /// ω of `sor`.
    #[serde(default = "one")]
    omega: f64,
    /// The number of sweeps or steps; by default until the problem is solved.
    sweeps: Option<usize>,
    /// Whether sweeps go from the last row to the first.
    #[serde(default)]
    backward: bool,
    /// The start; 0 by default.
    start: Option<Vec<f64>>,
}

fn one() -> f64 {
    1.0
}

impl Question {
    /// The steps, each with x, w, the residual and its event; the status; the judge's verdict.
    pub fn answer(self) -> Answer {
        let text = Value::Object(self.problem).to_string();
        let Problem { lcp, .. } = Problem::parse(&text, "problem").map_err(|e| e.to_string())?;
        let n = lcp.len();
        if n > MOST_ROWS {
            return Err(format!("{n} rows, at most {MOST_ROWS} are shown here"));
        }
        if self.start.as_ref().is_some_and(|x| x.len() != n) {
            return Err(format!("start: the problem has {n} rows"));
        }
        let limit = self.sweeps.unwrap_or(MOST_STEPS).min(MOST_STEPS);
        let tolerance = if self.sweeps.is_some() { 0.0 } else { Settings::default().tolerance };
        let settings = Settings::default().with_tolerance(tolerance).with_max_iterations(limit);
        let solver = solver(&self.solver, self.omega, self.backward, settings)?;
        let mut steps = Steps::of(&lcp, &self.solver, MOST_STEPS + 1);
        let start = self.start.as_deref().map_or(Start::default(), Start::at);
        let solution = solver.solve(&lcp, &start, &mut steps);
        let certificate = judge(&lcp, &solution.x, &Demand::default());
        Ok(json!({
            "steps": steps.steps,
            "x": numbers(&solution.x),
            "w": numbers(&solution.w),
            "status": solution.status.to_string(),
            "verdict": certificate.verdict.to_string(),
            "proved": certificate.verdict.distance().is_some(),
            "rate": rate(&self.solver, self.omega, &lcp, &solution.x),
        }))
    }
}

/// The factor by which a sweep multiplies the error while no row changes sides: the spectral radius
/// of the free rows' iteration matrix G, as (|G^2k| / |G^k|)^(1/k) for k = 2¹² (Gelfand). Without
/// an eigenvalue routine the module is smaller by a quarter.
fn rate(solver: &str, omega: f64, lcp: &Lcp, x: &[f64]) -> Option<f64> {
    let omega = match solver {
        Pgs::NAME => 1.0,
        Pgs::RELAXED => omega,
        _ => return None,
    };
    let is_inside = |&i: &usize| lcp.lo()[i] < x[i] && x[i] < lcp.hi()[i];
    let free: Vec<usize> = (0..lcp.len()).filter(is_inside).collect();
    let mut n = sor_iteration_matrix(&principal_submatrix(lcp.matrix(), &free), omega);
    let (mut log, mut logs) = (0.0, [0.0; 2]);
    for _ in 0..=13 {
        let size = n.norm();
        if size == 0.0 || !size.is_finite() {
            return (size == 0.0).then_some(0.0);
        }
        // G to this power is now e^log N with |N| = 1.
        log += libm::log(size);
        n /= size;
        logs = [logs[1], log];
        n = squared(&n);
        log *= 2.0;
    }
    let rate = libm::exp((logs[1] - logs[0]) / f64::from(1 << 12));
    (rate < 1.0).then_some(rate)
}

/// N N, summed in one order on every machine.
fn squared(n: &DMatrix<f64>) -> DMatrix<f64> {
    let entry = |i, j| (0..n.nrows()).fold(0.0, |sum, k| sum + n[(i, k)] * n[(k, j)]);
    DMatrix::from_fn(n.nrows(), n.ncols(), entry)
}

/// The solver with this name.
pub fn solver(
    name: &str,
    omega: f64,
    backward: bool,
    settings: Settings,
) -> Result<Box<dyn Solver>, String> {
    if !(omega > 0.0 && omega < 2.0) {
        return Err(format!("omega: must be between 0 and 2, is {omega}"));
    }
    let order = if backward { Order::Reverse } else { Order::Natural };
    let sweeping = |omega| Box::new(Pgs { omega, order, settings: settings.clone() });
    Ok(match name {
        Pgs::NAME => sweeping(1.0),
        Pgs::RELAXED => sweeping(omega),
        Jacobi::NAME => Box::new(Jacobi { damping: Damping::default(), settings }),
        Murty::NAME => Box::new(Murty { settings }),
        Dantzig::NAME => Box::new(Dantzig { settings }),
        Lemke::NAME => Box::new(Lemke { settings }),
        name => return Err(format!("solver: {name:?} is not one of these pages")),
    })
}

/// Records the steps of a solver.
pub struct Steps<'a> {
    lcp: &'a Lcp,
    solver: &'a str,
    /// After this number of steps the solver continues, but nothing is recorded.
    most: usize,
    /// The rows of the current sweep.
    rows: Vec<Value>,
    /// x, w, bounds, rows that are not solved yet, residual, event and row updates of each.
    pub steps: Vec<Value>,
}

impl<'a> Steps<'a> {
    pub fn of(lcp: &'a Lcp, solver: &'a str, most: usize) -> Self {
        Steps { lcp, solver, most, rows: Vec::new(), steps: Vec::new() }
    }

    /// Records x and its event.
    pub fn keep(&mut self, x: &[f64], event: String) {
        let rows = std::mem::take(&mut self.rows);
        if self.steps.len() < self.most {
            let n = self.lcp.len();
            let residual = |i| RowTerms::at(self.lcp, i, x).scaled_residual(self.lcp, i, x);
            let is_solved = |i: usize| residual(i) <= Settings::default().tolerance;
            self.steps.push(json!({
                "x": numbers(x),
                "w": numbers(&self.lcp.w(x)),
                "bounds": (0..n).map(|i| { let (lo, hi) = self.lcp.bounds(i, x); numbers(&[lo, hi]) }).collect::<Value>(),
                "open": (0..n).filter(|&i| !is_solved(i)).collect::<Value>(),
                "residual": number(merit::scaled_residual(self.lcp, x)),
                "event": event,
                "rows": rows,
            }));
        }
    }
}

impl Observer for Steps<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.keep(iterate.x, words(iterate.event, self.solver));
        ControlFlow::Continue(())
    }

    fn wants_details(&self) -> bool {
        true
    }

    fn part(&mut self, part: &StepDetail<'_>) {
        if let StepDetail::Row(RowUpdate { row, w, diagonal, before, unclamped, after, .. }) = part
        {
            self.rows.push(json!({
                "row": row, "w": number(*w), "diagonal": number(*diagonal), "before": number(*before),
                "unclamped": number(*unclamped), "after": number(*after),
            }));
        }
    }
}

fn words(event: Event, solver: &str) -> String {
    match event {
        Event::Start => "start".into(),
        Event::Sweep => "a sweep".into(),
        Event::Step => "a step".into(),
        Event::Pivot { driven, blocking } if solver == Lemke::NAME => {
            format!(
                "on the path: the variable of row {driven} enters, that of row {blocking} leaves"
            )
        }
        Event::Pivot { driven, blocking } if driven == blocking => {
            format!("row {driven} reaches w = 0 or its bound")
        }
        Event::Pivot { driven, blocking } => {
            format!("row {driven} is driven, row {blocking} changes sides first")
        }
        Event::Exchange { rows: 1 } => "a row changes sides".into(),
        Event::Exchange { rows } => format!("{rows} rows change sides"),
        Event::Trial => "another set of free rows is tried".into(),
    }
}

/// Numbers as JSON, "inf" and "nan" among them.
pub fn numbers(values: &[f64]) -> Value {
    values.iter().map(|&value| number(value)).collect()
}
