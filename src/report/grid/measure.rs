//! The measures at a point: claims, verdicts and residuals of its solves, and the motion of a
//! scene.

use crate::simulation;
use crate::simulation::Simulation;
use std::time::Instant;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use super::file::Grid;
use super::plan::Task;
use super::subject::Subject;
use super::theory::{Predicted, Prediction};
use crate::error::Result;
use crate::judge::{Demand, FrictionCertificate, Verdict, judge_friction};
use crate::lcp::Lcp;
use crate::lcp::file::{Expected, Problem, as_number, number};
use crate::lcp::friction::ProblemForm;
use crate::report::study::tally::Tally;
use crate::report::study::trial::Trial;
use crate::scene::Scene;
use crate::simulation::{Motion, Solve, Step};
use crate::solver::{Method, Options, Registry, Solution, Start, Status, theory};
use crate::trace::Convergence;

/// A measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Measure {
    /// Its name in files.
    pub name: &'static str,
    /// Its name in titles and at axes.
    pub words: &'static str,
    /// Its unit; empty if there is none.
    pub unit: &'static str,
    /// Its description.
    pub about: &'static str,
}

const fn measure(name: &'static str, unit: &'static str, about: &'static str) -> Measure {
    Measure { name, words: name, unit, about }
}

impl Measure {
    const fn called(self, words: &'static str) -> Self {
        Measure { words, ..self }
    }

    /// Whether it is a factor per iteration, whose ratios say little.
    pub fn is_rate(&self) -> bool {
        matches!(self.name, "rate" | "eigenvalue")
    }

    /// Whether a solver needs it.
    pub fn is_cost(&self) -> bool {
        matches!(self.name, "iterations" | "work" | "seconds")
    }
}

/// The number of sweeps or pivots, which closed forms predict.
pub const ITERATIONS: Measure =
    measure("iterations", "", "total sweeps, steps or pivots of the solver");

/// All measures, in the order of tables.
pub const MEASURES: [Measure; 16] = [
    ITERATIONS,
    measure("rows", "", "rows of the largest LCP"),
    measure("steps", "", "steps taken"),
    measure("solves", "", "LCPs solved"),
    measure("claimed", "", "LCPs that the solver reports as solved"),
    measure("accepted", "", "answers that the judge accepts"),
    measure("rejected", "", "false claims, rejected by the judge"),
    measure("work", "", "multiplications, by the leading term of the operation count")
        .called("multiplications"),
    measure(
        "rate",
        "",
        "contraction of the natural residual per iteration, over the second half of the run before rounding",
    )
    .called("error factor per iteration"),
    measure(
        "eigenvalue",
        "",
        "the largest modulus below 1 of an eigenvalue of the iteration matrix, on the rows inside their bounds",
    ),
    measure("scaled_residual", "", "the worst scaled residual of all answers")
        .called("scaled residual"),
    measure("error", "", "max |x − x*| / max |x*|, if x* is known"),
    measure("energy_change", "J", "the largest deviation of the energy from its initial value")
        .called("energy change"),
    measure("drift", "m", "the largest error of a joint"),
    measure("penetration", "m", "the deepest overlap"),
    measure("optimum", "", "the value at which the closed form has its smallest rate"),
];

/// The wall time of stepping and solving, which is recorded separately from machine-independent
/// results.
pub static SECONDS: Measure = measure(
    "seconds",
    "s",
    "the wall time of stepping and solving, on a shared machine; the least of up to five runs",
)
.called("time");

/// The result at a point; the same for any number of threads and for machines of one kind.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Finding {
    /// `solved`, or the solver's status on the last LCP that it did not solve; `no LCP` if there
    /// was none.
    pub status: String,
    /// The judge's verdict on the worst answer.
    pub verdict: String,
    /// Why it ended early, or what was not solved.
    pub trouble: Option<String>,
    /// The measures that apply here.
    pub values: Map<String, Json>,
    /// The predictions of the closed form.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub predicted: Vec<Predicted>,
}

impl Finding {
    /// A measure, if it was taken.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.values.get(name).and_then(as_number)
    }

    /// The prediction of the closed form for a measure, if there is one.
    pub fn predicted(&self, name: &str) -> Option<&Predicted> {
        self.predicted.iter().find(|predicted| predicted.measure == name)
    }

    /// Whether each claim of the closed form holds.
    pub fn claims(&self) -> impl Iterator<Item = bool> {
        let held = |predicted: &Predicted| predicted.holds(self.get(&predicted.measure)?);
        self.predicted.iter().filter_map(held)
    }

    fn put(&mut self, name: &str, value: f64) {
        self.values.insert(name.into(), number(value));
    }
}

