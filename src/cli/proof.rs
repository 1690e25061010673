//! `prove` and `check`: proof files.

use std::path::{Path, PathBuf};

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::files;
use lcplab::judge::Demand;
use lcplab::lcp::Question;
use lcplab::lcp::exact::SolutionSet;
use lcplab::lcp::friction::{Form, Model, ProblemForm};
use lcplab::proof::{Kind, Proof, ProofSearch, check, prove, prove_different, prove_kind};
use lcplab::report::answer::first_answer;
use lcplab::report::friction::JudgedAnswer;
use serde_json::json;

use super::limits::MemoryLimit;
use super::{Outcome, print, proof_page, read_problem, say, solutions};

/// Write the strongest proof about a problem, in exact arithmetic, as a file that others can check
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab export incline --out incline.json
  lcplab prove incline.json --out proof.json
  lcplab check incline.json proof.json
  python3 proofs/lcpcheck.py incline.json proof.json   # a checker that shares no code with lcplab
  lcplab prove incline.json --out proof.html           # a page with a button that checks it
  lcplab prove tower.json --kind motion   # a bound on the difference from the exact motion
  lcplab prove game.json --all            # every solution of a small problem
  lcplab prove transport.json plan_a.json plan_b.json   # two known answers: the solution is not unique

From the strongest to the weakest the kinds are no-solution, unique, not-unique, solution, cone-solution, \
body-solution, motion, within. \
The first kind that can be proved is written; for each stronger kind the output says why it was not proved. \
For a problem of up to 24 rows, lcplab also searches all active sets for a second solution, within about half a minute; \
the output says whether there is one. \
With two answers, it proves not-unique from both. \
With --all, lcplab lists all solutions, up to 1,024, of a problem of up to 19 rows if each has one finite bound, or of up to 12 \
rows if they have two. \
docs/proofs.md says what each kind proves. Most proofs are about boxes: under a friction cone, no-solution, \
solution, cone-solution and body-solution can be proved (under the associated law also motion), under a polygon only no-solution (although the judge can prove an answer under a polygon).

Exit codes:
  0  a proof was written; with --all, there is a solution
  1  nothing can be proved, for example if the residual is not finite; the judge rejects ANSWER (a proof is written, but \
it is about the problem, not about ANSWER); with --all, there is no solution
  2  invalid input or usage, or no proof was found under a friction cone or polygon")]
pub struct Prove {
    /// Problem file; its extension determines the format; - reads JSON from standard input
    problem: PathBuf,
    /// Answer to start from, a file with the key x [default: solve the problem first]
    answer: Option<PathBuf>,
    /// A second answer: prove that both are solutions, and different (not-unique)
    #[arg(conflicts_with = "kind")]
    second: Option<PathBuf>,
    /// Friction model [default: the file's]
    #[arg(long)]
    model: Option<Model>,
    /// Prove only this kind: one of those below, or frozen-motion (motion with the friction limits
    /// of the answer)
    #[arg(long)]
    kind: Option<Kind>,
    /// File to write; a page if it ends in .html [default: standard output]
    #[arg(long)]
    out: Option<PathBuf>,
    /// List all solutions instead, in exact arithmetic
    #[arg(long, conflicts_with_all = ["answer", "second", "kind", "out"])]
    all: bool,
    /// With --all: print one JSON object
    #[arg(long, requires = "all")]
    json: bool,
    #[command(flatten)]
    memory: MemoryLimit,
}

/// Check a proof file against its problem
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab check problem.json proof.json
  lcplab check cone.json proof.json --model coupled-box   # written with --model coupled-box

Exit codes:
  0  the proof is valid
  1  the proof proves nothing about this problem
  2  invalid input or usage, or the file is not a proof file")]
pub struct Check {
    /// Problem file; its extension determines the format; - reads JSON from standard input
    problem: PathBuf,
    /// Proof file, written by `prove`
    proof: PathBuf,
    /// Friction model [default: the file's]
    #[arg(long)]
    model: Option<Model>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    memory: MemoryLimit,
}

