//! What a sweep costs.

use super::goal::{self, Asked, Goal};
use crate::study::sweep_speed::{
    COLUMNS, Checked, EIGHT_PAIRS, Finding, Plan, ROW_BY_ROW, ROWS, Run, Times,
};
use crate::study::timing::Time;
use lcplab::plot::{Axis, Bar, Bars};
use lcplab::report::page::{Cell, Column, Mark, Table};
use lcplab::report::view::attempt::{anchor, tolerance};
use lcplab::report::view::{Document, Outcome, View};

impl View for Plan {
    const TITLE: &'static str = "What a sweep costs";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(
            "A fast form of a sweep is worth nothing if it is another sweep. So before a form is timed, its \
             iterates after eleven sweeps are held against those of the plain loop over the rows of A, in the \
             same order; a form that differs by more than rounding is not timed.",
        );
        document.table("sweep_speed", agreement(findings));
        for finding in findings.iter().filter(|finding| !finding.tolerances.is_empty()) {
            let id = format!("sweep_speed_{}_sweeps", anchor(&finding.problem));
            document.table(&id, sweeps(finding));
        }
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        let goals: Vec<Goal> = times.iter().flat_map(|times| self.goals(times)).collect();
        let command = "cargo bench -p lcplab-benches --bench dense_sweep --bench tower_sweep";
        document.table("sweep_goals", goal::table("Sweeps: goals", command, &goals));
        let dense: Vec<&Times> = times.iter().filter(|times| times.read.is_some()).collect();
        if !dense.is_empty() {
            document.table("sweep_times_dense", beside_a_read(&dense));
        }
        for times in times.iter().filter(|times| times.read.is_none()) {
            document.figure(a_row(times));
            let id = format!("sweep_times_{}", anchor(&times.problem));
            document.table(&id, to_tolerance(times));
        }
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let forms = || findings.iter().flat_map(|finding| &finding.forms);
        let agree = forms().filter(|form| form.agrees()).count();
        let says = format!("{agree} of {} forms sweep as the plain loop does", forms().count());
        Outcome { good: agree == forms().count(), says }
    }
}

/// The run of a form with the widest instructions.
fn widest<'a>(times: &'a Times, form: &str) -> Option<&'a Run> {
    times.runs.iter().rfind(|run| run.form == form)
}

/// Nanoseconds a row by the best sweep.
fn nanoseconds(run: &Run, rows: usize) -> f64 {
    1e9 * run.sweep.best / rows as f64
}

impl Plan {
    fn goals(&self, times: &Times) -> Vec<Goal> {
        let goal = |what: String, asked, unit, measured| Goal { what, asked, unit, measured };
        if let Some(read) = times.read {
            let of_read = |form: &str| Some(widest(times, form)?.sweep.best / read.best);
            let by = |form: &str, most| {
                let what = format!("{}: a sweep {form}", times.problem);
                goal(what, Asked::AtMost(most), "reads of A", of_read(form))
            };
            return vec![by(ROWS, self.goal.rows), by(COLUMNS, self.goal.columns)];
        }
        let a_row = widest(times, EIGHT_PAIRS).map(|run| nanoseconds(run, times.rows));
        // At the smallest of the tolerances that both reach.
        let to = |form, k: usize| *widest(times, form)?.to.get(k)?;
        let faster = |k| Some(to(ROW_BY_ROW, k)? / to(EIGHT_PAIRS, k)?);
        let reached = (0..times.tolerances.len()).rev().find_map(|k| Some((k, faster(k)?)));
        let what = match reached {
            Some((k, _)) => format!("to {} of the first residual", tolerance(times.tolerances[k])),
            None => "to a tolerance".into(),
        };
        vec![
            goal(
                format!("{}: a sweep by {EIGHT_PAIRS}", times.problem),
                Asked::AtMost(self.goal.row),
                "ns a row",
                a_row,
            ),
            goal(
                format!("{}: {EIGHT_PAIRS} {what}", times.problem),
                Asked::AtLeast(self.goal.faster),
                "times as fast as row by row",
                reached.map(|(_, faster)| faster),
            ),
        ]
    }
}

fn agreement(findings: &[Finding]) -> Table {
    let row = |finding: &Finding, form: &Checked| {
        let mark = if form.agrees() { Mark::Good } else { Mark::Bad };
        let difference = match form.difference {
            0.0 => Cell::text("0"),
            difference => Cell::number(difference, 2),
        };
        let bits = if form.same_bits { "the same" } else { "differ" };
        vec![
            Cell::text(&finding.problem),
            Cell::count(finding.rows),
            Cell::count(finding.stored),
            Cell::text(&form.form),
            difference,
            Cell::text(bits),
            Cell::text(if form.agrees() { "agrees" } else { "differs: not timed" }).marked(mark),
        ]
    };
    let rows =
        |finding: &Finding| finding.forms.iter().map(|f| row(finding, f)).collect::<Vec<_>>();
    Table {
        title: "Forms of a sweep beside the plain loop".into(),
        how_to_read: "*difference*: the largest one after eleven sweeps from 0, in parts of the largest |x|. \
                      *bits*: with all instructions that the processor has, the narrow and the wide."
            .into(),
        columns: vec![
            Column::words("problem"),
            Column::numbers("rows", ""),
            Column::numbers("entries of A", ""),
            Column::words("form"),
            Column::numbers("difference", ""),
            Column::words("bits"),
            Column::words("agreement"),
        ],
        rows: findings.iter().flat_map(rows).collect(),
        ..Table::default()
    }
}

