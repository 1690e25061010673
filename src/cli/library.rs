//! `problems`: the problem library.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::Result;
use lcplab::file;
use lcplab::lcp::file::SCHEMA;
use lcplab::lcp::library::{self, Family};
use lcplab::number::counted;
use lcplab::problem_set;

use super::{Outcome, bar, print};

/// List the problem library, or write one or all of its problems as problem files
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab problems                             # the families of the library
  lcplab problems manufactured --parameters   # its parameters
  lcplab problems fathi --n 8 | lcplab solve - --solver murty
  lcplab problems manufactured --n 100 --seed 7 --set rank=0.5 --out singular.json
  lcplab problems --export set; lcplab compare set --profile profile

The key \"expected\" of a problem file contains the exact solutions, if they are known.")]
pub struct Problems {
    /// Write a problem of this family [default: list all families]
    name: Option<String>,
    /// Describe the family and its parameters instead
    #[arg(long, requires = "name", conflicts_with_all = ["n", "seed", "set", "out"])]
    parameters: bool,
    /// Parameter n of the family [default: see --parameters]
    #[arg(long, requires = "name", allow_negative_numbers = true)]
    n: Option<f64>,
    /// Seed of the random numbers [default: see --parameters]
    #[arg(long, requires = "name", allow_negative_numbers = true)]
    seed: Option<f64>,
    /// Set a parameter of the family (repeatable)
    #[arg(long = "set", requires = "name", value_name = "NAME=VALUE", value_parser = assignment)]
    set: Vec<(String, f64)>,
    /// File to write the problem to [default: standard output]
    #[arg(long, requires = "name", value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the library and some steps of the shipped scenes into this folder: one file per
    /// problem, and index.csv with the known properties of each
    #[arg(long, value_name = "FOLDER", conflicts_with = "name")]
    export: Option<PathBuf>,
    /// Print the JSON schema of problem files
    #[arg(long, conflicts_with_all = ["name", "export"])]
    schema: bool,
}

impl Problems {
    pub fn run(&self) -> Result<Outcome> {
        if let Some(folder) = &self.export {
            let progress = bar(0, "problems");
            let count = problem_set::write(folder, &progress)?;
            progress.finish_and_clear();
            print(&format!("{} in {}\n", counted(count, "problem"), folder.display()))?;
            return Ok(Outcome::Good);
        }
        match &self.name {
            _ if self.schema => print(SCHEMA)?,
            Some(name) if self.parameters => print(&description(library::by_name(name)?))?,
            Some(name) => self.write(library::by_name(name)?)?,
            None => print(&list())?,
        }
        Ok(Outcome::Good)
    }

    /// Writes a problem of a family.
    fn write(&self, family: &dyn Family) -> Result<()> {
        let named = [("n", self.n), ("seed", self.seed)];
        let named = named.into_iter().filter_map(|(name, value)| Some((name, value?)));
        let set = self.set.iter().map(|(name, value)| (name.as_str(), *value));
        let values: Vec<(&str, f64)> = named.chain(set).collect();
        let text = format!("{}\n", family.generate(&values)?.to_json());
        match &self.out {
            Some(path) => file::write(path, &text),
            None => print(&text),
        }
    }
}

fn list() -> String {
    let line = |family: &dyn Family| format!("{:<18} {}\n", family.name(), family.about());
    library::all().map(line).collect()
}

fn description(family: &dyn Family) -> String {
    let mut text = format!("{}: {}\n{}\n", family.name(), family.about(), family.source());
    for p in family.parameters() {
        let range = format!("{} … {}", p.least, p.most);
        text += &format!("  {:<12} {:<20} {}, {} by default\n", p.name, range, p.about, p.default);
    }
    text
}

fn assignment(text: &str) -> std::result::Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("must be NAME=VALUE")?;
    let value = value.parse().map_err(|_| format!("{value:?} is not a number"))?;
    Ok((name.to_string(), value))
}
