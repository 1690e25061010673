//! Results as pages: tables, figures and their explanation. Nothing is solved here.
//!
//! Each study has a view in Rust. For five of them, tables of plain rows with a TOML description
//! and a common interpreter were tried: their 1,631 lines became 1,539 in two languages, plus an
//! interpreter of 808, and a wrong column name was no longer a compile error.

mod animation;
pub mod attempt;
mod cards;
mod comparison;
mod convergence;
mod cross_check;
mod defects;
mod diagnosis;
mod drift;
mod families;
mod grid;
mod headline;
mod profiles;
mod scenes;
mod sliding;
mod solved;
mod solver_times;
mod sparsity;
mod summary;
mod verification;

pub(crate) use comparison::alike;
pub use comparison::{
    answer as comparison_answer, document as comparison_document, table as comparison_table,
};

pub(crate) use diagnosis::diagnosis_page;
pub use headline::Headline;

pub(crate) use animation::simulation_page;
pub(crate) use families::by_solver as solvers_table;
pub use families::table as families_table;
pub use verification::table as verification_table;

use headline::Top;
use serde_json::Value;

use super::experiment::{Experiment, Fold, SHIPPED};
use super::page::{self, Block, Cell, Mark, Origin, Page, Picture, Section, Table};
use super::results::{Machine, Part, Results, Task};
use super::study::Study;
use crate::error::Result;
use crate::live::linked;
use crate::plot::Figure;

/// A page with its figures and tables, each with the name of its files.
pub struct ReportPage {
    /// The page.
    pub page: Page,
    /// The figures; their SVG and CSV files are written next to the page.
    pub figures: Vec<Box<dyn Figure>>,
    /// The tables with the names of their CSV files.
    pub tables: Vec<(String, Table)>,
}

/// Maximum number of tasks that are named individually where a section states how it was obtained.
const MOST_NAMED: usize = 20;
/// The setting that contains a whole file, which is not shown among the others.
const SOURCE: &str = "source";

/// The folder next to the page for figures and tables.
pub const FILES: &str = "data";

/// How the findings of a kind of study are shown.
pub trait View: Study {
    /// The heading of its section.
    const TITLE: &'static str;

    /// Adds the findings to the current section.
    fn show(&self, findings: &[Self::Finding], document: &mut ReportPage);

    /// Adds the machine-dependent data to the section of times.
    fn show_times(&self, _times: &[Self::Times], _document: &mut ReportPage) {}

    /// What it adds to the top of the page.
    fn headline(&self, _findings: &[Self::Finding]) -> Headline {
        Headline::default()
    }

    /// Whether all measurements are as expected; [`Outcome::undecided`] only for the kinds that
    /// [`UNDECIDED`](super::kind::UNDECIDED) lists.
    fn outcome(&self, findings: &[Self::Finding]) -> Outcome;
}

/// The outcome of a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// Whether all results are as expected.
    pub good: bool,
    /// The outcome in one line, with numbers; may be empty.
    pub says: String,
}

impl Outcome {
    /// The outcome of a kind of study that only shows something.
    pub fn undecided() -> Self {
        Outcome { good: true, says: String::new() }
    }
}

