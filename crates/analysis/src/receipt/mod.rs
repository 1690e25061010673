//! Receipts: the verification report of one step of a physics engine, and of a run of steps.
//!
//! A receipt checks each part of a step against the next: collision, assembly, solver, write-back.
//! The collision and most of the assembly need the engine itself, so that the Python package checks
//! them and passes a [`Report`]. What every engine's step allows is checked here: whether x and v
//! are a solution of the problem that the engine posed, with a proved bound on the error of v
//! relative to the change that the constraints cause (the *motion error*), whether v and the
//! reported forces follow from x, and whether bias and free motion are those that an adapter
//! expects. Where there is no such bound, x and v must satisfy the law of every row.
//!
//! One frame does not distinguish two releases of an engine; a [`Run`] does.
//!
//! ```
//! use lcplab_analysis::receipt::{EngineStep, Receipt};
//! use serde_json::json;
//!
//! // 2 kg fall at 3 m/s on one contact of compliance ½ s/kg: x = 3 N s, v = −1.5 m/s.
//! let problem = json!({"b": [-3], "motion": {"mass": [[0, 0, 2]], "jacobian": [[0, 0, 1]],
//!     "bias": [0], "compliance": [0.5], "target": [-3]}});
//! let answered = |x: f64, v: f64| {
//!     let answer = json!({"x": [x], "motion": [v]});
//!     let step = EngineStep::read(&problem, &answer, "a.json").unwrap();
//!     Receipt::new(step, None, None).unwrap()
//! };
//! assert_eq!(answered(3.0, -1.5).verdict().name(), "ok");
//! let wrong = answered(2.0, -2.0);
//! assert_eq!(wrong.stage().unwrap().name(), "solver");
//! assert!(wrong.bound().unwrap() >= 0.5 * 2f64.sqrt()); // |v − û|_M
//! ```

mod baseline;
mod bounds;
mod definite;
mod finding;
mod finite;
mod folder;
mod frequency;
mod law;
mod limits;
mod newton;
mod page;
mod read;
mod run;
mod shrink;
mod stages;
mod step;

use std::sync::OnceLock;

use rayon::prelude::*;
use serde_json::{Value, json};

use bounds::MotionError;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::number;
use lcplab_lcp::friction::Model;
use lcplab_page::number::{counted, readable};

pub use baseline::Baseline;
pub use finding::{Finding, Report, Stage};
pub use limits::NOTABLE;
pub use read::answer_of;
pub use run::Run;
pub use step::{EngineAnswer, EngineStep, Expected, FrictionRows, RowNames, Source, StepFacts};

/// The verdict on a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepVerdict {
    /// The motion error has a bound, or the law of all rows was checked, and all errors are below
    /// their limits.
    Ok,
    /// There are no rows, and no check failed.
    NoRows,
    /// No check failed, but the engine does not report all that the problem consists of.
    NotChecked,
    /// The motion error is above its limit, but the engine stopped at its iteration limit, or at an
    /// own tolerance that is looser than the usual limit.
    Unconverged,
    /// An error is above its limit.
    Wrong,
}

impl StepVerdict {
    /// The words in reports and files.
    pub fn name(self) -> &'static str {
        match self {
            StepVerdict::Ok => "ok",
            StepVerdict::NoRows => "no rows",
            StepVerdict::NotChecked => "not checked",
            StepVerdict::Unconverged => "unconverged",
            StepVerdict::Wrong => "wrong",
        }
    }
}

/// Why an engine's solver stopped before its error was below the limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stop {
    /// It reached its iteration limit.
    Iterations,
    /// Its own tolerance is looser than the usual limit.
    Tolerance,
}

impl Stop {
    /// That of a step whose first rejected error is this.
    fn of(step: &EngineStep, first: &Finding, is_loose: bool) -> Option<Stop> {
        match first.stage == Stage::Solver && first.error.is_finite() {
            true if !step.source.has_converged => Some(Stop::Iterations),
            true if is_loose => Some(Stop::Tolerance),
            _ => None,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Stop::Iterations => "iterations",
            Stop::Tolerance => "tolerance",
        }
    }
}

