//! What an exact answer costs where A is large and sparse.

use super::goal::{self, Asked, Goal};
use crate::study::sparse_speed::{Finding, Judged, Plan, Times, YARDSTICK};
use lcplab::report::page::{Cell, Column, Mark, Table};
use lcplab::report::study::attempt::Outcome;
use lcplab::report::view::attempt::tolerance;
use lcplab::report::view::{Document, Outcome as Verdict, View};

impl View for Plan {
    const TITLE: &'static str = "Exact where A is large and sparse";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(format!(
            "A net is equations only, a pile thousands of contacts between hundreds of bodies; the \
             friction bounds of a pile are frozen where {} sweeps have led to. An interior point needs one or \
             some twenty factorisations, and what it factorises is a choice: A itself, by *rows*, or with A in its \
             factors Ĵ Ĵᵀ a matrix of six rows a body, by *velocities*. The order of elimination is found by \
             approximate minimum degree where that pays. Clarabel has the same choice: a quadratic program in \
             x, or one in x and v with the equations v = Ĵᵀx. Each side is asked for a scaled residual of {}, \
             clarabel for no smaller gap than it needs to arrive there.",
            self.sweeps,
            tolerance(self.tolerance)
        ));
        document.table("sparse", claims(findings));
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        let goals: Vec<Goal> = times.iter().map(goal_of).collect();
        let (title, command) =
            ("Large and sparse: goals", "cargo bench -p lcplab-benches --bench sparse");
        document.table("sparse_goals", goal::table(title, command, &goals));
        document.table("sparse_times", seconds(times));
    }

    fn outcome(&self, findings: &[Finding]) -> Verdict {
        let ours = || {
            let answers = findings.iter().flat_map(|finding| &finding.answers);
            answers.map(|judged| &judged.answer).filter(|a| !YARDSTICK.contains(&a.solver.as_str()))
        };
        let solved = ours().filter(|answer| answer.outcome.is_solved()).count();
        let refuted = ours().filter(|answer| answer.outcome == Outcome::Refuted).count();
        let says = format!(
            "{solved} of {} answers to large sparse problems accepted, {refuted} claims refuted",
            ours().count()
        );
        Verdict { good: refuted == 0, says }
    }
}

/// Our better time beside clarabel's better one.
fn goal_of(times: &Times) -> Goal {
    let [ours, clarabel] = times.better();
    Goal {
        what: format!("{}: the better form", times.problem),
        asked: Asked::AtMost(times.goal),
        unit: "of clarabel's better time",
        measured: ours.zip(clarabel).map(|(ours, clarabel)| ours / clarabel),
    }
}

fn claims(findings: &[Finding]) -> Table {
    let row = |finding: &Finding, judged: &Judged| {
        let answer = &judged.answer;
        let mark = match &answer.outcome {
            outcome if outcome.is_solved() => Mark::Good,
            Outcome::Refuted => Mark::Bad,
            _ => Mark::Note,
        };
        vec![
            Cell::text(&finding.problem),
            Cell::count(finding.rows),
            Cell::count(finding.stored),
            Cell::count(finding.velocities),
            Cell::text(&answer.solver),
            Cell::text(answer.outcome.words()).marked(mark),
            Cell::number(answer.residual, 2),
            Cell::number(judged.natural, 2),
            Cell::count(answer.iterations),
            judged.asked.map_or(Cell::text("–"), |asked| Cell::number(asked, 1)),
        ]
    };
    let rows = |finding: &Finding| {
        finding.answers.iter().map(|judged| row(finding, judged)).collect::<Vec<_>>()
    };
    Table {
        title: "Large and sparse: what the judge says".into(),
        how_to_read:
            "*natural residual*: max |x − Π(x − w)|, which mixes N s and m/s. *asked*: the gap and \
                      feasibility that clarabel was asked for."
                .into(),
        columns: vec![
            Column::words("problem"),
            Column::numbers("rows", ""),
            Column::numbers("entries of A", ""),
            Column::numbers("velocities", ""),
            Column::words("solver"),
            Column::words("judge"),
            Column::numbers("scaled residual", ""),
            Column::numbers("natural residual", ""),
            Column::numbers("iterations", ""),
            Column::numbers("asked", ""),
        ],
        rows: findings.iter().flat_map(rows).collect(),
        ..Table::default()
    }
}

fn seconds(times: &[Times]) -> Table {
    let row = |times: &Times| {
        let [_, clarabel] = times.better();
        let problem = times.problem.clone();
        let timed = times.solvers.iter().map(move |(solver, time)| {
            vec![
                Cell::text(&problem),
                Cell::text(solver),
                Cell::number(1e3 * time.median, 3),
                Cell::number(1e3 * time.best, 3),
                clarabel.map_or(Cell::text("–"), |best| Cell::number(time.best / best, 3)),
            ]
        });
        timed.collect::<Vec<_>>()
    };
    Table {
        title: "Time to an exact answer, large and sparse".into(),
        how_to_read: "From the matrices to x: the order of elimination and, for clarabel, the writing of its \
                      program are in it. Only answers that the judge accepts are here."
            .into(),
        columns: vec![
            Column::words("problem"),
            Column::words("solver"),
            Column::numbers("median", "ms"),
            Column::numbers("best", "ms"),
            Column::numbers("of clarabel's better one, by bests", ""),
        ],
        rows: times.iter().flat_map(row).collect(),
        ..Table::default()
    }
}
