//! Cost against size.

use super::attempt::{outcome, tolerance};
use super::{Document, Outcome, View};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column as Head, Mark, Table};
use crate::report::study::attempt::Attempt;
use crate::report::study::scaling::{Column, Plan, Seconds};

/// Predicted and counted sweeps of Gauss-Seidel that differ by this part are the same.
const SAME: f64 = 0.05;

impl View for Plan {
    const TITLE: &'static str = "Twice the bodies, how many times the cost";

    fn show(&self, columns: &[Column], document: &mut Document) {
        document.text(
            "The same column, taller and taller. The slowest component of the error is a quarter of a \
             cosine over the whole column, and Gauss-Seidel leaves $\\cos^2(\\pi/2n)$ of it; with the \
             share it has in the start, the scaled residual is $\\varepsilon$ after",
        );
        document.equation(
            "k = \\frac{\\ln(\\varepsilon n^2)}{\\ln\\cos^2(\\pi/2n)} \\approx \\frac{4 n^2}{\\pi^2} \
             \\ln\\frac{1}{\\varepsilon n^2} \\qquad\\qquad k_{\\omega^*} \\approx \\frac{n}{\\pi} \
             \\ln\\frac{1}{\\varepsilon}",
            "sweeps",
        );
        document.figure(self.iterations(columns));
        document.figure(self.work(columns));
        document.table("scaling_theory", gauss_seidel(columns));
        document.table("scaling", self.table(columns));
    }

    fn outcome(&self, columns: &[Column]) -> Outcome {
        let pgs = columns.iter().filter_map(|column| Some((column, of(column, "pgs")?)));
        let agrees: Vec<bool> = pgs.map(|(column, attempt)| column.agrees(attempt)).collect();
        let agree = agrees.iter().filter(|agrees| **agrees).count();
        let says =
            format!("{agree} of {} columns take pgs as many sweeps as predicted", agrees.len());
        Outcome { good: agree == agrees.len(), says }
    }

    fn show_times(&self, times: &[Seconds], document: &mut Document) {
        let curve = |solver: &String| {
            let point = |column: &Seconds| {
                let (_, time) = column.solvers.iter().find(|(name, _)| name == solver)?;
                Some((column.bodies as f64, 1e3 * (*time)?))
            };
            Series::measured(solver.clone(), times.iter().filter_map(point).collect())
        };
        document.figure(Lines {
            id: "scaling_seconds".into(),
            title: format!("Time to a scaled residual of {}", tolerance(self.tolerance)),
            caption: "The same solves by the clock, on a machine that does other things too."
                .into(),
            x: Axis::log("bodies n", ""),
            panels: vec![Panel {
                y: Axis::log("time", "ms"),
                series: self.solvers.iter().map(curve).collect(),
            }],
        });
    }
}

impl Column {
    /// Whether Gauss-Seidel took as many sweeps as the formula says.
    fn agrees(&self, counted: &Attempt) -> bool {
        let part = self.gauss_seidel.ceil() / counted.iterations as f64 - 1.0;
        counted.outcome.is_solved() && part.abs() <= SAME
    }
}

/// What a solver made of a column.
fn of<'a>(column: &'a Column, solver: &str) -> Option<&'a Attempt> {
    column.attempts.iter().find(|attempt| attempt.solver == solver)
}

/// The points (n, cost) of a solver where it solved the column.
fn points(columns: &[Column], solver: &str, cost: fn(&Attempt) -> f64) -> Vec<(f64, f64)> {
    let point = |column: &Column| {
        let attempt = of(column, solver).filter(|attempt| attempt.outcome.is_solved())?;
        Some((column.bodies as f64, cost(attempt))).filter(|(_, cost)| cost.is_finite())
    };
    columns.iter().filter_map(point).collect()
}

/// The exponent of n over the last doubling or so.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let [.., (n0, y0), (n1, y1)] = points else { return None };
    Some((y1 / y0).ln() / (n1 / n0).ln()).filter(|slope| slope.is_finite())
}

impl Plan {
    fn curves(&self, columns: &[Column], cost: fn(&Attempt) -> f64) -> Vec<Series> {
        let curve = |solver: &String| Series::measured(solver, points(columns, solver, cost));
        self.solvers.iter().map(curve).collect()
    }