/// Iterations of the engine and of Newton's method with the exact Hessian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Work {
    /// The engine's iterations.
    pub engine: usize,
    /// Those of Newton's method, if it converges.
    pub newton: Option<usize>,
}

impl Work {
    /// An engine's Newton method is slow if it takes more than this many times the steps.
    const EXCESS: usize = 4;

    fn of(step: &EngineStep, accurate: &newton::Accurate) -> Work {
        Work { engine: step.source.iterations, newton: accurate.steps }
    }

    fn is_excessive(self, method: &str) -> bool {
        let most = self.newton.map(|newton| Work::EXCESS * newton);
        method == "newton" && most.is_some_and(|most| self.engine > most)
    }

    fn text(self) -> String {
        let Work { engine, newton } = self;
        let newton = match newton {
            Some(newton) => format!("needs {newton}"),
            None => format!("does not converge in {}", newton::MOST),
        };
        format!("{engine} iterations; Newton's method with the exact Hessian {newton}")
    }
}

/// The verification report of one step of an engine.
///
/// ```
/// use lcplab_analysis::receipt::{EngineStep, Receipt, answer_of};
/// use serde_json::json;
///
/// // 2 kg fall at 3 m/s on one contact of compliance ½ s/kg: x = 3 N s, v = −1.5 m/s. The engine
/// // returns 2 N s and −2 m/s. The file has its answer, too.
/// let problem = json!({"b": [-3], "motion": {"mass": [[0, 0, 2]], "jacobian": [[0, 0, 1]],
///     "bias": [0], "compliance": [0.5], "target": [-3]}, "answer": {"x": [2], "motion": [-2]}});
/// let answer = answer_of(&problem).unwrap();
/// let step = EngineStep::read(&problem, answer, "fall.json")?;
/// step.check("fall.json")?; // the lengths of all vectors, the signs of compliance and μ
/// assert_eq!((step.len(), step.unit()), (1, "√J"));
/// assert_eq!(step.to_answer()["x"], json!([2.0]));
/// assert_eq!(step.to_problem()?["b"], json!([-3.0])); // J u* + bias
///
/// let receipts = Receipt::of_all(vec![(step, None)], Some(0.01))?; // of all frames of a run
/// let receipt = &receipts[0];
/// assert!(receipt.is_rejected());
/// assert_eq!(receipt.rejected().unwrap().stage.name(), "solver");
/// assert!(receipt.findings().iter().any(|finding| finding.is_rejected()));
/// assert_eq!((receipt.limit(), receipt.step().len()), (0.01, 1));
/// // 0.5 m/s off, of the 1 m/s that the contact changed; 1 m/s has the norm √2 for 2 kg.
/// assert_eq!((receipt.step().norm(&[1.0]), receipt.step().effect()), (2f64.sqrt(), 2f64.sqrt()));
/// assert!(receipt.motion_error().unwrap() > 0.499);
/// assert_eq!(receipt.error(), receipt.motion_error());
/// assert_eq!((receipt.residual(), receipt.difference()), (None, None)); // there is a bound
/// assert!(receipt.not_checked().iter().any(|part| part.contains("collision")));
/// assert!(receipt.text().contains("solver"));
/// assert_eq!(receipt.to_json()["verdict"], "wrong");
/// // Its files; the step has only one row, so that no smaller one shows the same error.
/// assert_eq!(receipt.folder(&problem, answer)?[0].0, "frame.json");
/// assert!(receipt.shrunk().is_none());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Receipt {
    step: EngineStep,
    limit: f64,
    effect: f64,
    bound: Option<f64>,
    residual: Option<f64>,
    /// Whether the bound is one with the friction limits, or the slip, of the answer.
    is_frozen: bool,
    findings: Vec<Finding>,
    not_checked: Vec<String>,
    /// The place of the finding that decides.
    rejected: Option<usize>,
    verdict: StepVerdict,
    stop: Option<Stop>,
    work: Option<Work>,
    difference: OnceLock<Option<f64>>,
}

