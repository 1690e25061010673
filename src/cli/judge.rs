//! `judge`: checks answers to a problem, from any program.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lcplab::error::Result;
use lcplab::judge::{Demand, Verdict, judge, printed_up};
use lcplab::lcp::Question;
use lcplab::lcp::file::{Problem, number, read_answers};
use lcplab::lcp::friction::Model;
use lcplab::report::answer::{bound, certificate_text, json_object, searched};
use lcplab::report::friction::JudgedAnswer as Judgement;
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
use super::problem::{rows, title};
use super::{Outcome, print, read_problem};

/// Check answers from any program against a problem
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab solve problem.json --json > answer.json; lcplab judge problem.json answer.json
  lcplab judge problem.json mine.json theirs.json     # a table, one answer per row
  lcplab judge friction.json answer.json --model coulomb-cone

An answer file is a JSON object with the key \"x\". The key \"iterates\", a list of vectors, adds a row for \
each of them; iterates do not change the exit code.

Exit codes:
  0  every answer is accepted (with --fail-on within_tolerance: proved)
  1  an answer is rejected (or not proved)
  2  invalid input or usage")]
pub struct Judge {
    /// Problem file; its extension determines the format; - reads JSON from standard input
    problem: PathBuf,
    /// Answer files: JSON objects with the key "x"
    #[arg(required = true)]
    answers: Vec<PathBuf>,
    /// Friction model [default: the file's]
    #[arg(long)]
    model: Option<Model>,
    /// Largest scaled residual of an accepted answer
    #[arg(long, allow_negative_numbers = true, default_value = "1e-8")]
    tolerance: f64,
    /// Exit with 1 if a verdict is this or worse
    #[arg(long, value_enum, default_value_t = Worst::NotASolution)]
    fail_on: Worst,
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

/// Verdicts that a command may fail on, and on those that are worse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Worst {
    /// Fail unless every answer is proved
    WithinTolerance,
    /// Fail if an answer is rejected
    NotASolution,
}

impl Worst {
    fn outcome(self, verdict: &Verdict) -> Outcome {
        let passes = match self {
            Worst::WithinTolerance => matches!(verdict, Verdict::Proved { .. }),
            Worst::NotASolution => verdict.is_solution(),
        };
        if passes { Outcome::Good } else { Outcome::Rejected }
    }
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
        let read = |path: &PathBuf| read_answers(path, problem.lcp.len(), memory);
        let answers = self.answers.iter().map(read).collect::<Result<Vec<_>>>()?;
        let input = self.problem.display().to_string();
        let question = Question::new(&problem, self.model, &input)?;
        if self.loads {
            loads::check(&question, &input)?;
        }
        match answers.as_slice() {
            [only] if only.iterates.is_empty() => self.one(&question, &only.x),
            _ => {
                let mut all = Vec::new();
                for (path, answers) in self.answers.iter().zip(&answers) {
                    let name = path.display().to_string();
                    for (k, x) in answers.iterates.iter().enumerate() {
                        let label = format!("{name}, iterate {}", k + 1);
                        all.push(self.judged(label, &question, x, false));
                    }
                    all.push(self.judged(name, &question, &answers.x, true));
                }
                self.many(&problem, &all)
            }
        }
    }

    fn demand(&self) -> Demand {
        Demand { tolerance: self.tolerance, prove_up_to: Demand::EXACT_ROWS }
    }

    /// Judges one answer and prints its rows.
    fn one(&self, question: &Question, x: &[f64]) -> Result<Outcome> {
        let (demand, problem) = (self.demand(), question.problem());
        if question.model().is_some() {
            let verdict = friction::judge(question, &title(problem), x, &demand, self.json)?;
            return Ok(self.fail_on.outcome(&verdict));
        }
        let certificate = judge(&problem.lcp, x, &demand);
        let certificate = searched(&problem.lcp, certificate, &demand);
        let bound = bound(&problem.lcp, x, &certificate);
        if self.json {
            let mut object = json_object(&certificate);
            if let Some(bound) = bound {
                object.insert("error_bound".into(), number(printed_up(bound)));
            }
            object.extend(MotionError::json(question, x));
            if certificate.verdict.is_solution() {
                object.extend(Descent::json(question, x));
            }
            let loads = self.loads.then(|| Loads::of(question, x)).flatten();
            object.extend(loads.map(|loads| ("loads".to_string(), loads.json())));
            print(&format!("{}\n", Value::Object(object)))?;
        } else {
            let text = title(problem) + "\n" + &certificate_text(&certificate, bound, problem);
            let mut text = text + &MotionError::text(question, x);
            if certificate.verdict.is_solution() {
                text += &Descent::text(question, x);
            }
            let loads = self.loads.then(|| Loads::of(question, x)).flatten();
            text += &loads.map(|loads| loads.text()).unwrap_or_default();
            print(&(text + &rows(problem, x, &certificate)))?;
        }
        Ok(self.fail_on.outcome(&certificate.verdict))
    }

    fn judged(&self, label: String, question: &Question, x: &[f64], is_answer: bool) -> AnswerRow {
        let certificate = Judgement::of(question, x, &self.demand()).certificate;
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
        let fails =
            |judged: &&AnswerRow| self.fail_on.outcome(&judged.verdict) == Outcome::Rejected;
        let wrong = all.iter().filter(|judged| judged.is_answer).find(fails);
        Ok(wrong.map_or(Outcome::Good, |_| Outcome::Rejected))
    }
}
