//! What an exact answer costs where contacts are redundant.

use super::attempt::tolerance;
use super::goal::{self, Asked, Goal};
use super::{Document, Outcome as Verdict, View};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::attempt::Outcome;
use crate::report::study::contest::Answer;
use crate::report::study::singular::{Finding, Plan, Times, YARDSTICK};

impl View for Plan {
    const TITLE: &'static str = "Right where contacts are redundant";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(format!(
            "A cube on a cube touches it at four corners, where three would hold it: A is singular, the \
             impulses are not unique, and a pivot that should vanish is rounding. Each solver is asked for a \
             scaled residual of {}, its claim is judged; nobody may add to the diagonal but where \
             the problem says so (*regularised*). Clarabel, an interior-point code, is the yardstick: it is \
             asked for no smaller gap than it needs to arrive there too.",
            tolerance(self.tolerance)
        ));
        document.table("singular", claims(findings));
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        let goals: Vec<Goal> = self.solvers.iter().map(|name| self.goal_of(name, times)).collect();
        let command = "cargo bench --bench singular";
        let title = "Exact answers to redundant contacts: goals";
        document.table("singular_goals", goal::table(title, command, &goals));
        document.figure(self.figure(times));
        document.table("singular_times", seconds(times));
    }

    fn outcome(&self, findings: &[Finding]) -> Verdict {
        let ours = || findings.iter().flat_map(|f| &f.answers).filter(|a| a.solver != YARDSTICK);
        let solved = ours().filter(|answer| answer.outcome.is_solved()).count();
        let refuted = ours().filter(|answer| answer.outcome == Outcome::Refuted).count();
        let says = format!(
            "{solved} of {} answers to redundant contacts accepted, {refuted} claims refuted",
            ours().count()
        );
        Verdict { good: refuted == 0, says }
    }
}

/// How many times clarabel's a solver's time is, by the best of all rounds.
fn ratio(times: &Times, solver: &str) -> Option<f64> {
    Some(times.of(solver)?.best / times.yardstick()?.best)
}

impl Plan {
    /// The worst of the problems that clarabel solves; a solver that fails one of all has no such time.
    fn goal_of(&self, solver: &str, times: &[Times]) -> Goal {
        let ratios: Vec<f64> = times.iter().filter_map(|times| ratio(times, solver)).collect();
        let failed = times.iter().filter(|times| times.failed.iter().any(|f| f == solver)).count();
        let what = match failed {
            0 => format!("{solver}: worst of {} problems that clarabel solves too", ratios.len()),
            failed => format!("{solver}: no answer to {failed} of {} problems", times.len()),
        };
        let worst = ratios.into_iter().reduce(f64::max);
        Goal {
            what,
            asked: Asked::AtMost(self.goal),
            unit: "of clarabel's time",
            measured: worst.filter(|_| failed == 0),
        }
    }

    fn figure(&self, times: &[Times]) -> Lines {
        let of = |solver: &String| {
            let point = |times: &Times| Some((times.rows as f64, ratio(times, solver)?));
            Series::points(solver.clone(), times.iter().filter_map(point).collect())
        };
        let rows = || times.iter().map(|times| times.rows as f64);
        let ends = [rows().fold(f64::MAX, f64::min), rows().fold(0.0, f64::max)];
        let at = |value: f64| ends.map(|rows| (rows, value)).to_vec();
        let lines = [
            Series::reference("as fast as clarabel", at(1.0)),
            Series::reference("must", at(self.goal)),
        ];
        Lines {
            id: "singular_times".into(),
            title: "Time to an exact answer, in times of clarabel's".into(),
            caption:
                "A marker each problem, by the best of all rounds; lower is faster. Stacks with \
                      and without friction, singular and regularised, share the axis."
                    .into(),
            x: Axis::log("rows", ""),
            panels: vec![Panel {
                y: Axis::log("time over clarabel's", ""),
                series: self.solvers.iter().map(of).chain(lines).collect(),
            }],
        }
    }
}

fn claims(findings: &[Finding]) -> Table {
    let names = findings.first().map_or(&[][..], |finding| &finding.answers[..]);
    let columns = [Column::words("problem"), Column::numbers("rows", "")]
        .into_iter()
        .chain(names.iter().map(|answer| Column::words(&answer.solver)))
        .chain([Column::numbers("clarabel was asked for", "")]);
    let row = |finding: &Finding| {
        [Cell::text(&finding.problem), Cell::count(finding.rows)]
            .into_iter()
            .chain(finding.answers.iter().map(verdict))
            .chain([Cell::number(finding.asked, 1)])
            .collect()
    };
    Table {
        title: "Redundant contacts: what the judge says".into(),
        how_to_read: "The judge's word and the scaled residual. *proved*: an exact solution with this active \
                      set exists (up to 150 rows are tried)."
            .into(),
        columns: columns.collect(),
        rows: findings.iter().map(row).collect(),
        ..Table::default()
    }
}

fn verdict(answer: &Answer) -> Cell {
    let mark = match &answer.outcome {
        outcome if outcome.is_solved() => Mark::Good,
        Outcome::Refuted => Mark::Bad,
        _ => Mark::Note,
    };
    let text = format!("{}, {}", answer.outcome.words(), tolerance(answer.residual));
    Cell::text(text).marked(mark)
}

fn seconds(times: &[Times]) -> Table {
    let row = |times: &Times| {
        let yardstick = times.yardstick();
        let problem = times.problem.clone();
        let timed = times.solvers.iter().map(move |(solver, time)| {
            let by = |ratio: Option<f64>| ratio.map_or(Cell::text("–"), |r| Cell::number(r, 2));
            vec![
                Cell::text(&problem),
                Cell::text(solver),
                Cell::number(1e3 * time.median, 3),
                Cell::number(1e3 * time.best, 3),
                by(yardstick.map(|clarabel| time.median / clarabel.median)),
                by(yardstick.map(|clarabel| time.best / clarabel.best)),
            ]
        });
        timed.collect::<Vec<_>>()
    };
    Table {
        title: "Time to an exact answer".into(),
        how_to_read: "Setup included, for clarabel the writing of its program too. Only answers that the judge \
                      accepts are here; a run of more than a tenth of a second was not repeated."
            .into(),
        columns: vec![
            Column::words("problem"),
            Column::words("solver"),
            Column::numbers("median", "ms"),
            Column::numbers("best", "ms"),
            Column::numbers("of clarabel's, by medians", ""),
            Column::numbers("by bests", ""),
        ],
        rows: times.iter().flat_map(row).collect(),
        ..Table::default()
    }
}
