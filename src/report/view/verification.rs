//! Closed forms compared with measured numbers.

use super::{Headline, Outcome, ReportPage, View};
use crate::document::unicode;
use crate::number::{readable, significant, tabular};
use crate::plot::{Axis, Bar, Bars, Figure};
use crate::report::page::markup::literal;
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::verification::{Criterion, ORDER_SLACK, Plan, Row, title};

impl View for Plan {
    const TITLE: &'static str = "Verification against closed-form solutions";

    fn show(&self, findings: &[Vec<Row>], document: &mut ReportPage) {
        let rows = &findings.concat();
        document.text(format!(
            "If a number depends on the time step, its error must decrease at the derived order p: each \
             halving of the step multiplies the error by $2^{{-p}}$, and the observed order may differ from p by \
             at most {ORDER_SLACK}. If a number does not depend on the time step, it is *exact*: it must agree at every \
             time step within the error stated in the column *allowed*. All other numbers must stay *within a \
             bound*."
        ));
        let failed: Vec<&Row> = rows.iter().filter(|row| !row.passes()).collect();
        if !failed.is_empty() {
            document.table("failed", self::failed(&failed));
        }
        document.table("by_case", by_case(rows));
        if rows.iter().any(is_approximate) {
            document.table("approximate", approximate(rows));
        }
        document.aside("The closed forms", formulas(rows));
        document.table_without_secondary("closed_forms", table(rows));
        document.aside("The reasons for the allowed errors", tolerances(rows));
    }

    fn headline(&self, findings: &[Vec<Row>]) -> Headline {
        let rows = || findings.iter().flatten();
        let passed = rows().filter(|row| row.passes()).count();
        let label = "numbers agree with their closed forms".into();
        let result = Some(([passed, rows().count()], label));
        let figure: Box<dyn Figure> = Box::new(dots(&findings.concat()));
        let rows: Vec<&Row> = rows().collect();
        Headline { result, figure: Some(figure), ..Headline::of(answer(&rows)) }
    }

    fn outcome(&self, findings: &[Vec<Row>]) -> Outcome {
        let rows = || findings.iter().flatten();
        let (passed, all) = (rows().filter(|row| row.passes()).count(), rows().count());
        let kinds = kinds(&rows().collect::<Vec<_>>());
        let says = format!("{passed} of {all} numbers agree with their closed forms: {kinds}");
        Outcome { good: passed == all, says }
    }
}

/// Whether all numbers agree and, if not, which ones fail.
fn answer(rows: &[&Row]) -> Option<String> {
    let failed: Vec<&&Row> = rows.iter().filter(|row| !row.passes()).collect();
    let all = rows.len();
    Some(match failed.len() {
        0 if all == 0 => return None,
        0 => format!(
            "**All {all} numbers agree with their closed forms:** {}.{}",
            kinds(rows),
            closest(rows).map_or(String::new(), |(row, share)| format!(
                " The largest error, relative to the allowed one, is {share}: *{}* ({}), {}.",
                literal(title(&row.case)),
                literal(&row.method),
                literal(&row.quantity)
            ))
        ),
        count => {
            let Row { case, method, quantity, .. } = failed[0];
            let [case, method, quantity] = [title(case), method, quantity].map(literal);
            let [error, allowed] = error_and_allowed(failed[0]).map(|cell| cell.text);
            format!(
                "**Failed: {count} of {all} numbers.** The first: *{case}* ({method}), {quantity}, {error} instead of at most \
                 {allowed}."
            )
        }
    })
}

/// The number of passed rows of each kind.
fn kinds(rows: &[&Row]) -> String {
    let passed = || rows.iter().filter(|row| row.passes());
    let of_kind = |kind: &str| passed().filter(|row| self::kind(row) == kind).count();
    format!(
        "{} up to rounding and the solver's tolerance, {} converging at the derived order, {} within a bound \
         fixed beforehand",
        of_kind(EXACT),
        passed().filter(|row| row.derived_order().is_some()).count(),
        of_kind(BOUNDED)
    )
}

/// The row whose error is the largest part of the allowed one, and that part.
fn closest<'a>(rows: &[&'a Row]) -> Option<(&'a Row, String)> {
    let row = rows.iter().max_by(|a, b| share(a).total_cmp(&share(b)))?;
    Some((row, format!("{}\u{a0}%", readable(share(row), 3))))
}

