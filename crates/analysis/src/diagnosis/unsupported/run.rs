//! Runs a scene for a second as the user does and with exact answers, and again without each
//! suspected cause.

use lcplab_judge::Demand;
use lcplab_lcp::error::Result;
use lcplab_lcp::number::readable;
use lcplab_lcp::{Lcp, merit};
use lcplab_mechanics::body::State;
use lcplab_mechanics::formulation::Stage;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{self, LostBounces, Simulation, Slips, Solve, Step, Warnings};
use lcplab_solver::{Dantzig, Order, Pgs, Status};

use super::examination::{Examination, StepSummary, first_bad_step};
use super::examine::{UserSolver, examine};
use super::frame::Frame;
use super::island::{worst, worst_part};
use super::moving::causes;
use super::reference::{ReferenceSolution, is_accepted};
use super::remedy_effect::remedy_effects;
use super::thresholds::{HEALTHY, REPORTED_LENGTH};

/// The duration of a run (s), or that of the scene if it is shorter.
const TIME: f64 = 1.0;

/// Maximum number of steps of a run.
const MOST_STEPS: usize = 1000;

/// Maximum number of rows for comparison with exact answers.
const LARGEST: usize = 300;

/// Number of rows above which not every step is compared.
const EVERY_STEP: usize = 80;

/// Number of steps compared in a run of which only the end matters.
const COMPARED: usize = 20;

/// A drift of joints above this part of the scene's size is reported.
const DRIFTED: f64 = 0.05;

/// The solver for exact answers.
const EXACT: &str = Dantzig::NAME;

/// The end of a run.
pub(super) struct End {
    /// The last states.
    pub states: Vec<State>,
    /// The largest energy above that of the start (J).
    pub gained: f64,
    /// The largest kinetic energy (J).
    pub kinetic: f64,
    /// The mean error in its second half, over the compared steps.
    pub missing: f64,
    /// The mean number of sweeps, pivots or steps per solve.
    pub iterations: f64,
    /// The largest drift or overlap (m).
    pub error: f64,
    /// Its friction compared with Coulomb's law.
    pub slips: Slips,
    /// The number of steps taken.
    pub steps: usize,
    /// Whether every step was small enough for comparison with exact answers.
    pub is_compared: bool,
}

/// Examines a scene: its motion for a second, and the solve of a step (by default the first with a
/// large error).
///
/// # Errors
/// If its solver does not exist, or is not for boxes.
pub fn examine_scene(scene: &Scene, step: Option<usize>) -> Result<Examination> {
    let user_solver = user_solver(scene)?;
    let count = steps(scene);
    let run = go(scene, count, 1)?;
    let taken = run.notes.len();
    let refused = run.refused();
    let mut found = Examination {
        notes: run.notes,
        warnings: run.warnings,
        lost_bounces: run.lost_bounces,
        gave_up: run.gave_up.clone(),
        ended: run.ended.clone(),
        ..Examination::default()
    };
    if taken == 0 {
        return Ok(found);
    }
    found.time = Some(taken as f64 * scene.step.dt);
    let reference = go(&exact(scene), taken, sparsely(taken))?;
    let unaccepted = reference.first_unaccepted();
    let exactly = reference.end;
    if let Some(step) = unaccepted {
        found.no_reference = Some(format!(
            "the judge rejects the answer of {EXACT} in step {step}, so there is no run with exact answers"
        ));
    } else if run.end.is_compared && exactly.is_compared && exactly.steps == taken {
        // Exact answers are no reference for another scheme, nor if they let rows drift apart
        // themselves.
        let is_alike = is_of_impulses(scene.step.scheme);
        if is_alike && exactly.error <= REPORTED_LENGTH * scene.thinnest().unwrap_or(1.0) {
            found.sunk = sunk(scene, &run.end.states, &exactly.states);
        }
        let (moving, ruled_out) = causes(scene, taken, &run.end, &exactly)?;
        (found.moving, found.ruled_out) = (moving, ruled_out);
        if run.end.missing > HEALTHY {
            found.remedy_effects = remedy_effects(scene, taken, &run.end, &exactly.states)?;
        }
    }
    let number = step.unwrap_or_else(|| first_bad_step(&found.notes) + 1);
    let solve = run.solves.get(number - 1).and_then(Option::as_ref);
    if let Some(solve) = solve.filter(|solve| solve.posing.is_none()) {
        let whole = frame(scene, solve, number);
        let (frame, start) = worst_part(whole, &solve.solution.x, solve.start.clone());
        found.unsupported = examine(&frame, &user_solver, Some(&start));
        found.clear_the_start();
        found.ruled_out.extend(redundancy(&solve.problem.lcp));
        (found.place, found.frame) = (number - 1, Some(frame));
    }
    if found.unsupported.is_none() && run.solves.iter().any(Option::is_some) {
        let refused = refused.map_or(String::new(), |refused| format!("; {refused}"));
        let simulated = run.solves.len();
        let reason = match number > simulated {
            true => {
                let time = readable(simulated as f64 * scene.step.dt, 3);
                format!("step {number} is after the simulated time of {time} s")
            }
            false => unmeasured(solve, number),
        };
        found.unmeasured = Some(reason + &refused);
    }
    Ok(found)
}

