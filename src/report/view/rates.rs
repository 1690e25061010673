//! Rates in closed form beside eigenvalues and counted sweeps.

use super::{Document, Outcome, View};
use crate::number::{count, readable};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::rates::{BLOW, Method, Plan, Rate, System, TARGET};

/// An eigenvalue agrees with a closed form if the digits gained a sweep differ by this part at most.
const EIGENVALUE_AGREES: f64 = 1e-4;
/// The same for a measured rate, and for numbers of sweeps.
const MEASURED_AGREES: f64 = 0.01;
/// Where the rate alone does not predict the sweeps to this part, the cell is marked.
const RULE_AGREES: f64 = 0.1;

impl View for Plan {
    const TITLE: &'static str = "Rates that can be worked out by hand";

    fn show(&self, findings: &[System], document: &mut Document) {
        document.text(
            "Put $n$ equal bodies on each other, without friction, and let them fall for one step. Only \
             the lowest contact closes at once; the others learn of it row by row. In units of one mass \
             the matrix has 2 on the diagonal (1 in the first row, which belongs to the ground) and −1 \
             beside it. Its eigenvectors are cosines, so the rate of every splitting method is known:",
        );
        document.equation(
            "\\rho_J = \\cos\\frac{\\pi}{2n}, \\quad \\rho_{GS} = \\rho_J^2, \\quad \
             \\omega^* = \\frac{2}{1 + \\sin(\\pi/2n)}, \\quad \\rho(\\omega^*) = \\omega^* - 1",
            "Young 1950",
        );
        document.text(
            "For a tall column $1 - \\rho_{GS} \\approx (\\pi/2n)^2$: twice as many bodies, four times as \
             many sweeps. Two bodies are enough to make it as bad as one likes, if the upper one is $r$ \
             times as heavy as the lower one. Gauss-Seidel on the two rows is $x_1 \\leftarrow v + x_2$, \
             $x_2 \\leftarrow x_1 r / (1 + r)$ with $v = g\\,dt$; so, of the error, a sweep leaves",
        );
        document.equation("\\rho_{GS} = \\frac{r}{1 + r}", "two bodies");
        document.table("rates_contraction", contraction(findings));
        document.text(
            "How many sweeps is that? The *rule of thumb* is $\\ln\\varepsilon / \\ln\\rho$ for a \
             reduction by $\\varepsilon$. It assumes that all of the error is of the slowest kind. At \
             the start, $x = 0$, only a part of it is. Projecting the start on the slowest eigenvector \
             leaves, after $k$ sweeps, a natural residual $\\max_i |x_i - \\Pi(x_i - w_i)|$ of",
        );
        document.equation(
            "\\frac{2}{n}\\, v\\, \\rho_{GS}^k \\;\\; \\text{(column of n)}, \\qquad \
             v\\, \\rho_{GS}^k \\;\\; \\text{(two bodies, exactly)}",
            "residual",
        );
        document.text(format!(
            "which is to fall from $v = 9.81/60$ m/s to {} m/s.",
            readable(TARGET, 1)
        ));
        document.table("rates_sweeps", sweeps(findings));
        let pairs: Vec<&System> = findings.iter().filter(|s| !s.errors.is_empty()).collect();
        if !pairs.is_empty() {
            document.figure(figure(&pairs));
            document.text(
                "An engine that stops after a fixed number of sweeps, 4 or 10 say, has done next to \
                 nothing about a ratio of 100: it goes on with 96 % and 91 % of the error. Heavy bodies \
                 that sink into light ones need no further cause, though they may have one.",
            );
        }
    }

    fn outcome(&self, findings: &[System]) -> Outcome {
        let agree = findings.iter().filter(|system| system.sweeps.agree()).count();
        let all = findings.len();
        let says = format!("{agree} of {all} columns take as many sweeps as predicted");
        Outcome { good: agree == all, says }
    }
}

fn name(system: &System) -> String {
    if system.errors.is_empty() {
        format!("column of {}", system.bodies)
    } else {
        format!("two bodies, r = {}", readable(system.ratio, 3))
    }
}

/// Whether two rates gain the same digits a sweep, to this part.
fn same_digits(rate: f64, expected: f64, part: f64) -> bool {
    (rate.ln() / expected.ln() - 1.0).abs() <= part
}

fn contraction(systems: &[System]) -> Table {
    let rows = systems.iter().flat_map(|s| s.rates.iter().map(|rate| rate_cells(s, rate)));
    Table {
        title: "What a sweep leaves of the error".into(),
        how_to_read: "*closed form*: the formulas above. *eigenvalue*: the largest modulus of an \
                      eigenvalue of the iteration matrix, computed. *measured*: the slope of the \
                      residual over the last half of the sweeps down to 10⁻¹¹ m/s. Rows agree if the \
                      digits gained a sweep, $-\\log_{10} \\rho$, are the same to 10⁻⁴ for the \
                      eigenvalues and 1 % for the slope. They do not at $\\omega^*$, and cannot: \
                      there two eigenvalues meet in one eigenvector, the error falls like \
                      $k \\rho^k$, and the slope is late."
            .into(),
        columns: vec![
            Column::words("bodies"),
            Column::words("method"),
            Column::numbers("ω", ""),
            Column::numbers("closed form", ""),
            Column::numbers("eigenvalue", ""),
            Column::numbers("measured", ""),
            Column::words("eigenvalue agrees?"),
            Column::words("slope agrees?"),
        ],
        rows: rows.collect(),
        ..Table::default()
    }
}