/// The page of a report's results.
///
/// # Errors
/// If a finding does not have the format of this version.
pub fn document(results: &Results) -> Result<ReportPage> {
    let page = Page { title: results.title.clone(), facts: facts(results), ..Page::default() };
    let mut document = ReportPage { page, figures: Vec::new(), tables: Vec::new() };
    let experiment = Experiment::of(results)?;
    let mut top = Top::default();
    for (section, part) in experiment.sections.iter().zip(&results.sections) {
        let first = document.page.sections.len();
        document.open(&part.id, &part.title);
        if !part.text.is_empty() {
            document.text(&part.text);
        }
        let findings: Vec<Value> = part.findings().collect();
        if let Some(study) = &section.study {
            let failed = part.tasks.iter().any(|task| task.failure.is_some());
            let good = study.outcome(&findings)?.good && !failed;
            let fold = part.shown.fold.filter(|_| good);
            let Headline { answer, figure, table, .. } =
                top.add(study.headline(&findings)?, &part.id, good);
            if let Some(answer) = answer {
                document.text(answer);
            }
            if fold != Some(Fold::Answer) {
                table.into_iter().for_each(|(id, table)| document.table(&id, table));
                figure.into_iter().for_each(|figure| document.boxed(figure));
            }
            if !matches!(fold, Some(Fold::Figure | Fold::Answer)) {
                let figures = document.figures.len();
                study.show(&findings, &mut document)?;
                failures(&mut document, part);
                if fold == Some(Fold::Figures) {
                    document.keep_figures(figures + 1);
                }
            }
            let origin = origin(results, part);
            // A scene's picture says how to run it.
            let is_sheet = |block: &Block| matches!(block, Block::Thumbnails(_));
            let shown = document.page.sections[first..].iter_mut();
            shown.filter(|shown| !shown.blocks.iter().any(is_sheet)).for_each(|shown| {
                shown.origin = Some(origin.clone());
            });
        }
        if part.shown.summary {
            summary::show(results, &mut document)?;
        }
        if part.shown.times {
            times(&mut document, &experiment, results)?;
        }
        if let Some(Fold::Tables | Fold::Figures) = part.shown.fold {
            let shown = &mut document.page.sections[first..];
            shown.iter_mut().for_each(|shown| shown.fold = page::Fold::Tables);
        }
    }
    if !results.sections.iter().any(|part| part.shown.times) && !results.machine.times.is_empty() {
        document.open("times", "Times, on this machine");
        times(&mut document, &experiment, results)?;
    }
    document.page.sections.retain(|section| !section.blocks.is_empty());
    let summary = results.sections.iter().find(|part| part.shown.summary);
    top.put(&results.lead, summary.map(|part| part.id.as_str()), &mut document);
    Ok(document)
}

/// How to reproduce a section's findings.
fn origin(results: &Results, part: &Part) -> Origin {
    let command = command(results);
    let section = match results.machine.command.as_ref().filter(|own| own.contains(" --section ")) {
        Some(_) => String::new(),
        None => format!(" --section {}", part.id),
    };
    let tasks: Vec<&str> = part.tasks.iter().map(|task| task.name.as_str()).collect();
    let named = match tasks[..] {
        [first, second, .., last] if tasks.len() > MOST_NAMED => {
            format!("{first}; {second}; … {last}: {} tasks", tasks.len())
        }
        _ => tasks.join("; "),
    };
    let mut settings = part.settings.clone();
    if let Value::Object(fields) = &mut settings {
        fields.remove(SOURCE);
    }
    Origin {
        scene: named,
        settings: toml::to_string(&settings).unwrap_or_default().trim().into(),
        command: command + &section,
    }
}

/// The command that ran the report, or the most likely one if the results do not contain it.
fn command(results: &Results) -> String {
    let likely = || {
        let is_shipped = SHIPPED.iter().any(|(name, _)| *name == results.name);
        format!("lcplab report {}{}", results.name, if is_shipped { "" } else { ".toml" })
    };
    results.machine.command.clone().unwrap_or_else(likely)
}

/// The machine-dependent data, study by study.
fn times(document: &mut ReportPage, experiment: &Experiment, results: &Results) -> Result<()> {
    for section in &experiment.sections {
        let of_section = results.machine.times.iter().filter(|timed| timed.section == section.id);
        let times: Vec<Value> = of_section.map(|timed| timed.times.clone()).collect();
        if let (Some(study), false) = (&section.study, times.is_empty()) {
            study.show_times(&times, document)?;
        }
    }
    Ok(())
}

/// The tasks of a section that failed, each with its reason.
fn failures(document: &mut ReportPage, part: &Part) {
    let row = |task: &Task| {
        let why = Cell::text(task.failure.as_ref()?).marked(Mark::Bad);
        Some(vec![Cell::text(&task.name), why])
    };
    let rows: Vec<_> = part.tasks.iter().filter_map(row).collect();
    if rows.is_empty() {
        return;
    }
    let table = Table::new(
        format!("What failed: {}", part.title),
        "These are missing from the figures and tables of this section.",
        "task | reason",
        rows,
    );
    document.table(&format!("{}_failures", part.id), table);
}

