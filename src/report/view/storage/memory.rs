//! What storages hold by fill, and what a search in them looks at.

use super::super::Document;
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Table};
use crate::report::study::storage::Finding;
use crate::report::study::storage::memory::Memory;
use crate::report::study::storage::search::Search;

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
        "For the chapter's list that is $4/28 = 1/7$, or 14.3 %; for the list and the tree here, \
         $8/24 = 1/3$; for compressed rows $8/12 = 2/3$. Maps, hash tables and block rows have no fixed price \
         for an entry, so theirs is measured.",
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
        caption: "Where a line crosses the dense one, its storage stops paying. List and tree lie on each \
                  other: 24 bytes an entry. The table of a hash doubles; so does its memory. Block rows \
                  suffer at random places, where a block of six has one entry."
            .into(),
        x: Axis::log("fill", "%"),
        panels: vec![Panel {
            y: Axis::log("memory", "bytes"),
            series: study.memory.iter().map(series).collect(),
        }],
    }
}

pub(super) fn search(document: &mut Document, searches: &[Search]) {
    if searches.is_empty() {
        return;
    }
    document.open("search", "What a search looks at");
    document.text(
        "A search in a list begins at its head, so to find each of $k$ entries once takes $(k + 1)/2$ looks \
         on average: linear, whatever the fill. A tree takes as many looks as it has levels on the way. \
         Filled in a random order it has $2(1 + 1/k) H_k - 3$ of them on average, with \
         $H_k = 1 + 1/2 + … + 1/k$; filled in the order of the indices, as \
         an assembly does, it has no left branches and is the list again. Built from \
         sorted entries, the middle one on top, it is as shallow as can be; a B-tree, the standard library's \
         sorted map, stays shallow by itself.",
    );
    let row = |search: &Search| {
        vec![
            Cell::count(search.entries),
            Cell::number(search.list, 4),
            Cell::count(search.sorted.depth),
            Cell::number(search.sorted.visits, 4),
            Cell::count(search.shuffled.depth),
            Cell::number(search.shuffled.visits, 3),
            Cell::count(search.balanced.depth),
            Cell::number(search.balanced.visits, 3),
        ]
    };
    let table = Table {
        title: "Entries that a search looks at".into(),
        how_to_read:
            "*looks*: the mean over a search for every entry. *depth*: the longest way down.".into(),
        columns: vec![
            Column::numbers("entries", ""),
            Column::numbers("list: looks", ""),
            Column::numbers("in order: depth", ""),
            Column::numbers("looks", ""),
            Column::numbers("shuffled: depth", ""),
            Column::numbers("looks", ""),
            Column::numbers("from sorted: depth", ""),
            Column::numbers("looks", ""),
        ],
        rows: searches.iter().map(row).collect(),
        ..Table::default()
    };
    document.table("storage_search", table);
    document.figure(looks(searches));
}

fn looks(searches: &[Search]) -> Lines {
    let points = |looks: fn(&Search) -> f64| {
        searches.iter().map(|s| (s.entries as f64, looks(s))).collect::<Vec<_>>()
    };
    let theory = |looks: fn(f64) -> f64| {
        let last = searches.last().map_or(10.0, |s| s.entries as f64);
        let grid = (0..=60).map(|k| 10.0 * (last / 10.0).powf(f64::from(k) / 60.0));
        grid.map(|k| (k, looks(k))).collect::<Vec<_>>()
    };
    Lines {
        id: "storage_looks".into(),
        title: "Entries that a search looks at, on average".into(),
        caption: "The list and the tree filled in order are one line: $(k + 1)/2$. The shuffled tree follows \
                  $2 (1 + 1/k) H_k - 3$ (Knuth)."
            .into(),
        x: Axis::log("entries k", ""),
        panels: vec![Panel {
            y: Axis::log("looks", "entries"),
            series: vec![
                Series::measured("linked list", points(|s| s.list)),
                Series::points("tree, in order", points(|s| s.sorted.visits)),
                Series::measured("tree, shuffled", points(|s| s.shuffled.visits)),
                Series::measured("tree, from sorted", points(|s| s.balanced.visits)),
                Series::theory("(k + 1)/2", theory(|k| f64::midpoint(k, 1.0))),
                Series::theory("2 (1 + 1/k) H − 3", theory(|k| {
                    let harmonic = k.ln() + 0.577_215_664_9 + 0.5 / k;
                    2.0 * (1.0 + 1.0 / k) * harmonic - 3.0
                })),
            ],
        }],
    }
}
