//! Storages of sparse matrices: what they take, what they ask for, and what the chapter says of them.

mod factors;
mod memory;
mod structures;
mod times;

pub(super) use times::section as times;

use super::Document;
use crate::plot::number::{count, readable};
use crate::plot::{Small, Spies};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::storage::Study;
use crate::report::study::storage::claims::{Claim, Verdict};
use crate::report::study::storage::pictures::Picture;

/// Pictures in a figure, and side by side.
const PICTURES: usize = 20;
const ACROSS: usize = 5;

pub(super) fn sections(document: &mut Document, study: &Study) {
    claims(document, &study.claims);
    memory::section(document, study);
    memory::search(document, &study.search);
    structures::structures(document, &study.structures);
    if let Some(steps) = &study.steps {
        structures::steps(document, steps);
    }
    factors::section(document, &study.factors);
    pictures(document, &study.pictures);
}

fn claims(document: &mut Document, claims: &[Claim]) {
    document.open("claims", "What the chapter says, and what was measured");
    document.text(
        "The sections below have the measurements behind this table. Where the chapter counts in \
         numbers of 4 bytes (`float`) and entries of 28, so does the table; lcplab's own numbers have 8 \
         bytes, and its list entries 24.",
    );
    let row = |claim: &Claim| {
        let verdict = match claim.verdict {
            Verdict::Confirmed => Cell::text("confirmed").marked(Mark::Good),
            Verdict::Conditional => Cell::text("with a condition").marked(Mark::Note),
            Verdict::Wrong => Cell::text("wrong").marked(Mark::Bad),
        };
        vec![Cell::text(&claim.says), Cell::text(&claim.found), verdict, Cell::text(&claim.erratum)]
    };
    let table = Table {
        title: "The chapter's claims about storage".into(),
        how_to_read:
            "*says*: the claim in our words. *found*: counted here. A claim *with a condition* \
                      holds where the condition in *found* is met."
                .into(),
        columns: vec![
            Column::words("says"),
            Column::words("found"),
            Column::words("verdict"),
            Column::words("erratum"),
        ],
        rows: claims.iter().map(row).collect(),
        ..Table::default()
    };
    document.table("storage_claims", table);
}

fn pictures(document: &mut Document, pictures: &[Picture]) {
    if pictures.is_empty() {
        return;
    }
    document.open("pictures", "Where A has entries, scene by scene");
    document.text(
        "Rows come in the order of the scene's constraints, then its contacts, each contact as normal \
         and two tangents. Two rows share an entry if they share a moving body. A chain is a band, a \
         stack a band of blocks, a net two bands as far apart as it is wide; a body that many others \
         touch makes a full square.",
    );
    let figures = pictures.len().div_ceil(PICTURES);
    for (k, some) in pictures.chunks(PICTURES).enumerate() {
        let small = |picture: &Picture| Small {
            name: picture.scene.clone(),
            note: note(picture),
            raster: picture.raster.clone(),
        };
        document.figure(Spies {
            id: format!("storage_pictures_{}", k + 1),
            title: format!("A of the shipped scenes, {} of {figures}", k + 1),
            caption: "Under each name: the number of rows and the share of entries that are not zero; the \
                      step, if it is not the first. An empty frame has no rows in that step. Rows at right angles share a body and no entry."
                .into(),
            across: ACROSS,
            panels: some.iter().map(small).collect(),
        });
    }
}

fn note(picture: &Picture) -> String {
    let raster = &picture.raster;
    let step = if picture.step > 1 { format!(", step {}", picture.step) } else { String::new() };
    if raster.rows == 0 {
        return format!("no rows{step}");
    }
    format!("{}², {} %{step}", count(raster.rows), readable(raster.fill(), 2))
}

/// What the report does not show.
pub(super) fn limits(document: &mut Document) {
    document.open("limits", "What this report does not show");
    document.text(
        "- Bytes are those asked for. An allocator adds its own, 8 to 16 bytes a piece as a rule, which \
         hits maps hardest, and memory in many pieces is scattered.\n\
         - A sorted map's bytes are counted for entries that were set in ascending order; another order \
         splits its nodes elsewhere and moves the number by up to a quarter.\n\
         - Random places are the worst case for block rows: in a J, whose rows fill whole blocks, they \
         are the smallest.\n\
         - Times are of one thread, one matrix at a time, in a warm cache, through a call that is not \
         known at compile time: what small sizes show is mostly that call.\n\
         - The chapter's lists and maps hold numbers of 4 bytes; here all hold 8.",
    );
}
