//! How deep a stack with a heavy top sinks, by solver and mass ratio.

use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::sinking::{Finding, Plan, Run};

/// A stack that is squeezed by more than this (mm) has visibly sunk.
const VISIBLE: f64 = 10.0;
/// A stack whose top has moved by more than this (m) has fallen over.
const FALLEN: f64 = 0.5;

impl View for Plan {
    const TITLE: &'static str = "Why a stack with a heavy top sinks";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        for finding in findings {
            if let Some(footage) = &finding.footage {
                let caption = format!(
                    "The stack with a top {} times as heavy, by each solver at the same instants. Play it: a load that is \
                     carried stays where it is.",
                    readable(finding.ratio, 4)
                );
                document.footage(footage, &caption);
            }
        }
        document.text(format!(
            "{} cubes of 1 m stand on each other; the top one is $r$ times as heavy as the others. The \
             ground must carry all of them, but a sweep hands a load down only little by little, and \
             less the lighter the cubes are that must pass it on. What is not yet handed on when the \
             sweeps end is not carried, and what is not carried falls. Overlap is pushed out again (β), and \
             a light cube under a heavy one too hard: the stack is thrown. {} Errors of position are fed back ($\\beta = 0.2$) in all runs.",
            self.boxes,
            match self.solvers.iter().all(|contender| contender.warm) {
                true => "Each step starts from the impulses of the step before, so that sweeps go on where they stopped.",
                false =>
                    "Each step starts from the impulses of the step before, so that sweeps go on where they \
                     stopped; runs *from 0* begin each step without them.",
            }
        ));
        document.figure(figure(self, findings));
        document.table("sinking", table(self, findings));
    }

    /// Too few sweeps may let it sink, which is what the study shows; without a limit it must stand.
    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let runs = findings.iter().flat_map(|finding| self.solvers.iter().zip(&finding.runs));
        let unlimited = runs.filter(|(contender, _)| contender.sweeps.is_none());
        let unlimited: Vec<&Run> = unlimited.map(|(_, run)| run).collect();
        let (stands, all) =
            (unlimited.iter().filter(|run| fate(run).is_none()).count(), unlimited.len());
        let says = format!("the stack stands in {stands} of {all} runs without a limit of sweeps");
        Outcome { good: stands == all, says }
    }
}

fn figure(settings: &Plan, findings: &[Finding]) -> Lines {
    let curve = |run: &Run| {
        Series::measured(run.name.clone(), run.history.curve(|sample| 1e3 * sample.penetration))
    };
    let panel = |finding: &Finding| Panel {
        y: Axis::linear(format!("penetration, r = {}", readable(finding.ratio, 4)), "mm"),
        series: finding.runs.iter().map(curve).collect(),
    };
    Lines {
        id: "sinking".into(),
        title: format!("Deepest overlap in a stack of {}", settings.boxes),
        caption: "A panel for each mass ratio, the heaviest load at the bottom; the scales differ. A stack that is \
                  carried stays at 0.".into(),
        x: Axis::linear("time", "s"),
        panels: findings.iter().map(panel).collect(),
    }
}

fn table(settings: &Plan, findings: &[Finding]) -> Table {
    let rows = findings.iter().flat_map(|f| f.runs.iter().map(move |run| cells(f.ratio, run)));
    Table {
        title: "Who carries the heavy top".into(),
        how_to_read: format!(
            "*carried*: the force of the ground, in parts of the weight of all cubes; it should be 1 in \
             every step, and is more while the ground stops a fall. *sweeps*: or pivots, mean over the steps. *top*: \
             where the heavy cube is after {} s. The *outcome* is the first that applies: *falls over*, the top has moved \
             by more than {} m; *is thrown up*, it ends higher than it began by more than {} mm; *sinks*, the deepest \
             overlap is over {2} mm.",
            readable(settings.duration, 3),
            readable(FALLEN, 2),
            readable(VISIBLE, 2)
        ),
        columns: vec![
            Column::numbers("r", ""),
            Column::words("solver"),
            Column::numbers("sweeps", "a step"),
            Column::numbers("carried, first step", ""),
            Column::numbers("carried, last step", ""),
            Column::numbers("deepest overlap", "mm"),
            Column::numbers("top rose", "mm"),
            Column::numbers("and aside", "mm"),
            Column::words("outcome"),
        ],
        rows: rows.collect(),
        ..Table::default()
    }
}

/// What becomes of the stack; none if it stands.
fn fate(run: &Run) -> Option<&str> {
    let history = &run.history;
    match &history.ending {
        Some(why) => Some(why),
        None if run.top.iter().any(|way| way.abs() > FALLEN) => Some("falls over"),
        None if -1e3 * run.top[0] > VISIBLE => Some("is thrown up"),
        None if 1e3 * history.penetration > VISIBLE => Some("sinks"),
        None => None,
    }
}

fn cells(ratio: f64, run: &Run) -> Vec<Cell> {
    let history = &run.history;
    let outcome = match fate(run) {
        Some(fate) => Cell::text(fate).marked(Mark::Bad),
        None => Cell::text("stands").marked(Mark::Good),
    };
    vec![
        Cell::number(ratio, 4),
        Cell::text(&run.name),
        Cell::number(history.passes as f64 / history.steps.max(1) as f64, 3),
        Cell::number(run.carried[0], 3),
        Cell::number(run.carried[1], 3),
        depth(history.penetration),
        depth(-run.top[0]),
        depth(run.top[1]),
        outcome,
    ]
}

/// In mm; what is rounding is 0.
fn depth(metres: f64) -> Cell {
    let shown = if metres.abs() < 1e-9 { 0.0 } else { 1e3 * metres };
    Cell { value: Some(1e3 * metres), ..Cell::number(shown, 3) }
}
