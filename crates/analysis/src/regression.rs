//! What a solver makes of a set of problems, compared with a recorded run.
//!
//! A *baseline* is the recorded run of a version that is trusted. A problem fails if its result is
//! worse than the recorded one, or if it is not recorded and not accepted. So a solver that does
//! not solve everything can be tested, and each problem that it loses is found.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::ci::{Case, Verdict, junit, sarif};
use crate::families::Row;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::number::counted;

/// Residuals below this part of the tolerance never count as worse.
const NEGLIGIBLE: f64 = 1e-3;

/// What a solver makes of a problem, the best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The judge accepts the answer, or no solution exists and the solver claims none.
    Accepted,
    /// The solver ends without a solution.
    NotSolved,
    /// The solver crashes, is too slow, or writes an answer that cannot be read.
    NoAnswer,
    /// The solver claims a solution, and the judge rejects it.
    FalseClaim,
}

/// The result of a solver on a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// What the solver makes of the problem.
    pub outcome: Outcome,
    /// Sweeps or pivots.
    pub iterations: usize,
    /// The scaled residual; none without a claim.
    #[serde(with = "crate::number::perhaps")]
    pub residual: Option<f64>,
    /// Why the answer is not accepted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Record {
    fn of(row: &Row) -> Record {
        let outcome = match row {
            row if row.rejected_claims + row.false_claims > 0 => Outcome::FalseClaim,
            row if row.unanswered > 0 => Outcome::NoAnswer,
            row if row.accepted + row.denied == row.problems || row.solvable() == 0 => {
                Outcome::Accepted
            }
            _ => Outcome::NotSolved,
        };
        let reason = row.trouble.clone().filter(|_| outcome != Outcome::Accepted);
        Record { outcome, iterations: row.iterations, residual: row.worst_residual, reason }
    }

    fn reason(&self) -> &str {
        self.reason.as_deref().unwrap_or("its answer is rejected")
    }
}

/// The results of a run, by solver and problem.
///
/// ```
/// use lcplab_analysis::regression::Run;
///
/// let text = r#"{"tolerance": 1e-8, "solvers": {"mine": {"a.json":
///     {"outcome": "accepted", "iterations": 12, "residual": 3e-16}}}}"#;
/// let run = Run::from_json("base.json", text).unwrap();
/// assert_eq!(run.solvers["mine"]["a.json"].iterations, 12);
/// let run = run.renamed(|name| format!("dumps/{name}"));
/// assert!(run.solvers["mine"].contains_key("dumps/a.json"));
/// assert!(Run::from_json("base.json", "{}").is_err());
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// The largest scaled residual that counts as solved.
    pub tolerance: f64,
    /// By solver and problem.
    pub solvers: BTreeMap<String, BTreeMap<String, Record>>,
}

/// From which factor on a result is worse than the recorded one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Factors {
    /// Of the iterations.
    pub iterations: f64,
    /// Of the scaled residual; below a thousandth of the tolerance no residual is worse.
    pub residual: f64,
}

/// The verdict on a solver and a problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// The solver.
    pub solver: String,
    /// The problem.
    pub problem: String,
    /// The verdict.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// The result.
    pub result: Record,
}

impl Finding {
    /// The finding as a test case for continuous integration.
    fn case(&self) -> Case {
        Case {
            class: self.solver.clone(),
            name: self.problem.clone(),
            verdict: self.verdict.clone(),
            rule: "solver".into(),
            properties: Vec::new(),
            details: String::new(),
            is_file: true,
        }
    }

    /// The findings as JUnit XML: a test case for each solver and problem, also for those of the
    /// baseline that are missing.
    pub fn junit(findings: &[Finding], missing: &[(String, String)]) -> String {
        junit("lcplab test", &Finding::cases(findings, missing))
    }

    /// The problems that are not accepted, worse than recorded, or missing, as SARIF 2.1.0.
    pub fn sarif(findings: &[Finding], missing: &[(String, String)]) -> String {
        let rules = [("solver".into(), "A solver's answer to a problem".into())];
        sarif(&rules, &Finding::cases(findings, missing))
    }

    fn cases(findings: &[Finding], missing: &[(String, String)]) -> Vec<Case> {
        let lost = missing.iter().map(|(solver, problem)| Case {
            class: solver.clone(),
            name: problem.clone(),
            verdict: Verdict::Failed("is in the baseline, but was not tested".into()),
            rule: "solver".into(),
            properties: Vec::new(),
            details: String::new(),
            is_file: true,
        });
        findings.iter().map(Finding::case).chain(lost).collect()
    }
}