/// Why the answer of a step is not compared with an exact one.
fn unmeasured(solve: Option<&Solve>, step: usize) -> String {
    match solve {
        None => format!("step {step} has no rows"),
        Some(Solve { posing: Some(posing), .. }) => {
            format!(
                "exact answers are available for the coupled box only, and this problem has the model \
             {}",
                posing.model
            )
        }
        Some(solve) => ReferenceSolution::absence(&solve.problem.lcp).into(),
    }
}

/// Redundant rows, which are harmless for a motion without friction.
fn redundancy(lcp: &Lcp) -> Option<String> {
    let found =
        lcplab_judge::regularity::regularity(lcp.matrix()).filter(|_| lcp.len() <= LARGEST)?;
    let spare = lcp.len() - found.rank;
    let effect = match lcp.has_coupled_rows() {
        true => "they make the forces non-unique, which is not an error of the solver",
        false => "they make the forces non-unique, but do not change the motion",
    };
    (spare > 0).then(|| format!("{spare} redundant rows ({effect})"))
}

/// The number of steps of a run.
fn steps(scene: &Scene) -> usize {
    let second = (TIME / scene.step.dt).ceil() as usize;
    second.min(scene.step.count).clamp(1, MOST_STEPS)
}

/// The scene with exact answers.
pub fn exact(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    (scene.solver.name, scene.solver.fixed_sweeps) = (EXACT.into(), false);
    let usual = lcplab_solver::Settings::default();
    scene.solver.max_iterations = usual.max_iterations;
    scene.solver.tolerance = scene.solver.tolerance.min(usual.tolerance);
    if !scene.step.scheme.solves_lcps() {
        scene.step.scheme = Scheme::Velocity;
    }
    scene
}

/// Whether steps solve for impulses or forces of rigid constraints, in an LCP or sweep by sweep.
pub(super) fn is_of_impulses(scheme: Scheme) -> bool {
    scheme.solves_lcps() || scheme == Scheme::SequentialImpulses
}

/// The result of a run.
struct RunResult {
    notes: Vec<StepSummary>,
    solves: Vec<Option<Solve>>,
    warnings: Vec<String>,
    /// The impacts that lost their bounce, in words.
    lost_bounces: Option<String>,
    /// Why a step could not be computed, if so.
    ended: Option<String>,
    /// Why the solver gave up, in the first step in which it did.
    gave_up: Option<String>,
    /// The tolerance of the scene's solver settings.
    tolerance: f64,
    end: End,
}

impl RunResult {
    /// The number of rejected answers under models other than the coupled box, and the first one.
    fn refused(&self) -> Option<String> {
        let posed = self.solves.iter().enumerate().filter_map(|(k, solve)| {
            let solve = solve.as_ref().filter(|solve| solve.posing.is_some())?;
            let demand = Demand { tolerance: self.tolerance, prove_up_to: 0 };
            let certificate = solve.judged(&demand);
            (!certificate.verdict.is_solution())
                .then(|| (k + 1, &solve.solver, certificate.verdict))
        });
        let refused: Vec<_> = posed.collect();
        let (step, solver, verdict) = refused.first()?;
        let (count, steps) = (refused.len(), self.solves.len());
        Some(format!(
            "the judge rejects {count} of {steps} answers; the first is that of {solver} in step {step}: \
             {verdict}"
        ))
    }

