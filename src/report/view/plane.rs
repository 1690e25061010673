//! Paths in the plane of a row.

use super::attempt::{anchor, iterations_in_words, section_id};
use super::{Document, Outcome, View};
use crate::plot::Axis;
use crate::plot::plane::{Path, Plane};
use crate::report::study::plane::{Plan, Row};

impl View for Plan {
    const TITLE: &'static str = "One row on its way to the law";

    fn show(&self, rows: &[Row], document: &mut Document) {
        document.text(
            "What a row asks for is a place on a graph: $x_i$ at its lower bound and $w_i \\ge 0$, or \
             $x_i$ between its bounds and $w_i = 0$, or $x_i$ at its upper bound and $w_i \\le 0$. The \
             graph is drawn in grey. A solver's iterates are points beside it, and the row is satisfied \
             when they come to lie on it.",
        );
        for row in rows {
            let id = format!("{}_{}_{}", section_id(document), anchor(&row.problem), row.row);
            document.figure(figure(id, row));
        }
        document.text(
            "In this plane row i of a sweep is a step along a line of slope $a_{ii}$ down to the graph; \
             then the other rows move, and lift the point off it again, straight up or down: only $w_i$ \
             feels them. Pivoting methods walk along the graph itself and take each segment in one step.",
        );
    }

    fn outcome(&self, _: &[Row]) -> Outcome {
        Outcome::undecided()
    }
}

fn figure(id: String, row: &Row) -> Plane {
    let [lo, hi] = row.bounds;
    let ends: Vec<String> = row
        .paths
        .iter()
        .map(|path| {
            let iterations = iterations_in_words(&path.solver, path.iterations);
            format!("{} {} after {iterations}", path.solver, path.status)
        })
        .collect();
    let path = |path: &crate::report::study::plane::Path| Path {
        name: path.solver.clone(),
        points: path.points.clone(),
    };
    Plane {
        id,
        title: format!("{} ({}, row {})", row.what, row.problem, row.row),
        caption: format!(
            "$(x_i, w_i)$ after each iteration, from the ring to the black disc, beside the graph of the \
             law. At the end: {}.",
            ends.join("; ")
        ),
        x: Axis::linear("x", "N s"),
        w: Axis::linear("w", "m/s"),
        bounds: (lo.unwrap_or(f64::NEG_INFINITY), hi.unwrap_or(f64::INFINITY)),
        paths: row.paths.iter().map(path).collect(),
    }
}
