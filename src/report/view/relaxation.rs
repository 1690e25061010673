//! SOR against ω, beside Young's curve.

use super::attempt::{iterations_in_words, section_id};
use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column as Head, Mark, Table};
use crate::report::study::posed::BLOW;
use crate::report::study::relaxation::{Column, Plan, Point};
use crate::solver::theory;
use crate::solver::theory::sor_radius;

/// An eigenvalue is the formula's up to this: at ω* the matrix is defective, and half of the digits go.
const EIGENVALUE: f64 = 1e-5;
/// Digits gained a sweep that differ by this part are the same.
const SAME: f64 = 0.05;
/// The same for the sweeps that theory counts by the rate alone.
const NEAR: f64 = 0.2;

impl View for Plan {
    const TITLE: &'static str = "Which ω, and what it is worth";

    fn show(&self, columns: &[Column], document: &mut Document) {
        document.text(
            "SOR goes ω times as far as Gauss-Seidel in each row. For a column of bodies, whose matrix \
             is consistently ordered, Young's theory knows the contraction for every ω from the one \
             of Jacobi's method:",
        );
        document.equation(
            "\\rho(\\omega) = \\begin{cases} \\tfrac14 \\left(\\omega\\rho_J + \\sqrt{\\omega^2\\rho_J^2 \
             - 4(\\omega - 1)}\\right)^2 & \\omega \\le \\omega^* \\\\ \\omega - 1 & \\omega \\ge \
             \\omega^* \\end{cases} \\qquad \\omega^* = \\frac{2}{1 + \\sqrt{1 - \\rho_J^2}}",
            "Young 1950",
        );
        for column in columns {
            let id = format!("{}_{}", section_id(document), column.bodies);
            document.figure(self.figure(id, column));
        }
        document.table(&section_id(document), self.table(columns));
        for column in columns {
            document.text(words(column));
        }
    }

    fn outcome(&self, columns: &[Column]) -> Outcome {
        let points = || columns.iter().flat_map(|column| &column.points);
        let same = |point: &&Point| (point.eigenvalue - point.closed_form).abs() <= EIGENVALUE;
        let eigenvalues = points().filter(same).count();
        let slopes = points().filter(|point| point.has_the_slope() == Some(true)).count();
        let says = format!(
            "{eigenvalues} of {0} eigenvalues and {slopes} of {0} slopes are Young's",
            points().count()
        );
        Outcome { good: eigenvalues == points().count(), says }
    }
}

impl Point {
    /// Whether the slope of the residuals is Young's.
    fn has_the_slope(&self) -> Option<bool> {
        let digits = self.measured?.ln() / self.closed_form.ln();
        Some((digits - 1.0).abs() <= SAME)
    }
}

impl Plan {
    fn figure(&self, id: String, column: &Column) -> Lines {
        let omegas = || (1..400).map(|k| f64::from(k) / 200.0);
        let rate = |omega| sor_radius(column.jacobi, omega);
        let sweeps = |omega| theory::sweeps_to(self.target / BLOW, rate(omega));
        let of = |of: fn(&Point) -> Option<f64>| {
            column.points.iter().filter_map(|p| Some((p.omega, of(p)?))).collect::<Vec<_>>()
        };
        let counted = of(|point| point.sweeps.map(|sweeps| sweeps as f64));
        let best = format!("ω* = {}", readable(column.best, 5));
        let contraction = vec![
            Series::points("measured", of(|point| point.measured)),
            Series::points("eigenvalue", of(|point| Some(point.eigenvalue))),
            Series::theory("Young's formula", omegas().map(|omega| (omega, rate(omega))).collect()),
            Series::reference(best.clone(), vec![(column.best, 0.0), (column.best, 1.0)]),
        ];
        let sweeps = vec![
            Series::points("measured", counted),
            Series::theory("Young's formula", omegas().map(|o| (o, sweeps(o))).collect()),
            Series::reference(best, vec![(column.best, 1e-3), (column.best, 1e12)]),
        ];
        Lines {
            id,
            title: format!("SOR on a column of {} bodies", column.bodies),
            caption: format!(
                "Above: what a sweep leaves of the error. Below: sweeps from $x = 0$ to a natural \
                 residual of {} m/s. Left of ω\\* the curve falls steeply into the optimum, right of it \
                 it is $\\omega - 1$ whatever the problem: rather a little too large than a little too \
                 small. Where the markers lie below the dashed line, the start has little of the \
                 slowest component; at ω\\* the error falls like $k\\rho^k$, and they lie above.",
                readable(self.target, 1)
            ),
            x: Axis::linear("relaxation factor ω", ""),
            panels: vec![
                Panel { y: Axis::linear("contraction ρ", "a sweep"), series: contraction },
                Panel { y: Axis::log("sweeps", ""), series: sweeps },
            ],
        }
    }

