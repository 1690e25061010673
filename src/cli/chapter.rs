//! `chapter`: the statements of K&M, whether they are correct, and where the library has them.

use clap::Args;
use lcplab::chapter::inventory::{self, Verdict};
use lcplab::chapter::{errata, exhibit, glossary, references};
use lcplab::document::Document;
use lcplab::error::{Error, Result};
use serde_json::Value;

use super::form::Writing;
use super::{Outcome, print};

/// List the statements of the chapter by Kenwright & Morgan and whether each is correct, or show a
/// statement or an erratum
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab chapter              # all equations, listings, figures, notes, claims, …
  lcplab chapter --kind equations --verdict wrong
  lcplab chapter 16           # equation (16); also \"Code 6\", \"Fig 8\", T20
  lcplab chapter E07          # an erratum: printed and correct form, with an example that runs
  lcplab chapter errata       # all errata; runs their examples
  lcplab chapter glossary
  lcplab chapter references --format html --out literature.html

Kinds: equations, unnumbered, listings, figures, notes, claims, techniques, demos, future.

Verdicts: right, convention (another choice is usual), misprint, misleading, wrong, confirmed (by measurement), opinion, rebuilt (drawn again by lcplab).

Exit codes:
  0  printed or written
  1  an example does not show what its erratum claims
  2  invalid input or usage")]
pub struct Chapter {
    /// Entry such as (16), 16, "Code 6" or T20, erratum such as E07, or one of errata, glossary,
    /// references [default: list the entries]
    name: Option<String>,
    /// List only entries of this kind
    #[arg(long)]
    kind: Option<String>,
    /// List only entries with this verdict
    #[arg(long)]
    verdict: Option<String>,
    /// Print entries or errata as JSON
    #[arg(long, conflicts_with_all = ["format", "out"])]
    json: bool,
    #[command(flatten)]
    writing: Writing,
}

impl Chapter {
    pub fn run(&self) -> Result<Outcome> {
        let Some(name) = self.name.as_deref() else { return self.list() };
        for (option, given) in [("--kind", &self.kind), ("--verdict", &self.verdict)] {
            if given.is_some() {
                return Err(Error::invalid(
                    "options",
                    option,
                    format!("applies to the list, not to {name}"),
                ));
            }
        }
        match name.to_lowercase().as_str() {
            "errata" => self.errata(),
            "glossary" => self.page(&glossary::document()),
            "references" => self.page(&references::document()),
            erratum if is_erratum(erratum) => self.exhibit(erratum),
            _ => self.entry(name),
        }
    }

    fn list(&self) -> Result<Outcome> {
        let kind = self.kind.as_deref().map(inventory::group).transpose()?;
        let verdict = self.verdict.as_deref().map(Verdict::named).transpose()?;
        if !self.json {
            return self.writing.write(&inventory::list(kind, verdict));
        }
        let entries = inventory::chosen(kind, verdict).flat_map(|(group, entries)| {
            entries.into_iter().map(move |entry| entry.to_json(&group.kind))
        });
        self.object(&entries.collect(), Outcome::Good)
    }

    fn entry(&self, name: &str) -> Result<Outcome> {
        let (group, entry) = inventory::named(name)?;
        if self.json {
            return self.object(&entry.to_json(&group.kind), Outcome::Good);
        }
        self.writing.write(&entry.document())
    }

    fn exhibit(&self, name: &str) -> Result<Outcome> {
        let exhibit = exhibit::named(name)?;
        if !self.json {
            return self.writing.write(&exhibit.document()?);
        }
        let tried = errata::ErratumResult::of(exhibit)?;
        self.object(&tried.to_json(), outcome(tried.is_shown != Some(false)))
    }

    fn errata(&self) -> Result<Outcome> {
        let tried = errata::tried()?;
        let document = errata::document(&tried);
        if !self.json {
            return self.writing.write(&document);
        }
        let list = tried.iter().map(errata::ErratumResult::to_json).collect();
        self.object(&list, outcome(document.is_accepted))
    }

    fn page(&self, document: &Document) -> Result<Outcome> {
        if self.json {
            return Err(Error::invalid("options", "--json", "applies only to entries and errata"));
        }
        self.writing.write(document)
    }

    fn object(&self, value: &Value, outcome: Outcome) -> Result<Outcome> {
        print(&format!("{value:#}\n"))?;
        Ok(outcome)
    }
}

fn outcome(is_good: bool) -> Outcome {
    if is_good { Outcome::Good } else { Outcome::Rejected }
}

/// Whether a name is E followed by a number.
fn is_erratum(name: &str) -> bool {
    name.strip_prefix('e').is_some_and(|number| number.parse::<u8>().is_ok())
}