/// The largest error over all time steps and the largest allowed one; for a derived order, how far
/// the observed order is from it and may be.
fn error_and_allowed(row: &Row) -> [Cell; 2] {
    let [error, allowed] = match &row.criterion {
        Criterion::Exact { tolerance, .. } => [largest_error(row), *tolerance],
        Criterion::Order(order) => [(row.observed_order() - order).abs(), ORDER_SLACK],
    };
    let [shown, limit] = [error, allowed].map(|value| Cell::number(value, 2));
    match row.criterion {
        Criterion::Exact { .. } => [Cell { text: format!("error {}", shown.text), ..shown }, limit],
        Criterion::Order(order) => {
            let text = format!("order {order} missed by {}", shown.text);
            [Cell { text, ..shown }, limit]
        }
    }
}

/// The numbers that fail, and by how much.
fn failed(rows: &[&Row]) -> Table {
    let cells = |row: &&Row| {
        let [measured, allowed] = error_and_allowed(row);
        vec![
            Cell::text(title(&row.case)),
            Cell::text(&row.method),
            Cell::text(&row.quantity),
            measured.marked(Mark::Bad),
            allowed,
        ]
    };
    Table::new(
        "Numbers that do not agree with the closed form",
        "The largest error over all time steps or, if theory gives an order, the difference between the \
         observed and the derived order.",
        "case | method | quantity | #found | #allowed",
        rows.iter().map(cells).collect(),
    )
}

/// A number whose allowed errors are at most this large is exact up to rounding and the solver's
/// tolerance.
const ROUNDING: f64 = 1e-7;
/// The least part of an allowed error that is drawn (%),
const LEAST: f64 = 1e-4;
/// and the least of a case that is shown.
const SHOWN: f64 = 10.0;
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

/// An error above this is no rounding.
const NOTABLE: f64 = 1e-6;

/// Whether a number does not converge to its closed form, but only stays near it.
fn is_approximate(row: &Row) -> bool {
    kind(row) == BOUNDED && largest_error(row) > NOTABLE
}

/// The largest error of any step length; NaN if one is not a number.
fn largest_error(row: &Row) -> f64 {
    let larger = |most: f64, error: f64| if most >= error || most.is_nan() { most } else { error };
    row.errors().into_iter().fold(0.0, larger)
}

/// A summary of each case.
fn by_case(rows: &[Row]) -> Table {
    let summary = |rows: &[Row]| {
        let passed = rows.iter().filter(|row| row.passes()).count();
        let mut methods: Vec<&str> = rows.iter().map(|row| row.method.as_str()).collect();
        methods.sort_unstable();
        methods.dedup();
        let of_kind = |kind: &str| rows.iter().filter(|row| self::kind(row) == kind).count();
        let outcome = match passed == rows.len() {
            true => Cell::text("passed").marked(Mark::Good),
            false => Cell::text("FAILED").marked(Mark::Bad),
        };
        vec![
            Cell::text(title(&rows[0].case)),
            Cell::count(methods.len()),
            Cell::count(rows.len()),
            Cell::count(passed),
            Cell::count(of_kind(EXACT)),
            Cell::count(rows.iter().filter(|row| row.derived_order().is_some()).count()),
            Cell::count(of_kind(BOUNDED)),
            outcome,
        ]
    };
    Table::new(
        "The cases",
        "*exact*, *converging* and *bounded*: how many numbers must be right at every time step, must converge at \
         the derived order, and must stay within a bound.",
        "case | #methods | #numbers | #passed | #exact | #converging | #bounded | outcome",
        rows.chunk_by(|a, b| a.case == b.case).map(summary).collect(),
    )
}

/// The numbers that are only near their closed form, with the largest error first.
fn approximate(rows: &[Row]) -> Table {
    let mut found: Vec<&Row> = rows.iter().filter(|row| is_approximate(row)).collect();
    found.sort_by(|a, b| largest_error(b).total_cmp(&largest_error(a)));
    let cells = |row: &Row| {
        let Criterion::Exact { tolerance, because } = &row.criterion else { return Vec::new() };
        vec![
            Cell::text(title(&row.case)),
            Cell::text(&row.method),
            Cell::text(&row.quantity),
            Cell::number(largest_error(row), 2),
            Cell::number(*tolerance, 2),
            typeset(&format!("${}$", row.formula)),
            typeset(because),
        ]
    };
    Table::new(
        "Laws that a method obeys only approximately",
        "Numbers that must stay within a bound, and whose error exceeds 10⁻⁶. *error*: the largest over all time \
         steps; it is relative unless the expected value is 0. *bound*: the largest allowed error. *reason*: why an error \
         remains.",
        "case | method | quantity | #error | #bound | law | reason",
        found.into_iter().map(cells).collect(),
    )
}