fn to_each(tolerances: &[f64], unit: &str) -> Vec<Column> {
    let column = |at: &f64| Column::numbers(format!("to {}", tolerance(*at)), unit);
    tolerances.iter().map(column).collect()
}

fn sweeps(finding: &Finding) -> Table {
    let row = |form: &Checked| {
        let counts = form.sweeps.iter().map(|n| n.map_or(Cell::text("–"), Cell::count));
        [Cell::text(&form.form)].into_iter().chain(counts).collect()
    };
    let mut columns = vec![Column::words("form")];
    columns.extend(to_each(&finding.tolerances, "sweeps"));
    Table {
        title: format!("{}: sweeps to a part of the first residual", finding.problem),
        how_to_read: "Of the natural residual, which is looked at every twenty sweeps. Eight pairs take the rows in \
                      another order, layer by layer, and need another number."
            .into(),
        columns,
        rows: finding.forms.iter().map(row).collect(),
        ..Table::default()
    }
}

fn instructions(run: &Run) -> Cell {
    Cell::text(run.width.as_deref().unwrap_or("the compiler's"))
}

fn beside_a_read(dense: &[&Times]) -> Table {
    let rows = |times: &&Times| {
        let Some(read) = times.read else { return Vec::new() };
        let cells = |form: Cell, width: Cell, time: Time| {
            vec![
                Cell::count(times.rows),
                form,
                width,
                Cell::number(1e6 * time.median, 3),
                Cell::number(1e6 * time.best, 3),
                Cell::number(time.median / read.median, 3),
                Cell::number(time.best / read.best, 3),
            ]
        };
        let first =
            cells(Cell::text("one read of A, the fastest way"), Cell::text("the widest"), read);
        let runs =
            times.runs.iter().map(|run| cells(Cell::text(&run.form), instructions(run), run.sweep));
        [first].into_iter().chain(runs).collect()
    };
    Table {
        title: "A sweep over a dense A beside one read of A".into(),
        how_to_read: "A read adds up the entries of A, in the memory that the sweeps read too; the fastest of three ways \
                      counts. Less than that no sweep by rows can cost, since it reads every entry. By \
                      columns, rows that do not change are not read. The fourth to the eleventh sweep from 0, in the mean."
            .into(),
        columns: vec![
            Column::numbers("n", ""),
            Column::words("form"),
            Column::words("instructions"),
            Column::numbers("median", "µs"),
            Column::numbers("best", "µs"),
            Column::numbers("of one read, by medians", ""),
            Column::numbers("by bests", ""),
        ],
        rows: dense.iter().flat_map(rows).collect(),
        ..Table::default()
    }
}

fn a_row(times: &Times) -> Bars {
    let name = |run: &Run| match &run.width {
        Some(width) => format!("{}, {width}", run.form),
        None => run.form.clone(),
    };
    let bar = |run: &Run| Bar { name: name(run), value: nanoseconds(run, times.rows) };
    Bars {
        id: format!("sweep_{}_row", anchor(&times.problem)),
        title: format!("{}: a sweep, by the row", times.problem),
        caption: "By the best of all rounds. The upper bars have A assembled or wait for each row's sum; \
                  the others take eight pairs of bodies at a time."
            .into(),
        x: Axis::linear("time", "ns a row"),
        bars: times.runs.iter().map(bar).collect(),
    }
}

fn to_tolerance(times: &Times) -> Table {
    let row = |run: &Run| {
        let median = 1e9 * run.sweep.median / times.rows as f64;
        let to = run.to.iter().map(|s| s.map_or(Cell::text("–"), |s| Cell::number(1e3 * s, 3)));
        [
            Cell::text(&run.form),
            instructions(run),
            Cell::number(median, 3),
            Cell::number(nanoseconds(run, times.rows), 3),
        ]
        .into_iter()
        .chain(to)
        .collect()
    };
    let mut columns = vec![
        Column::words("form"),
        Column::words("instructions"),
        Column::numbers("median", "ns a row"),
        Column::numbers("best", "ns a row"),
    ];
    columns.extend(to_each(&times.tolerances, "ms"));
    Table {
        title: format!("{}: a sweep, and the time to a tolerance", times.problem),
        how_to_read:
            "The last columns are the counted sweeps times the best sweep: another order needs \
                      another number of them. A dash: not reached within the sweeps allowed."
                .into(),
        columns,
        rows: times.runs.iter().map(row).collect(),
        ..Table::default()
    }
}
