//! `gradient`: derivatives of a solution with respect to the data of its problem.

use std::path::PathBuf;

use clap::Args;
use dashu_ratio::RBig;
use lcplab::error::{Error, Result};
use lcplab::file::read;
use lcplab::files;
use lcplab::gradient::{Direction, Gradient, Pullback, Theirs};
use lcplab::lcp::Question;
use lcplab::number::readable;
use lcplab::report::answer::first_answer;
use serde_json::{Map, Value};

use super::limits::MemoryLimit;
use super::problem::title;
use super::{Outcome, print, read_problem};

/// Maximum number of entries of a list that are printed.
const PRINTED: usize = 12;
/// Significant digits.
const DIGITS: usize = 5;

/// Differentiate a solution exactly, or check the derivative of another program
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab gradient problem.json                          # the table dx/db, with its certificate
  lcplab gradient problem.json answer.json --row 3      # of x_3, with respect to b, A, mu, lo and hi
  lcplab gradient problem.json --motion 0               # of u_0; the file needs the key motion
  lcplab gradient problem.json --direction change.json  # dx for a change of the data
  lcplab gradient problem.json --theirs mine.json       # right? If not, which mistake is it?

Without ANSWER, lcplab solves the problem. The derivative is that of the exact solution next to the answer, which \
may have up to 150 rows; the table dx/db has up to 50. At a kink, a row at a bound with w = 0, lcplab reports \
the left and the right derivative.

The file of --direction is a JSON object with some of the keys b, A, mu, lo, hi, and target, bias, compliance, mass, \
jacobian of the key motion; A, mass and jacobian are lists of [row, column, value]. The file of --theirs has the \
key dx_db, an n × n matrix with dx_i/db_j in row i; h, if it comes from finite differences of this step; and \
tolerance, relative to the largest entry of a row and column [default: 1e-4].

Exit codes:
  0  x has a derivative, also a one-sided one or that of the motion; with --theirs: theirs is right
  1  x has none, or theirs is wrong
  2  invalid input or usage, or no exact solution is known next to the answer")]
