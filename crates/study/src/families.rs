//! Problem families from the library × solvers, each answer judged.
//!
//! Families with friction are solved under each model of friction by the methods that it takes, and
//! judged by the certificate of that model.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::answer::labelled;
use lcplab_judge::{Demand, FrictionCertificate, Verdict, judge_friction};
use lcplab_problem::Complementarity;
use lcplab_problem::file::{Expected, Problem};
use lcplab_problem::friction::{Model, Posed};
use lcplab_problem::library::Family;
use lcplab_solver::trace::{Provenance, Work};
use lcplab_solver::{Group, Iterate, Method, Observer, Options, Reason, Solution, Status, Stop};

/// A solver on the problems of one family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The family.
    pub family: String,
    /// The model of friction; `None` for a family without friction.
    pub model: Option<String>,
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
    /// Multiplications in all, by each method's formula; none where nobody knows.
    #[serde(with = "crate::number::perhaps")]
    pub multiplications: Option<f64>,
    /// The worst scaled residual among the answers claimed; none without a claim.
    #[serde(with = "crate::number::perhaps")]
    pub worst_residual: Option<f64>,
    /// The fingerprint of the iterates on the first problem.
    pub fingerprint: String,
    /// Problems where something else than the method itself had a part in the answer.
    pub fallbacks: usize,
    /// What that was, the last time.
    pub fallback: Option<String>,
    /// Why the last problem that was not solved was not, or what the judge says of a refuted claim.
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
    ("pgs", "cps-2", "the diagonal is 0: a sweep divides by it"),
];

impl Row {
    /// Whether something is claimed that is not so, or a known failure has not happened.
    pub fn is_wrong(&self) -> bool {
        let came_off = self.known_failure.is_some() && self.claimed > 0;
        self.refuted_claims > 0 || self.false_claims > 0 || came_off
    }
}

/// What a family is solved as: its problems under one model of friction, or without any.
struct Posing<'a> {
    family: &'a str,
    model: Option<Model>,
    problems: Vec<(&'a Problem, Posed)>,
}

/// Runs each method on each family that it takes, with the seeds 1 … `seeds`; on families with
/// friction under each of the models. When it is time to stop, rows that are not done are left out.
pub fn run(
    families: &[&dyn Family],
    models: &[Model],
    methods: &[Method],
    options: &Options,
    seeds: u32,
    stop: &Stop,
) -> Vec<Row> {
    let named = |family: &&dyn Family| (family.name().to_string(), instances(*family, seeds));
    let problems: Vec<_> = families.iter().map(named).collect();
    run_on(&problems, models, methods, options, &Limits { stop, each: None, tick: &|| () })
}

/// When to stop, and who is told how far it is.
pub struct Limits<'a> {
    /// When all of it ends.
    pub stop: &'a Stop,
    /// How long a solve may take; it ends at the iterate after.
    pub each: Option<Duration>,
    /// Called after every row.
    pub tick: &'a (dyn Fn() + Sync),
}

/// Runs each method on the problems of each name that it takes; on problems with friction under each
/// of the models, or, if there are none, under the one that the first of them states.
///
/// Plug-ins run one after another and beside nothing else: each has one process, and waiting for it would count as time.
pub fn run_on(
    problems: &[(String, Vec<Problem>)],
    models: &[Model],
    methods: &[Method],
    options: &Options,
    limits: &Limits<'_>,
) -> Vec<Row> {
    let posings: Vec<Posing> =
        problems.iter().flat_map(|(family, problems)| posings(family, problems, models)).collect();
    let pairs: Vec<(&Posing, &Method)> = posings
        .iter()
        .flat_map(|posing| methods.iter().map(move |method| (posing, method)))
        .filter(|(posing, method)| method.takes(posing.model))
        .collect();
    let row = |(posing, method): &(&Posing, &Method)| attempt(posing, method, options, limits);
    let is_plugin = |(_, method): &(&Posing, &Method)| match method {
        Method::Boxed(entry) => entry.group == Group::Plugin,
        Method::Cone(_) => false,
    };
    let own = |pair: &(&Posing, &Method)| if is_plugin(pair) { None } else { row(pair) };
    let mut rows: Vec<Option<Row>> = pairs.par_iter().map(own).collect();
    for (place, pair) in rows.iter_mut().zip(&pairs).filter(|(_, pair)| is_plugin(pair)) {
        *place = row(pair);
    }
    rows.into_iter().flatten().collect()
}

/// The problems of a family: one a seed, or one where the family has none.
pub fn instances(family: &dyn Family, seeds: u32) -> Vec<Problem> {
    let seeded = family.parameters().iter().any(|parameter| parameter.name == "seed");
    let problem = |seed: u32| family.generate(&[("seed", f64::from(seed))]).ok();
    if seeded {
        (1..=seeds).filter_map(problem).collect()
    } else {
        family.generate(&[]).into_iter().collect()
    }
}

fn posings<'a>(family: &'a str, problems: &'a [Problem], models: &[Model]) -> Vec<Posing<'a>> {
    let posed = |model: Option<Model>| {
        let problems = problems.iter().filter_map(|problem| Some((problem, pose(problem, model)?)));
        Posing { family, model, problems: problems.collect() }
    };
    if let Some(first) = problems.iter().find(|problem| problem.friction().is_some()) {
        let own = [first.model.unwrap_or_default()];
        let models = if models.is_empty() { &own } else { models };
        models.iter().map(|&model| posed(Some(model))).collect()
    } else {
        vec![posed(None)]
    }
}

