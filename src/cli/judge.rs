//! `judge`: checks answers to a problem, from any program.

use std::path::PathBuf;

use clap::Args;
use lcplab::diagnosis::{Precision, single_precision};
use lcplab::error::Result;
use lcplab::files;
use lcplab::judge::{Certificate, Demand, Verdict, judge, printed_up};
use lcplab::lcp::Question;
use lcplab::lcp::file::{Problem, number};
use lcplab::lcp::friction::Model;
use lcplab::report::answer::{bound, certificate_text, json_object, searched};
use lcplab::report::friction::JudgedAnswer;
use lcplab::report::loads::Loads;
use lcplab::report::minimum::Descent;
use lcplab::report::motion_error::MotionError;
use lcplab::report::page::{Cell, Table};
use lcplab::report::terminal;
use lcplab::solver::Settings;
use serde_json::{Map, Value, json};

use super::friction;
use super::limits::MemoryLimit;
use super::loads;
use super::mistake;
use super::problem::{rows, title};
use super::{Outcome, print, read_problem, say};

/// Check answers from any program against a problem
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab solve problem.json --json > answer.json; lcplab judge problem.json answer.json
  lcplab judge problem.json mine.json theirs.json     # a table, one answer per row
  lcplab judge friction.json answer.json --model coulomb-cone