    fn table(&self, columns: &[Column]) -> Table {
        let rows = columns
            .iter()
            .flat_map(|column| column.points.iter().map(|point| cells(column, point)));
        Table {
            title: "SOR by ω: formula, eigenvalue, measurement".into(),
            how_to_read: format!(
                "*formula*: Young's ρ(ω); *eigenvalue*: the spectral radius of the iteration matrix, \
                 computed; *measured*: the slope of the residual's envelope over the last half of the \
                 sweeps. *by the rate*: $\\ln(\\varepsilon/b)/\\ln\\rho$ for {} m/s, beside the sweeps \
                 counted. A slope agrees if the digits gained a sweep are the same to 5 %, a count if it \
                 is the same to 20 %: the rule knows the rate and not the start. At ω\\* two \
                 eigenvalues meet, and above it they are complex: there the residual goes up and down or falls like \
                 $k\\rho^k$, and a slope over a few sweeps is off.",
                readable(self.target, 1)
            ),
            columns: vec![
                Head::numbers("bodies", ""),
                Head::numbers("ω", ""),
                Head::numbers("formula", ""),
                Head::numbers("eigenvalue", ""),
                Head::numbers("measured", ""),
                Head::words("slope"),
                Head::numbers("by the rate", "sweeps"),
                Head::numbers("counted", "sweeps"),
                Head::words("count"),
            ],
            rows: rows.collect(),
            ..Table::default()
        }
    }
}

fn says(agrees: bool) -> Cell {
    match agrees {
        true => Cell::text("agrees").marked(Mark::Good),
        false => Cell::text("differs").marked(Mark::Note),
    }
}

fn cells(column: &Column, point: &Point) -> Vec<Cell> {
    let none = || Cell::text("–");
    let near = |sweeps: usize| says((point.expected / sweeps as f64 - 1.0).abs() <= NEAR);
    let omega = Cell::number(point.omega, 5);
    let is_best = point.omega == column.best;
    vec![
        Cell::count(column.bodies),
        if is_best { Cell { text: format!("{} = ω*", omega.text), ..omega } } else { omega },
        Cell::number(point.closed_form, 5),
        Cell::number(point.eigenvalue, 5),
        point.measured.map_or_else(none, |rate| Cell::number(rate, 5)),
        point.has_the_slope().map_or_else(none, says),
        Cell::count(point.expected.ceil() as usize),
        point.sweeps.map_or(Cell::text("not reached").marked(Mark::Note), Cell::count),
        point.sweeps.map_or_else(none, near),
    ]
}

fn words(column: &Column) -> String {
    let counted = |at: f64| {
        let point = column.points.iter().find(|point| point.omega == at)?;
        point.sweeps.map(|sweeps| (at, sweeps))
    };
    let fastest =
        column.points.iter().filter_map(|p| Some((p.omega, p.sweeps?))).min_by_key(|p| p.1);
    match (counted(1.0), counted(column.best), fastest) {
        (Some((_, plain)), Some((_, best)), Some((omega, least))) => format!(
            "On the column of {} Gauss-Seidel takes {} and SOR with ω\\* = {} takes {best}: {} times \
             fewer. The fewest of the ω tried were {least}, with ω = {}.",
            column.bodies,
            iterations_in_words("pgs", plain),
            readable(column.best, 4),
            readable(plain as f64 / best as f64, 2),
            readable(omega, 4)
        ),
        _ => format!("On the column of {} not all of them got there.", column.bodies),
    }
}
