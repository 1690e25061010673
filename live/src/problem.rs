//! A problem of the user: solved by any method and derived, judged, proved.

use lcplab_analysis::answer::{Answer as JudgedAnswer, bound, certificate_text};
use lcplab_analysis::explain::{Method, problem as derivation};
use lcplab_judge::{Demand, judge};
use lcplab_lcp::file::Problem;
use lcplab_lcp::{Lcp, Question};
use lcplab_page::document::{Block, SHOWN, Section};
use lcplab_proof::prove;
use lcplab_solver::{Options, Registry, Start, default_for};
use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::Answer;
use super::trace::{Steps, numbers};

/// Maximum number of rows; larger problems need the program itself.
const MOST_ROWS: usize = 60;
/// Maximum number of steps that are shown.
const MOST_STEPS: usize = 2_000;

/// A problem by a method.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Solve {
    /// A problem file.
    problem: Map<String, Value>,
    /// A solver of the registry; by default one that suits the problem.
    solver: Option<String>,
}

/// An x for a problem, and the judge's verdict on it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Judge {
    problem: Map<String, Value>,
    x: Vec<f64>,
}

/// The same, and the strongest proof.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Prove {
    problem: Map<String, Value>,
    x: Vec<f64>,
}

impl Solve {
    /// The answer as `solve --json` prints it, the steps, the derivation where the method is one of
    /// those that are derived, and the list of methods.
    pub fn answer(self) -> Answer {
        let question = read(self.problem)?;
        let (problem, lcp) = (question.problem(), boxed(&question)?);
        let name = self.solver.as_deref().unwrap_or_else(|| default_for(lcp));
        let solver = Registry::standard()
            .entry(name)
            .map_err(|error| error.to_string())?
            .build(&Options::default());
        let mut steps = Steps::of(lcp, name, MOST_STEPS);
        let solution = solver.solve(lcp, &Start::default(), &mut steps);
        if steps.steps.is_empty() {
            steps.keep(&solution.x, "no step was taken".into());
        }
        let derived =
            Method::NAMES.contains(&name).then(|| derived(&question, name)).transpose()?;
        let answer = JudgedAnswer::judged(lcp, solver.name(), solution, &Demand::default());
        Ok(json!({
            "name": problem.name,
            "warnings": problem.warnings,
            "answer": answer.to_json(),
            "A": (lcp.len() <= SHOWN).then(|| matrix(lcp)),
            "b": numbers(lcp.b()),
            "judge": certificate_text(&answer.certificate, answer.error_bound, problem),
            "steps": steps.steps,
            "derivation": derived,
            "solvers": Registry::standard().entries().map(|entry| [&*entry.name, entry.method]).collect::<Vec<_>>(),
        }))
    }
}

impl Judge {
    /// The certificate in words.
    pub fn answer(self) -> Answer {
        let question = read(self.problem)?;
        let lcp = boxed(&question)?;
        fits(lcp, &self.x)?;
        let certificate = judge(lcp, &self.x, &Demand::default());
        let bound = bound(lcp, &self.x, &certificate);
        Ok(json!(certificate_text(&certificate, bound, question.problem())))
    }
}

impl Prove {
    /// The proof as a sentence and as a file, and why there is no stronger one.
    pub fn answer(self) -> Answer {
        let question = read(self.problem)?;
        fits(&question.problem().lcp, &self.x)?;
        let found = prove(&question, &self.x);
        let missing: Vec<[String; 2]> =
            found.missing.into_iter().map(|(kind, why)| [kind.name().to_string(), why]).collect();
        let proof = found.proof.map(|proof| {
            json!({ "kind": proof.claim.kind().name(), "sentence": proof.sentence(), "file": proof.to_json() })
        });
        Ok(json!({ "proof": proof, "missing": missing }))
    }
}

/// A problem that this page supports, under the model that it states.
fn read(problem: Map<String, Value>) -> Result<Question, String> {
    let text = Value::Object(problem).to_string();
    let problem = Problem::parse(&text, "problem").map_err(|error| error.to_string())?;
    let n = problem.lcp.len();
    if n > MOST_ROWS {
        return Err(format!("{n} rows, at most {MOST_ROWS} are treated here"));
    }
    let question = Question::new(&problem, None, "problem").map_err(|error| error.to_string())?;
    boxed(&question)?;
    Ok(question)
}

/// The LCP that is solved here.
fn boxed(question: &Question) -> Result<&Lcp, String> {
    question.boxed().ok_or_else(|| {
        let model = question.model().unwrap_or_default();
        format!("model {model}: this page solves boxes; lcplab solve does more")
    })
}

fn fits(lcp: &Lcp, x: &[f64]) -> Result<(), String> {
    let n = lcp.len();
    (x.len() == n).then_some(()).ok_or_else(|| format!("x: {} numbers for {n} rows", x.len()))
}

/// The rows of A.
fn matrix(lcp: &Lcp) -> Value {
    let entries = |i| (0..lcp.len()).map(|j| lcp.matrix().entry(i, j)).collect::<Vec<_>>();
    (0..lcp.len()).map(|i| numbers(&entries(i))).collect()
}

/// The sections, each with its heading and its blocks.
fn derived(question: &Question, solver: &str) -> Answer {
    let document = Method::named(solver)
        .and_then(|method| derivation(question, &method))
        .map_err(|error| error.to_string())?;
    let section = |Section { title, blocks }: &Section| json!({ "title": title, "blocks": blocks.iter().map(Block::to_json).collect::<Value>() });
    Ok(document.sections.iter().map(section).collect())
}
