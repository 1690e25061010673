//! Storages of sparse matrices: what they take, what they ask for, and what the chapter says of them.

mod factors;
mod memory;
mod structures;
mod times;

use super::{Document, Outcome, View};
use crate::number::{count, readable};
use crate::plot::{Small, Spies};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::storage::claims::{Claim, Verdict};
use crate::report::study::storage::pictures::Picture;
use crate::report::study::storage::time::Times;
use crate::report::study::storage::{Finding, Plan};

/// Pictures in a figure, and side by side.
const PICTURES: usize = 20;
const ACROSS: usize = 5;

impl View for Plan {
    const TITLE: &'static str = "How to keep a sparse matrix";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        for study in findings {
            claims(document, &study.claims);
            memory::section(document, study);
            structures::structures(document, &study.structures);
            if let Some(steps) = &study.steps {
                structures::steps(document, steps);
            }
            factors::section(document, &study.factors);
            pictures(document, &study.pictures);
        }
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        times.iter().for_each(|times| times::section(document, times));
    }

    fn answer(&self, findings: &[Finding]) -> Option<String> {
        findings.iter().find_map(advice)
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let asked = || findings.iter().flat_map(|f| &f.structures).filter_map(|s| s.agree);
        let (agree, all) = (asked().filter(|agree| *agree).count(), asked().count());
        let claims = || findings.iter().flat_map(|study| &study.claims);
        let says = format!(
            "{agree} of {all} scenes have the same A in every storage; {} of the chapter's {} claims \
             on storage hold as they stand",
            claims().filter(|claim| claim.holds()).count(),
            claims().count(),
        );
        Outcome { good: agree == all, says }
    }
}

/// What to keep a matrix in, by the largest scene and by the fill at which storages stop paying.
fn advice(study: &Finding) -> Option<String> {
    let largest = study.structures.iter().max_by_key(|structure| structure.rows)?;
    let of = |name: &str| {
        let (_, [_, _, bytes]) = largest.bytes.iter().find(|(storage, _)| storage == name)?;
        Some(mega(*bytes))
    };
    let pays = |name: &str| {
        let memory = study.memory.iter().find(|memory| memory.storage == name)?;
        Some(readable(memory.break_even?, 2))
    };
    Some(format!(
        "**Which storage?** Compressed rows: A of *{}* ({} rows) takes {} MB dense and {} in compressed rows. \
         At random places compressed rows take less than the dense matrix up to a fill of {} %, the chapter's map of maps up to {} %.",
        largest.scene,
        count(largest.rows),
        of("dense")?,
        of("compressed rows")?,
        pays("compressed rows")?,
        pays("map of maps")?
    ))
}

fn mega(bytes: usize) -> String {
    readable(bytes as f64 / 1e6, 3)
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
