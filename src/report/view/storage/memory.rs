//! What storages hold by fill.

use super::super::Document;
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Table};
use crate::report::study::storage::Finding;
use crate::report::study::storage::memory::Memory;

pub(super) fn section(document: &mut Document, study: &Finding) {
    document.open("memory", "Memory by fill: the chapter's Table 1 again");
    let size = study.size;
    document.text(format!(
        "A matrix of {size} × {size} is filled at random places. The dense one always takes {size} · {size} · 8 \
         bytes. The others grow with their entries: what an entry costs, beside the 8 bytes of a number in the \
         dense matrix, decides the fill at which a storage stops paying."
    ));
    document.equation(
        "\\text{break-even fill} = \\frac{\\text{bytes of a number}}{\\text{bytes of an entry}}",
        "E57",
    );
    document.text(
        "For the chapter's list that is $4/28 = 1/7$, or 14.3 %; for the list here, \
         $8/24 = 1/3$; for compressed rows $8/12 = 2/3$. A map has no fixed price \
         for an entry, so its own is measured.",
    );
    document.table("storage_memory", table(study));
    document.figure(figure(study));
}

fn table(study: &Finding) -> Table {
    let shown = [0.1, 1.0, 10.0, 50.0, 100.0];
    let mut columns = vec![Column::words("storage")];
    columns.extend(shown.map(|fill| Column::numbers(format!("{} %", readable(fill, 3)), "bytes")));
    columns.push(Column::numbers("an entry at 10 %", "bytes"));
    columns.push(Column::numbers("pieces at 1 %", ""));
    columns.push(Column::numbers("break-even", "% fill"));
    let row = |memory: &Memory| {
        let at = |fill: f64| memory.points.iter().find(|p| (p.fill - fill).abs() < 1e-9);
        let mut cells = vec![Cell::text(&memory.storage)];
        cells.extend(shown.map(|fill| at(fill).map_or(Cell::text("–"), |p| Cell::count(p.bytes))));
        cells.push(Cell::number(memory.bytes_an_entry, 3));
        cells.push(at(1.0).map_or(Cell::text("–"), |p| Cell::count(p.allocations)));
        cells.push(match memory.break_even {
            Some(fill) => Cell::number(fill, 3),
            None => Cell::text(if memory.storage == "dense" { "–" } else { "never" }),
        });
        cells
    };
    Table {
        title: format!("Bytes of a {0} × {0} matrix by fill", study.size),
        how_to_read:
            "*pieces*: how often heap memory was asked for to make and fill it. *break-even*: the \
                      least fill at which it takes more than the dense matrix, found by halving."
                .into(),
        columns,
        rows: study.memory.iter().map(row).collect(),
        ..Table::default()
    }
}

fn figure(study: &Finding) -> Lines {
    let series = |memory: &Memory| {
        let points = memory.points.iter().map(|p| (p.fill, p.bytes as f64)).collect();
        Series::measured(memory.storage.clone(), points)
    };
    Lines {
        id: "storage_memory_by_fill".into(),
        title: format!("Memory of a {0} × {0} matrix", study.size),
        caption: "Where a line crosses the dense one, its storage stops paying. The list takes \
                  24 bytes an entry."
            .into(),
        x: Axis::log("fill", "%"),
        panels: vec![Panel {
            y: Axis::log("memory", "bytes"),
            series: study.memory.iter().map(series).collect(),
        }],
    }
}
