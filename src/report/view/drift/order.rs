//! Errors as a function of the step length, with reference slopes and fitted orders.

use crate::number::significant;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::drift::order::{
    Curve, Expected, Finding, Problem, ROUNDING, SLACK, Sample,
};
use crate::report::view::{Outcome, ReportPage};

pub(super) fn show(findings: &[&Finding], document: &mut ReportPage) {
    document.text(format!(
        "**Order of accuracy.** Each problem below has a closed form, so every error is a distance to \
         the exact motion, not to a finer run. A method of order $p$ divides its error by $2^p$ when the step is halved: a line \
         of slope $p$ in the figures. The schemes *velocity* and *acceleration* have no error feedback here ($\\alpha = \\beta = 0$); \
         *split-impulse*, *gauss-seidel* and *xpbd* always correct positions. Schemes with substeps \
         use eight of them. The observed order, from the two shortest steps, must be within {SLACK} of the \
         derived one.",
    ));
    for finding in findings {
        document.figure(figure(finding));
    }
    document.table("order", table(findings));
    document.aside("Reasons for the derived orders, or for claiming none", reasons(findings));
}

pub(super) fn outcome(findings: &[&Finding]) -> Outcome {
    let claimed = curves(findings).filter(|(_, curve)| curve.holds().is_some()).count();
    let held = || curves(findings).filter(|(_, curve)| curve.holds() == Some(true));
    let those = |expected: fn(&Expected) -> bool| {
        held().filter(|(_, curve)| expected(&curve.expected)).count()
    };
    let exact = those(|expected| matches!(expected, Expected::Exact { .. }));
    let constant = those(|expected| matches!(expected, Expected::Order { order: 0.0, .. }));
    let (held, verb) = (held().count(), if constant == 1 { "does" } else { "do" });
    let says = format!(
        "{held} of {claimed} errors behave as derived: {} decrease at the derived order, {exact} stay at rounding level, \
         {constant} {verb} not depend on dt",
        held - exact - constant
    );
    Outcome { good: held == claimed, says }
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

fn figure(finding: &Finding) -> Lines {
    let claims = finding.curves.iter().filter_map(Curve::holds);
    let (held, all) = (claims.clone().filter(|held| *held).count(), claims.count());
    Lines {
        id: format!("order_{}", finding.problem.scene()),
        title: format!(
            "{}: {held} of {all} errors behave as derived when dt is halved {} times",
            what(finding.problem),
            finding.curves.first().map_or(0, |curve| curve.errors.len().saturating_sub(1))
        ),
        caption: "Pale bands have the slope of the derived order. The label names the methods whose errors \
             coincide, and the order observed between the two shortest steps, unless theory makes no claim. \
             Errors that are rounding at every step, and quantities with the same orders as one above, are only in the \
             table."
            .into(),
        x: Axis::log("step dt", "s"),
        panels: panels(finding),
    }
}

/// A panel for each quantity whose labels differ from those of the earlier ones.
fn panels(finding: &Finding) -> Vec<Panel> {
    let mut panels: Vec<Panel> = Vec::new();
    for quantity in quantities(finding) {
        let own = panel(finding, quantity);
        let labels =
            |panel: &Panel| panel.series.iter().map(|own| own.end.clone()).collect::<Vec<_>>();
        if panels.iter().all(|other| labels(other) != labels(&own)) {
            panels.push(own);
        }
    }
    panels
}

fn panel(finding: &Finding, quantity: &str) -> Panel {
    let shown: Vec<&Curve> =
        finding.curves.iter().filter(|curve| curve.quantity == quantity).collect();
    let unit = shown.first().map_or("", |curve| curve.unit.as_str());
    // The longest step last: the label is at the right.
    let points = |curve: &Curve| -> Vec<(f64, f64)> {
        let seen = curve.errors.iter().rev().filter(|sample| sample.error > ROUNDING);
        seen.map(|sample| (sample.dt, sample.error)).collect()
    };
    let series = alike(&shown).into_iter().map(|curves| {
        let names: Vec<&str> = curves.iter().map(|curve| short(&curve.method)).collect();
        let order = match (&curves[0].expected, curves[0].observed()) {
            (Expected::Open { .. }, _) | (_, None) => String::new(),
            (_, Some(order)) => format!(": order {:.1}", order.abs()),
        };
        let label = format!("{}{order}", names.join(", "));
        Series::measured(&curves[0].method, points(curves[0])).labeled(label)
    });
    let y = Axis::log(format!("error of the {quantity}"), unit);
    Panel { y, series: series.chain(slopes(&shown)).collect() }
}

/// The name of a method without the level of its integrator.
fn short(method: &str) -> &str {
    method.strip_prefix("acceleration, ").unwrap_or(method)
}

/// Curves whose errors are not rounding, those that coincide together.
fn alike<'a>(shown: &[&'a Curve]) -> Vec<Vec<&'a Curve>> {
    let same = |a: &Curve, b: &Curve| {
        a.errors.iter().zip(&b.errors).all(|(a, b)| (a.error / b.error - 1.0).abs() < 0.01)
    };
    let mut groups: Vec<Vec<&Curve>> = Vec::new();
    for curve in shown.iter().filter(|curve| curve.errors.iter().any(|s| s.error > ROUNDING)) {
        match groups.iter_mut().find(|group| same(group[0], curve)) {
            Some(group) => group.push(curve),
            None => groups.push(vec![curve]),
        }
    }
    groups
}

