//! Problem families from the library × solvers, each answer judged.
//!
//! Families with friction are solved under each friction model by the methods that it takes, and
//! judged by the certificate of that model.
//!
//! ```
//! use lcplab_analysis::families::{Contender, Limits, Models, instances, run, run_on, useless};
//! use lcplab_lcp::library::by_name;
//! use lcplab_solver::{Method, Options, Registry, Stop};
//!
//! // Lemke and PGS on four contacts. The matrix of `murty` is a P-matrix, but not symmetric.
//! let (family, options, stop) = (by_name("murty")?, Options::default(), Stop::default());
//! let registry = Registry::standard();
//! let lemke: Vec<Method> = vec![registry.method("lemke", None)?.clone()];
//! let rows = run(&[family], &[], &lemke, &options, 1, &stop);
//! assert_eq!((rows[0].solver.as_str(), rows[0].solved(), rows[0].solvable()), ("lemke", 1, 1));
//! assert!(!rows[0].is_wrong()); // no false claim
//!
//! // The same with more to choose: the solvers by name, a time limit, progress.
//! let problems = [("murty".to_string(), instances(family, 1))];
//! let contenders = [Contender::named("lemke", registry)?];
//! let limits = Limits { stop: &stop, each: None, motion: None, search: false, tick: &|| () };
//! let named = run_on(&problems, Models::Usual(&[]), &contenders, &options, &limits);
//! assert_eq!(named[0].iterations, rows[0].iterations);
//! assert!(useless(&named, &contenders).is_empty()); // Lemke's method solved something
//! assert_eq!(Contender::unnamed(lemke).len(), 1); // without a row where it supports nothing
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod contender;

use std::time::Duration;

pub use contender::{Contender, useless};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::answer::{labelled, proof_of_denial};
use crate::friction::is_impossible;
use crate::motion_error::MotionError;
use crate::trial::{Trial, solved_rows};
use lcplab_judge::{Demand, FrictionCertificate};
use lcplab_lcp::Question;
use lcplab_lcp::file::{Expected, Problem};
use lcplab_lcp::friction::{Model, ProblemForm};
use lcplab_lcp::library::Family;
use lcplab_solver::trace::{NO_ITERATES, Provenance};
use lcplab_solver::{
    Group, Lemke, Method, Murty, Options, Pgs, Reason, Solution, Status, Stop, why_none_takes,
};

/// A solver on the problems of one family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The family.
    pub family: String,
    /// The friction model; `None` for a family without friction.
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
    /// Answers that the judge accepts, proved or within tolerance, or whose motion error is within
    /// [`Limits::motion`].
    pub accepted: usize,
    /// Problems that are proved to have no solution, and for which the solver claims none.
    #[serde(default, skip_serializing_if = "crate::number::is_zero")]
    pub denied: usize,
    /// Problems to which the solver gives no answer that can be read: it crashed or was too slow.
    #[serde(default, skip_serializing_if = "crate::number::is_zero")]
    pub unanswered: usize,
    /// Claims that the judge refutes: this must be 0.
    pub rejected_claims: usize,
    /// Claims on problems that are known to have no solution: this must be 0.
    pub false_claims: usize,
    /// Sweeps or pivots in all.
    pub iterations: usize,
    /// The total number of multiplications, by each method's formula; none if it is not known.
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
    /// Why the last problem that was not solved was not, or what the judge says of a rejected
    /// claim.
    pub trouble: Option<String>,
    /// Why this solver cannot solve this family, where that is known.
    pub known_failure: Option<String>,
    /// Wall time of the solves (s); differs from machine to machine.
    pub seconds: f64,
}

/// Failures that mathematics explains, beside those on problems without solution: (solver, family,
/// why). They must stay failures.
pub const KNOWN_FAILURES: &[(&str, &str, &str)] = &[
    (
        Lemke::NAME,
        "cps-3",
        "A is not copositive-plus: the path ends on a ray although solutions exist",
    ),
    (
        Murty::NAME,
        "cps-2",
        "the diagonal is 0: least-index pivoting needs positive principal minors",
    ),
    (
        Murty::NAME,
        "cps-3",
        "the diagonal is 0: least-index pivoting needs positive principal minors",
    ),
    (Pgs::NAME, "cps-2", "the diagonal is 0: a sweep divides by it"),
];