impl Receipt {
    /// Checks a step; `report` contains the findings of collision and assembly that its engine
    /// allows, `None` those of a step that an adapter or a file describes. Without a limit on the
    /// motion error, that of the solver's kind applies, or the engine's own tolerance if that is
    /// looser, but at most ten times the former.
    ///
    /// # Errors
    /// If vectors of the step have different lengths, a compliance or a coefficient of friction is
    /// negative, its kind of solver is unknown, or the limit is negative.
    pub fn new(step: EngineStep, report: Option<Report>, limit: Option<f64>) -> Result<Self> {
        step.check("step")?;
        let (limit, is_loose) = limit_for(&step, limit)?;
        let solved = Solved::new(&step, limit);
        let Solved { mut all, bound, residual, is_frozen, accurate } = solved;
        all.add(report.unwrap_or_else(|| stages::before_solver(&step)));
        all.findings.sort_by_key(|finding| finding.stage);
        let not_checked = [step.not_checked.clone(), all.not_checked].concat();
        let findings = all.findings;
        let rejected: Vec<usize> =
            (0..findings.len()).filter(|&at| findings[at].is_rejected()).collect();
        let first = rejected.first().map(|&at| &findings[at]);
        let stop = first.and_then(|first| Stop::of(&step, first, is_loose));
        let accurate = accurate.filter(|_| stop == Some(Stop::Iterations));
        let work = accurate.map(|accurate| Work::of(&step, &accurate));
        let is_excessive = work.is_some_and(|work| work.is_excessive(&step.source.method));
        let is_excused = stop.is_some() && !is_excessive;
        // Errors of other stages are not excused, and count first.
        let is_wrong = |at: &&usize| !is_excused || findings[**at].stage != Stage::Solver;
        let wrong = rejected.iter().find(is_wrong).copied();
        let verdict = match wrong {
            Some(_) => StepVerdict::Wrong,
            None if is_excused => StepVerdict::Unconverged,
            None if step.is_empty() => StepVerdict::NoRows,
            None if bound.is_some() || residual.is_some() => StepVerdict::Ok,
            None => StepVerdict::NotChecked,
        };
        let rejected = wrong.or(rejected.first().copied());
        let effect = step.effect();
        let difference = OnceLock::new();
        Ok(Receipt {
            step,
            limit,
            effect,
            bound,
            residual,
            is_frozen,
            findings,
            not_checked,
            rejected,
            verdict,
            stop,
            work,
            difference,
        })
    }

    /// The receipts of many steps, computed on all processors.
    ///
    /// # Errors
    /// That of the first step that has one, as in [`Receipt::new`].
    pub fn of_all(
        steps: Vec<(EngineStep, Option<Report>)>,
        limit: Option<f64>,
    ) -> Result<Vec<Receipt>> {
        let receipts: Vec<Result<Receipt>> =
            steps.into_par_iter().map(|(step, report)| Receipt::new(step, report, limit)).collect();
        receipts.into_iter().collect()
    }

    /// The step.
    pub fn step(&self) -> &EngineStep {
        &self.step
    }

    /// The verdict.
    pub fn verdict(&self) -> StepVerdict {
        self.verdict
    }

    /// Whether an error is above its limit and the engine did not report itself as unconverged.
    pub fn is_rejected(&self) -> bool {
        self.verdict == StepVerdict::Wrong
    }

    /// The finding that decides, if one is above its limit.
    pub fn rejected(&self) -> Option<&Finding> {
        self.rejected.map(|at| &self.findings[at])
    }

    /// The first rejected stage.
    pub fn stage(&self) -> Option<Stage> {
        self.rejected().map(|finding| finding.stage)
    }

    /// All measured errors, by stage.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// The parts that were not checked, with reasons.
    pub fn not_checked(&self) -> &[String] {
        &self.not_checked
    }

    /// A proved bound on |v − û|_M, if there is one. For coupled boxes and Coulomb's law û is the
    /// motion with the friction limits, or the slip, of this answer: v = û if the answer satisfies
    /// the law, but otherwise û is not the motion of the law.
    pub fn bound(&self) -> Option<f64> {
        self.bound
    }

    /// The bound relative to [`EngineStep::effect`].
    pub fn motion_error(&self) -> Option<f64> {
        self.bound.map(|bound| self.step.relative(bound))
    }