/// The error of each row as a part of the allowed one (%): for a derived order, the distance of the
/// observed order from it.
fn share(row: &Row) -> f64 {
    100.0
        * match &row.criterion {
            Criterion::Exact { tolerance, .. } => {
                row.errors().into_iter().fold(0.0, f64::max) / tolerance
            }
            Criterion::Order(_) => {
                let derived = row.derived_order().unwrap_or(f64::NAN);
                (row.observed_order() - derived).abs() / ORDER_SLACK
            }
        }
}

/// The rows of each case as dots, the largest with its value.
fn dots(rows: &[Row]) -> Bars {
    let bar = |rows: &[Row]| {
        let mut others: Vec<f64> = rows.iter().map(|row| share(row).max(LEAST)).collect();
        others.sort_by(f64::total_cmp);
        let value = others.pop().unwrap_or(f64::NAN);
        let (name, amount) = (title(&rows[0].case).to_string(), readable(value, 3));
        Bar { name, accent: value > 100.0, value, amount, others }
    };
    let mut bars: Vec<Bar> = rows.chunk_by(|a, b| a.case == b.case).map(bar).collect();
    let cases = bars.len();
    if bars.iter().any(|bar| bar.value > SHOWN) {
        bars.retain(|bar| bar.value > SHOWN);
    }
    let below = match cases - bars.len() {
        0 => String::new(),
        1 => " One further case is not shown: its errors are below 10 % of the allowed ones."
            .to_string(),
        others => format!(
            " {others} further cases are not shown: their errors are below 10 % of the allowed ones."
        ),
    };
    bars.sort_by(|a, b| b.value.total_cmp(&a.value));
    let passed = rows.iter().filter(|row| row.passes()).count();
    let title = match closest(&rows.iter().collect::<Vec<_>>()) {
        Some((row, share)) if passed == rows.len() => format!(
            "All {passed} errors are within their bounds; the closest, {share}: {}, {}",
            row.quantity,
            self::title(&row.case)
        ),
        _ => format!("{passed} of {} numbers agree with their closed forms", rows.len()),
    };
    Bars {
        id: "verification_dots".into(),
        title,
        caption: format!(
            "Each dot is one number. Its position is the error divided by the allowed error or, if theory \
                  gives an order, the difference between the observed and the derived order, divided by {ORDER_SLACK}. \
                  The largest of each case has its value. Dots below 10⁻⁴ % lie at the left edge.{below}"
        ),
        x: Axis::log("error / allowed error", "%"),
        bars,
        limit: Some((100.0, "allowed".into())),
    }
}

/// The formulas of each case, each once with all quantities that it gives.
fn formulas(rows: &[Row]) -> String {
    let of_case = |rows: &[Row]| {
        let mut formulas: Vec<(&str, Vec<&str>)> = Vec::new();
        for row in rows {
            let quantity = row.quantity.as_str();
            match formulas.iter_mut().find(|(latex, _)| *latex == row.formula) {
                Some((_, quantities)) if quantities.contains(&quantity) => (),
                Some((_, quantities)) => quantities.push(quantity),
                None => formulas.push((&row.formula, vec![quantity])),
            }
        }
        let line = |(latex, quantities): &(&str, Vec<&str>)| {
            format!("  - {}: ${latex}$", quantities.join("; "))
        };
        let lines: Vec<String> = formulas.iter().map(line).collect();
        format!("- *{}*\n{}", title(&rows[0].case), lines.join("\n"))
    };
    let cases: Vec<String> = rows.chunk_by(|a, b| a.case == b.case).map(of_case).collect();
    let explained = SYMBOLS.iter().filter(|(case, _)| rows.iter().any(|row| row.case == *case));
    let explained: Vec<&str> = explained.map(|(_, words)| *words).collect();
    format!("{}\n\n{}", cases.join("\n"), explained.join(" "))
}