/// The reason why no solver solves a problem without a solution.
const NO_SOLUTION: &str = "no solution exists";

impl Row {
    /// Whether something is claimed that is not so, or a known failure has not happened.
    pub fn is_wrong(&self) -> bool {
        let came_off = self.known_failure.is_some() && self.claimed > 0;
        self.rejected_claims > 0 || self.false_claims > 0 || came_off
    }

    /// Problems that the solver claims to have solved, and has.
    pub fn solved(&self) -> usize {
        self.claimed.saturating_sub(self.rejected_claims.max(self.false_claims))
    }

    /// Problems that may have a solution.
    pub fn solvable(&self) -> usize {
        if self.known_failure.as_deref() == Some(NO_SOLUTION) { 0 } else { self.problems }
    }
}

/// What a family is solved as: its problems under one friction model, or without any.
struct Posing<'a> {
    family: &'a str,
    model: Option<Model>,
    /// Whether the user named the model, or the problem states it.
    is_stated: bool,
    problems: Vec<(&'a Problem, ProblemForm)>,
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
    let of_family = |family: &&dyn Family| (family.name().to_string(), instances(*family, seeds));
    let problems: Vec<_> = families.iter().map(of_family).collect();
    let contenders = Contender::unnamed(methods.iter().cloned());
    let limits = Limits { stop, each: None, motion: None, search: false, tick: &|| () };
    run_on(&problems, Models::Usual(models), &contenders, options, &limits)
}

/// Under which models the problems with friction are solved.
#[derive(Debug, Clone, Copy)]
pub enum Models<'a> {
    /// Under each of these by default: a solver takes part under those that it supports.
    Usual(&'a [Model]),
    /// Under each of these, which the user named; if there are none, under the model that the first
    /// of the problems states.
    Stated(&'a [Model]),
}

impl<'a> Models<'a> {
    fn list(self) -> &'a [Model] {
        match self {
            Models::Usual(list) | Models::Stated(list) => list,
        }
    }
}

/// When to stop, and who receives the progress.
pub struct Limits<'a> {
    /// When all of it ends.
    pub stop: &'a Stop,
    /// How long a solve may take; it ends at the iterate after.
    pub each: Option<Duration>,
    /// The relative [motion error](MotionError) up to which an answer counts as accepted, although
    /// the judge rejects it.
    pub motion: Option<f64>,
    /// Whether the judge looks for a proof that no solution exists where a solver reports none. A
    /// solver that reports that there is none is always checked.
    pub search: bool,
    /// Called after every row.
    pub tick: &'a (dyn Fn() + Sync),
}

/// Runs each method on the problems of each name that it takes; on problems with friction under
/// each of the models.
///
/// A solver that was named has a row with the reason where none of its methods takes the model that
/// was asked for or that the problem states, or none of the usual ones.
///
/// Plug-ins run one after another and beside nothing else: each has one process, and waiting for it
/// would count as time.
pub fn run_on(
    problems: &[(String, Vec<Problem>)],
    models: Models<'_>,
    contenders: &[Contender],
    options: &Options,
    limits: &Limits<'_>,
) -> Vec<Row> {
    let posings: Vec<Posing> =
        problems.iter().flat_map(|(family, problems)| posings(family, problems, models)).collect();
    let parts: Vec<Participation> = posings
        .iter()
        .flat_map(|posing| contenders.iter().map(move |contender| (posing, contender)))
        .flat_map(|(posing, contender)| participations(posing, contender, &posings))
        .collect();
    let row = |part: &Participation| match part {
        Participation::Solves(posing, method) => attempt(posing, method, options, limits),
        Participation::LeftOut(posing, solver, reason) => Some(posing.left_out(solver, reason)),
    };
    let own = |part: &Participation| if part.is_plugin() { None } else { row(part) };
    let mut rows: Vec<Option<Row>> = parts.par_iter().map(own).collect();
    for (place, part) in rows.iter_mut().zip(&parts).filter(|(_, part)| part.is_plugin()) {
        *place = row(part);
    }
    rows.into_iter().flatten().collect()
}

