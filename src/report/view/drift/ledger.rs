//! The energy balance: every gain and loss with its cause.

use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::drift::ledger::{Account, Book};
use crate::report::view::attempt::section_id;
use crate::report::view::{Outcome, ReportPage};

/// Accounts below this fraction of the exchanged energy are not drawn.
const SMALL: f64 = 1e-6;
/// Numbers below this fraction of the exchanged energy are shown as 0.
const NOTHING: f64 = 1e-9;
/// A remainder up to this fraction of the energies in the computation is rounding.
const ROUNDING: f64 = 1e-11;

pub(super) fn show(findings: &[&Account], document: &mut ReportPage) {
    document.text(
        "**The energy ledger.** Every impulse does work, and the work of an impulse at fixed positions is \
         known exactly. Therefore each change of energy has a known cause: impacts and friction dissipate energy, \
         restitution returns some of it, and error feedback adds or removes energy. The ledger computes \
         the work of gravity in a step with the mean of the old and the new velocity, but the step moves the bodies with the \
         new one. The entry *integrator* is the difference; it is not 0 even if gravity is constant.",
    );
    document.equation(
        "\\Delta E = \\sum_{\\text{rows}} \\tfrac12 x_i (J u + J u^+)_i + \\Delta E_{\\text{integrator}} \
         + \\dots",
        "ledger of a step",
    );
    for finding in findings {
        document.text(format!("**{}.** {}", finding.run.title, finding.run.text));
    }
    document.figure(figure(section_id(document) + "_ledger", findings));
    document.table("ledger", table(findings));
}

pub(super) fn outcome(findings: &[&Account]) -> Outcome {
    let kept: Vec<bool> = findings.iter().filter_map(|finding| balances(finding)).collect();
    let balanced = kept.iter().filter(|balances| **balances).count();
    let mut says = format!("{balanced} of {} energy ledgers balance", kept.len());
    if kept.len() < findings.len() {
        says += &format!(", {} without a ledger", findings.len() - kept.len());
    }
    let ended_early = findings.iter().any(|finding| finding.ending.is_some());
    Outcome { good: balanced == kept.len() && !ended_early, says }
}

/// Whether the energy balance holds up to rounding; `None` if there is none.
fn balances(finding: &Account) -> Option<bool> {
    let remainder = finding.remainder?;
    let scale = finding.scale.max(finding.turnover);
    Some(finding.ending.is_none() && remainder <= ROUNDING * scale)
}

/// The names of the significant accounts of a run, with their indices.
fn used(finding: &Account) -> Vec<(usize, &str)> {
    let most =
        |k: usize| finding.books.iter().map(|book| book.accounts[k].abs()).fold(0.0, f64::max);
    let names = finding.accounts.iter().map(String::as_str).enumerate();
    names.filter(|&(k, _)| most(k) > SMALL * finding.turnover).collect()
}

fn figure(id: String, findings: &[&Account]) -> Lines {
    let remainders = findings.iter().filter_map(|finding| finding.remainder);
    let worst = readable(remainders.fold(0.0, f64::max), 2);
    Lines {
        id,
        title: title(findings),
        caption: format!(
            "Gains are positive. The pale band is the measured change of kinetic plus potential energy; the line on \
             it is the sum of the entries, to within {worst} J."
        ),
        x: Axis::linear("time", "s"),
        panels: findings.iter().map(|finding| panel(finding)).collect(),
    }
}

/// The finding: the largest entry at the end of a run.
fn title(findings: &[&Account]) -> String {
    let at_end = |finding: &&Account| {
        let last = finding.books.last()?;
        let largest = used(finding)
            .into_iter()
            .max_by(|a, b| last.accounts[a.0].abs().total_cmp(&last.accounts[b.0].abs()))?;
        Some((last.accounts[largest.0], largest.1.to_string(), finding.run.title.clone()))
    };
    let largest = findings.iter().filter_map(at_end).max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let Some((work, name, run)) = largest else { return "The energy ledger".into() };
    let name = if name == "bias" { "error feedback" } else { &name };
    let does = if work > 0.0 { "adds" } else { "takes" };
    format!("{run}: {name} {does} {} J", readable(work.abs(), 3))
}

fn panel(finding: &Account) -> Panel {
    let curve = |value: &dyn Fn(&Book) -> f64| {
        finding.books.iter().map(|book| (book.time, value(book))).collect::<Vec<_>>()
    };
    let label = |name: &str, points: &[(f64, f64)]| {
        format!("{name} {} J", readable(points.last().map_or(0.0, |(_, work)| *work), 3))
    };
    let cause = |(k, name): (usize, &str)| {
        let points = curve(&|book| book.accounts[k]);
        let label = label(name, &points);
        Series::measured(name, points).labeled(label)
    };
    let measured = curve(&|book| book.kinetic + book.potential);
    let mut series = vec![Series::theory("change of energy", measured).labeled("")];
    if finding.remainder.is_some() {
        let sum = curve(&|book| book.accounts.iter().sum());
        let label = label("sum", &sum);
        series.extend(used(finding).into_iter().map(cause));
        series.push(Series::measured("sum", sum).labeled(label));
    }
    Panel { y: Axis::linear(finding.run.title.clone(), "J"), series }
}

fn table(findings: &[&Account]) -> Table {
    let with_books = findings.iter().find(|finding| finding.remainder.is_some());
    let names: Vec<String> = with_books.map_or(Vec::new(), |f| f.accounts.clone());
    let matters = |k: &usize| {
        findings.iter().any(|finding| used(finding).iter().any(|(other, _)| other == k))
    };
    let shown: Vec<usize> = (0..names.len()).filter(matters).collect();
    let mut columns = vec![Column::words("run"), Column::numbers("change", "J")];
    columns.extend(shown.iter().map(|&k| Column::numbers(names[k].clone(), "J")));
    columns.extend([
        Column::numbers("remainder", "J"),
        Column::numbers("energy scale", "J"),
        Column::words("ledger"),
    ]);
    let cells = |finding: &&Account| {
        let last = finding.books.last();
        let small = |x: f64| {
            let shown = if x.abs() <= NOTHING * finding.turnover { 0.0 } else { x };
            Cell { value: Some(x), ..Cell::number(shown, 3) }
        };
        let mut cells = vec![Cell::text(&finding.run.title)];
        cells.push(last.map_or(Cell::text("–"), |book| small(book.kinetic + book.potential)));
        let work = |&k: &usize| last.and_then(|book| book.accounts.get(k).copied());
        cells.extend(shown.iter().map(|k| work(k).map_or(Cell::text("–"), small)));
        cells.push(finding.remainder.map_or(Cell::text("–"), |rest| Cell::number(rest, 2)));
        cells.push(Cell::number(finding.turnover, 3));
        cells.push(match (&finding.ending, balances(finding)) {
            (Some(why), _) => Cell::text(why).marked(Mark::Bad),
            (None, None) => Cell::text("not accounted"),
            (None, Some(true)) => Cell::text("balances").marked(Mark::Good),
            (None, Some(false)) => Cell::text("does not balance").marked(Mark::Bad),
        });
        cells
    };
    Table {
        title: "The ledger of each run".into(),
        how_to_read: "*change*: the change of kinetic plus potential energy over the run, which is the sum of \
         the entries. *remainder*: the largest deviation from this sum at any time. *energy scale*: the \
         largest kinetic energy or change of potential energy. *ledger*: balances if the remainder is a \
         rounding error of the energies from which it was computed. *not accounted*: this scheme does not \
         record the forces."
            .into(),
        columns,
        rows: findings.iter().map(cells).collect(),
        ..Table::default()
    }
}
