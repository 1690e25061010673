//! The force through a column, a pair of balls and a chain, contact by contact and joint by joint.

use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::force_path::{Finding, Line, Path, Plan};

/// A measured remainder may differ from the predicted one by this part.
const AGREES: f64 = 1e-6;
/// Below this part nothing is left out that a solver would go on for.
const CONVERGED: f64 = 1e-7;

impl View for Plan {
    const TITLE: &'static str = "The way of a force through a stack and along a chain";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(
            "A contact of a column must carry all that stands above it, a joint of a hanging chain all \
             that hangs below it. No solver is needed to know that. Below is what solvers have found \
             after the first step, all starting from 0.",
        );
        let columns = |pairs: bool| {
            findings.iter().filter(move |finding| match finding.line {
                Line::Column { bodies, .. } => (bodies == 2) == pairs,
                Line::Chain { .. } => false,
            })
        };
        if columns(false).next().is_some() {
            document.figure(column_figure(columns(false)));
        }
        if columns(true).next().is_some() {
            document.text(
                "For two balls the part that is left out is known: a sweep of Gauss-Seidel shrinks the \
                 error to",
            );
            document.equation("\\rho_{GS} = \\frac{r}{1 + r}", "two bodies, mass ratio r");
            document.figure(pair_figure(columns(true)));
        }
        for finding in findings {
            if let Line::Chain { title } = &finding.line {
                document.text(
                    "The chain is the same the other way round: the weight hangs at its far end, and \
                     every joint on the way up must carry it. Sweeps go from the top down, so that a \
                     sweep hands the load up by one joint, and no more.",
                );
                document.figure(chain_figure(title, finding));
            }
        }
        document.table("force_path", table(findings));
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let paths = || findings.iter().flat_map(|f| f.paths.iter().map(move |path| (f, path)));
        let known: Vec<bool> = paths().filter_map(|(f, path)| agrees(f, path)).collect();
        let held = known.iter().filter(|held| **held).count();
        let says = format!("{held} of {} forces between two balls as predicted", known.len());
        Outcome { good: held == known.len(), says }
    }
}

/// Whether as much is left out as theory says, where it says something. Sweeps end early once the
/// answer is within the tolerance.
fn agrees(finding: &Finding, path: &Path) -> Option<bool> {
    let (left, predicted) = (finding.left_out(path), finding.predicted(path)?);
    Some((left - predicted).abs() <= AGREES * predicted + CONVERGED)
}

/// Force over contact or joint, theory among the curves.
fn panel(heading: String, finding: &Finding) -> Panel {
    let points = |forces: &[f64]| {
        forces.iter().enumerate().map(|(k, force)| ((k + 1) as f64, *force)).collect::<Vec<_>>()
    };
    let measured =
        finding.paths.iter().map(|p| Series::measured(p.name.clone(), points(&p.forces)));
    let theory = Series::theory("theory: the weight carried", points(&finding.expected));
    Panel { y: Axis::linear(heading, "N"), series: measured.chain([theory]).collect() }
}

fn column_figure<'a>(findings: impl Iterator<Item = &'a Finding>) -> Lines {
    let panel = |finding: &Finding| match finding.line {
        Line::Column { ratio, .. } => {
            panel(format!("force, top {} times as heavy", readable(ratio, 4)), finding)
        }
        Line::Chain { .. } => panel("force".into(), finding),
    };
    Lines {
        id: "force_path_columns".into(),
        title: "The force through a column of balls".into(),
        caption:
            "Contact 1 is the ground's. A curve below the dashed line lets its balls fall: they \
                  are carried in part only. Sweeps go from the ground up."
                .into(),
        x: Axis::linear("contact, from the ground up", ""),
        panels: findings.map(panel).collect(),
    }
}

fn pair_figure<'a>(findings: impl Iterator<Item = &'a Finding>) -> Lines {
    let mut series = Vec::new();
    for finding in findings {
        let Line::Column { ratio, .. } = finding.line else { continue };
        let name = format!("r = {}", readable(ratio, 5));
        let sweeps = || finding.paths.iter().filter_map(|path| Some((path.sweeps? as f64, path)));
        let measured = sweeps().map(|(k, path)| (k, finding.left_out(path)));
        let theory = sweeps().filter_map(|(k, path)| Some((k, finding.predicted(path)?)));
        series.push(Series::points(name.clone(), measured.collect()));
        series.push(Series::theory(format!("theory, {name}"), theory.collect()));
    }
    Lines {
        id: "force_path_pairs".into(),
        title: "What is left out of the force between two balls".into(),
        caption: "The upper ball is r times as heavy as the lower one. Lines are $\\rho_{GS}^k$. \
                  Sweeps end early once the answer is within the solver's tolerance."
            .into(),
        x: Axis::log("sweeps k", ""),
        panels: vec![Panel { y: Axis::log("part of the force left out", ""), series }],
    }
}

fn chain_figure(title: &str, finding: &Finding) -> Lines {
    Lines {
        id: "force_path_chain".into(),
        title: title.to_string(),
        caption: "Joint 1 is the one that holds the chain. The load comes in at the right.".into(),
        x: Axis::linear("joint, from the top down", ""),
        panels: vec![panel("pull of the joint".into(), finding)],
    }
}

fn table(findings: &[Finding]) -> Table {
    let rows = findings.iter().flat_map(|f| f.paths.iter().map(move |path| cells(f, path)));
    Table {
        title: "What is left out of the forces".into(),
        how_to_read: "*left out*: the largest part of its load that a contact or joint does not carry \
                      (or carries too much). *predicted*: $(r/(1 + r))^k$ for two balls; for longer \
                      lines there is no such short formula."
            .into(),
        columns: vec![
            Column::words("line"),
            Column::words("solver"),
            Column::numbers("at the support", "N"),
            Column::numbers("must be", "N"),
            Column::numbers("left out", ""),
            Column::numbers("predicted", ""),
            Column::words("agreement"),
        ],
        rows: rows.collect(),
        ..Table::default()
    }
}

fn cells(finding: &Finding, path: &Path) -> Vec<Cell> {
    let line = match &finding.line {
        Line::Column { bodies, ratio } => format!("{bodies} balls, r = {}", readable(*ratio, 5)),
        Line::Chain { title } => title.clone(),
    };
    let support = |forces: &[f64]| forces.first().copied().unwrap_or(f64::NAN);
    let (left, predicted) = (finding.left_out(path), finding.predicted(path));
    let shown = if left < 1e-9 { 0.0 } else { left };
    let agreement = match agrees(finding, path) {
        Some(true) => Cell::text("agrees").marked(Mark::Good),
        Some(false) => Cell::text("differs").marked(Mark::Bad),
        None if left <= 1e-6 => Cell::text("all is carried").marked(Mark::Good),
        None => Cell::text("–"),
    };
    vec![
        Cell::text(line),
        Cell::text(&path.name),
        Cell::number(support(&path.forces), 5),
        Cell::number(support(&finding.expected), 5),
        Cell { value: Some(left), ..Cell::number(shown, 4) },
        predicted.map_or(Cell::text("–"), |p| Cell::number(p, 4)),
        agreement,
    ]
}