An answer file is JSON, such as {\"x\": [0.5, 0]} or the list alone, NumPy's .npy, or .npz with the array x. In JSON the key \
\"iterates\", a list of vectors, adds a row for each of them; iterates do not change the exit code.

Exit codes:
  0  every answer is accepted (with --proved: proved)
  1  an answer is rejected (or not proved)
  2  invalid input or usage")]
pub struct Judge {
    /// Problem file; its extension determines the format; - reads JSON from standard input
    problem: PathBuf,
    /// Answer files: JSON with the key "x", .npy, or .npz
    #[arg(required = true)]
    answers: Vec<PathBuf>,
    /// Friction model [default: the file's]
    #[arg(long)]
    model: Option<Model>,
    /// Largest scaled residual of an accepted answer
    #[arg(long, allow_negative_numbers = true, default_value = "1e-8")]
    tolerance: f64,
    /// Exit with 1 unless every answer is proved
    #[arg(long)]
    proved: bool,
    #[command(flatten)]
    memory: MemoryLimit,
    /// Print the forces for each pair of bodies and for each contact, and mark the unique ones.
    /// The file must have the keys motion, rows and bodies, like the files of `export`
    #[arg(long)]
    loads: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// One x with the judge's verdict.
struct AnswerRow {
    label: String,
    verdict: Verdict,
    scaled_residual: f64,
    is_answer: bool,
}

impl Judge {
    pub fn run(&self) -> Result<Outcome> {
        Settings::default().with_tolerance(self.tolerance).validate()?;
        let memory = self.memory.max_memory;
        let problem = read_problem(&self.problem, memory)?;
        let read = |path: &PathBuf| files::read_answers(path, problem.lcp.len(), memory);
        let input = self.problem.display().to_string();
        let question = Question::new(&problem, self.model, &input)?;
        if self.loads {
            loads::check(&question, &input)?;
        }
        if let [path] = &self.answers[..] {
            let only = read(path)?;
            if only.iterates.is_empty() {
                return self.one(&question, &only.x);
            }
        }
        let (mut all, mut unreadable) = (Vec::new(), Vec::new());
        for path in &self.answers {
            let name = path.display().to_string();
            let answers = match read(path) {
                Ok(answers) => answers,
                Err(error) => {
                    unreadable.push(error);
                    continue;
                }
            };
            for (k, x) in answers.iterates.iter().enumerate() {
                let label = format!("{name}, iterate {}", k + 1);
                all.push(self.judged(label, &question, x, false));
            }
            all.push(self.judged(name, &question, &answers.x, true));
        }
        let outcome = if all.is_empty() { Outcome::Rejected } else { self.many(&problem, &all)? };
        let last = unreadable.pop();
        unreadable.iter().for_each(|error| say(&format!("error: {error}")));
        last.map_or(Ok(outcome), Err)
    }

    fn outcome(&self, verdict: &Verdict) -> Outcome {
        let passes = match self.proved {
            true => matches!(verdict, Verdict::Proved { .. }),
            false => verdict.is_solution(),
        };
        if passes { Outcome::Good } else { Outcome::Rejected }
    }

    fn demand(&self) -> Demand {
        Demand { tolerance: self.tolerance, prove_up_to: Demand::EXACT_ROWS }
    }

    /// Judges one answer and prints its rows.
    fn one(&self, question: &Question, x: &[f64]) -> Result<Outcome> {
        let (demand, problem) = (self.demand(), question.problem());
        if question.model().is_some() {
            let judged = JudgedAnswer::of(question, x, &demand).searched(question.posed(), &demand);
            match self.json {
                true => friction::print_json(question, Map::new(), x, &judged)?,
                false => print(&friction::text(question, &title(problem), "", x, &judged))?,
            }
            return Ok(self.outcome(&judged.certificate.verdict));
        }
        let certificate = judge(&problem.lcp, x, &demand);
        let certificate = searched(&problem.lcp, certificate, &demand);
        let loads = self.loads.then(|| Loads::of(question, x)).flatten();
        if self.json {
            let mut object = json_object(&certificate);
            if let Some(bound) = bound(&problem.lcp, x, &certificate) {
                object.insert("error_bound".into(), number(printed_up(bound)));
            }
            object.extend(MotionError::json(question, x));
            if certificate.verdict.is_solution() {
                object.extend(Descent::json(question, x));
            }
            object.extend(loads.map(|loads| ("loads".to_string(), loads.json())));
            print(&format!("{}\n", Value::Object(object)))?;
        } else {
            print(&certified(question, x, &certificate, loads.as_ref()))?;
        }
        Ok(self.outcome(&certificate.verdict))
    }

    fn judged(&self, label: String, question: &Question, x: &[f64], is_answer: bool) -> AnswerRow {
        let certificate = JudgedAnswer::of(question, x, &self.demand()).certificate;
        let (verdict, scaled_residual) = (certificate.verdict, certificate.scaled_residual);
        AnswerRow { label, verdict, scaled_residual, is_answer }
    }

    /// Judges several answers and prints one line for each.
    fn many(&self, problem: &Problem, all: &[AnswerRow]) -> Result<Outcome> {
        if self.json {
            let object = |judged: &AnswerRow| {
                let mut object = Map::new();
                object.insert("answer".into(), json!(judged.label));
                object.insert("scaled_residual".into(), number(judged.scaled_residual));
                object.extend(json_object(&judged.verdict));
                Value::Object(object)
            };
            let answers: Vec<Value> = all.iter().map(object).collect();
            print(&format!("{}\n", json!({ "answers": answers })))?;
        } else {
            let row = |judged: &AnswerRow| {
                let residual = Cell::number(judged.scaled_residual, 3);
                vec![Cell::text(&judged.label), residual, Cell::text(judged.verdict.to_string())]
            };
            let rows = all.iter().map(row).collect();
            let headings = "answer | #scaled residual | verdict";
            print(&terminal::table(&Table::new(title(problem), "", headings, rows)))?;
        }
        let fails = |judged: &&AnswerRow| self.outcome(&judged.verdict) == Outcome::Rejected;
        let wrong = all.iter().filter(|judged| judged.is_answer).find(fails);
        Ok(wrong.map_or(Outcome::Good, |_| Outcome::Rejected))
    }
}

/// What `judge` prints about an answer.
pub fn text(question: &Question, x: &[f64], demand: &Demand) -> String {
    let problem = question.problem();
    if question.model().is_some() {
        let judged = JudgedAnswer::of(question, x, demand).searched(question.posed(), demand);
        return friction::text(question, &title(problem), "", x, &judged);
    }
    let certificate = searched(&problem.lcp, judge(&problem.lcp, x, demand), demand);
    certified(question, x, &certificate, None)
}

/// The certificate of an answer to a box, its motion, and its rows.
fn certified(
    question: &Question,
    x: &[f64],
    certificate: &Certificate,
    loads: Option<&Loads>,
) -> String {
    let problem = question.problem();
    let bound = bound(&problem.lcp, x, certificate);
    let mut text =
        title(problem) + "\n" + &certificate_text(certificate, bound, problem).to_string();
    text += &MotionError::text(question, x);
    if certificate.verdict.is_solution() {
        text += &Descent::text(question, x);
    } else if Precision::of(x) == Precision::Single {
        text +=
            &single_precision(&problem.lcp, x).map(mistake::single_precision).unwrap_or_default();
    }
    text += &loads.map(Loads::text).unwrap_or_default();
    text + &rows(problem, x, certificate)
}
