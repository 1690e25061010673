//! Problem families from the library × solvers, each answer judged.

use std::time::Instant;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::certificate::{Demand, Verdict, judge};
use crate::lcp::file::Problem;
use crate::lcp::library::Family;
use crate::solver::{Entry, Options, Solution, Start, Status};
use crate::trace::Provenance;

/// A solver on the problems of one family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The family.
    pub family: String,
    /// The solver.
    pub solver: String,
    /// The problems it was given: one a seed, or one where the family has none.
    pub problems: usize,
    /// Problems it says are outside its class: not attempts.
    pub outside: usize,
    /// Problems it claims to have solved.
    pub claimed: usize,
    /// Answers that the judge proves exactly.
    pub proved: usize,
    /// Answers that the judge accepts, proved or within tolerance.
    pub accepted: usize,
    /// Claims that the judge refutes: this must be 0.
    pub refuted_claims: usize,
    /// Claims on problems that are known to have no solution: this must be 0.
    pub false_claims: usize,
    /// Sweeps or pivots in all.
    pub iterations: usize,
    /// The worst scaled residual among the answers claimed.
    #[serde(with = "crate::report::results::number")]
    pub worst_residual: f64,
    /// The fingerprint of the iterates on the first problem.
    pub fingerprint: String,
    /// Problems where something else than the method itself had a part in the answer.
    pub fallbacks: usize,
    /// What that was, the last time.
    pub fallback: Option<String>,
    /// Why the last problem that was not solved was not.
    pub trouble: Option<String>,
    /// Why this solver cannot solve this family, where that is known.
    pub known_failure: Option<String>,
    /// Wall time of the solves (s); differs from machine to machine.
    pub seconds: f64,
}

/// Failures that mathematics explains, beside those on problems without solution: (solver, family,
/// why). They must stay failures.
pub const KNOWN_FAILURES: &[(&str, &str, &str)] = &[
    ("lemke", "cps-3", "A is not copositive-plus: a ray at once, though solutions exist"),
    ("murty", "cps-2", "the diagonal is 0: least-index pivoting needs positive principal minors"),
    ("murty", "cps-3", "the diagonal is 0: least-index pivoting needs positive principal minors"),
    ("block-pivoting", "cps-1", "A is singular: block pivoting solves regular blocks only"),
    ("block-pivoting", "table", "A is singular: block pivoting solves regular blocks only"),
    ("pgs", "cps-2", "the diagonal is 0: a sweep divides by it"),
];

impl Row {
    /// Whether something is claimed that is not so, or a known failure has not happened.
    pub fn is_wrong(&self) -> bool {
        let came_off = self.known_failure.is_some() && self.claimed > 0;
        self.refuted_claims > 0 || self.false_claims > 0 || came_off
    }
}

/// Runs each solver on each family with the seeds 1 … `seeds`.
pub fn run(families: &[&dyn Family], solvers: &[Entry], options: &Options, seeds: u32) -> Vec<Row> {
    let problems: Vec<(&str, Vec<Problem>)> =
        families.iter().map(|family| (family.name(), instances(*family, seeds))).collect();
    let pairs: Vec<_> = problems
        .iter()
        .flat_map(|family| solvers.iter().map(move |entry| (family, entry)))
        .collect();
    let row = |&((family, problems), entry): &(&(&str, Vec<Problem>), &Entry)| {
        attempt(family, problems, entry, options)
    };
    pairs.par_iter().map(row).collect()
}

fn instances(family: &dyn Family, seeds: u32) -> Vec<Problem> {
    let seeded = family.parameters().iter().any(|parameter| parameter.name == "seed");
    let problem = |seed: u32| family.generate(&[("seed", f64::from(seed))]).ok();
    if seeded {
        (1..=seeds).filter_map(problem).collect()
    } else {
        family.generate(&[]).into_iter().collect()
    }
}

fn attempt(family: &str, problems: &[Problem], entry: &Entry, options: &Options) -> Row {
    let known = KNOWN_FAILURES.iter().find(|(s, f, _)| *s == entry.name && *f == family);
    let unsolvable = !problems.is_empty() && problems.iter().all(has_no_solution);
    let known = known.map(|(_, _, why)| *why).or(unsolvable.then_some("no solution exists"));
    let mut row = Row {
        family: family.to_string(),
        solver: entry.name.to_string(),
        problems: problems.len(),
        outside: 0,
        claimed: 0,
        proved: 0,
        accepted: 0,
        refuted_claims: 0,
        false_claims: 0,
        iterations: 0,
        worst_residual: 0.0,
        fingerprint: String::new(),
        fallbacks: 0,
        fallback: None,
        trouble: None,
        known_failure: known.map(str::to_string),
        seconds: 0.0,
    };
    let solver = (entry.build)(options);
    for problem in problems {
        let mut provenance = Provenance::of(&problem.lcp);
        let start = Instant::now();
        let solution = solver.solve(&problem.lcp, &Start::default(), &mut provenance);
        row.seconds += start.elapsed().as_secs_f64();
        if row.fingerprint.is_empty() {
            row.fingerprint = format!("{:016x}", provenance.fingerprint);
        }
        let demand = Demand { tolerance: options.settings.tolerance, ..Demand::default() };
        let certificate = judge(&problem.lcp, &solution.x, &demand);
        row.add(problem, &solution, &certificate);
    }
    row
}

impl Row {
    fn add(
        &mut self,
        problem: &Problem,
        solution: &Solution,
        certificate: &crate::certificate::Certificate,
    ) {
        let status = &solution.status;
        let (claims, holds) = (*status == Status::Solved, certificate.verdict.is_solution());
        self.outside += usize::from(matches!(status, Status::OutsideClass { .. }));
        self.claimed += usize::from(claims);
        self.proved += usize::from(matches!(certificate.verdict, Verdict::Proved { .. }));
        self.accepted += usize::from(holds);
        self.refuted_claims += usize::from(claims && !holds);
        self.false_claims += usize::from(claims && has_no_solution(problem));
        self.iterations += solution.iterations;
        if let Some(fallback) = solution.fallback {
            self.fallbacks += 1;
            self.fallback = Some(fallback.to_string());
        }
        if claims {
            self.worst_residual = self.worst_residual.max(certificate.scaled_residual);
        } else {
            self.trouble = Some(status.to_string());
        }
    }
}

/// Whether the library knows that there is no solution.
fn has_no_solution(problem: &Problem) -> bool {
    let expected = problem.extra.get("expected");
    expected.is_some_and(|expected| {
        expected["complete"] == true && expected["solutions"].as_array().is_some_and(Vec::is_empty)
    })
}
