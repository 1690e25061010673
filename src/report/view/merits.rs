//! One run, measured in six ways.

use super::Document;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Table, markup};
use crate::report::study::merits::{Curve, Study};

pub(super) fn section(document: &mut Document, studies: &[Study]) {
    if studies.is_empty() {
        return;
    }
    document.open("merits", "One run, and six opinions on how far it got");
    document.text(
        "The same iterates of Gauss-Seidel, measured by the merit functions of different codes. \
         Factors between the curves are a matter of units and norms; that one of them stays where \
         it is is not: the chapter's stop test measures $w$, which at a solution is not zero where \
         a bound holds (E04).",
    );
    for study in studies {
        document.figure(figure(study));
        document.table(&format!("merits_{}", study.scene), table(study));
    }
}

fn figure(study: &Study) -> Lines {
    let series = |curve: &Curve| {
        let points = curve.values.iter().enumerate().map(|(k, &v)| (k as f64, v)).collect();
        Series::measured(curve.name.clone(), points)
    };
    Lines {
        id: format!("merits_{}", study.scene),
        title: format!("{}: merits by sweep", study.title),
        caption: "A measure of w alone cannot fall where a bound holds at the solution.".into(),
        x: Axis::linear("sweep", ""),
        panels: vec![Panel {
            y: Axis::log("merit", "its own unit"),
            series: study.curves.iter().map(series).collect(),
        }],
    }
}

fn table(study: &Study) -> Table {
    let cells = |curve: &Curve| {
        let last = curve.values.last().copied().unwrap_or(f64::NAN);
        vec![Cell::text(&curve.name), Cell::text(&curve.definition), Cell::number(last, 3)]
    };
    Table {
        title: format!("Merits and their definitions: {}", markup::literal(&study.scene)),
        how_to_read: "The value after the last sweep of the figure.".into(),
        columns: vec![
            Column::words("merit"),
            Column::words("definition"),
            Column::numbers("at the end", ""),
        ],
        rows: study.curves.iter().map(cells).collect(),
        files: Vec::new(),
    }
}
