//! Problem files × solvers as tables.

use std::collections::BTreeMap;

use super::{Outcome, ReportPage, View};
use crate::number::{counted, tabular};
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::solved::{Answer, Column, File, Plan};

impl View for Plan {
    const TITLE: &'static str = "Problem files solved";

    fn show(&self, findings: &[Vec<File>], document: &mut ReportPage) {
        let files = findings.concat();
        document.table("by_solver", by_solver(self, &files));
        document.table("by_file", by_file(self, &files));
    }

    fn outcome(&self, findings: &[Vec<File>]) -> Outcome {
        let files = findings.concat();
        let solved = self.solvers.iter().enumerate().map(|(k, column)| {
            let (accepted, asked) = counts(&files, k);
            format!("{} {accepted} of {asked}", heading(column))
        });
        let solved: Vec<String> = solved.collect();
        let false_claims = answers(&files).filter(|answer| is_false(answer)).count();
        let says = format!(
            "{}, of which each solver solves: {}; {}",
            counted(files.len(), "file"),
            solved.join(", "),
            counted(false_claims, "false claim")
        );
        Outcome { good: false_claims == 0 && !files.is_empty(), says }
    }
}

/// Whether the solver claims a solution that the judge rejects.
fn is_false(answer: &Answer) -> bool {
    answer.is_claim && !answer.is_accepted
}

fn answers(files: &[File]) -> impl Iterator<Item = &Answer> {
    files.iter().flat_map(|file| file.answers.iter().flatten())
}

/// The solver, and its friction model if it is not that of each file.
fn heading(column: &Column) -> String {
    match column.model {
        Some(model) => format!("{} ({model})", column.solver),
        None => column.solver.clone(),
    }
}

/// How many answers of this solver the judge accepts, and for how many files it is made.
fn counts(files: &[File], solver: usize) -> (usize, usize) {
    let own = || files.iter().filter_map(|file| file.answers[solver].as_ref());
    (own().filter(|answer| answer.is_accepted).count(), own().count())
}

/// One row per solver.
fn by_solver(plan: &Plan, files: &[File]) -> Table {
    let row = |(k, column): (usize, &Column)| {
        let (accepted, asked) = counts(files, k);
        let mut others: BTreeMap<&str, usize> = BTreeMap::new();
        let mut worst = 0.0_f64;
        for answer in files.iter().filter_map(|file| file.answers[k].as_ref()) {
            if !answer.is_accepted {
                *others.entry(&answer.status).or_default() += 1;
                worst = worst.max(answer.residual);
            }
        }
        let reasons: Vec<String> =
            others.iter().map(|(status, count)| format!("{status}: {count}")).collect();
        let worst = if others.is_empty() { Cell::text("–") } else { Cell::number(worst, 2) };
        let law = column.model.map_or("own".to_string(), |model| model.to_string());
        vec![
            Cell::text(&column.solver),
            Cell::text(law),
            Cell::count(asked),
            Cell::count(accepted),
            Cell::text(reasons.join(", ")),
            worst,
        ]
    };
    Table::new(
        format!("Solvers on {}", counted(files.len(), "problem file")),
        "*friction model*: own is that of each file. *files*: those that the solver is made for; the others \
         have another form. *accepted*: answers that the judge accepts. *not accepted*: the solver's own \
         status of the other answers. *largest residual*: the scaled residual of the worst of these.",
        "solver | friction model | #files | #accepted | not accepted | #largest residual",
        plan.solvers.iter().enumerate().map(row).collect(),
    )
}

/// One row per file.
fn by_file(plan: &Plan, files: &[File]) -> Table {
    let row = |file: &File| {
        let answers = file.answers.iter().map(cell);
        [Cell::text(&file.name), Cell::count(file.rows)].into_iter().chain(answers).collect()
    };
    let headings: Vec<String> = plan.solvers.iter().map(heading).collect();
    Table::new(
        "Each problem file and solver",
        "*accepted*: the judge accepts the answer. Otherwise the solver's status, with the scaled residual \
         of its answer; – if the solver is not made for this problem.",
        &format!("file | #rows | {}", headings.join(" | ")),
        files.iter().map(row).collect(),
    )
}

fn cell(answer: &Option<Answer>) -> Cell {
    match answer {
        None => Cell::text("–"),
        Some(answer) if answer.is_accepted => Cell::text("accepted").marked(Mark::Good),
        Some(answer) => {
            let text = format!("{}, {}", answer.status, tabular(answer.residual, 2));
            let mark = if is_false(answer) { Mark::Bad } else { Mark::Note };
            Cell::text(text).marked(mark)
        }
    }
}
