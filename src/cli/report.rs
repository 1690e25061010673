//! `report`: runs the studies of a report file and writes its page.

use std::path::{Path, PathBuf};

use clap::Args;
use lcplab::document::unicode;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::lesson::Program;
use lcplab::number::plain;
use lcplab::page::Table;
use lcplab::report::difference::Tolerance;
use lcplab::report::experiment::{self, Experiment, SHIPPED};
use lcplab::report::kind::KINDS;
use lcplab::report::results::Results;
use lcplab::report::{difference, run, terminal, view, write};
use lcplab::solver::Reason;

use super::engines;
use super::limits::Limits;
use super::pdf::Browser;
use super::plugin::Declared;
use super::{Outcome, bar, folder_of, print, say, threads};
use crate::handout::ALL;

/// The walk through the chapter.
const HANDOUT: &Program = &ALL[0];

/// The name of the schema of report files in `--print`.
const SCHEMA: &str = "schema";

/// The report that shows the results of physics engines.
const ENGINES: &str = "engines";

/// The width of what is printed, and of the names of sections before their outcomes.
const WIDTH: usize = 100;
const NAME: usize = 15;

/// Run the studies that a report file lists, and write a page with figures and tables
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab report                        # writes reports/standard/index.html
  lcplab report --list                 # the shipped reports, and what a report file can contain
  lcplab report verification --list    # all closed forms, on the terminal
  lcplab report chapter                # the chapter with all its examples computed
  lcplab report solvers --out solvers.pdf
  lcplab report --print standard > mine.toml; lcplab report mine.toml --out mine
  lcplab report mine/results.json      # draws the page again without solving
  lcplab report --section convergence --figure convergence_chain --out chain.pdf
  lcplab report --compare before/results.json after/results.json 1e-9
  lcplab report engines --engine mujoco,rapier

The folder gets results.json, the data of every figure and table, and index.html, a page without network access. \
results.json grows while the report runs: a run that was stopped continues from it. Delete it to start over. \
Results are identical for any number of threads.

Your own problem files: `diagnose FOLDER` explains what a solver leaves unsolved, `compare FILES` compares \
solvers on them, and a report file with the studies `solved` and `profiles` shows both on a page.

Exit codes:
  0  the checks of every section pass
  1  a check fails, a measurement could not be computed, or compared results differ
  2  invalid input or usage")]
pub struct Report {
    /// Report file, name of a shipped report, or results.json of a report to draw again
    #[arg(value_name = "REPORT")]
    report: Option<String>,
    /// With a report: print its tables on the terminal and write no files. Without: list the
    /// shipped reports and the kinds of studies
    #[arg(long, conflicts_with_all = ["compare", "out"])]
    list: bool,
    /// Print the file of a shipped report, to start your own from; the name schema prints the JSON
    /// schema of report files
    #[arg(long, value_name = "NAME", conflicts_with_all = ["report", "list", "compare"])]
    print: Option<String>,
    /// List the differences between two results files, except for times. Numbers pass if they
    /// differ by at most TOLERANCE, relative to the larger one [default: 0]
    #[arg(long, num_args = 2..=3, value_names = ["OLD", "NEW", "TOLERANCE"])]
    compare: Vec<String>,
    /// Run only this section, given by its id: the name of the study, or the anchor in the address
    /// of the page
    #[arg(long, value_name = "ID", conflicts_with = "compare")]
    section: Option<String>,
    /// Write only this figure, given by its id, to the file of --out: .svg, .pdf, or its data as
    /// .csv
    #[arg(long, value_name = "ID", requires = "out", conflicts_with = "compare")]
    figure: Option<String>,
    /// Folder of the report [default: reports/NAME]; or a .pdf file, to which a Chromium or Chrome
    /// on the PATH prints the page
    #[arg(long, conflicts_with = "compare")]
    out: Option<PathBuf>,
    /// Number of threads [default: one per processor]
    #[arg(long, value_parser = threads())]
    threads: Option<u16>,
    /// Only for the report named engines: first run these installed physics engines, separated by
    /// commas, or all [default: draw the recorded results]
    #[arg(long, value_name = "NAMES|all", conflicts_with_all = ["compare", "section"])]
    engine: Option<String>,
    #[command(flatten)]
    plugins: Declared,
}

