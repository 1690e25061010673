//! Times of storages on this machine.

use super::super::Document;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Table};
use crate::report::study::storage::time::{Time, Times};

pub(in super::super) fn section(document: &mut Document, times: &Times) {
    document.text(
        "These differ from run to run and from machine to machine: compare shapes, not digits. To find an \
         entry is cheap in all storages but the list, which the entries make dearer one by one. To multiply a \
         row is cheap where its entries lie together.",
    );
    let fill = |time: &Time| 100.0 * time.entries as f64 / (time.rows * time.rows).max(1) as f64;
    document.figure(Lines {
        id: "storage_time_fill".into(),
        title: "Time to find an entry, and to multiply a row, by fill".into(),
        caption: "One size, entries at random places and on the diagonal. Means over places and rows chosen at \
                  random."
            .into(),
        x: Axis::log("fill", "%"),
        panels: vec![
            panel("find an entry", &times.by_fill, fill, |time| Some(time.get)),
            panel("multiply a row", &times.by_fill, fill, |time| Some(time.row)),
        ],
    });
    let rows = |time: &Time| time.rows as f64;
    document.figure(Lines {
        id: "storage_time_size".into(),
        title: "Time to assemble A = J M⁻¹ Jᵀ, and of a sweep, by size".into(),
        caption: "Stacks of cubes in their first step, 12 rows a cube. All three matrices are in the storage."
            .into(),
        x: Axis::log("rows", ""),
        panels: vec![
            panel("assemble", &times.by_size, rows, |time| time.assembly),
            panel("sweep", &times.by_size, rows, |time| Some(time.sweep)),
        ],
    });
    document.table("storage_times", table(&times.by_size));
}

/// A curve a storage: seconds in µs.
fn panel(
    label: &str,
    times: &[Time],
    x: impl Fn(&Time) -> f64,
    y: impl Fn(&Time) -> Option<f64>,
) -> Panel {
    let mut series: Vec<Series> = Vec::new();
    for time in times {
        let Some(seconds) = y(time) else { continue };
        let point = (x(time), 1e6 * seconds);
        match series.iter_mut().find(|series| series.name == time.storage) {
            Some(series) => series.points.push(point),
            None => series.push(Series::measured(time.storage.clone(), vec![point])),
        }
    }
    Panel { y: Axis::log(label, "µs"), series }
}

fn table(times: &[Time]) -> Table {
    let micro = |seconds: f64| Cell::number(1e6 * seconds, 3);
    let row = |time: &Time| {
        vec![
            Cell::count(time.rows),
            Cell::count(time.entries),
            Cell::text(&time.storage),
            micro(time.get),
            micro(time.row),
            time.assembly.map_or(Cell::text("–"), micro),
            micro(time.sweep),
        ]
    };
    Table {
        title: "Times by size".into(),
        how_to_read: "Stacks of cubes. The best of three rounds of 2 ms or more.".into(),
        columns: vec![
            Column::numbers("rows", ""),
            Column::numbers("entries of A", ""),
            Column::words("storage"),
            Column::numbers("find an entry", "µs"),
            Column::numbers("multiply a row", "µs"),
            Column::numbers("assemble A", "µs"),
            Column::numbers("sweep", "µs"),
        ],
        rows: times.iter().map(row).collect(),
        ..Table::default()
    }
}