/// Solves a task with a solver of the registry and judges every answer; the second value is the
/// wall time of stepping and solving (s).
///
/// # Errors
/// If the task's settings give no scene or problem, or name no solver.
pub fn run(task: &Task, grid: &Grid, solvers: &Registry) -> Result<(Finding, f64)> {
    match Subject::of(task)? {
        Subject::Scene(mut scene, steps) => {
            scene.solvers = solvers.clone();
            simulate(task, &scene, steps, grid)
        }
        Subject::Problem(problem, mut settings) => {
            settings.solvers = solvers.clone();
            solve(task, &problem, &settings, grid)
        }
    }
}

fn simulate(task: &Task, scene: &Scene, steps: usize, grid: &Grid) -> Result<(Finding, f64)> {
    let mut simulation = Simulation::of(scene)?;
    let mut answers = Answers::default();
    let mut course = SceneMotion::from(simulation.motion());
    let (mut seconds, mut last) = (0.0, None);
    for _ in 0..steps {
        let start = Instant::now();
        let step = simulation.step();
        seconds += start.elapsed().as_secs_f64();
        match step {
            Ok(step) => {
                answers.step(&step, scene.solver.tolerance);
                course.add(&step.motion);
                last = step.solves.into_iter().next_back().map(|solve| solve.problem.lcp).or(last);
            }
            Err(failure) => {
                answers.fail(failure.to_string());
                break;
            }
        }
    }
    let mut finding = answers.finding();
    finding.put("steps", course.steps as f64);
    finding.put("energy_change", course.energy_change);
    finding.put("drift", course.drift);
    finding.put("penetration", course.penetration);
    if let Some(lcp) = last {
        finding.beside_theory(task, grid, &lcp, scene)?;
    }
    Ok((finding, seconds))
}

fn solve(task: &Task, problem: &Problem, settings: &Scene, grid: &Grid) -> Result<(Finding, f64)> {
    let options = simulation::options(settings);
    let method = Method::Boxed(settings.solvers.entry(&settings.solver.name)?.clone());
    let posed = ProblemForm::Boxed(problem.lcp.clone());
    let Trial { solution, multiplications, seconds } =
        Trial::run(&method, &posed, &options, &mut ());
    let demand = Demand { tolerance: options.settings.tolerance, ..Demand::default() };
    let mut answers = Answers::default();
    answers.add(problem.lcp.len(), &solution, &judge_friction(&posed, &solution.x, &demand));
    let mut finding = answers.finding();
    if let Some(work) = multiplications {
        finding.put("work", work);
    }
    if let Some(exact) = only_solution(problem) {
        let size = exact.iter().fold(0.0, |size, x| f64::max(size, x.abs()));
        let off = exact.iter().zip(&solution.x).map(|(exact, x)| (x - exact).abs());
        finding.put("error", off.fold(0.0, f64::max) / size);
    }
    finding.beside_theory(task, grid, &problem.lcp, settings)?;
    Ok((finding, seconds))
}

impl Finding {
    /// Adds the predictions of the closed form for the last problem, and its rate if the grid
    /// requests it.
    fn beside_theory(&mut self, task: &Task, grid: &Grid, lcp: &Lcp, scene: &Scene) -> Result<()> {
        let (name, options) = (&scene.solver.name, simulation::options(scene));
        if grid.measures.iter().any(|measure| measure.name == "rate") {
            let (rate, eigenvalue) = rates(scene, &options, lcp)?;
            rate.into_iter().for_each(|rate| self.put("rate", rate));
            eigenvalue.into_iter().for_each(|rate| self.put("eigenvalue", rate));
        }
        let Some(theory) = grid.theory else { return Ok(()) };
        let iterations = self.get("iterations").unwrap_or(0.0);
        let Prediction { values, optimum } = theory.predict(task, lcp, name, &options, iterations);
        optimum.into_iter().for_each(|optimum| self.put("optimum", optimum));
        let is_taken = |predicted: &Predicted| self.get(&predicted.measure).is_some();
        let values = values.into_iter().filter(|own| own.value.is_finite() && is_taken(own));
        self.predicted = values.collect();
        Ok(())
    }
}

