//! `report`: runs the studies of a report file and writes its page.

use std::path::{Path, PathBuf};

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::lcp::exchange;
use lcplab::lesson::Program;
use lcplab::report::difference::Tolerance;
use lcplab::report::experiment::{self, Experiment, SHIPPED};
use lcplab::report::kind::KINDS;
use lcplab::report::proofs::Proofs;
use lcplab::report::results::Results;
use lcplab::report::{difference, run, text, view, write};
use lcplab::solver::Reason;

use super::engines;
use super::limits::Limits;
use super::pdf::Browser;
use super::plugin::Declared;
use super::{Outcome, bar, folder_of, print, say, threads};
use crate::handout::ALL;

/// The walk through the chapter.
const HANDOUT: &Program = &ALL[0];

/// The report that draws what physics engines did.
const ENGINES: &str = "engines";

/// Run a report and write its page
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab report                # writes reports/standard/index.html
  lcplab report chapter        # the chapter, walked through with everything computed
  lcplab report solvers --pdf  # all solvers on all families of problems; and report.pdf
  lcplab report --print standard > mine.toml   # a start for a report of your own
  lcplab report mine.toml --out mine
  lcplab report frames/*.json --solver pgs --sweeps 10   # problems of your own: what is missing, who solves them
  lcplab report engines --engine mujoco,rapier # engines that are installed, run on this machine
  lcplab report --proofs       # with proof files, and buttons on the page that check them
  lcplab report --section convergence          # one section of the standard report
  lcplab report --section convergence --figure convergence_chain --out chain.pdf   # one figure alone
  lcplab report --redraw reports/standard      # the page again, nothing is solved
  lcplab report --compare before/results.json after/results.json

The folder gets index.html, which needs no network, results.json, and the data of every figure and
table. results.json grows while the report runs; a run that was stopped goes on from it. Exit code 1 if a known number is missed or a solver's claim is refuted, if a study fails, if the
solver leaves something of problem files undone, or if compared results differ, 2 for bad input.")]
pub struct Report {
    /// A report file, the name of a shipped report, or problem files, folders and patterns of them
    #[arg(default_value = "standard")]
    report: Vec<String>,
    /// Of problem files: the solver whose answers are examined
    #[arg(long, default_value = "pgs")]
    solver: String,
    /// Of problem files: most sweeps or pivots of that solver
    #[arg(long, visible_alias = "sweeps", default_value_t = 10)]
    max_iterations: usize,
    /// List the shipped reports and the kinds of studies that a report file can ask for
    #[arg(long, conflicts_with_all = ["redraw", "compare"])]
    list: bool,
    /// Print the file of a shipped report, as a start for one of your own
    #[arg(long, value_name = "NAME", conflicts_with_all = ["redraw", "compare"])]
    print: Option<String>,
    /// Print the JSON schema of report files
    #[arg(long, conflicts_with_all = ["redraw", "compare"])]
    schema: bool,
    /// Draw the page of a folder with results.json again
    #[arg(long, value_name = "FOLDER", conflicts_with = "compare")]
    redraw: Option<PathBuf>,
    /// List what differs between two results files, times aside
    #[arg(long, num_args = 2, value_names = ["OLD", "NEW"])]
    compare: Vec<PathBuf>,
    /// Relative difference of numbers that --compare lets pass
    #[arg(long, allow_negative_numbers = true, default_value_t = 0.0, requires = "compare")]
    tolerance: f64,
    /// Run one section alone, by its id: the study's name, or the anchor in the page's address
    #[arg(long, value_name = "ID")]
    section: Option<String>,
    /// Write one figure alone, by its id, to the file of --out: .svg, .pdf, or its numbers as .csv. With --redraw nothing
    /// is computed; with --section only that section is
    #[arg(long, value_name = "ID", requires = "out", conflicts_with_all = ["compare", "pdf", "proofs"])]
    figure: Option<String>,
    /// Start over even if an interrupted run has left results to go on from
    #[arg(long)]
    fresh: bool,
    /// Difference of numbers that --compare lets pass, whatever their size
    #[arg(long, allow_negative_numbers = true, default_value_t = 0.0, requires = "compare")]
    absolute: f64,
    /// Folder of the report [default: reports/NAME]
    #[arg(long)]
    out: Option<PathBuf>,
    /// Threads to use; the results are the same for any number
    #[arg(long, value_parser = threads())]
    threads: Option<u16>,
    /// Print the page to report.pdf beside it too, by a Chromium or Chrome that is on the PATH
    #[arg(long, conflicts_with = "compare")]
    pdf: bool,
    /// Prove what the rows about single problems say, and let the page check it
    #[arg(long, conflicts_with = "compare")]
    proofs: bool,
    /// Of the report engines: run these physics engines first, with commas between them, or all that are installed, by
    /// python3 -m lcplab.cards; without it the recorded page is drawn
    #[arg(long, value_name = "NAMES|all", conflicts_with_all = ["redraw", "compare", "section"])]
    engine: Option<String>,
    #[command(flatten)]
    plugins: Declared,
}

impl Report {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        if self.list {
            return list();
        }
        if let Some(name) = &self.print {
            print(experiment::shipped(name, "shipped report")?)?;
            return Ok(Outcome::Good);
        }
        if self.schema {
            print(&format!("{}\n", experiment::schema()))?;
            return Ok(Outcome::Good);
        }
        if let [old, new] = &self.compare[..] {
            return self.changes(old, new);
        }
        let browser = self.pdf.then(Browser::find).transpose()?;
        let record =
            match self.engine.as_ref().map(|names| self.engines(names, limits)).transpose()? {
                Some(Err(reason)) => {
                    say("the engines were stopped, and what they did is lost");
                    return Ok(Outcome::Stopped(reason));
                }
                Some(Ok(record)) => Some(record),
                None => None,
            };
        let (outcome, page) = self.page(record.as_deref(), limits)?;
        if let Some(browser) = browser {
            print(&format!("{}\n", browser.print(&page)?.display()))?;
        }
        Ok(outcome)
    }

    /// Runs engines; returns their record, or why they were stopped.
    fn engines(
        &self,
        names: &str,
        limits: &Limits,
    ) -> Result<std::result::Result<PathBuf, Reason>> {
        if self.report != [ENGINES] {
            let reason = format!("belongs to the report {ENGINES}, not to {}", self.report[0]);
            return Err(Error::invalid("report", "--engine", reason));
        }
        let out = self.out.as_deref().filter(|_| self.figure.is_none());
        engines::run(names, &folder_of(out, "reports", ENGINES)?, limits.stop())
    }

    /// Writes the page, of a record if there is one; returns how the report came out, and the page's path.
    fn page(&self, record: Option<&Path>, limits: &Limits) -> Result<(Outcome, PathBuf)> {
        if let Some(folder) = &self.redraw {
            return self.shown(&read_results(folder)?, folder);
        }
        let mut experiment = match &self.report[..] {
            [name] if name == HANDOUT.name => return self.handout(),
            [name] if !is_of_problems(name) => Experiment::load(name)?,
            names => Experiment::of_problems(names, &self.solver, self.max_iterations)?,
        };
        let _running = self.plugins.start(&self.report[0], &experiment.plugins)?;
        let out = self.out.as_deref().filter(|_| self.figure.is_none());
        let mut folder = folder_of(out, "reports", &experiment.name)?;
        if let Some(record) = record {
            experiment = of_record(record)?;
        }
        if let Some(id) = &self.section {
            experiment = experiment.only(id)?;
            folder = file::inside(&folder, id)?;
        }
        if let Some(threads) = self.threads {
            // Fails only if the pool exists already, which nothing before this has made.
            let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        }
        let is_alone = self.figure.is_some();
        if !is_alone {
            write::WRITTEN.iter().try_for_each(|name| file::inside(&folder, name).map(drop))?;
        }
        let begun = || interrupted(&folder.join(write::RESULTS));
        let earlier = if self.fresh || is_alone { None } else { begun() };
        experiment.command = Some(self.command());
        let progress = bar(0, "");
        let save = |results: &Results| match is_alone {
            true => Ok(()),
            false => write::results(results, &folder),
        };
        let stop = limits.stop();
        let results = run::run(&experiment, earlier.as_ref(), &progress, stop, &save)?;
        let stopped = stop.reason().filter(|_| !results.is_complete());
        limits.over();
        progress.finish_and_clear();
        save(&results)?;
        let (outcome, page) = self.shown(&results, &folder)?;
        Ok((stopped.map_or(outcome, Outcome::Stopped), page))
    }

    /// The command that makes this page again, wherever it is run from the same folder.
    fn command(&self) -> String {
        let mut words = vec!["lcplab".to_string(), "report".into()];
        words.extend(self.report.iter().map(|name| shell_word(name)));
        if is_of_problems(&self.report[0]) {
            words.extend(["--solver".into(), shell_word(&self.solver)]);
            words.extend(["--sweeps".into(), self.max_iterations.to_string()]);
        }
        if let Some(id) = &self.section {
            words.extend(["--section".into(), shell_word(id)]);
        }
        if let Some(folder) = &self.out {
            words.extend(["--out".into(), shell_word(&folder.display().to_string())]);
        }
        if self.proofs {
            words.push("--proofs".into());
        }
        if let Some(names) = &self.engine {
            words.extend(["--engine".into(), shell_word(names)]);
        }
        words.extend(self.plugins.word());
        words.join(" ")
    }

    /// Writes the page, with proofs if they are asked for, and prints the summary; or a figure alone.
    fn shown(&self, results: &Results, folder: &Path) -> Result<(Outcome, PathBuf)> {
        let mut document = view::document(results)?;
        if let (Some(id), Some(file)) = (&self.figure, &self.out) {
            alone(&document, id, file)?;
            print(&format!("{}\n", file.display()))?;
            return Ok((Outcome::Good, file.clone()));
        }
        if self.proofs {
            let progress = bar(0, "proofs");
            let proofs = Proofs::of(&Experiment::of(results)?, &progress)?;
            progress.finish_and_clear();
            proofs.write(folder)?;
            proofs.onto(&mut document);
            let left_out = match proofs.left_out {
                0 => String::new(),
                count => format!(", {count} more would be too many files"),
            };
            say(&format!("{} proofs in {}/proofs{left_out}", proofs.count(), folder.display()));
        }
        let page = write::document(&document, folder)?;
        print(&format!("{}\n{}\n", results.summary()?, page.display()))?;
        Ok((if results.is_good()? { Outcome::Good } else { Outcome::Refuted }, page))
    }

    fn changes(&self, old: &Path, new: &Path) -> Result<Outcome> {
        let tolerance = Tolerance { relative: self.tolerance, absolute: self.absolute };
        let changes =
            difference::between(&difference::read(old)?, &difference::read(new)?, tolerance);
        if changes.is_empty() {
            print("no difference\n")?;
            return Ok(Outcome::Good);
        }
        print(&text::table(&difference::table(&changes)))?;
        Ok(Outcome::Refuted)
    }

    /// The report `chapter`: a notebook in the order of the chapter, run and written as one page.
    fn handout(&self) -> Result<(Outcome, PathBuf)> {
        let folder = folder_of(self.out.as_deref(), "reports", HANDOUT.name)?;
        let path = file::inside(&folder, "index.html")?;
        let page = HANDOUT.page(&HANDOUT.run()?)?.render()?;
        file::write_in(&folder, "index.html", &page)?;
        print(&format!("{}\n", path.display()))?;
        Ok((Outcome::Good, path))
    }
}

/// The report on engines that draws this record.
fn of_record(record: &Path) -> Result<Experiment> {
    let record = toml::Value::from(record.display().to_string());
    let text = format!("{}record = {record}\n", experiment::shipped(ENGINES, "report")?);
    Experiment::parse(&text, "engines.toml", ENGINES)
}

/// Whether a name is that of a problem file, or of a folder or a pattern of them; the name of a shipped report is none.
fn is_of_problems(name: &str) -> bool {
    let path = Path::new(name);
    let is_shipped = SHIPPED.iter().any(|(shipped, _)| *shipped == name);
    let is_pattern = name.contains('*') && !path.exists();
    !is_shipped && (exchange::is_problem(path) || path.is_dir() || is_pattern)
}

/// What can be run, and what a report file can ask for.
fn list() -> Result<Outcome> {
    let mut text = "reports\n".to_string();
    for (name, _) in SHIPPED {
        text += &format!("  {name:<17} {}\n", Experiment::load(name)?.title);
    }
    text += &format!("  {:<17} {}\n\nstudies\n", HANDOUT.name, "the chapter, everything computed");
    for kind in KINDS {
        text += &format!("  {:<17} {}\n", kind.name, kind.title);
    }
    print(&text)?;
    Ok(Outcome::Good)
}

/// The results of a folder.
fn read_results(folder: &Path) -> Result<Results> {
    let path = folder.join(write::RESULTS);
    serde_json::from_value(difference::read(&path)?)
        .map_err(|cause| Error::invalid(path.display().to_string(), "results", cause.to_string()))
}

/// Writes a figure alone.
fn alone(document: &view::Document, id: &str, file: &Path) -> Result<()> {
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

/// What a run that did not come to its end has left, as far as nobody has changed it since; nothing if
/// there is none, or it is not readable.
fn interrupted(path: &Path) -> Option<Results> {
    let results: Results = serde_json::from_value(difference::read(path).ok()?).ok()?;
    if results.is_complete() {
        return None;
    }
    let (results, edited) = results.unedited();
    for id in edited {
        let file = path.display();
        say(&format!("warning: {file}: section {id} is not as it was written: it is done again"));
    }
    Some(results)
}

/// A word as a shell takes it: in quotes if it needs them.
fn shell_word(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_string();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}