    /// Where the motion error has no bound: the largest violation of the law of a row or cone, as
    /// the change of the motion by the impulse that corrects this row alone, relative to
    /// [`EngineStep::effect`]. It is 0 exactly if forces and motion satisfy the law of all rows.
    pub fn residual(&self) -> Option<f64> {
        self.residual
    }

    /// The motion error, or else the residual.
    pub fn error(&self) -> Option<f64> {
        self.motion_error().or(self.residual)
    }

    /// The largest accepted motion error.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// For coupled boxes and Coulomb's law, and without a bound on the motion: its distance from
    /// that of lcplab's own answer, relative to [`EngineStep::effect`]. It is measured and
    /// proves nothing: these laws can have several solutions. `None` if lcplab finds no answer.
    pub fn difference(&self) -> Option<f64> {
        *self.difference.get_or_init(|| {
            let has_law = self.is_frozen || self.residual.is_some();
            if !has_law {
                return None;
            }
            let own = bounds::own_answer(&self.step)?;
            let apart = step::difference(&self.step.answer.motion, &own.answer.motion);
            Some(self.step.relative(self.step.norm(&apart)))
        })
    }

    /// The receipt for people: a line for each part.
    pub fn text(&self) -> String {
        let Source { engine, version, method, iterations, name, time, own_tolerance, .. } =
            &self.step.source;
        let engine = format!("{engine} {version}").trim().to_string();
        let scene = if name == &engine { "" } else { name.as_str() };
        let scene = match (scene, *time) {
            ("", 0.0) => String::new(),
            ("", time) => format!("at {} s, ", readable(time, 4)),
            (name, 0.0) => format!("{name}, "),
            (name, time) => format!("{name} at {} s, ", readable(time, 4)),
        };
        let iterations = match iterations {
            0 => String::new(),
            _ => format!(", {}", counted(*iterations, "iteration")),
        };
        let rows = counted(self.step.len(), "row");
        let stage = self.stage().map(|stage| format!(": {stage}")).unwrap_or_default();
        let mut lines = vec![
            format!("{engine}: {scene}{rows}, {method}{iterations}"),
            format!("  verdict       {}{stage}", self.verdict.name()),
        ];
        let cause = self.step.cause_of_effect();
        let limit = readable(self.limit, 1);
        if let Some(residual) = self.residual {
            let residual = readable(residual, 2);
            lines.push(format!(
                "  residual      a row's law is violated by {residual} of {cause} (limit {limit})"
            ));
        }
        if let (Some(bound), Some(error)) = (self.bound, self.motion_error()) {
            lines.push(format!(
                "  motion error  at most {} of {cause} (limit {limit}): {} of {} {}{}",
                readable(error, 2),
                readable(bound, 2),
                readable(self.effect, 3),
                self.step.unit(),
                match (self.is_frozen, self.step.friction.model) {
                    (false, _) => "",
                    (true, Some(Model::CoulombCone)) => ", with the slip of this answer",
                    (true, _) => ", with the friction limits of this answer",
                }
            ));
        }
        if let Some(difference) = self.difference() {
            let difference = readable(difference, 2);
            lines.push(format!(
                "  difference    about {difference} of {cause}, from lcplab's own answer"
            ));
        }
        let is_small = *own_tolerance > 0.0 && *own_tolerance < self.effect;
        if (is_small || self.stop == Some(Stop::Tolerance)) && !self.step.is_empty() {
            let part = readable(own_tolerance / self.effect, 1);
            let stopped = match self.stop {
                Some(Stop::Tolerance) => ", looser than the usual limit",
                _ => "",
            };
            lines.push(format!("  tolerance     of the engine: {part} of {cause}{stopped}"));
        }
        if self.stop == Some(Stop::Iterations) {
            lines.push(
                "  stopped       at its iteration limit, as far as the engine reports".into(),
            );
        }
        lines.extend(self.work.map(|work| format!("  work          {}", work.text())));
        let rejected = self.findings.iter().filter(|finding| finding.is_rejected());
        lines.extend(rejected.map(|f| format!("  {:<12}  {}", f.stage.name(), self.line(f))));
        lines.extend(self.not_checked.iter().map(|part| format!("  not checked   {part}")));
        lines.join("\n")
    }