/// Residuals below this fraction of the first are rounding.
const FLOOR: f64 = 1e-11;

/// The convergence rate of a sweep method, from its residuals and as an eigenvalue.
fn rates(scene: &Scene, options: &Options, lcp: &Lcp) -> Result<(Option<f64>, Option<f64>)> {
    let settings = options.settings.clone().with_tolerance(0.0);
    let options = options.clone().with_settings(settings);
    let mut trace = Convergence::of(lcp);
    trace.floor = FLOOR;
    let name = &scene.solver.name;
    let solver = scene.solvers.entry(name)?.build(&options);
    let x = solver.solve(lcp, &Start::default(), &mut trace).x;
    let eigenvalue = theory::rate(name, &options, lcp, &theory::rows_inside(lcp, &x));
    Ok((eigenvalue.and(trace.rate()), eigenvalue))
}

/// The counts of many answers, and the worst that is said of them.
#[derive(Default)]
struct Answers {
    tally: Tally,
    worst: Worst,
}

/// The last status that is not solved, and the worst verdict.
#[derive(Default)]
struct Worst {
    status: Option<&'static str>,
    verdict: Option<Verdict>,
}

impl Worst {
    fn add(&mut self, solution: &Solution, certificate: &FrictionCertificate) {
        let verdict = certificate.verdict;
        if solution.status != Status::Solved {
            self.status = Some(solution.status.word());
        }
        if self.verdict.is_none_or(|worst| rank(&verdict) > rank(&worst)) {
            self.verdict = Some(verdict);
        }
    }
}

impl Answers {
    fn step(&mut self, step: &Step, tolerance: f64) {
        let Answers { tally, worst } = self;
        let note = |solve: &Solve, certificate: &_| worst.add(&solve.solution, certificate);
        tally.add_step(step, tolerance, note);
    }

    fn add(&mut self, rows: usize, solution: &Solution, certificate: &FrictionCertificate) {
        self.tally.add(rows, solution, certificate, "");
        self.worst.add(solution, certificate);
    }

    fn fail(&mut self, reason: String) {
        self.worst.status = Some("failed");
        self.tally.trouble = Some(reason);
    }

    fn finding(self) -> Finding {
        let Answers { tally, worst } = self;
        let usual = if tally.solves > 0 { "solved" } else { "no LCP" };
        let mut finding = Finding {
            status: worst.status.unwrap_or(usual).into(),
            verdict: worst.verdict.map_or("none", |verdict| verdict.word()).into(),
            trouble: tally.trouble,
            values: Map::new(),
            predicted: Vec::new(),
        };
        for (name, count) in [
            ("iterations", tally.iterations),
            ("rows", tally.rows),
            ("solves", tally.solves),
            ("claimed", tally.claimed),
            ("accepted", tally.accepted),
            ("rejected", tally.rejected_claims),
        ] {
            finding.values.insert(name.into(), count.into());
        }
        finding.put("scaled_residual", tally.worst_residual);
        finding
    }
}

fn rank(verdict: &Verdict) -> u8 {
    match verdict {
        Verdict::Proved { .. } => 0,
        Verdict::WithinTolerance => 1,
        // Also a verdict of a later judge, which no figure may show as accepted.
        _ => 2,
    }
}

/// The motion of a scene.
struct SceneMotion {
    steps: usize,
    start: f64,
    energy_change: f64,
    drift: f64,
    penetration: f64,
}

impl From<Motion> for SceneMotion {
    fn from(motion: Motion) -> Self {
        let (start, Motion { drift, penetration, .. }) = (motion.energy(), motion);
        SceneMotion { steps: 0, start, energy_change: 0.0, drift, penetration }
    }
}

impl SceneMotion {
    fn add(&mut self, motion: &Motion) {
        let change = motion.energy() - self.start;
        self.steps += 1;
        self.drift = self.drift.max(motion.drift);
        self.penetration = self.penetration.max(motion.penetration);
        if change.abs() > self.energy_change.abs() {
            self.energy_change = change;
        }
    }
}

/// The solution of a problem if it is known to be unique.
fn only_solution(problem: &Problem) -> Option<Vec<f64>> {
    let expected = Expected::of(problem).filter(|expected| expected.complete)?;
    let [x] = expected.solutions.as_slice() else { return None };
    Some(x.iter().map(|x| x.to_f64().value()).collect())
}
