//! Errors as a function of the step length, with reference slopes and fitted orders.

use crate::number::significant;
use crate::plot::{Axis, Lines, Series};
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::drift::order::{
    Curve, Expected, Finding, Problem, ROUNDING, SLACK, Sample,
};
use crate::report::view::{Document, Outcome};

pub(super) fn show(findings: &[&Finding], document: &mut Document) {
    document.text(format!(
        "**Order of accuracy.** Each problem below has a closed form, so every error is a distance to \
         the exact motion, not to a finer run. A method of order $p$ divides its error by $2^p$ when the step is halved: a line \
         of slope $p$ in the figures. Error feedback is off ($\\alpha = \\beta = 0$). Schemes with substeps \
         use eight of them. The observed order, from the two shortest steps, must be within {SLACK} of the \
         derived one. The fitted order is the slope through all points, with its standard error.",
    ));
    for finding in findings {
        for quantity in quantities(finding) {
            document.figure(figure(finding, quantity));
        }
    }
    document.table("order", table(findings));
    document.aside("Reasons for the derived orders", reasons(findings));
}

pub(super) fn outcome(findings: &[&Finding]) -> Outcome {
    let claims: Vec<bool> = curves(findings).filter_map(|(_, curve)| curve.holds()).collect();
    let held = claims.iter().filter(|held| **held).count();
    let exact = curves(findings)
        .filter(|(_, curve)| matches!(curve.expected, Expected::Exact { .. }))
        .count();
    let says = format!(
        "{held} of {} errors behave as derived, {exact} of them at rounding level",
        claims.len()
    );
    Outcome { good: held == claims.len(), says }
}

fn curves<'a>(findings: &[&'a Finding]) -> impl Iterator<Item = (Problem, &'a Curve)> {
    findings.iter().flat_map(|finding| finding.curves.iter().map(|curve| (finding.problem, curve)))
}

fn quantities(finding: &Finding) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for curve in &finding.curves {
        if !names.contains(&curve.quantity.as_str()) {
            names.push(&curve.quantity);
        }
    }
    names
}

fn what(problem: Problem) -> &'static str {
    match problem {
        Problem::Fall => "Free fall",
        Problem::Swing => "Pendulum",
        Problem::Bounce => "Bouncing ball",
        Problem::Slide => "Box on a slope",
    }
}

fn figure(finding: &Finding, quantity: &str) -> Lines {
    let shown: Vec<&Curve> =
        finding.curves.iter().filter(|curve| curve.quantity == quantity).collect();
    let unit = shown.first().map_or("", |curve| curve.unit.as_str());
    let measured = shown.iter().map(|curve| {
        let seen = curve.errors.iter().filter(|sample| sample.error > ROUNDING);
        (curve.method.clone(), seen.map(|s| (s.dt, s.error)).collect::<Vec<_>>())
    });
    let measured: Vec<_> = measured.filter(|(_, points)| !points.is_empty()).collect();
    let theory = slopes(&shown);
    let series = measured.into_iter().map(|(name, points)| Series::measured(name, points));
    Lines::new(
        format!("order_{}_{}", finding.problem.scene(), quantity.replace(' ', "_")),
        format!("{}: error of the {quantity}", what(finding.problem)),
        "Gray lines have the slope of the derived order. Methods whose error is a rounding error at \
                  every step are listed only in the table. Curves with equal errors coincide.",
        Axis::log("step dt", "s"),
        Axis::log(format!("error of the {quantity}"), unit),
        series.chain(theory).collect(),
    )
}

/// A reference line for each derived order, through the longest step of the first method with that
/// order.
fn slopes(shown: &[&Curve]) -> Vec<Series> {
    let mut lines: Vec<(f64, Vec<(f64, f64)>)> = Vec::new();
    for curve in shown {
        let Expected::Order { order, .. } = curve.expected else { continue };
        let first = curve.errors.iter().find(|sample| sample.error > ROUNDING);
        if let (Some(first), false) = (first, lines.iter().any(|(known, _)| *known == order)) {
            let at = |dt: f64| (dt, first.error * (dt / first.dt).powf(order));
            lines.push((order, curve.errors.iter().map(|sample| at(sample.dt)).collect()));
        }
    }
    let named = |(order, points): (f64, Vec<_>)| Series::theory(format!("order {order}"), points);
    lines.into_iter().map(named).collect()
}

fn table(findings: &[&Finding]) -> Table {
    Table::new(
        "Orders, derived, observed and fitted",
        format!(
            "Errors at the longest and at the shortest step. *derived*: the theoretical order; 0 means that \
             the error does not decrease, *exact* that it is a rounding error (below 10⁻¹¹) at every step, and \
             *open* that no order is claimed. The reasons are given below. A row passes if the observed order \
             is within {SLACK} of the derived one."
        ),
        "problem | quantity | method | #first error | #last error | unit | derived | #observed | \
         fitted | verdict",
        curves(findings).map(|(problem, curve)| cells(problem, curve)).collect(),
    )
}

fn cells(problem: Problem, curve: &Curve) -> Vec<Cell> {
    let error = |sample: Option<&Sample>| {
        sample.map_or(Cell::text("–"), |sample| match sample.error {
            error if error <= ROUNDING => Cell { value: Some(error), ..Cell::text("rounding") },
            error => Cell::number(error, 2),
        })
    };
    let derived = match curve.expected {
        Expected::Order { order, .. } => format!("{order}"),
        Expected::Exact { .. } => "exact".into(),
        Expected::Open { .. } => "open".into(),
    };
    let fitted = curve.fitted().map_or("–".into(), |(slope, error)| {
        format!("{} ± {}", significant(slope, 3), significant(error, 1))
    });
    let verdict = match curve.holds() {
        Some(true) => Cell::text("pass").marked(Mark::Good),
        Some(false) => Cell::text("FAIL").marked(Mark::Bad),
        None => Cell::text("–"),
    };
    vec![
        Cell::text(what(problem)),
        Cell::text(&curve.quantity),
        Cell::text(&curve.method),
        error(curve.errors.first()),
        error(curve.errors.last()),
        Cell::text(&curve.unit),
        Cell::text(derived),
        curve.observed().map_or(Cell::text("–"), |order| Cell::number(order, 3)),
        Cell::text(fitted),
        verdict,
    ]
}

/// Each reason once, with the methods it applies to.
fn reasons(findings: &[&Finding]) -> String {
    let mut lines: Vec<(String, Vec<&str>)> = Vec::new();
    for (problem, curve) in curves(findings) {
        let because = match &curve.expected {
            Expected::Order { because, .. }
            | Expected::Exact { because }
            | Expected::Open { because } => because,
        };
        let reason = format!("{}, {}: {because}", what(problem), curve.quantity);
        match lines.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, methods)) => methods.push(&curve.method),
            None => lines.push((reason, vec![&curve.method])),
        }
    }
    let line =
        |(reason, methods): &(String, Vec<&str>)| format!("- {reason} ({})", methods.join(", "));
    let lines: Vec<String> = lines.iter().map(line).collect();
    lines.join("\n")
}