/// A band for each derived order, through the longest step of the first method with that order.
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
    let band = |(order, points): (f64, Vec<_>)| {
        Series::theory(format!("order {order}"), points).labeled("")
    };
    lines.into_iter().map(band).collect()
}

fn table(findings: &[&Finding]) -> Table {
    Table::new(
        "Orders, derived, observed and fitted",
        format!(
            "Errors at the longest and at the shortest step. *derived*: the derived order. Here 0 means that \
             the error does not decrease, *exact* means that it is a rounding error (below 10⁻¹¹) at every step, and \
             *open* means that no order is claimed; the page gives the reasons. *midpoint rule* and *RK4* integrate at acceleration level. A row passes if the observed order \
             is within {SLACK} of the derived one."
        ),
        "problem | quantity | method | #first error | #last error | unit | derived | #observed | \
         fitted | outcome",
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
    let outcome = match curve.holds() {
        Some(true) => Cell::text("passed").marked(Mark::Good),
        Some(false) => Cell::text("FAILED").marked(Mark::Bad),
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
        outcome,
    ]
}

/// Each reason once, with the quantities and methods it applies to.
fn reasons(findings: &[&Finding]) -> String {
    let mut lines: Vec<Reason<'_>> = Vec::new();
    for (problem, curve) in curves(findings) {
        let because = match &curve.expected {
            Expected::Order { because, .. }
            | Expected::Exact { because }
            | Expected::Open { because } => because,
        };
        let (quantity, method) = (curve.quantity.as_str(), curve.method.as_str());
        match lines.iter_mut().find(|line| line.problem == problem && line.because == because) {
            Some(line) => {
                line.quantities.extend((!line.quantities.contains(&quantity)).then_some(quantity));
                line.methods.extend((!line.methods.contains(&method)).then_some(method));
            }
            None => {
                let (quantities, methods) = (vec![quantity], vec![method]);
                lines.push(Reason { problem, because, quantities, methods });
            }
        }
    }
    let line = |reason: &Reason<'_>| {
        let Reason { problem, because, quantities, methods } = reason;
        let (quantities, methods) = (quantities.join(", "), methods.join(", "));
        format!("- {} ({quantities}), {methods}: {because}", what(*problem))
    };
    let lines: Vec<String> = lines.iter().map(line).collect();
    lines.join("\n")
}

/// Why curves have the orders that they have.
struct Reason<'a> {
    problem: Problem,
    because: &'a str,
    quantities: Vec<&'a str>,
    methods: Vec<&'a str>,
}