impl Report {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        if self.list && self.report.is_none() {
            return list();
        }
        if let Some(name) = &self.print {
            print(&printed(name)?)?;
            return Ok(Outcome::Good);
        }
        if let [old, new, tolerance @ ..] = &self.compare[..] {
            return changes(Path::new(old), Path::new(new), tolerance.first());
        }
        let browser = self.pdf().map(|_| Browser::find()).transpose()?;
        let record =
            match self.engine.as_ref().map(|names| self.engines(names, limits)).transpose()? {
                Some(Err(reason)) => {
                    say("the run of the engines was stopped; its results are lost");
                    return Ok(Outcome::Stopped(reason));
                }
                Some(Ok(record)) => Some(record),
                None => None,
            };
        let (outcome, page) = self.page(record.as_deref(), limits)?;
        if let (Some(browser), Some(pdf), Some(page)) = (browser, self.pdf(), page) {
            browser.print(&page, pdf)?;
            print(&format!("{}\n", pdf.display()))?;
        }
        Ok(outcome)
    }

    /// The requested report.
    fn name(&self) -> &str {
        self.report.as_deref().unwrap_or("standard")
    }

    /// The requested folder.
    fn folder(&self) -> Option<&Path> {
        let is_file = self.figure.is_some() || self.pdf().is_some();
        self.out.as_deref().filter(|_| !is_file)
    }

    /// The file to which the page is printed.
    fn pdf(&self) -> Option<&Path> {
        let is_pdf = |path: &&Path| path.extension().is_some_and(|ending| ending == "pdf");
        self.out.as_deref().filter(|_| self.figure.is_none()).filter(is_pdf)
    }

    /// Whether only a figure or the terminal's tables are requested.
    fn is_without_page(&self) -> bool {
        self.figure.is_some() || self.list
    }

    /// Runs engines; returns their record, or why they were stopped.
    fn engines(
        &self,
        names: &str,
        limits: &Limits,
    ) -> Result<std::result::Result<PathBuf, Reason>> {
        if self.name() != ENGINES {
            let reason = format!("applies to the report {ENGINES}, not to {}", self.name());
            return Err(Error::invalid("report", "--engine", reason));
        }
        engines::run(names, &folder_of(self.folder(), "reports", ENGINES)?, limits.stop())
    }

    /// Writes the page, of a record if there is one; returns the outcome of the report, and the
    /// page's path.
    fn page(&self, record: Option<&Path>, limits: &Limits) -> Result<(Outcome, Option<PathBuf>)> {
        if self.name() == HANDOUT.name {
            return self.handout();
        }
        let path = Path::new(self.name());
        if path.file_name().is_some_and(|name| name == write::RESULTS) {
            let beside = file::folder_of(path);
            return self.shown(&read_results(path)?, self.folder().unwrap_or(&beside));
        }
        let mut experiment = Experiment::load(self.name())?;
        let (_running, solvers) = self.plugins.start(self.name(), &experiment.plugins)?;
        let mut folder = folder_of(self.folder(), "reports", &experiment.name)?;
        if let Some(record) = record {
            experiment = of_record(record)?;
        }
        if let Some(id) = &self.section {
            experiment = experiment.only(id)?;
            folder = file::inside(&folder, id)?;
        }
        if let Some(threads) = self.threads {
            // Fails only if the pool already exists, and nothing has created it before.
            let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        }
        let is_without_page = self.is_without_page();
        if !is_without_page {
            write::WRITTEN.iter().try_for_each(|name| file::inside(&folder, name).map(drop))?;
        }
        let begun = || interrupted(&folder.join(write::RESULTS));
        let earlier = if is_without_page { None } else { begun() };
        experiment.command = Some(self.command());
        let progress = bar(0, "");
        let save = |results: &Results| match is_without_page {
            true => Ok(()),
            false => write::results(results, &folder),
        };
        let stop = limits.stop();
        let results = run::run(&experiment, earlier.as_ref(), &solvers, &progress, stop, &save)?;
        let stopped = stop.reason().filter(|_| !results.is_complete());
        limits.over();
        progress.finish_and_clear();
        save(&results)?;
        let (outcome, page) = self.shown(&results, &folder)?;
        Ok((stopped.map_or(outcome, Outcome::Stopped), page))
    }

    /// The command that reproduces this page in the default folder.
    fn command(&self) -> String {
        let mut words = vec!["lcplab".to_string(), "report".into()];
        words.extend(self.report.as_deref().map(shell_word));
        if let Some(id) = &self.section {
            words.extend(["--section".into(), shell_word(id)]);
        }
        if let Some(names) = &self.engine {
            words.extend(["--engine".into(), shell_word(names)]);
        }
        words.extend(self.plugins.word());
        words.join(" ")
    }

    /// Writes the page and prints the summary; or writes only a figure, or prints tables.
    fn shown(&self, results: &Results, folder: &Path) -> Result<(Outcome, Option<PathBuf>)> {
        let document = view::document(results)?;
        if let (Some(id), Some(file)) = (&self.figure, &self.out) {
            alone(&document, id, file)?;
            print(&format!("{}\n", file.display()))?;
            return Ok((Outcome::Good, None));
        }
        let outcome = if results.is_good()? { Outcome::Good } else { Outcome::Rejected };
        if self.list {
            let printed =
                |table| print(&(terminal::table_within(&for_terminal(table), WIDTH) + "\n"));
            document.tables.iter().try_for_each(|(_, table)| printed(table))?;
            print(&summary(results)?)?;
            return Ok((outcome, None));
        }
        let page = write::document(&document, folder)?;
        print(&format!("{}{}\n", summary(results)?, page.display()))?;
        Ok((outcome, Some(page)))
    }

    /// The report `chapter`: a notebook in the order of the chapter, run and written as one page.
    fn handout(&self) -> Result<(Outcome, Option<PathBuf>)> {
        let option = self.list.then_some("--list").or(self.figure.is_some().then_some("--figure"));
        if let Some(option) = option {
            let reason = format!("the report {} is one page, without tables", HANDOUT.name);
            return Err(Error::invalid("report", option, reason));
        }
        let folder = folder_of(self.folder(), "reports", HANDOUT.name)?;
        let path = file::inside(&folder, "index.html")?;
        let page = HANDOUT.page(&HANDOUT.run()?)?.render()?;
        file::write_in(&folder, "index.html", &page)?;
        print(&format!("{}\n", path.display()))?;
        Ok((Outcome::Good, Some(path)))
    }
}

