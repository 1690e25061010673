//! `report`: runs the studies of a report file and writes its page.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::Result;
use lcplab::lesson::Program;
use lcplab::report::experiment::Experiment;
use lcplab::report::{run, write};

use super::{Outcome, bar, print};
use crate::handout::ALL;

/// The walk through the chapter.
const HANDOUT: &Program = &ALL[0];

/// Run a report and write its page
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab report                # writes reports/standard/index.html
  lcplab report chapter        # the chapter, walked through with everything computed
  lcplab report mine.toml --out mine

The folder gets index.html, which needs no network, results.json, and the data of every figure and
table. Exit code 1 if a known number is missed or a solver's claim is refuted, 2 for bad input.")]
pub struct Report {
    /// A report file, or the name of a shipped report
    #[arg(default_value = "standard")]
    report: String,
    /// Folder of the report; reports/NAME without it
    #[arg(long)]
    out: Option<PathBuf>,
    /// Threads to use; the results are the same for any number
    #[arg(long)]
    threads: Option<usize>,
}

impl Report {
    pub fn run(&self) -> Result<Outcome> {
        if self.report == HANDOUT.name {
            return self.handout();
        }
        let experiment = Experiment::load(&self.report)?;
        let folder =
            self.out.clone().unwrap_or_else(|| ["reports", &experiment.name].iter().collect());
        if let Some(threads) = self.threads {
            // Fails only if the pool exists already, which nothing before this has made.
            let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        }
        let progress = bar(0, "");
        let results = run::run(&experiment, &progress)?;
        progress.finish_and_clear();
        let page = write::report(&results, &folder)?;
        print(&format!("{}\n{}\n", results.summary(), page.display()))?;
        Ok(if results.is_good() { Outcome::Good } else { Outcome::Refuted })
    }

    /// The report `chapter`: a notebook in the order of the chapter, run and written as one page.
    fn handout(&self) -> Result<Outcome> {
        let folder = self.out.clone().unwrap_or_else(|| ["reports", HANDOUT.name].iter().collect());
        let page = HANDOUT.page(&HANDOUT.run()?)?.render()?;
        let path = folder.join("index.html");
        write::file(&path, &page)?;
        print(&format!("{}\n", path.display()))?;
        Ok(Outcome::Good)
    }
}