    fn line(&self, finding: &Finding) -> String {
        let label = finding.row.and_then(|row| self.step.rows.get(row)).map(|row| &row.label);
        let place = match (finding.row, label) {
            (Some(row), Some(label)) => format!("; row {row}, {label}"),
            (Some(row), None) => format!("; row {row}"),
            _ if finding.bodies.is_empty() => String::new(),
            _ => format!("; {}", finding.bodies.join(", ")),
        };
        if !finding.error.is_finite() {
            return format!("{}{place}", finding.what);
        }
        let (error, limit) = (readable(finding.error, 2), readable(finding.limit, 1));
        format!("{}: {error}, limit {limit}{place}", finding.what)
    }

    /// The receipt as JSON.
    pub fn to_json(&self) -> Value {
        let source = &self.step.source;
        let rejected = self.rejected();
        let optional = |value: Option<f64>| value.map_or(Value::Null, number);
        json!({
            "engine": source.engine, "version": source.version, "name": source.name,
            "time": number(source.time), "rows": self.step.len(), "method": source.method,
            "bits": source.bits, "iterations": source.iterations,
            "verdict": self.verdict.name(), "stage": self.stage(),
            "row": rejected.and_then(|finding| finding.row),
            "bodies": rejected.map(|finding| finding.bodies.as_slice()).unwrap_or_default(),
            "motion_error": optional(self.motion_error()), "limit": number(self.limit),
            "bound": optional(self.bound), "frozen": self.is_frozen, "effect": number(self.effect),
            "effect_of": self.step.cause_of_effect(), "residual": optional(self.residual),
            "stopped_by": self.stop.map(Stop::name), "unit": self.step.unit(),
            "rejected": self.rejected, "not_checked": self.not_checked,
            "findings": self.findings,
            "work": self.work.map(|Work { engine, newton }| {
                json!({ "engine": engine, "newton": newton })
            }),
        })
    }
}

/// What the forces and the motion of a step allow to check.
struct Solved {
    all: Report,
    bound: Option<f64>,
    residual: Option<f64>,
    is_frozen: bool,
    accurate: Option<newton::Accurate>,
}

impl Solved {
    fn new(step: &EngineStep, limit: f64) -> Solved {
        if let Some(all) = stages::broken(step) {
            return Solved { all, bound: None, residual: None, is_frozen: false, accurate: None };
        }
        let frozen = if step.is_associated() { None } else { step.frozen() };
        let posed = frozen.as_ref().unwrap_or(step);
        let mut accurate = None;
        let error = match MotionError::of(posed) {
            MotionError::Bounded(bounds)
                if !step.is_empty() && !bounds::is_sharp(posed, &bounds, limit) =>
            {
                accurate = newton::accurate_motion(posed);
                let is_needed = accurate.is_some() || !bounds::is_within(posed, &bounds, limit);
                MotionError::Bounded(match is_needed {
                    true => bounds::sharpened(posed, bounds, accurate.as_ref()),
                    false => bounds,
                })
            }
            error => error,
        };
        let all = stages::check(posed, &error, limit);
        let is_law = |finding: &&Finding| finding.what == stages::UNLAWFUL;
        let residual = all.findings.iter().find(is_law).map(|finding| finding.error);
        let bound = match error {
            MotionError::Bounded(bounds) if !step.is_empty() => Some(bounds.motion),
            _ => None,
        };
        Solved { all, bound, residual, is_frozen: frozen.is_some(), accurate }
    }
}

/// The limit on the motion error, and whether the engine's own tolerance is looser than the usual
/// one, which it raises up to [`limits::MOST_LOOSENED`] times.
fn limit_for(step: &EngineStep, limit: Option<f64>) -> Result<(f64, bool)> {
    let usual = limits::limit_of(&step.source)?;
    let effect = step.effect();
    let own = if effect > 0.0 { step.source.own_tolerance / effect } else { 0.0 };
    match limit {
        None if own > usual => Ok((own.min(limits::MOST_LOOSENED * usual), true)),
        None => Ok((usual, false)),
        Some(limit) if limit >= 0.0 => Ok((limit, false)),
        Some(limit) => {
            Err(Error::invalid("options", "limit", format!("is {limit}, must be 0 or larger")))
        }
    }
}
