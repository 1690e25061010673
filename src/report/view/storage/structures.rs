//! The matrices of scenes: what they take, and how often a step asks for memory.

use super::super::Document;
use crate::number::{count, readable};
use crate::report::page::markup::literal;
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::storage::steps::{Count, Steps};
use crate::report::study::storage::structure::Structure;

pub(super) fn structures(document: &mut Document, structures: &[Structure]) {
    if structures.is_empty() {
        return;
    }
    document.open("structures", "The matrices of scenes");
    document.text(
        "J has six columns a moving body and entries for one or two bodies a row, M⁻¹ a block of 6 × 6 \
         a body, A an entry for each two rows that share a body.",
    );
    document.table("storage_structures", sizes(structures, "A", |[_, _, a]| a));
    let factors = "J and M⁻¹ together";
    document.table("storage_factor_sizes", sizes(structures, factors, |[j, m_inv, _]| j + m_inv));
    let asked = structures.iter().filter(|s| s.agree.is_some()).map(|s| literal(&s.scene));
    let asked = asked.collect::<Vec<_>>().join(", ");
    document.text(match structures.iter().all(|s| s.agree != Some(false)) {
        true => format!(
            "J, M⁻¹ and the product A = J M⁻¹ Jᵀ were also kept and computed in each storage in turn \
             ({asked}): the same A to the last bit."
        ),
        false => format!("**The storages do not agree on A** ({asked})."),
    });
}

/// Kilobytes by storage and scene.
fn sizes(structures: &[Structure], what: &str, of: impl Fn([usize; 3]) -> usize) -> Table {
    let mut columns = vec![Column::words("storage")];
    columns.extend(structures.iter().map(|s| Column::numbers(&s.scene, "kB")));
    let storages = structures.first().map_or(&[][..], |structure| &structure.bytes);
    let row = |(k, (name, _)): (usize, &(String, [usize; 3]))| {
        let cells = structures.iter().map(|s| kilo(of(s.bytes[k].1)));
        std::iter::once(Cell::text(name)).chain(cells).collect::<Vec<_>>()
    };
    let rows = storages.iter().enumerate().map(row).collect();
    let scene = |s: &Structure| {
        let [_, entries] = s.entries;
        let rows = count(s.rows);
        format!(
            "{}: {rows} rows, {} entries of A, {} %",
            s.scene,
            count(entries),
            readable(s.fill, 2)
        )
    };
    Table {
        title: format!("Memory of {what} in scenes"),
        how_to_read: format!(
            "{}. Dense matrices were counted, not made.",
            structures.iter().map(scene).collect::<Vec<_>>().join("; ")
        ),
        columns,
        rows,
        ..Table::default()
    }
}

fn kilo(bytes: usize) -> Cell {
    let value = bytes as f64 / 1e3;
    let text = if bytes < 100_000 { readable(value, 3) } else { count(value.round() as usize) };
    Cell { text, value: Some(value), ..Cell::default() }
}

pub(super) fn steps(document: &mut Document, steps: &Steps) {
    document.open("pool", "Memory that is kept from step to step");
    let (least, most) = (steps.rows.iter().min(), steps.rows.iter().max());
    document.text(format!(
        "The chapter's matrix manager keeps matrices of common sizes, so that a step need not ask for \
         memory. Here a step of *{}* ({} steps of {} to {} rows) assembles $A = J M^{{-1}} J^T$: with matrices and buffers made \
         anew, as the chapter's first version does; with all of them kept, in a first pass over the steps; \
         and in a second pass, when everything is as large as it needs to be.",
        literal(&steps.scene),
        steps.rows.len(),
        least.unwrap_or(&0),
        most.unwrap_or(&0)
    ));
    let mean =
        |value: f64| Cell { text: readable(value, 4), value: Some(value), ..Cell::default() };
    let row = |count: &Count| {
        let mark = if count.warm == 0.0 { Mark::Good } else { Mark::Note };
        vec![
            Cell::text(&count.storage),
            mean(count.anew),
            mean(count.first),
            mean(count.warm).marked(mark),
        ]
    };
    let table = Table {
        title: "Requests for memory a step".into(),
        how_to_read: "The mean over the steps, for J, M⁻¹, A and the buffers of the product, counted by the \
                      storages and the pool; a test compares with the allocator. Sorted maps \
                      give every node back and ask for it again: no pool of matrices helps them, only one \
                      of nodes, as the list has it here."
            .into(),
        columns: vec![
            Column::words("storage"),
            Column::numbers("made anew", ""),
            Column::numbers("kept, first pass", ""),
            Column::numbers("kept, warm", ""),
        ],
        rows: steps.counts.iter().map(row).collect(),
        ..Table::default()
    };
    document.table("storage_steps", table);
}
