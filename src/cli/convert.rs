//! `convert`: writes a problem in another file format.

use std::path::{Path, PathBuf};

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::files::{self, ALL, Format};

use super::limits::MemoryLimit;
use super::{Outcome, print, say, warn};

/// Convert a problem file to another format, or list the formats
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab convert problem.npz problem.json
  lcplab export stack --step 50 | lcplab convert - stack.mtx   # also writes stack_b.mtx, …
  lcplab convert dumps/ contact.json        # Chrono's dump_H.dat, dump_Cq.dat, … in a folder
  lcplab convert lcp.txt - --from siconos   # to standard output
  lcplab convert program.mat program.json --scale 1e-6   # a smaller x is rounding
  lcplab convert --list                     # the formats, their contents and pitfalls

The extensions determine the formats unless --from or --to is given. It is an error if the target format \
cannot store the problem. Standard error has the friction model of FROM, the metadata that TO cannot store, and a warning if TO implies \
another friction model.

Exit codes:
  0  written
  2  invalid input or usage")]
pub struct Convert {
    /// Problem: a file, a folder, the common beginning of the names of several files, or - for
    /// standard input
    #[arg(value_name = "FROM", required_unless_present = "list")]
    source: Option<PathBuf>,
    /// File to write, with more files next to it if the format has several; - for standard output
    #[arg(value_name = "TO", required_unless_present = "list")]
    target: Option<PathBuf>,
    /// Format of FROM
    #[arg(long, value_name = "FORMAT")]
    from: Option<String>,
    /// Format of TO
    #[arg(long, value_name = "FORMAT")]
    to: Option<String>,
    /// State the smallest significant size of x: a row whose terms are smaller is judged as if they
    /// had this size
    #[arg(long, value_name = "SIZE")]
    scale: Option<f64>,
    /// List the formats
    #[arg(long, exclusive = true)]
    list: bool,
    #[command(flatten)]
    memory: MemoryLimit,
}

impl Convert {
    pub fn run(&self) -> Result<Outcome> {
        let format = |name: &Option<String>| name.as_deref().map(Format::by_name).transpose();
        let (from, to) = (format(&self.from)?, format(&self.to)?);
        let (Some(source), Some(target)) = (&self.source, &self.target) else {
            print(&ALL.iter().map(description).collect::<String>())?;
            return Ok(Outcome::Good);
        };
        if source.is_dir() && !files::is_problem(source) {
            let reason =
                "is a folder that is no problem of several files; convert its files one by one";
            return Err(Error::invalid(source.display().to_string(), "file", reason));
        }
        let mut problem = files::read_within(source, from, self.memory.max_memory)?;
        warn(&problem);
        if let Some(scale) = self.scale {
            let stated = problem.lcp.with_scale(scale);
            problem.lcp = stated.map_err(|_| {
                Error::invalid("--scale", scale.to_string(), "must be finite and not negative")
            })?;
        }
        let to = to.or_else(|| Format::of(target));
        if let Some(model) = files::model(&problem) {
            say(&format!("note: {}: the friction model is {model}", source.display()));
        }
        let notes = if target == Path::new("-") {
            let output = files::encode(&problem, to.unwrap_or(&files::JSON))?;
            let text = String::from_utf8(output.main).ok().filter(|_| output.parts.is_empty());
            let reason = "is not a single text: it needs a file";
            print(&text.ok_or_else(|| Error::invalid("-", "format", reason))?)?;
            output.notes
        } else {
            files::write(&problem, target, to)?
        };
        if let Some((own, meant)) = files::remodelled(&problem, to.unwrap_or(&files::JSON)) {
            let (from, format) = (source.display(), to.unwrap_or(&files::JSON).name);
            say(&format!(
                "warning: {}: {format} means {meant}, {from} is {own}: the two problems have different solutions",
                target.display()
            ));
        }
        notes.iter().for_each(|note| say(&format!("note: {note}")));
        Ok(Outcome::Good)
    }
}

fn description(format: &Format) -> String {
    let Format { name, about, carries, trap, .. } = format;
    let endings = format.endings.join(", ");
    let only = if format.write.is_some() { "" } else { "; import only" };
    format!(
        "{name:<14} {about}\n  files    *{endings}{only}\n  stores   {carries}\n  pitfall  {trap}\n"
    )
}
