//! Proof files for the verdicts in a report's tables, and their links on the page.

use std::path::Path;

use indicatif::ProgressBar;
use rayon::prelude::*;

use super::experiment::Experiment;
use super::page::{self, Block, Section};
use super::view::attempt::anchor;
use super::view::{Document, FILES};
use crate::error::Result;
use crate::file;
use crate::lcp::Question;
use crate::lcp::file::Problem;
use crate::proof::{Kind, prove, prove_kind};

/// The folder for them next to the page, the input of `lcpcheck.py`.
const FOLDER: &str = "proofs";
/// Maximum number of files, problems and proofs together.
const MOST_FILES: usize = 300;
/// Maximum total size (bytes).
const MOST_BYTES: usize = 10_000_000;

/// A problem whose verdicts a table shows.
pub struct Judged {
    /// The problem.
    pub problem: Problem,
    /// The answers in its rows.
    pub answers: Vec<Answered>,
}

/// A row of a table that shows the verdict on an answer.
pub struct Answered {
    /// The table's id.
    pub table: String,
    /// The text of the row's first cells.
    pub begins: Vec<String>,
    /// The heading of the column with the verdict.
    pub column: &'static str,
    /// The answer.
    pub answer: Vec<f64>,
}

/// The proofs of a report.
#[derive(Default)]
pub struct Proofs {
    problems: Vec<Proved>,
    /// The number of rows without a proof because there would be too many files.
    pub left_out: usize,
}

/// A problem with its proofs.
struct Proved {
    section: String,
    name: String,
    problem: String,
    proofs: Vec<(Answered, page::Proof)>,
}

impl Proved {
    fn files(&self) -> usize {
        1 + self.proofs.len()
    }

    fn bytes(&self) -> usize {
        self.problem.len() + self.proofs.iter().map(|(_, proof)| proof.text.len()).sum::<usize>()
    }
}

impl Proofs {
    /// Solves the problems of a report again and proves the verdicts of its rows.
    ///
    /// # Errors
    /// If a problem cannot be reproduced.
    pub fn of(experiment: &Experiment, progress: &ProgressBar) -> Result<Proofs> {
        let mut judged = Vec::new();
        for section in &experiment.sections {
            let Some(study) = &section.study else { continue };
            for task in 0..study.tasks().len() {
                let problems = study.judged(&section.id, task)?;
                judged.extend(problems.into_iter().map(|own| (section.id.clone(), own)));
            }
        }
        progress.set_length(judged.iter().map(|(_, own)| own.answers.len() as u64).sum());
        let prove = |(section, judged): (String, Judged)| proved(section, judged, progress);
        let all: Vec<Proved> = judged.into_par_iter().map(prove).collect::<Result<_>>()?;
        let mut proofs = Proofs::default();
        let (mut files, mut bytes) = (0, 0);
        for own in all {
            if files + own.files() > MOST_FILES || bytes + own.bytes() > MOST_BYTES {
                proofs.left_out += own.proofs.len();
                continue;
            }
            (files, bytes) = (files + own.files(), bytes + own.bytes());
            proofs.problems.push(own);
        }
        Ok(proofs)
    }

    /// The number of proofs.
    pub fn count(&self) -> usize {
        self.problems.iter().map(|own| own.proofs.len()).sum()
    }

    /// Writes the files into the report's folder.
    ///
    /// # Errors
    /// If one cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        for own in &self.problems {
            file::write_in(folder, format!("{FOLDER}/{}.json", own.name), &own.problem)?;
            for (_, proof) in &own.proofs {
                file::write_in(folder, &proof.file, &proof.text)?;
            }
        }
        Ok(())
    }

    /// Links each row to its proof, which is at the end of its section with a button that checks
    /// it.
    pub fn onto(&self, document: &mut Document) {
        for section in &mut document.page.sections {
            let id = section.id.clone();
            let of_section = self.problems.iter().filter(|own| own.section == id);
            let mut blocks = Vec::new();
            for own in of_section {
                own.proofs.iter().for_each(|(row, proof)| link(section, row, &proof.id));
                let proofs = own.proofs.iter().map(|(_, proof)| proof.clone()).collect();
                blocks.push(Block::Proofs { problem: own.problem.clone(), proofs });
            }
            if !blocks.is_empty() {
                section.blocks.push(Block::Text(WORDS.into()));
                section.blocks.extend(blocks);
            }
        }
    }
}

const WORDS: &str = "Proofs of the verdicts on single problems in these rows, in exact arithmetic. The buttons \
 run a checker that is part of this page and shares no code with lcplab. `python3 proofs/lcpcheck.py` in \
 lcplab's repository checks the folder `proofs` next to this page.";

fn proved(section: String, judged: Judged, progress: &ProgressBar) -> Result<Proved> {
    let Judged { problem, answers } = judged;
    let question = Question::new(&problem, None, &problem.name)?;
    let name = anchor(&format!("{section} {}", problem.name));
    let mut proofs = Vec::new();
    for (k, row) in answers.into_iter().enumerate() {
        // An exact solution near the answer says more about a row than uniqueness.
        let found = prove_kind(&question, &row.answer, Kind::Solution).proof;
        if let Some(proof) = found.or_else(|| prove(&question, &row.answer).proof) {
            let id = format!("{name}-{}", k + 1);
            let shown = page::Proof {
                about: row.begins.join(", "),
                claim: proof.sentence(),
                text: format!("{}\n", proof.to_json()),
                file: format!("{FOLDER}/{id}.proof.json"),
                id,
            };
            proofs.push((row, shown));
        }
        progress.inc(1);
    }
    let problem = format!("{}\n", problem.to_json());
    Ok(Proved { section, name, problem, proofs })
}

/// Turns the verdict in a row into a link.
fn link(section: &mut Section, row: &Answered, id: &str) {
    let file = format!("{FILES}/{}.csv", row.table);
    for block in &mut section.blocks {
        let Block::Table(table) = block else { continue };
        let Some(column) = table.columns.iter().position(|own| own.title == row.column) else {
            continue;
        };
        if !table.files.iter().any(|(_, address)| *address == file) {
            continue;
        }
        let is_meant = |cells: &&mut Vec<page::Cell>| {
            cells.iter().zip(&row.begins).all(|(cell, begin)| cell.text == *begin)
        };
        if let Some(cells) = table.rows.iter_mut().find(is_meant) {
            cells[column].link = format!("#{id}");
        }
    }
}