impl Prove {
    pub fn run(&self) -> Result<Outcome> {
        let memory = self.memory.max_memory;
        let problem = read_problem(&self.problem, memory)?;
        let input = self.problem.display().to_string();
        let question = Question::new(&problem, self.model, &input)?;
        if self.all {
            return self.all_solutions(&question, &input);
        }
        let read = |path: &PathBuf| {
            files::read_answers(path, problem.lcp.len(), memory).map(|read| read.x)
        };
        let answer = match &self.answer {
            Some(path) => read(path)?,
            None => first_answer(&question),
        };
        let second = self.second.as_ref().map(read).transpose()?;
        let found = match (&second, self.kind) {
            (Some(second), _) => prove_different(&question, &answer, second),
            (None, None) => prove(&question, &answer),
            (None, Some(kind)) => prove_kind(&question, &answer, kind),
        };
        if let Some(reason) = found.refusal(&question) {
            let advice = match (self.kind, question.posed()) {
                (Some(Kind::Solution), ProblemForm::Cone(_)) => {
                    "use --kind cone-solution to prove that a small box contains a solution"
                }
                _ => "use --model coupled-box to prove a statement about the coupled box",
            };
            let reason = format!("{reason}; {advice}");
            return Err(Error::invalid(input, "model", reason));
        }
        let ProofSearch { proof, missing } = found;
        let answers = [(&self.answer, Some(&answer)), (&self.second, second.as_ref())];
        let given = answers.into_iter().filter_map(|(path, x)| Some((path.as_ref()?, x?)));
        let is_rejected = |(path, x): (&PathBuf, &Vec<f64>)| {
            let verdict = JudgedAnswer::of(&question, x, &Demand::default()).certificate.verdict;
            if verdict.is_solution() {
                return false;
            }
            let path = path.display();
            say(&format!(
                "the judge rejects {path}: {verdict}; a proof is about the problem, not about this answer"
            ));
            true
        };
        let has_rejected = given.map(is_rejected).fold(false, |one, other| one | other);
        for (kind, reason) in &missing {
            say(&format!("no proof of kind {kind}: {reason}"));
        }
        let Some(proof) = proof else { return Ok(Outcome::Rejected) };
        let text = format!("{}\n", proof.to_json());
        match &self.out {
            Some(path) => {
                let is_page = path.extension().is_some_and(|ending| ending == "html");
                let page = || proof_page::page(&question, &proof, &missing, &text).render();
                file::write(path, if is_page { page()? } else { text.clone() })?;
                print(&format!("{}: {}\n", proof.claim.kind(), proof.sentence()))?;
            }
            None => print(&text)?,
        }
        Ok(if has_rejected { Outcome::Rejected } else { Outcome::Good })
    }

    /// Lists all solutions.
    fn all_solutions(&self, question: &Question, input: &str) -> Result<Outcome> {
        let lcp = question.require_boxed("all solutions can be listed", input)?;
        let set = SolutionSet::of(lcp)
            .map_err(|many| Error::invalid(input, "problem", many.to_string()))?;
        print(&if self.json { solutions::to_json(&set) } else { solutions::words(&set) })?;
        Ok(if set.corners.is_empty() { Outcome::Rejected } else { Outcome::Good })
    }
}

impl Check {
    pub fn run(&self) -> Result<Outcome> {
        let memory = self.memory.max_memory;
        let problem = read_problem(&self.problem, memory)?;
        let question = Question::new(&problem, self.model, &self.problem.display().to_string())?;
        let input = self.proof.display().to_string();
        let bytes = lcplab::lcp::disk::read(&self.proof, memory)?;
        let proof = Proof::parse(&bytes, &input)?;
        let verdict = check(&question, &proof);
        let (kind, claim) = (proof.claim.kind().name(), proof.sentence());
        if self.json {
            let holds = verdict.is_ok();
            let reason = verdict.as_ref().err();
            let object = json!({ "kind": kind, "claim": claim, "holds": holds, "reason": reason });
            print(&format!("{object}\n"))?;
        } else {
            print(&match &verdict {
                Ok(()) => format!("proved: {claim}\n"),
                Err(reason) => format!("rejected: {reason}\n"),
            })?;
        }
        Ok(if verdict.is_ok() { Outcome::Good } else { Outcome::Rejected })
    }
}

/// Checks the friction model for `solve --proof`: only boxes can be proved with an answer.
pub fn check_model(model: Model) -> Result<()> {
    match model.form() {
        Form::Box => Ok(()),
        Form::Polygon { .. } | Form::Cone(_) => {
            let reason = format!("an answer can be proved for a box, not for {model}");
            Err(Error::invalid("options", "--proof", reason))
        }
    }
}

/// Writes the strongest proof that starts from this answer.
pub fn write(path: &Path, question: &Question, answer: &[f64]) -> Result<()> {
    match prove(question, answer).proof {
        Some(proof) => file::write(path, format!("{}\n", proof.to_json())),
        None => {
            say("warning: no proof was written, because the residual of the answer is not finite");
            Ok(())
        }
    }
}
