//! Results as pages: tables, figures and what to see in them. Nothing is solved here.

mod comparison;
mod convergence;
mod cross_check;
mod drift;
mod families;
mod film;
mod friction;
mod introduction;
mod merits;
mod rates;
mod sparsity;
mod storage;
mod timing;
mod verification;
mod worst_cases;

pub use comparison::{alike, document as comparison_document, table as comparison_table};

pub use families::table as families_table;
pub use film::simulation_page;
pub use verification::table as verification_table;

use super::page::{Block, Page, Picture, Section, Table};
use super::results::Results;
use crate::plot::Figure;

/// A page with the figures and tables on it, each under the name of its files.
pub struct Document {
    /// The page.
    pub page: Page,
    /// The figures: SVG and CSV are written beside the page.
    pub figures: Vec<Box<dyn Figure>>,
    /// The tables with the names of their CSV files.
    pub tables: Vec<(String, Table)>,
}

/// The folder beside the page that holds figures and tables.
pub const FILES: &str = "data";

/// The page of a report's results.
pub fn document(results: &Results) -> Document {
    let mut document = Document {
        page: Page {
            title: results.experiment.title.clone(),
            lead: results.experiment.lead.clone(),
            ..Page::default()
        },
        figures: Vec::new(),
        tables: Vec::new(),
    };
    let solves = results.experiment.solves();
    if solves {
        introduction::problem(&mut document, results);
    }
    verification::section(&mut document, &results.verification);
    comparison::section(&mut document, &results.comparisons);
    cross_check::section(&mut document, &results.cross_checks);
    convergence::section(&mut document, &results.convergence);
    rates::section(&mut document, &results.rates);
    if let Some(study) = &results.worst_cases {
        worst_cases::section(&mut document, study);
    }
    if let Some(study) = &results.friction {
        friction::section(&mut document, study);
    }
    merits::section(&mut document, &results.merits);
    sparsity::section(&mut document, &results.sparsity);
    drift::section(&mut document, &results.drift);
    if let Some(study) = &results.storage {
        storage::sections(&mut document, study);
    }
    timing::section(&mut document, results);
    if let Some(times) = &results.machine.storage {
        storage::times(&mut document, times);
    }
    if solves {
        introduction::limits(&mut document);
    } else {
        storage::limits(&mut document);
    }
    document.page.facts = introduction::facts(results);
    document
}

impl Document {
    /// Starts a section.
    fn open(&mut self, id: &str, title: &str) {
        let section = Section { id: id.into(), title: title.into(), blocks: Vec::new() };
        self.page.sections.push(section);
    }

    /// Adds a block to the section opened last.
    fn add(&mut self, block: Block) {
        if let Some(section) = self.page.sections.last_mut() {
            section.blocks.push(block);
        }
    }

    fn text(&mut self, text: impl Into<String>) {
        self.add(Block::Text(text.into()));
    }

    fn equation(&mut self, latex: &str, label: &str) {
        self.add(Block::Equation { latex: latex.into(), label: Some(label.into()) });
    }

    fn figure(&mut self, figure: impl Figure + 'static) {
        self.add(Block::Figure(Picture::of(&figure, FILES)));
        self.figures.push(Box::new(figure));
    }

    /// Adds a table whose CSV file is called `id`.
    fn table(&mut self, id: &str, mut table: Table) {
        table.files = vec![("data (CSV)".into(), format!("{FILES}/{id}.csv"))];
        self.tables.push((id.into(), table.clone()));
        self.add(Block::Table(table));
    }
}