fn facts(results: &Results) -> Vec<(String, String)> {
    let stopped = results.progress().map(|progress| ("stopped".into(), progress));
    let facts = [
        ("lcplab".into(), results.version.clone()),
        ("libraries".into(), results.libraries.join(", ")),
        ("platform".into(), results.machine.platform.clone()),
    ];
    // Recorded results take no time.
    let time = (results.machine.seconds >= 1.0).then(|| {
        let Machine { seconds, threads, .. } = results.machine;
        ("wall time".into(), format!("{seconds:.1} s, {threads} threads"))
    });
    let reproduce = ("reproduce".into(), command(results));
    facts.into_iter().chain(time).chain([reproduce]).chain(stopped).collect()
}

impl ReportPage {
    /// A page that shows the findings of one study.
    pub fn of<S: View>(study: &S, findings: &[S::Finding]) -> Self {
        let page = Page { title: S::TITLE.into(), ..Page::default() };
        let mut document = ReportPage { page, figures: Vec::new(), tables: Vec::new() };
        document.open(S::NAME, S::TITLE);
        study.show(findings, &mut document);
        document
    }

    /// Starts a section.
    pub(in crate::report) fn open(&mut self, id: &str, title: &str) {
        let section = Section {
            id: id.into(),
            title: title.into(),
            blocks: Vec::new(),
            ..Section::default()
        };
        self.page.sections.push(section);
    }

    /// Collapses what is added to the last section from now on.
    fn fold_rest(&mut self) {
        if let Some(section) = self.page.sections.last_mut() {
            section.fold = page::Fold::After(section.blocks.len());
        }
    }

    /// Leaves out the last figures of the page, which are in the last section, down to a number.
    fn keep_figures(&mut self, kept: usize) {
        let Some(section) = self.page.sections.last_mut() else { return };
        while self.figures.len() > kept {
            let is_figure = |block: &Block| matches!(block, Block::Figure(_));
            let Some(last) = section.blocks.iter().rposition(is_figure) else { return };
            section.blocks.remove(last);
            self.figures.pop();
        }
    }

    /// Adds a block to the last section.
    fn add(&mut self, block: Block) {
        if let Some(section) = self.page.sections.last_mut() {
            section.blocks.push(block);
        }
    }

    /// Adds text in page markup; a live page that it links to opens in place.
    pub fn text(&mut self, text: impl Into<String>) {
        let text = text.into();
        let lives = linked(&text);
        self.add(Block::Text(text));
        lives.into_iter().for_each(|live| self.add(Block::Live(live)));
    }

    /// Adds text that is collapsed under a title.
    pub(crate) fn aside(&mut self, title: &str, text: impl Into<String>) {
        self.add(Block::Aside { title: title.into(), text: text.into() });
    }

    fn equation(&mut self, latex: &str, label: &str) {
        self.add(Block::Equation { latex: latex.into(), label: Some(label.into()) });
    }

    /// Adds a figure.
    pub(crate) fn figure(&mut self, figure: impl Figure + 'static) {
        self.boxed(Box::new(figure));
    }

    /// Adds a figure of any kind.
    fn boxed(&mut self, figure: Box<dyn Figure>) {
        self.add(Block::Figure(Picture::of(&*figure, FILES)));
        self.figures.push(figure);
    }

    /// Adds a table whose CSV file is named `id`.
    pub(crate) fn table(&mut self, id: &str, table: Table) {
        let block = self.filed(id, table);
        self.add(block);
    }

    /// Adds a table whose secondary columns are only in its CSV file.
    fn table_without_secondary(&mut self, id: &str, table: Table) {
        if let Block::Table(whole) = self.filed(id, table) {
            self.add(Block::Table(whole.primary()));
        }
    }

    /// The block of a table whose CSV file is named `id`.
    fn filed(&mut self, id: &str, mut table: Table) -> Block {
        table.files = vec![("data (CSV)".into(), format!("{FILES}/{id}.csv"))];
        self.tables.push((id.into(), table.clone()));
        Block::Table(table)
    }
}