/// What a row of a comparison is made from.
enum Participation<'a> {
    /// A method that takes the model.
    Solves(&'a Posing<'a>, Method),
    /// A solver that was named and does not, with the reason.
    LeftOut(&'a Posing<'a>, String, String),
}

impl Participation<'_> {
    fn is_plugin(&self) -> bool {
        matches!(self, Participation::Solves(_, method) if method.group() == Group::Plugin)
    }
}

/// The rows of a solver under one posing: one for each method that supports it. If none does, a
/// solver that the user named has a row with the reason; under default models only once, and only
/// if it supports none of them.
fn participations<'a>(
    posing: &'a Posing<'a>,
    contender: &Contender,
    all: &[Posing<'_>],
) -> Vec<Participation<'a>> {
    let Some(reason) = why_none_takes(&contender.methods, posing.model) else {
        let taking = contender.methods.iter().filter(|method| method.takes(posing.model));
        return taking.map(|method| Participation::Solves(posing, method.clone())).collect();
    };
    let mut same = all.iter().filter(|other| other.family == posing.family);
    let is_first = same.clone().next().is_some_and(|first| first.model == posing.model);
    let refuses = |other: &Posing<'_>| why_none_takes(&contender.methods, other.model).is_some();
    let is_due = posing.is_stated || is_first && same.all(refuses);
    match contender.is_named && is_due {
        true => vec![Participation::LeftOut(posing, contender.name().to_string(), reason)],
        false => Vec::new(),
    }
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

fn posings<'a>(family: &'a str, problems: &'a [Problem], models: Models<'_>) -> Vec<Posing<'a>> {
    let posed = |model: Option<Model>, is_stated: bool| {
        let problems = problems.iter().filter_map(|problem| Some((problem, pose(problem, model)?)));
        Posing { family, model, is_stated, problems: problems.collect() }
    };
    let Some(first) = problems.iter().find(|problem| problem.friction().is_some()) else {
        return vec![posed(None, true)];
    };
    let own = [first.model.unwrap_or_default()];
    let (list, is_stated) = match models {
        Models::Usual(list) if !list.is_empty() => (list, false),
        models if models.list().is_empty() => (&own[..], true),
        models => (models.list(), true),
    };
    list.iter().map(|&model| posed(Some(model), is_stated)).collect()
}

/// The problem under the model; `None` if it cannot be stated so. Friction rows that are not two
/// tangents a contact each are a coupled box and nothing else.
fn pose(problem: &Problem, model: Option<Model>) -> Option<ProblemForm> {
    let Some(model) = model else { return Some(ProblemForm::Boxed(problem.lcp.clone())) };
    match problem.friction()? {
        Ok(friction) => model.pose(&friction, problem.frozen_at.as_deref()).ok(),
        Err(_) => (model == Model::CoupledBox).then(|| ProblemForm::Boxed(problem.lcp.clone())),
    }
}

impl Posing<'_> {
    /// The row of a solver before it has solved anything.
    fn row(&self, solver: &str) -> Row {
        Row {
            family: self.family.to_string(),
            model: self.model.map(|model| model.to_string()),
            solver: solver.to_string(),
            problems: self.problems.len(),
            outside: 0,
            claimed: 0,
            proved: 0,
            accepted: 0,
            denied: 0,
            unanswered: 0,
            rejected_claims: 0,
            false_claims: 0,
            iterations: 0,
            multiplications: Some(0.0),
            worst_residual: None,
            fingerprint: String::new(),
            fallbacks: 0,
            fallback: None,
            trouble: None,
            known_failure: None,
            seconds: 0.0,
        }
    }

    /// The row of a solver that is not made for the problems, and was not asked.
    fn left_out(&self, solver: &str, reason: &str) -> Row {
        Row {
            outside: self.problems.len(),
            multiplications: None,
            fingerprint: format!("{NO_ITERATES:016x}"),
            trouble: Some(format!("not run: {reason}")),
            ..self.row(solver)
        }
    }
}