impl Run {
    /// The results of one row for each solver and problem.
    pub fn of(rows: &[Row], tolerance: f64) -> Run {
        let mut solvers: BTreeMap<String, BTreeMap<String, Record>> = BTreeMap::new();
        for row in rows {
            let records = solvers.entry(row.solver.clone()).or_default();
            records.insert(row.family.clone(), Record::of(row));
        }
        Run { tolerance, solvers }
    }

    /// A recorded run.
    ///
    /// # Errors
    /// If the text is not one.
    pub fn from_json(input: &str, text: &str) -> Result<Run> {
        let is_of_engine = |text| {
            serde_json::from_str::<Value>(text).is_ok_and(|run| run.get("rejected").is_some())
        };
        let reason = |cause: serde_json::Error| match is_of_engine(text) {
            true => "is a recorded run of the command receipts, which checks an engine".into(),
            false => format!("is not a recorded run: {cause}"),
        };
        serde_json::from_str(text).map_err(|cause| Error::invalid(input, "baseline", reason(cause)))
    }

    /// The run with other names of its problems.
    #[must_use]
    pub fn renamed(mut self, name: fn(&str) -> String) -> Run {
        for records in self.solvers.values_mut() {
            let own = std::mem::take(records).into_iter();
            *records = own.map(|(problem, record)| (name(&problem), record)).collect();
        }
        self
    }

    /// Every result beside that of the baseline, by solver and problem.
    pub fn findings(&self, baseline: Option<&Run>, factors: Factors) -> Vec<Finding> {
        let recorded = |solver: &str, problem: &str| {
            baseline.and_then(|run| run.solvers.get(solver)?.get(problem))
        };
        let finding = |solver: &String, problem: &String, result: &Record| Finding {
            solver: solver.clone(),
            problem: problem.clone(),
            verdict: self.verdict(result, recorded(solver, problem), factors),
            result: result.clone(),
        };
        self.results().map(|(solver, problem, result)| finding(solver, problem, result)).collect()
    }

    /// Solvers and problems of the baseline that this run has not.
    pub fn missing(&self, baseline: &Run) -> Vec<(String, String)> {
        let is_missing = |solver: &str, problem: &str| {
            !self.solvers.get(solver).is_some_and(|records| records.contains_key(problem))
        };
        let missing = baseline.results().filter(|(solver, problem, _)| is_missing(solver, problem));
        missing.map(|(solver, problem, _)| (solver.clone(), problem.clone())).collect()
    }

    fn results(&self) -> impl Iterator<Item = (&String, &String, &Record)> {
        let of_solver = |(solver, records)| {
            let records: &BTreeMap<String, Record> = records;
            records.iter().map(move |(problem, record)| (solver, problem, record))
        };
        self.solvers.iter().flat_map(of_solver)
    }

    fn verdict(&self, now: &Record, before: Option<&Record>, factors: Factors) -> Verdict {
        let Some(before) = before else {
            return match now.outcome {
                Outcome::Accepted => Verdict::Passed,
                _ => Verdict::Failed(now.reason().into()),
            };
        };
        match now.outcome.cmp(&before.outcome) {
            std::cmp::Ordering::Less if now.outcome == Outcome::Accepted => Verdict::Fixed,
            std::cmp::Ordering::Greater => Verdict::Failed(format!(
                "was {}, is {}: {}",
                before.outcome.words(),
                now.outcome.words(),
                now.reason()
            )),
            _ if now.outcome > Outcome::Accepted => Verdict::Known(now.reason().into()),
            _ => self.worse(now, before, factors).map_or(Verdict::Passed, Verdict::Failed),
        }
    }

    /// What is worse about an accepted answer than it was, in a sentence.
    fn worse(&self, now: &Record, before: &Record, factors: Factors) -> Option<String> {
        if now.iterations as f64 > factors.iterations * before.iterations.max(1) as f64 {
            let (now, before) = (now.iterations, before.iterations);
            return Some(format!("{}, recorded are {before}", counted(now, "iteration")));
        }
        let (now, before) = (now.residual?, before.residual?);
        let most = (factors.residual * before).max(NEGLIGIBLE * self.tolerance);
        (now > most).then(|| format!("scaled residual {now:.1e}, recorded is {before:.1e}"))
    }
}

impl Outcome {
    fn words(self) -> &'static str {
        match self {
            Outcome::Accepted => "accepted",
            Outcome::NotSolved => "not solved",
            Outcome::NoAnswer => "without an answer",
            Outcome::FalseClaim => "a false claim",
        }
    }
}
