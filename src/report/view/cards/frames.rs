//! The contact problems that engines solve themselves: their own answers judged, and who else solves them.

use crate::number::readable;
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::cards::{Frame, Record, Tried};
use crate::report::view::Document;
use crate::report::view::attempt::iterations_in_words;

/// Adds a section, if there are such problems.
pub fn show(record: &Record, document: &mut Document) {
    if record.frames.is_empty() {
        return;
    }
    document.open("frames", "Do engines solve the problems that they pose?");
    document.text(
        "What an engine misses may lie in the problem that it poses or in its solution of it. Here the problem of a step is \
         taken out of the engine as it is installed, the engine's own forces or impulses are judged, in exact arithmetic where \
         it says *proved*, and lcplab's solvers try the same problem. A law that is missed although the answer is proved is \
         missed by the model: a softer contact, a pyramid for a cone, friction bounded by an earlier force. An answer that is \
         refused may keep a law all the same: it is off by what the table says. Pinocchio poses no contacts: its solver gets \
         the problem that lcplab poses. Rapier tells no problem, and DART none of a scene that sleeps.",
    );
    document.table("cards_frames", table(record));
}

fn table(record: &Record) -> Table {
    Table {
        title: "Engines' own answers".into(),
        how_to_read: "*accepted*: of the solvers that take such problems, with Coulomb's cones one. *cheapest*: the one that was accepted \
                       with the fewest multiplications. 10,000 iterations are the limit."
            .into(),
        columns: vec![
            Column::words("engine"),
            Column::words("phenomenon"),
            Column::numbers("at", "s"),
            Column::numbers("rows", ""),
            Column::words("its own answer"),
            Column::numbers("scaled residual", ""),
            Column::words("missed most"),
            Column::words("lcplab's solvers accepted"),
            Column::words("cheapest"),
            Column::words("not within the limit"),
        ],
        rows: record.frames.iter().map(|frame| row(record, frame)).collect(),
        ..Table::default()
    }
}

/// The row that is missed most, with its name, and by how much.
fn missed(frame: &Frame) -> Option<String> {
    let label = frame.problem["rows"][frame.row?]["label"].as_str()?;
    Some(format!("{label}: {} mm/s", readable(1e3 * frame.missed?, 2)))
}

fn row(record: &Record, frame: &Frame) -> Vec<Cell> {
    let accepted: Vec<&Tried> = frame.solvers.iter().filter(|tried| tried.accepted).collect();
    let cost = |own: &&&Tried| own.multiplications.unwrap_or(f64::INFINITY);
    let cheapest = accepted.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
    let failed: Vec<&str> =
        frame.solvers.iter().filter(|own| !own.accepted).map(|own| own.solver.as_str()).collect();
    let mark = if frame.verdict == "not_a_solution" { Mark::Bad } else { Mark::Good };
    vec![
        Cell::text(record.title(&frame.engine)),
        Cell::text(frame.phenomenon.replace('_', " ")),
        Cell::number(frame.time, 2),
        Cell::count(frame.rows),
        Cell::text(frame.verdict.replace('_', " ")).marked(mark),
        Cell::number(frame.residual, 2),
        Cell::text(missed(frame).unwrap_or_else(|| "–".into())),
        Cell::text(format!("{} of {}", accepted.len(), frame.solvers.len())),
        Cell::text(cheapest.map_or_else(
            || "–".into(),
            |own| format!("{}, {}", own.solver, iterations_in_words(&own.solver, own.iterations)),
        )),
        Cell::text(if failed.is_empty() { "–".into() } else { failed.join(", ") }),
    ]
}