fn rate_cells(system: &System, rate: &Rate) -> Vec<Cell> {
    let (method, omega) = match rate.method {
        Method::Jacobi => ("Jacobi", Cell::text("–")),
        Method::GaussSeidel => ("Gauss-Seidel", Cell::number(1.0, 1)),
        Method::BestSor { omega } => ("SOR, ω*", Cell::number(omega, 7)),
    };
    let says = |agrees| match agrees {
        true => Cell::text("agrees").marked(Mark::Good),
        false => Cell::text("differs").marked(Mark::Bad),
    };
    let is_late = rate.measured.is_some_and(|measured| measured > rate.closed_form);
    let late = |slope: bool| !slope && is_late && matches!(rate.method, Method::BestSor { .. });
    let eigenvalue = same_digits(rate.eigenvalue, rate.closed_form, EIGENVALUE_AGREES);
    let slope = rate.measured.map(|m| same_digits(m, rate.closed_form, MEASURED_AGREES));
    vec![
        Cell::text(name(system)),
        Cell::text(method),
        omega,
        Cell::number(rate.closed_form, 7),
        Cell::number(rate.eigenvalue, 7),
        rate.measured.map_or(Cell::text("–"), |m| Cell::number(m, 7)),
        says(eigenvalue),
        match slope {
            None => Cell::text("–"),
            Some(slope) if late(slope) => Cell::text("late, as it must"),
            Some(slope) => says(slope),
        },
    ]
}

fn sweeps(systems: &[System]) -> Table {
    Table {
        title: "Sweeps of Gauss-Seidel to a natural residual of 10⁻⁸ m/s".into(),
        how_to_read: "*rule of thumb*: by the rate alone, marked where it is off by more than 10 %. \
                      *predicted*: with the share of the slowest eigenvector, the first whole number \
                      of sweeps. *agreement*: predicted and counted are the same to 1 %. The \
                      natural residual is in m/s: to a *scaled* residual of 10⁻⁸ the same problem takes other \
                      numbers of sweeps."
            .into(),
        columns: vec![
            Column::words("bodies"),
            Column::numbers("ρ", ""),
            Column::numbers("rule of thumb", ""),
            Column::numbers("predicted", ""),
            Column::numbers("counted", ""),
            Column::words("agreement"),
        ],
        rows: systems.iter().map(sweep_cells).collect(),
        ..Table::default()
    }
}

fn sweep_cells(system: &System) -> Vec<Cell> {
    let found = &system.sweeps;
    let whole = |sweeps: f64| Cell::count(sweeps.ceil() as usize);
    let off = |sweeps: f64| found.measured.map(|m| (sweeps.ceil() / m as f64 - 1.0).abs());
    let thumb = match off(found.by_rate) {
        Some(off) if off <= RULE_AGREES => Mark::Plain,
        _ => Mark::Note,
    };
    let agreement = match found.measured {
        Some(_) if found.agree() => Cell::text("agrees").marked(Mark::Good),
        Some(_) => Cell::text("differs").marked(Mark::Note),
        None => Cell::text("not reached").marked(Mark::Note),
    };
    let gauss_seidel = system.rates.iter().find(|rate| rate.method == Method::GaussSeidel);
    vec![
        Cell::text(name(system)),
        gauss_seidel.map_or(Cell::text("–"), |rate| Cell::number(rate.closed_form, 7)),
        whole(found.by_rate).marked(thumb),
        whole(found.predicted),
        found.measured.map_or(Cell::text("–"), Cell::count),
        agreement,
    ]
}

/// The error left by two bodies after k sweeps.
fn figure(pairs: &[&System]) -> Lines {
    let ratio = |system: &System| readable(system.ratio, 3);
    let last = pairs.iter().flat_map(|s| s.errors.last()).map(|(k, _)| *k).max().unwrap_or(1);
    let decades = (last as f64).log10();
    let sweeps: Vec<f64> = (0..=200).map(|i| 10f64.powf(decades * f64::from(i) / 200.0)).collect();
    let theory = |system: &&System| {
        let rate = system.ratio / (1.0 + system.ratio);
        let points = sweeps.iter().map(|&k| (k, rate.powf(k))).collect();
        Series::theory(format!("theory, r = {}", ratio(system)), points)
    };
    let measured = |system: &&System| {
        let points = system.errors.iter().map(|&(k, error)| (k as f64, error)).collect();
        Series::points(format!("r = {}", ratio(system)), points)
    };
    let half = |r: f64| count((0.5f64.ln() / (r / (1.0 + r)).ln()).ceil() as usize);
    let heaviest = pairs.iter().map(|s| s.ratio).fold(0.0, f64::max);
    Lines {
        id: "rates_error".into(),
        title: "Two bodies: what is left of the error after k sweeps".into(),
        caption: format!(
            "Mass ratio r = upper / lower; start x = 0, blow {} m/s. Error: max |x − x\\*| / x\\* over \
             the two rows. Markers are measured, lines are $(r/(1+r))^k$. At r = {} it takes {} \
             sweeps to halve the error.",
            readable(BLOW, 4),
            readable(heaviest, 3),
            half(heaviest)
        ),
        x: Axis::log("sweeps k", ""),
        panels: vec![Panel {
            y: Axis::linear("error left", "parts of x*"),
            series: pairs.iter().map(measured).chain(pairs.iter().map(theory)).collect(),
        }],
    }
}