    /// The first step whose answer the judge does not accept, if there is one.
    fn first_unaccepted(&self) -> Option<usize> {
        let is_refused = |solve: &Solve| {
            solve.posing.is_none() && !is_accepted(&solve.problem.lcp, &solve.solution.x)
        };
        self.solves.iter().position(|solve| solve.as_ref().is_some_and(is_refused)).map(|k| k + 1)
    }
}

/// Takes this number of steps; every `every`-th is compared with its exact answer.
fn go(scene: &Scene, count: usize, every: usize) -> Result<RunResult> {
    let mut simulation = Simulation::of(scene)?;
    let start = simulation.motion().energy();
    let (mut notes, mut solves) = (Vec::new(), Vec::new());
    let (mut gained, mut kinetic, mut error, mut drift) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    let mut is_compared = true;
    let (mut warnings, mut ended, mut given_up) = (Warnings::default(), None, None);
    let (mut slips, mut lost_bounces) = (Slips::default(), LostBounces::default());
    while notes.len() < count && is_compared {
        let step = match simulation.step() {
            Ok(step) => step,
            Err(failure) => {
                ended = Some(failure.to_string());
                break;
            }
        };
        gained = gained.max(step.motion.energy() - start);
        kinetic = kinetic.max(step.motion.kinetic);
        drift = drift.max(step.motion.drift);
        error = error.max(step.motion.drift).max(step.motion.penetration);
        warnings.add(scene, &step);
        slips.add(&step);
        lost_bounces.add(scene, &step);
        given_up = given_up.or_else(|| gave_up(scene, &step));
        let solve = main_solve(&step);
        is_compared = solve.is_none_or(|solve| solve.problem.lcp.len() <= LARGEST);
        notes.push(note(scene, &step, solve, every));
        solves.push(solve.cloned());
    }
    let half = notes[notes.len() / 2..].iter().filter_map(|note| note.missing);
    let missing = mean(half).unwrap_or(0.0);
    let done = solves.iter().flatten().map(|solve: &Solve| solve.solution.iterations as f64);
    let iterations = mean(done).unwrap_or(0.0);
    let end = End {
        states: simulation.states().to_vec(),
        gained,
        kinetic,
        missing,
        iterations,
        error,
        slips,
        steps: notes.len(),
        is_compared,
    };
    let springs = simulation::unstable_springs(scene).into_iter();
    let warnings = springs.chain(warnings.texts()).chain(drifted(scene, drift)).collect();
    let tolerance = scene.solver.tolerance;
    let lost_bounces = lost_bounces.in_words(scene);
    Ok(RunResult {
        notes,
        solves,
        warnings,
        lost_bounces,
        ended,
        gave_up: given_up,
        tolerance,
        end,
    })
}

/// The solver's message in a step in which it gave up and the judge does not accept its answer, if
/// it did, or the rows that contradict each other. Reaching the iteration limit does not count as
/// giving up.
fn gave_up(scene: &Scene, step: &Step) -> Option<String> {
    let gives_up = |solve: &&Solve| {
        let is_said_elsewhere = matches!(
            solve.solution.status,
            Status::Solved
                | Status::IterationLimit
                | Status::SetsLeft { .. }
                | Status::NoAnswer { .. }
                | Status::OutsideClass { .. }
        );
        let is_boxed = solve.posing.is_none();
        is_boxed && !is_said_elsewhere && !is_accepted(&solve.problem.lcp, &solve.solution.x)
    };
    let solve = step.solves.iter().find(gives_up)?;
    let conflict = solve.conflict(scene);
    let (number, status) = (step.number, &solve.solution.status);
    Some(match conflict.is_empty() {
        true => format!("in step {number}: {status}; another solver may continue"),
        false => {
            let rows = conflict.join(", ");
            format!("in step {number}, no impulses or forces satisfy these rows together: {rows}")
        }
    })
}