/// The symbols of formulas that are not in the glossary, each with a case that has them.
const SYMBOLS: [(&str, &str); 10] = [
    ("pendulum", "agm: the arithmetic-geometric mean."),
    ("iftomm-pendulum", "sn, cn: Jacobi's elliptic functions with the modulus $k$."),
    ("flip", "$K(k)$: the complete elliptic integral of the first kind with the modulus $k$."),
    (
        "capstan",
        "In the two cases *rope around a post*, $T_1$ and $T_2$ are the pulls at the ends of the rope, $n$ is the number of its links, \
         $\\delta$ the angle of a link around the post, $r = (1 + \\mu \\tan \\frac{\\delta}{2}) / (1 - \\mu \\tan \
         \\frac{\\delta}{2})$, $m$ the mass of each point, and $m K$ the pull $T_2$ per acceleration of the rope if $T_1 = 0$.",
    ),
    (
        "oblique-slip",
        "$p$: the corner of the polygon that points most along the slip, as a unit vector.",
    ),
    (
        "flat-bounce",
        "$\\zeta$: the damping ratio of a penalty contact; $\\varphi$: the phase of its oscillation at which the force is 0.",
    ),
    (
        "gap-below-a-step",
        "In *impacts closer than a step*, $s$ is the sine of the angle between the velocity of the first ball and the \
         line of the centers.",
    ),
    ("moving-support", "In *moving supports*, $s$ is the distance that the belt moves."),
    ("static-friction", "$F'$: the rate at which the force grows."),
    ("bricard", "In Bricard's ring, $n$ is its degree of freedom, $J n = 0$."),
];

/// Each tolerance once, with its reason and its cases.
fn tolerances(rows: &[Row]) -> String {
    let mut lines: Vec<(String, Vec<&str>)> = Vec::new();
    for row in rows {
        let Criterion::Exact { tolerance, because } = &row.criterion else { continue };
        let line = format!("- {}: {because}", significant(*tolerance, 2));
        let case = title(&row.case);
        match lines.iter().position(|(own, _)| *own == line) {
            Some(at) if lines[at].1.contains(&case) => (),
            Some(at) => lines[at].1.push(case),
            None => lines.push((line, vec![case])),
        }
    }
    let lines = lines.iter().map(|(line, cases)| format!("{line} (*{}*)", cases.join(", ")));
    let lines: Vec<String> = lines.collect();
    lines.join("\n")
}

/// A cell whose formulas a page typesets.
fn typeset(markup: &str) -> Cell {
    Cell { markup: markup.into(), ..Cell::text(unicode(markup)) }
}

/// If 0 is expected, digits of a smaller number are meaningless.
const NOISE: f64 = 1e-12;

/// One row per closed form and method.
pub fn table(rows: &[Row]) -> Table {
    let head = Column::list(
        "case | method | quantity | #expected | #measured | unit | #error | #allowed | #order | \
         #derived",
    );
    let tail = [Column::words("formula").secondary()];
    Table {
        title: "Closed forms and measured values".into(),
        how_to_read: "*measured*, *error*: with the shortest step; the error is relative unless 0 is expected. A row with a \
         *derived* order passes if the observed *order*, from the two shortest steps, is within 0.1 of it. Any \
         other row passes if no error exceeds *allowed*; the page gives the reasons. *exact*: the value does \
         not depend on the time step, and *allowed* covers rounding and the solver's tolerance."
            .into(),
        columns: head.into_iter().chain(tail).collect(),
        rows: rows.iter().map(cells).collect(),
        ..Table::default()
    }
}

fn cells(row: &Row) -> Vec<Cell> {
    let is_noise = |value: f64| row.expected == 0.0 && value.abs() < NOISE;
    let seven = |value: f64| {
        let digits = if is_noise(value) { 1 } else { 7 };
        Cell { text: tabular(value, digits), value: Some(value), ..Cell::default() }
    };
    let measured = row.samples.last().map_or(Cell::text("–"), |sample| seven(sample.measured));
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
    vec![
        Cell::text(title(&row.case)),
        Cell::text(&row.method),
        Cell::text(&row.quantity),
        seven(row.expected),
        measured,
        Cell::text(&row.unit),
        Cell::number(error, 2).marked(if row.passes() { Mark::Good } else { Mark::Bad }),
        allowed,
        observed,
        order.map_or(Cell::text(kind(row)), |order| Cell::number(order, 2)),
        typeset(&format!("${}$", row.formula)),
    ]
}