/// A table of a page with its formulas in Unicode.
fn for_terminal(table: &Table) -> Table {
    let mut table = table.clone();
    let columns = table.columns.iter_mut().flat_map(|own| [&mut own.title, &mut own.unit]);
    let cells = table.rows.iter_mut().flatten().map(|cell| &mut cell.text);
    for text in [&mut table.title, &mut table.how_to_read].into_iter().chain(columns).chain(cells) {
        *text = unicode(text);
    }
    table
}

/// The text that `--print` shows.
fn printed(name: &str) -> Result<String> {
    match name {
        SCHEMA => Ok(format!("{}\n", experiment::schema())),
        _ => experiment::shipped(name, "shipped report").map(String::from),
    }
}

/// Lists the differences between two results files.
fn changes(old: &Path, new: &Path, tolerance: Option<&String>) -> Result<Outcome> {
    let relative = tolerance.map_or(Ok(0.0), |text| text.parse()).map_err(|_| {
        let reason = format!("the tolerance {tolerance:?} is not a number");
        Error::invalid("report", "--compare", reason)
    })?;
    let tolerance = Tolerance { relative, absolute: 0.0 };
    let changes = difference::between(&difference::read(old)?, &difference::read(new)?, tolerance);
    if changes.is_empty() {
        print("no difference\n")?;
        return Ok(Outcome::Good);
    }
    print(&terminal::table(&difference::table(&changes)))?;
    Ok(Outcome::Rejected)
}

/// The report on engines that draws this record.
fn of_record(record: &Path) -> Result<Experiment> {
    let record = toml::Value::from(record.display().to_string());
    let study = "study = \"cards\"\n";
    let text = experiment::shipped(ENGINES, "report")?;
    let text = text.replace(study, &format!("{study}record = {record}\n"));
    Experiment::parse(&text, "engines.toml", ENGINES)
}

/// Lists the shipped reports, and the kinds of studies of report files.
fn list() -> Result<Outcome> {
    let mut text = "reports\n".to_string();
    for (name, _) in SHIPPED {
        text += &format!("  {name:<17} {}\n", Experiment::load(name)?.title);
    }
    text += &format!(
        "  {:<17} {}\n\nstudies\n",
        HANDOUT.name, "the chapter, with all its examples computed"
    );
    for kind in KINDS {
        text += &format!("  {:<17} {}\n", kind.name, kind.title);
    }
    print(&text)?;
    Ok(Outcome::Good)
}

/// The outcome of each section, with powers of ten as they are printed.
fn summary(results: &Results) -> Result<String> {
    Ok(terminal::hanging(&plain(&results.summary()?), NAME, WIDTH))
}

/// The results in a file.
fn read_results(path: &Path) -> Result<Results> {
    serde_json::from_value(difference::read(path)?)
        .map_err(|cause| Error::invalid(path.display().to_string(), "results", cause.to_string()))
}

/// Writes a single figure.
fn alone(document: &view::ReportPage, id: &str, file: &Path) -> Result<()> {
    let known = || document.figures.iter().map(|figure| figure.id().into()).collect();
    let figure = document.figures.iter().find(|figure| figure.id() == id);
    let figure = figure.ok_or_else(|| Error::Unknown {
        kind: "figure in this report",
        name: id.into(),
        known: known(),
    })?;
    match file.extension().and_then(|ending| ending.to_str()) {
        Some("svg") => file::write(file, figure.svg()),
        Some("csv") => file::write(file, figure.csv()),
        Some("pdf") => Browser::find()?.print_picture(&figure.svg(), file),
        _ => {
            let reason = "must end in .svg, .pdf or .csv";
            Err(Error::invalid(file.display().to_string(), "--out", reason))
        }
    }
}

/// The sections of an interrupted run that have not been edited since; `None` if there is no such
/// run, or it is not readable.
fn interrupted(path: &Path) -> Option<Results> {
    let results: Results = serde_json::from_value(difference::read(path).ok()?).ok()?;
    if results.is_complete() {
        return None;
    }
    let (results, edited) = results.unedited();
    for id in edited {
        let file = path.display();
        say(&format!("warning: {file}: section {id} was edited: lcplab computes it again"));
    }
    Some(results)
}

/// A word quoted for a shell, if necessary.
fn shell_word(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_string();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}
