//! The same iterates, measured in six ways.

use super::attempt::stem;
use super::{Document, Outcome, View};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Table, markup};
use crate::report::study::merits::{Curve, Plan, Run, Shape};

impl View for Plan {
    const TITLE: &'static str = "One run, and six opinions on how far it got";

    fn show(&self, findings: &[Vec<Run>], document: &mut Document) {
        document.text(
            "The same iterates of Gauss-Seidel, measured by the merit functions of different codes. \
             Factors between the curves are a matter of units and norms; that one of them stays where \
             it is is not: the chapter's stop test measures $w$, which at a solution is not zero where \
             a bound holds (E04). Where there is friction, a second run solves Coulomb's law with \
             circular cones: the codes that measure cones, $K$ with $\\hat w = w + \\mu |w_t| n$, agree up \
             to a factor; those that see a box stay where the slip is oblique, for the box is another \
             law.",
        );
        for study in findings.iter().flatten() {
            document.figure(figure(study));
            document.table(&id(study), table(study));
        }
    }

    fn outcome(&self, _: &[Vec<Run>]) -> Outcome {
        Outcome::undecided()
    }
}

fn id(study: &Run) -> String {
    match study.shape {
        Shape::Box => format!("merits_{}", stem(&study.scene)),
        Shape::Cone => format!("merits_{}_cone", stem(&study.scene)),
    }
}

/// What tells two runs on one scene apart.
fn suffix(study: &Run) -> &'static str {
    match study.shape {
        Shape::Box => "",
        Shape::Cone => ", circular cones",
    }
}

fn figure(study: &Run) -> Lines {
    let series = |curve: &Curve| {
        let points = curve.values.iter().enumerate().map(|(k, &v)| (k as f64, v)).collect();
        Series::measured(curve.name.clone(), points)
    };
    Lines {
        id: id(study),
        title: format!("{}{}: merits by sweep", study.title, suffix(study)),
        caption: "A measure of w alone cannot fall where a bound holds at the solution.".into(),
        x: Axis::linear("sweep", ""),
        panels: vec![Panel {
            y: Axis::log("merit", "its own unit"),
            series: study.curves.iter().map(series).collect(),
        }],
    }
}

fn table(study: &Run) -> Table {
    let cells = |curve: &Curve| {
        let last = curve.values.last().copied().unwrap_or(f64::NAN);
        vec![Cell::text(&curve.name), Cell::text(&curve.definition), Cell::number(last, 3)]
    };
    Table {
        title: format!(
            "Merits and their definitions: {}{}",
            markup::literal(&study.scene),
            suffix(study)
        ),
        how_to_read: "The value after the last sweep of the figure.".into(),
        columns: vec![
            Column::words("merit"),
            Column::words("definition"),
            Column::numbers("at the end", ""),
        ],
        rows: study.curves.iter().map(cells).collect(),
        ..Table::default()
    }
}