pub struct Derivatives {
    /// Problem file; its extension determines the format; - reads JSON from standard input
    problem: PathBuf,
    /// Answer file: a JSON object with the key "x" [default: lcplab's own answer]
    answer: Option<PathBuf>,
    /// Print the gradient of x in this row
    #[arg(long, value_name = "ROW")]
    row: Vec<usize>,
    /// Print the gradient of this entry of the motion u
    #[arg(long, value_name = "ENTRY")]
    motion: Vec<usize>,
    /// Print the derivative for a change of the data
    #[arg(long, value_name = "FILE")]
    direction: Option<PathBuf>,
    /// Compare a matrix dx/db from another program, and name its mistake
    #[arg(long, value_name = "FILE")]
    theirs: Option<PathBuf>,
    #[command(flatten)]
    memory: MemoryLimit,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Derivatives {
    pub fn run(&self) -> Result<Outcome> {
        let memory = self.memory.max_memory;
        let problem = read_problem(&self.problem, memory)?;
        let input = self.problem.display().to_string();
        let question = Question::new(&problem, None, &input)?;
        let n = question.require_boxed("derivatives are", &input)?.len();
        let x = match &self.answer {
            Some(path) => files::read_answers(path, n, memory)?.x,
            None => first_answer(&question),
        };
        let gradient = Gradient::of(&problem, &x)?;
        let mut text = format!("{}\n{}", title(&problem), gradient.text());
        let mut object = gradient.json();
        let mut outcome = if gradient.is_known() { Outcome::Good } else { Outcome::Rejected };
        for (name, entries, len) in
            [("x", &self.row, n), ("u", &self.motion, gradient.motion_len())]
        {
            let mut all = Map::new();
            for &i in entries {
                let pullback = of_entry(&gradient, name, i, len)?;
                text += &pullback_text(&format!("gradient of {name}_{i}"), &pullback);
                all.insert(i.to_string(), pullback.json());
            }
            if !all.is_empty() {
                object.insert(format!("gradient_of_{name}"), Value::Object(all));
            }
        }
        if let Some(path) = &self.direction {
            let own = read(path, memory)?;
            let direction = Direction::read(&own, &path.display().to_string())?;
            let [right, left] = gradient.directional(&direction)?;
            text += &format!("derivative in the direction of {}\n", path.display());
            let sides = [("dx", &right.x), ("du", &right.u)];
            for (name, v) in sides.into_iter().filter_map(|(name, v)| Some((name, v.as_ref()?))) {
                text += &line(name, v);
            }
            if right != left {
                text += "derivative from the left\n";
                for (name, v) in [("dx", &left.x), ("du", &left.u)] {
                    text += &v.as_ref().map(|v| line(name, v)).unwrap_or_default();
                }
            }
            object.insert("right".into(), right.json());
            object.insert("left".into(), left.json());
        }
        if let Some(path) = &self.theirs {
            let own = read(path, memory)?;
            let theirs = Theirs::read(&own, &path.display().to_string(), n)?;
            let found = gradient.compare(&theirs)?;
            text += &found.text();
            object.insert("theirs".into(), found.json());
            outcome = if found.is_right { Outcome::Good } else { Outcome::Rejected };
        }
        print(&if self.json { format!("{}\n", Value::Object(object)) } else { text })?;
        Ok(outcome)
    }
}

/// The gradient of one entry of x or u.
fn of_entry(gradient: &Gradient, name: &str, i: usize, len: usize) -> Result<Pullback> {
    if i >= len {
        let option = if name == "x" { "--row" } else { "--motion" };
        let reason = format!("is {i}, {name} has {len} entries");
        return Err(Error::invalid("options", option, reason));
    }
    let n = gradient.x().len();
    let unit = |len: usize| (0..len).map(|k| f64::from(k == i)).collect::<Vec<f64>>();
    match name {
        "x" => gradient.pullback(&unit(n), None),
        _ => gradient.pullback(&vec![0.0; n], Some(&unit(len))),
    }
}

fn pullback_text(heading: &str, pullback: &Pullback) -> String {
    let mut text = format!("{heading}\n");
    for (name, own) in
        [("b", &pullback.b), ("mu", &pullback.mu), ("lo", &pullback.lo), ("hi", &pullback.hi)]
    {
        text += &line(name, own);
    }
    let a = |b: &RBig| pullback.x.iter().map(|x| b * x).collect::<Vec<RBig>>();
    text += &entries("A", &pullback.b.iter().map(a).collect::<Vec<_>>());
    if let Some(motion) = &pullback.motion {
        text += &line("target", &motion.target);
        text += &line("bias", &motion.bias);
        text += &line("compliance", &motion.compliance);
        text += &entries("mass", &motion.mass);
        text += &entries("jacobian", &motion.jacobian);
    }
    if text.lines().count() == 1 { text + "  all entries are 0\n" } else { text }
}

/// The entries that are not 0 on a line; none if all are.
fn line(name: &str, v: &[RBig]) -> String {
    let places = v.iter().enumerate().map(|(i, v)| (i.to_string(), v));
    listed(name, places.collect())
}

fn entries(name: &str, table: &[Vec<RBig>]) -> String {
    let row = |(i, row): (usize, &Vec<RBig>)| -> Vec<(String, RBig)> {
        row.iter().enumerate().map(|(j, v)| (format!("({i}, {j})"), v.clone())).collect()
    };
    let all: Vec<(String, RBig)> = table.iter().enumerate().flat_map(row).collect();
    listed(name, all.iter().map(|(place, v)| (place.clone(), v)).collect())
}

fn listed(name: &str, mut all: Vec<(String, &RBig)>) -> String {
    all.retain(|(_, v)| **v != RBig::ZERO);
    let shown =
        |(place, v): &(String, &RBig)| format!("{place}: {}", readable(v.to_f64().value(), DIGITS));
    let words: Vec<String> = all.iter().take(PRINTED).map(shown).collect();
    let more = match all.len().saturating_sub(PRINTED) {
        0 => String::new(),
        more => format!(", and {more} more: see --json"),
    };
    if all.is_empty() { String::new() } else { format!("  {name:<11}{}{more}\n", words.join(", ")) }
}