/// The problem under the model; `None` if it cannot be stated so. Friction rows that are not two
/// tangents a contact each are a coupled box and nothing else.
fn pose(problem: &Problem, model: Option<Model>) -> Option<Posed> {
    let Some(model) = model else { return Some(Posed::Boxed(problem.lcp.clone())) };
    match problem.friction()? {
        Ok(friction) => model.pose(&friction, problem.frozen_at.as_deref()).ok(),
        Err(_) => (model == Model::CoupledBox).then(|| Posed::Boxed(problem.lcp.clone())),
    }
}

/// The row of a method, unless it is time to stop before it is done.
fn attempt(
    posing: &Posing,
    method: &Method,
    options: &Options,
    limits: &Limits<'_>,
) -> Option<Row> {
    let Posing { family, model, problems } = posing;
    let known = KNOWN_FAILURES.iter().find(|(s, f, _)| *s == method.name() && f == family);
    let unsolvable = !problems.is_empty() && problems.iter().all(|(p, _)| has_no_solution(p));
    let known = known.map(|(_, _, why)| *why).or(unsolvable.then_some("no solution exists"));
    let mut row = Row {
        family: family.to_string(),
        model: model.map(|model| model.to_string()),
        solver: method.name().to_string(),
        problems: problems.len(),
        outside: 0,
        claimed: 0,
        proved: 0,
        accepted: 0,
        refuted_claims: 0,
        false_claims: 0,
        iterations: 0,
        multiplications: Some(0.0),
        worst_residual: None,
        fingerprint: String::new(),
        fallbacks: 0,
        fallback: None,
        trouble: None,
        known_failure: known.map(str::to_string),
        seconds: 0.0,
    };
    for (problem, posed) in problems {
        limits.stop.reason().is_none().then_some(())?;
        let lcp = match posed {
            Posed::Boxed(lcp) => lcp,
            Posed::Polyhedral(polyhedral) => polyhedral.lcp(),
            Posed::Cone(cone) => cone.lcp(),
        };
        let work = match method {
            Method::Boxed(entry) => Some(Work::of(entry, lcp)),
            Method::Cone(_) => None,
        };
        let mut told = Told { provenance: Provenance::of(lcp), work };
        let start = Instant::now();
        let each = limits.each.map_or_else(Stop::default, Stop::after);
        let mut watched = limits.stop.watch(&mut told);
        let mut solution = method.solve(posed, options, &mut each.watch(&mut watched));
        row.seconds += start.elapsed().as_secs_f64();
        if solution.status == Status::Stopped {
            let Some(Reason::TimeLimit(limit)) = each.reason() else { return None };
            let reason = format!("none within {} s, its time limit", limit.as_secs_f64());
            solution.status = Status::NoAnswer { reason };
        }
        if row.fingerprint.is_empty() {
            row.fingerprint = format!("{:016x}", told.provenance.fingerprint);
        }
        let known = told.work.map(|work| work.multiplications).filter(|work| work.is_finite());
        row.multiplications = row.multiplications.zip(known).map(|(sum, own)| sum + own);
        let demand = Demand { tolerance: options.settings.tolerance, ..Demand::default() };
        let certificate = judge_friction(posed, &solution.x, &demand);
        row.add(&solution, &certificate, problem);
    }
    if unsolvable && row.proved > 0 {
        // A file may say what is not so; a proof outranks it.
        (row.known_failure, row.false_claims) = (None, 0);
        row.trouble = Some("the file says that no solution exists, and one was proved".into());
    }
    (limits.tick)();
    Some(row)
}

/// What is kept of a solve's iterates.
struct Told<'a> {
    provenance: Provenance<'a>,
    work: Option<Work<'a>>,
}

impl Observer for Told<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if let Some(work) = &mut self.work {
            work.observe(iterate)?;
        }
        self.provenance.observe(iterate)
    }
}

impl Row {
    fn add(&mut self, solution: &Solution, certificate: &FrictionCertificate, problem: &Problem) {
        let unsolvable = has_no_solution(problem);
        let status = &solution.status;
        let (claims, holds) = (*status == Status::Solved, certificate.verdict.is_solution());
        self.outside += usize::from(matches!(status, Status::OutsideClass { .. }));
        self.claimed += usize::from(claims);
        self.proved += usize::from(matches!(certificate.verdict, Verdict::Proved { .. }));
        self.accepted += usize::from(holds);
        self.refuted_claims += usize::from(claims && !holds);
        self.false_claims += usize::from(claims && unsolvable);
        self.iterations += solution.iterations;
        if let Some(fallback) = solution.fallback {
            self.fallbacks += 1;
            self.fallback = Some(fallback.to_string());
        }
        if claims {
            let worst = self.worst_residual.map_or(0.0, |worst| worst);
            self.worst_residual = Some(worst.max(certificate.scaled_residual));
            if !holds {
                self.trouble = Some(labelled(&certificate.verdict, &certificate.w, problem));
            }
        } else if self.refuted_claims == 0 {
            self.trouble = Some(solution.status.to_string());
        }
    }
}

/// Whether it is known that there is no solution.
fn has_no_solution(problem: &Problem) -> bool {
    Expected::of(problem).is_some_and(|expected| expected.is_impossible())
}
