//! Closed forms compared with measured numbers.

use super::{Document, Headline, Outcome, View};
use crate::number::{significant, tabular};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::verification::{Criterion, ORDER_SLACK, Plan, Row};

impl View for Plan {
    const TITLE: &'static str = "Verification against closed-form solutions";

    fn show(&self, findings: &[Vec<Row>], document: &mut Document) {
        let rows = &findings.concat();
        let failed = rows.iter().filter(|row| !row.passes()).count();
        document.text(format!(
            "Does the simulation reproduce numbers with a closed form? {} of {} numbers pass. If a number \
             depends on the time step, its error must decrease at the theoretical order p: each halving of the \
             step multiplies the error by $2^{{-p}}$, and the observed order may differ from p by at most \
             {ORDER_SLACK}. If a number does not depend on the time step, it is *exact*: it must agree at every \
             time step within the error stated in the column *allowed*. All other numbers must stay *within a \
             bound*. The reasons for the allowed errors are below the table.",
            rows.len() - failed,
            rows.len()
        ));
        document.aside("The closed forms", formulas(rows));
        document.table("closed_forms", table(rows));
        document.text(tolerances(rows));
    }

    fn headline(&self, findings: &[Vec<Row>]) -> Headline {
        let rows = || findings.iter().flatten();
        let passed = rows().filter(|row| row.passes()).count();
        let value = format!("{passed} of {}", rows().count());
        let label = "numbers agree with their closed forms".into();
        Headline { result: Some([value, label]), ..Headline::default() }
    }

    fn outcome(&self, findings: &[Vec<Row>]) -> Outcome {
        let rows = || findings.iter().flatten();
        let (passed, all) = (rows().filter(|row| row.passes()).count(), rows().count());
        let of_kind =
            |kind: &str| rows().filter(|row| row.passes() && self::kind(row) == kind).count();
        let by_order = rows().filter(|row| row.passes() && row.derived_order().is_some()).count();
        let says = format!(
            "{passed} of {all} numbers agree with their closed forms: {} up to rounding and the solver's tolerance, {by_order} \
             converging at the predicted order, {} within a bound fixed beforehand",
            of_kind(EXACT),
            of_kind(BOUNDED)
        );
        Outcome { good: passed == all, says }
    }
}

/// A number whose allowed errors are at most this large is exact up to rounding and the solver's
/// tolerance.
const ROUNDING: f64 = 1e-7;
const EXACT: &str = "exact";
const BOUNDED: &str = "within a bound";

/// The requirement on a number without a derived order.
fn kind(row: &Row) -> &'static str {
    match row.criterion {
        Criterion::Exact { tolerance, .. } if tolerance > ROUNDING => BOUNDED,
        Criterion::Exact { .. } => EXACT,
        Criterion::Order(_) => "",
    }
}

/// Each formula once.
fn formulas(rows: &[Row]) -> String {
    let mut lines: Vec<String> = Vec::new();
    for row in rows {
        let line = format!("- *{}*, {}: ${}$", row.case, row.quantity, row.latex);
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines.join("\n")
}

/// Each tolerance once, with its reason and its cases.
fn tolerances(rows: &[Row]) -> String {
    let mut lines: Vec<(String, Vec<&str>)> = Vec::new();
    for row in rows {
        let Criterion::Exact { tolerance, because } = &row.criterion else { continue };
        let line = format!("- {}: {because}", significant(*tolerance, 2));
        let case = row.case.as_str();
        match lines.iter().position(|(own, _)| *own == line) {
            Some(at) if lines[at].1.contains(&case) => (),
            Some(at) => lines[at].1.push(case),
            None => lines.push((line, vec![case])),
        }
    }
    let lines = lines.iter().map(|(line, cases)| format!("{line} (*{}*)", cases.join(", ")));
    let lines: Vec<String> = lines.collect();
    format!("Reasons for the allowed errors, with the cases:\n\n{}", lines.join("\n"))
}

/// If 0 is expected, digits of a smaller number are meaningless.
const NOISE: f64 = 1e-12;

/// One row per closed form and method.
pub fn table(rows: &[Row]) -> Table {
    let levels = rows.iter().map(|row| row.samples.len()).max().unwrap_or(0);
    let measured = (0..levels).map(|level| match level {
        0 => Column::numbers("at dt", ""),
        level if level + 1 == levels => Column::numbers(format!("at dt/{}", 1 << level), ""),
        level => Column::numbers(format!("at dt/{}", 1 << level), "").secondary(),
    });
    let head = Column::list(
        "case | method | quantity | verdict | #error | #allowed | #observed order | #derived | \
         #expected | unit",
    );
    let tail = [Column::words("formula").secondary()];
    Table {
        title: "Closed forms and measured values".into(),
        how_to_read: "*error*: the error with the shortest step, relative unless 0 is expected. A row with a \
         *derived* order passes if the *observed* order, from the two shortest steps, is within 0.1 of it. Any \
         other row passes if no error exceeds *allowed*, for the reason given below. *exact*: the value does \
         not depend on the time step, and *allowed* covers rounding and the solver's tolerance."
            .into(),
        columns: head.into_iter().chain(measured).chain(tail).collect(),
        rows: rows.iter().map(|row| cells(row, levels)).collect(),
        ..Table::default()
    }
}

fn cells(row: &Row, levels: usize) -> Vec<Cell> {
    let is_noise = |value: f64| row.expected == 0.0 && value.abs() < NOISE;
    let seven = |value: f64| {
        let digits = if is_noise(value) { 1 } else { 7 };
        Cell { text: tabular(value, digits), value: Some(value), ..Cell::default() }
    };
    let measured = (0..levels).map(|level| match row.samples.get(level) {
        Some(sample) => seven(sample.measured),
        None => Cell::text("–"),
    });
    let error = row.errors().last().copied().unwrap_or(f64::NAN);
    let order = row.derived_order();
    let observed = match order {
        Some(_) => Cell::number(row.observed_order(), 4),
        None => Cell::text("–"),
    };
    let allowed = match row.criterion {
        Criterion::Exact { tolerance, .. } => Cell::number(tolerance, 2),
        Criterion::Order(_) => Cell::text("–"),
    };
    let verdict = match row.passes() {
        true => Cell::text("pass").marked(Mark::Good),
        false => Cell::text("FAIL").marked(Mark::Bad),
    };
    let head = vec![
        Cell::text(&row.case),
        Cell::text(&row.method),
        Cell::text(&row.quantity),
        verdict,
        Cell::number(error, 2),
        allowed,
        observed,
        order.map_or(Cell::text(kind(row)), |order| Cell::number(order, 2)),
        seven(row.expected),
        Cell::text(&row.unit),
    ];
    let tail = [Cell::text(&row.formula)];
    head.into_iter().chain(measured).chain(tail).collect()
}