/// The row of a method, unless it is time to stop before it is done.
fn attempt(
    posing: &Posing,
    method: &Method,
    options: &Options,
    limits: &Limits<'_>,
) -> Option<Row> {
    let Posing { family, problems, .. } = posing;
    let known = KNOWN_FAILURES.iter().find(|(s, f, _)| *s == method.name() && f == family);
    let unsolvable = !problems.is_empty() && problems.iter().all(|(p, _)| has_no_solution(p));
    let known = known.map(|(_, _, why)| *why).or(unsolvable.then_some(NO_SOLUTION));
    let mut row = posing.row(method.name());
    row.known_failure = known.map(str::to_string);
    for (problem, posed) in problems {
        limits.stop.reason().is_none().then_some(())?;
        let mut provenance = Provenance::of(solved_rows(posed));
        let each = limits.each.map_or_else(Stop::default, Stop::after);
        let mut watched = limits.stop.watch(&mut provenance);
        let mut trial = Trial::run(method, posed, options, &mut each.watch(&mut watched));
        row.seconds += trial.seconds;
        if trial.solution.status == Status::Stopped {
            let Some(Reason::TimeLimit(limit)) = each.reason() else { return None };
            let reason = format!("no answer within its time limit of {} s", limit.as_secs_f64());
            trial.solution.status = Status::NoAnswer { reason };
        }
        if row.fingerprint.is_empty() {
            row.fingerprint = format!("{:016x}", provenance.fingerprint);
        }
        row.multiplications =
            row.multiplications.zip(trial.multiplications).map(|(sum, own)| sum + own);
        let demand = Demand { tolerance: options.settings.tolerance, ..Demand::default() };
        let certificate = trial.judged(posed, &demand);
        let status = &trial.solution.status;
        row.denied += usize::from(match posed {
            _ if limits.search && reports_none(status) => {
                !certificate.verdict.is_solution() && is_impossible(posed, &demand)
            }
            ProblemForm::Boxed(lcp) => proof_of_denial(lcp, status, &demand).is_some(),
            ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => false,
        });
        let moves_right = |limit: f64| {
            let question = Question::new(problem, posing.model, family);
            question.is_ok_and(|own| MotionError::is_within(&own, &trial.solution.x, limit))
        };
        let is_accepted =
            certificate.verdict.is_solution() || limits.motion.is_some_and(moves_right);
        row.add(&trial.solution, &certificate, is_accepted, problem);
    }
    if unsolvable && row.proved > 0 {
        // A file may say what is not so; a proof outranks it.
        (row.known_failure, row.false_claims) = (None, 0);
        row.trouble = Some("the file states that no solution exists, but one was proved".into());
    }
    (limits.tick)();
    Some(row)
}

/// Whether a solver ends without a solution; one that crashes or is too slow says nothing.
fn reports_none(status: &Status) -> bool {
    !matches!(status, Status::Solved | Status::NoAnswer { .. })
}

impl Row {
    fn add(
        &mut self,
        solution: &Solution,
        certificate: &FrictionCertificate,
        is_accepted: bool,
        problem: &Problem,
    ) {
        let unsolvable = has_no_solution(problem);
        let status = &solution.status;
        let is_outside = matches!(status, Status::OutsideClass { .. });
        // Without an answer x is the start, which the solver has no part in.
        let is_unanswered = matches!(status, Status::NoAnswer { .. });
        let answers = !is_outside && !is_unanswered;
        let holds = answers && is_accepted;
        let claims = *status == Status::Solved;
        self.outside += usize::from(is_outside);
        self.unanswered += usize::from(is_unanswered);
        self.claimed += usize::from(claims);
        self.proved += usize::from(holds && certificate.verdict.distance().is_some());
        self.accepted += usize::from(holds);
        self.rejected_claims += usize::from(claims && !holds);
        self.false_claims += usize::from(claims && unsolvable);
        self.iterations = self.iterations.saturating_add(solution.iterations);
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
        } else if self.rejected_claims == 0 {
            self.trouble = Some(solution.status.to_string());
        }
    }
}

/// Whether it is known that there is no solution.
fn has_no_solution(problem: &Problem) -> bool {
    Expected::of(problem).is_some_and(|expected| expected.is_impossible())
}
