//! `problems` and `generate`: the problem library.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::Result;
use lcplab::file;
use lcplab::lcp::file::SCHEMA;
use lcplab::lcp::library::{self, Family};
use lcplab::problem_set;

use super::{Outcome, bar, print};

/// List the families of the problem library, or what is known of one
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab problems
  lcplab problems manufactured   # its parameters
  lcplab problems --export set; lcplab compare-solvers set --profile profile")]
pub struct Problems {
    /// Describe this family and its parameters
    name: Option<String>,
    /// Write the library and steps of the shipped scenes into this folder: a file a problem, and index.csv with a card
    /// of each
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
            print(&format!("{count} problems in {}\n", folder.display()))?;
            return Ok(Outcome::Good);
        }
        let text = match &self.name {
            _ if self.schema => SCHEMA.to_string(),
            Some(name) => description(library::by_name(name)?),
            None => library::all()
                .map(|family| format!("{:<18} {}\n", family.name(), family.about()))
                .collect(),
        };
        print(&text)?;
        Ok(Outcome::Good)
    }
}

fn description(family: &dyn Family) -> String {
    let mut text = format!("{}: {}\n{}\n", family.name(), family.about(), family.source());
    for p in family.parameters() {
        let range = format!("{} … {}", p.least, p.most);
        text += &format!("  {:<12} {:<20} {}, {} by default\n", p.name, range, p.about, p.default);
    }
    text
}

/// Write a problem of the library as a problem file
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab generate fathi --n 8 | lcplab solve - --solver murty
  lcplab generate manufactured --n 100 --seed 7 --set rank=0.5 --out singular.json

The key \"expected\" of the file holds the exact solutions, where they are known.")]
pub struct Generate {
    /// A family that `problems` lists
    name: String,
    /// The parameter n
    #[arg(long, allow_negative_numbers = true)]
    n: Option<f64>,
    /// The seed of the random numbers
    #[arg(long, allow_negative_numbers = true)]
    seed: Option<f64>,
    /// Any parameter, as NAME=VALUE
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    set: Vec<(String, f64)>,
    /// The file [default: standard output]
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Generate {
    pub fn run(&self) -> Result<Outcome> {
        let named = [("n", self.n), ("seed", self.seed)];
        let named = named.into_iter().filter_map(|(name, value)| Some((name, value?)));
        let set = self.set.iter().map(|(name, value)| (name.as_str(), *value));
        let values: Vec<(&str, f64)> = named.chain(set).collect();
        let problem = library::by_name(&self.name)?.generate(&values)?;
        let text = format!("{}\n", problem.to_json());
        match &self.out {
            Some(path) => file::write(path, &text)?,
            None => print(&text)?,
        }
        Ok(Outcome::Good)
    }
}

fn assignment(text: &str) -> std::result::Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("must be NAME=VALUE")?;
    let value = value.parse().map_err(|_| format!("{value:?} is not a number"))?;
    Ok((name.to_string(), value))
}