/// The drift of joints (m), if it is a large part of the scene.
fn drifted(scene: &Scene, drift: f64) -> Option<String> {
    let points = || scene.states.iter().map(|state| state.pose.p);
    let farthest = points().map(|p| p.norm()).fold(0.0, f64::max);
    let pairs = points().flat_map(|p| points().map(move |q| (p - q).norm()));
    let part = drift / pairs.fold(farthest, f64::max);
    let remedy = match scene.step.scheme {
        Scheme::Velocity | Scheme::SequentialImpulses => "a shorter step or step.baumgarte",
        Scheme::Acceleration => "a shorter step or step.alpha",
        _ => "a shorter step",
    };
    (part > DRIFTED && part.is_finite()).then(|| {
        format!(
            "joints came apart by up to {} m, {} % of the scene's size at the start; {remedy} reduces \
             this",
            readable(drift, 3),
            readable(100.0 * part, 2)
        )
    })
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}

/// The end of a run of this number of steps.
pub(super) fn end_of(scene: &Scene, count: usize) -> Result<End> {
    Ok(go(scene, count, sparsely(count))?.end)
}

/// The interval between compared steps, in a run of which only the end matters.
fn sparsely(count: usize) -> usize {
    (count / COMPARED).max(1)
}

/// The problem of a step with its bodies, and the rounding of positions.
fn frame(scene: &Scene, solve: &Solve, step: usize) -> Frame {
    let farthest = scene.states.iter().map(|state| state.pose.p.norm()).fold(0.0, f64::max);
    let dt = scene.step.dt;
    let time = if solve.problem.stage == Stage::Acceleration { dt * dt } else { dt };
    let position_rounding = f64::EPSILON * (farthest + scene.thinnest().unwrap_or(0.0)) / time;
    Frame { position_rounding, ..Frame::of(&solve.exported(scene, step)) }
}

/// The main solve of a step, not those of impacts and corrections.
pub fn main_solve(step: &Step) -> Option<&Solve> {
    let carries =
        |solve: &&Solve| matches!(solve.problem.stage, Stage::Velocity | Stage::Acceleration);
    step.solves.iter().find(carries)
}

fn note(scene: &Scene, step: &Step, solve: Option<&Solve>, every: usize) -> StepSummary {
    let mut note = StepSummary {
        name: format!("step {}", step.number),
        missing: None,
        unsupported: 0.0,
        residual: 0.0,
        bias: 0.0,
        penetration: Some(step.motion.penetration),
        energy: Some(step.motion.energy()),
    };
    let Some(solve) = solve else { return note };
    let (lcp, x) = (&solve.problem.lcp, &solve.solution.x);
    note.residual = merit::scaled_residual(lcp, x);
    note.bias = solve.problem.bias.iter().fold(0.0, |most: f64, bias| most.max(-bias));
    // Large problems are compared less often.
    let every = every * (lcp.len() / EVERY_STEP).max(1).pow(2);
    if lcp.len() > LARGEST || step.number % every != 1 % every || solve.posing.is_some() {
        return note;
    }
    let frame = frame(scene, solve, step.number);
    if let Some(reference) = ReferenceSolution::of(&frame) {
        let missing = reference.missing_in_answer(x);
        note.missing = Some(worst(&frame, x, missing).map_or(missing, |(_, error)| error));
        let error: Vec<f64> = reference.exact.iter().zip(x).map(|(exact, x)| exact - x).collect();
        let impulse = frame.impulse(&error, |_| true);
        note.unsupported = frame.bodies.iter().map(|body| frame.upward(&impulse, body)).sum();
    }
    note
}

/// The body that is farthest below its position in another run, and by how much.
pub(super) fn sunk(scene: &Scene, own: &[State], exact: &[State]) -> Option<(String, f64)> {
    let down = scene.gravity.try_normalize(0.0)?;
    let depth = |k: usize| down.dot(&(own[k].pose.p - exact[k].pose.p));
    let lowest = (0..own.len()).max_by(|a, b| depth(*a).total_cmp(&depth(*b)))?;
    Some((scene.bodies[lowest].name.clone(), depth(lowest)))
}

/// How the scene's problems are solved. Sequential impulses are sweeps of PGS.
///
/// # Errors
/// If its solver is not for boxes.
pub fn user_solver(scene: &Scene) -> Result<UserSolver> {
    let mut options = simulation::options(scene);
    let name = match scene.step.scheme {
        Scheme::SequentialImpulses => {
            options.settings.max_iterations = scene.step.sweeps;
            options.order = Order::Natural;
            Pgs::NAME
        }
        _ => &scene.solver.name,
    };
    Ok(UserSolver { entry: scene.solvers.entry(name)?.clone(), options })
}