    fn iterations(&self, columns: &[Column]) -> Lines {
        let mut series = self.curves(columns, |attempt| attempt.iterations as f64);
        let theory = |of: fn(&Column) -> f64| {
            columns.iter().map(|column| (column.bodies as f64, of(column))).collect::<Vec<_>>()
        };
        series.push(Series::theory("Gauss-Seidel: ~ n²", theory(|column| column.gauss_seidel)));
        series.push(Series::theory("SOR, ω*: ~ n", theory(|column| column.best_sor)));
        Lines {
            id: "scaling_iterations".into(),
            title: format!("Iterations to a scaled residual of {}", tolerance(self.tolerance)),
            caption: "Sweeps of Gauss-Seidel lie on the steeper dashed line: nearly four times as many \
                      for twice the bodies. SOR with the best ω follows the other one, as most methods with memory \
                      do; the table has the exponents. A flat line is no free lunch: its iterations are dearer the larger \
                      the column, see the next figure. Curves that coincide hide each other; the table \
                      has them all."
                .into(),
            x: Axis::log("bodies n", ""),
            panels: vec![Panel { y: Axis::log("iterations", ""), series }],
        }
    }

    fn work(&self, columns: &[Column]) -> Lines {
        let mut series = self.curves(columns, |attempt| attempt.work);
        // The matrix of a column is tridiagonal: a sweep is 4 n multiplications.
        let sweeps = columns
            .iter()
            .map(|column| (column.bodies as f64, 4.0 * column.bodies as f64 * column.gauss_seidel));
        series.push(Series::theory("Gauss-Seidel: ~ n³", sweeps.collect()));
        Lines {
            id: "scaling_work".into(),
            title: format!("Multiplications to a scaled residual of {}", tolerance(self.tolerance)),
            caption: "The same solves. A is tridiagonal, so a sweep costs 4 n multiplications and \
                      Gauss-Seidel grows as fast as a dense factorisation, with n³. SOR grows with n² \
                      only, but with an ω that nobody knows for a scene of another kind. Direct methods \
                      are counted as dense: that A is sparse helps none but sweeps and first-order \
                      methods here."
                .into(),
            x: Axis::log("bodies n", ""),
            panels: vec![Panel { y: Axis::log("multiplications", ""), series }],
        }
    }

    fn table(&self, columns: &[Column]) -> Table {
        let row = |solver: &String| {
            let counts = columns.iter().map(|column| match of(column, solver) {
                Some(attempt) if attempt.outcome.is_solved() => Cell::count(attempt.iterations),
                Some(attempt) => outcome(&attempt.outcome),
                None => Cell::text("–"),
            });
            let slopes = [
                slope(&points(columns, solver, |attempt| attempt.iterations as f64)),
                slope(&points(columns, solver, |attempt| attempt.work)),
            ];
            let slopes = slopes.map(|s| s.map_or(Cell::text("–"), |s| Cell::number(s, 2)));
            [Cell::text(solver)].into_iter().chain(counts).chain(slopes).collect()
        };
        let heads =
            columns.iter().map(|column| Head::numbers(format!("n = {}", column.bodies), ""));
        let slopes = ["iterations ~ n^", "multiplications ~ n^"].map(|t| Head::numbers(t, ""));
        Table {
            title: "Iterations by size, and how they grow".into(),
            how_to_read: "Iterations for a column of n bodies, or why there was no answer. The last two \
                          columns are the exponents over the last two sizes: 1 means that twice the \
                          bodies cost twice as much, 2 four times."
                .into(),
            columns: [Head::words("solver")].into_iter().chain(heads).chain(slopes).collect(),
            rows: self.solvers.iter().map(row).collect(),
            ..Table::default()
        }
    }
}

/// Sweeps of Gauss-Seidel, by the formula and counted.
fn gauss_seidel(columns: &[Column]) -> Table {
    let row = |column: &Column| {
        let counted = of(column, "pgs").filter(|attempt| attempt.outcome.is_solved());
        let agrees = |counted: &Attempt| match column.agrees(counted) {
            true => Cell::text("agrees").marked(Mark::Good),
            false => Cell::text("differs").marked(Mark::Note),
        };
        vec![
            Cell::count(column.bodies),
            Cell::count(column.gauss_seidel.ceil() as usize),
            counted.map_or(Cell::text("–"), |attempt| Cell::count(attempt.iterations)),
            counted.map_or(Cell::text("–"), agrees),
        ]
    };
    Table {
        title: "Sweeps of Gauss-Seidel by size, predicted and counted".into(),
        how_to_read: "*predicted* by the formula above; they agree if they are the same to 5 %."
            .into(),
        columns: vec![
            Head::numbers("bodies", ""),
            Head::numbers("predicted", "sweeps"),
            Head::numbers("counted", "sweeps"),
            Head::words("agreement"),
        ],
        rows: columns.iter().map(row).collect(),
        ..Table::default()
    }
}
