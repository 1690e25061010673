//! A second of a scene, stepped as its owner does and exactly, and again without what is suspected.

use lcplab_mechanics::body::State;
use lcplab_mechanics::formulation::Stage;
use lcplab_mechanics::scene::{Persistence, Scene, Scheme};
use lcplab_mechanics::simulation::{self, Simulation, Solve, Step};
use lcplab_problem::error::Result;
use lcplab_problem::friction::Model;
use lcplab_problem::{Lcp, merit};

use super::cause::Moving;
use super::examination::{Examination, Note, telling_step};
use super::examine::{HEALTHY, Practice, examine};
use super::frame::Frame;
use super::yard::Yard;

/// A run takes this long (s), or as long as the scene says if that is shorter.
const TIME: f64 = 1.0;

/// A run takes no more steps.
const MOST_STEPS: usize = 1000;

/// Lengths are worth a word from this part of the thinnest body on, energies from the work of all weights over it.
const WORTH: f64 = 0.01;

/// A cause explains at least this part of what is seen.
const TELLING: f64 = 0.5;

/// Steps with more rows are not compared with exact answers.
const LARGEST: usize = 300;

/// With more rows not every step is compared.
const EVERY_STEP: usize = 80;

/// The solver that a run is compared with.
const EXACT: &str = "dantzig";

/// Where a run ends.
struct End {
    states: Vec<State>,
    gained: f64,
    missing: f64,
}

/// Examines a scene: its motion for a second, and the solve of a step, or of the first in which much is missing.
///
/// # Errors
/// If its solver does not exist, or is none for boxes.
pub fn examine_scene(scene: &Scene, step: Option<usize>) -> Result<Examination> {
    let practice = practice(scene)?;
    let count = steps(scene);
    let went = go(scene, count)?;
    let taken = went.notes.len();
    let mut found = Examination { notes: went.notes, ..Examination::default() };
    if taken == 0 {
        return Ok(found);
    }
    found.time = Some(taken as f64 * scene.step.dt);
    if went.is_compared {
        let exactly = end_of(&exact(scene), taken)?;
        found.sunk = sunk(scene, &went.end.states, &exactly.states);
        let (moving, innocent) = causes(scene, taken, &went.end, &exactly)?;
        (found.moving, found.innocent) = (moving, innocent);
    }
    let number = step.unwrap_or_else(|| telling_step(&found.notes) + 1);
    let solve = went.solves.get(number - 1).and_then(Option::as_ref);
    if let Some(solve) = solve.filter(|solve| solve.posing.is_none()) {
        let frame = Frame::of(&solve.exported(scene, number));
        found.shortfall = examine(&frame, &practice, Some(&solve.start));
        found.innocent.extend(redundancy(&solve.problem.lcp));
    }
    Ok(found)
}

/// Redundant rows, which do no harm to a motion without friction.
fn redundancy(lcp: &Lcp) -> Option<String> {
    let found =
        lcplab_judge::regularity::regularity(lcp.matrix()).filter(|_| lcp.len() <= LARGEST)?;
    let spare = lcp.len() - found.rank;
    let word = if lcp.has_coupled_rows() { "" } else { ", and the motion is unique" };
    (spare > 0).then(|| {
        format!("{spare} redundant rows (their forces are shared in one way or another{word})")
    })
}

/// How many steps a run has.
fn steps(scene: &Scene) -> usize {
    let second = (TIME / scene.step.dt).ceil() as usize;
    second.min(scene.step.count).clamp(1, MOST_STEPS)
}

/// The scene with exact answers.
fn exact(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.solver.name = EXACT.into();
    scene.solver.max_iterations = lcplab_solver::Settings::default().max_iterations;
    if !scene.step.scheme.solves_lcps() {
        scene.step.scheme = Scheme::Velocity;
    }
    scene
}

/// How a run went.
struct Went {
    notes: Vec<Note>,
    solves: Vec<Option<Solve>>,
    end: End,
    /// Whether every step is small enough to be compared with exact answers.
    is_compared: bool,
}

fn go(scene: &Scene, count: usize) -> Result<Went> {
    let mut simulation = Simulation::of(scene)?;
    let start = simulation.motion().energy();
    let (mut notes, mut solves, mut gained) = (Vec::new(), Vec::new(), 0.0_f64);
    let mut is_compared = true;
    while notes.len() < count && is_compared {
        let Ok(step) = simulation.step() else { break };
        gained = gained.max(step.motion.energy() - start);
        let solve = main_solve(&step);
        is_compared = solve.is_none_or(|solve| solve.problem.lcp.len() <= LARGEST);
        notes.push(note(scene, &step, solve));
        solves.push(solve.cloned());
    }
    let half = &notes[notes.len() / 2..];
    let missing = half.iter().map(|note| note.missing).sum::<f64>() / half.len().max(1) as f64;
    let end = End { states: simulation.states().to_vec(), gained, missing };
    Ok(Went { notes, solves, end, is_compared })
}

fn end_of(scene: &Scene, count: usize) -> Result<End> {
    Ok(go(scene, count)?.end)
}

/// The solve that carries: not those of blows and corrections.
fn main_solve(step: &Step) -> Option<&Solve> {
    let carries =
        |solve: &&Solve| matches!(solve.problem.stage, Stage::Velocity | Stage::Acceleration);
    step.solves.iter().find(carries)
}

fn note(scene: &Scene, step: &Step, solve: Option<&Solve>) -> Note {
    let mut note = Note {
        name: format!("step {}", step.number),
        missing: 0.0,
        uncarried: 0.0,
        residual: 0.0,
        bias: 0.0,
        penetration: Some(step.motion.penetration),
        energy: Some(step.motion.energy()),
    };
    let Some(solve) = solve else { return note };
    let (lcp, x) = (&solve.problem.lcp, &solve.solution.x);
    note.residual = merit::scaled_residual(lcp, x);
    note.bias = solve.problem.bias.iter().fold(0.0, |most: f64, bias| most.max(-bias));
    // Large problems are looked at now and then.
    let every = (lcp.len() / EVERY_STEP).max(1).pow(2);
    if lcp.len() > LARGEST || step.number % every != 1 % every || solve.posing.is_some() {
        return note;
    }
    let frame = Frame::of(&solve.exported(scene, step.number));
    if let Some(yard) = Yard::new(lcp, frame.weight(|_| 1.0)) {
        note.missing = yard.missing(x);
        let error: Vec<f64> = yard.exact.iter().zip(x).map(|(exact, x)| exact - x).collect();
        let impulse = frame.impulse(&error, |_| true);
        note.uncarried = frame.bodies.iter().map(|body| frame.upward(&impulse, body)).sum();
    }
    note
}

/// The body that is lowest beside another run, and by how much.
fn sunk(scene: &Scene, own: &[State], exact: &[State]) -> Option<(String, f64)> {
    let down = scene.gravity.try_normalize(0.0)?;
    let depth = |k: usize| down.dot(&(own[k].pose.p - exact[k].pose.p));
    let lowest = (0..own.len()).max_by(|a, b| depth(*a).total_cmp(&depth(*b)))?;
    Some((scene.bodies[lowest].name.clone(), depth(lowest)))
}

/// How far two runs end apart (m).
fn apart(one: &[State], other: &[State]) -> f64 {
    let distance = |(a, b): (&State, &State)| (a.pose.p - b.pose.p).norm();
    one.iter().zip(other).map(distance).fold(0.0, f64::max)
}

/// What is left of a motion when what is suspected is taken away; each is a run of its own.
fn causes(
    scene: &Scene,
    count: usize,
    own: &End,
    exactly: &End,
) -> Result<(Vec<Moving>, Vec<String>)> {
    let mut innocent = Vec::new();
    let size = scene.thinnest().unwrap_or(1.0);
    let weight: f64 =
        scene.bodies.iter().map(|body| body.mass.mass()).sum::<f64>() * scene.gravity.norm();
    let mut found = Vec::new();
    if scene.contact.persistence == Persistence::None && own.missing > HEALTHY {
        let mut warm = scene.clone();
        warm.contact.persistence = Persistence::Features;
        let without = end_of(&warm, count)?.missing;
        if without < TELLING * own.missing {
            found.push((own.missing / without, Moving::Cold { with: own.missing, without }));
        } else {
            innocent.push("the cold start".into());
        }
    }
    if scene.step.baumgarte > 0.0 && exactly.gained <= WORTH * weight * size {
        innocent.push("Baumgarte's feedback (no energy is gained)".into());
    } else if scene.step.baumgarte > 0.0 {
        let mut plain = exact(scene);
        plain.step.baumgarte = 0.0;
        let (with, without) = (exactly.gained, end_of(&plain, count)?.gained.max(0.0));
        if without < TELLING * with {
            found.push((with / (WORTH * weight * size), Moving::Feedback { with, without }));
        }
    }
    if !scene.step.scheme.solves_lcps() && scene.step.scheme != Scheme::SequentialImpulses {
        let rigid = end_of(&exact(scene).at_level(Scheme::Velocity), count)?;
        let deep =
            sunk(scene, &own.states, &rigid.states).filter(|(_, depth)| *depth > WORTH * size);
        if let Some((body, depth)) = deep {
            let scheme = scene.step.scheme.name();
            found.push((depth / (WORTH * size), Moving::Soft { scheme, body, depth }));
        }
    }
    let rubs = scene.bodies.iter().any(|body| body.friction > 0.0);
    if rubs && scene.contact.model == Model::CoupledBox && scene.step.scheme == Scheme::Velocity {
        let mut round = exact(scene);
        round.contact.model = Model::CoulombCone;
        let distance = apart(&exactly.states, &end_of(&round, count)?.states);
        let start = &scene.states;
        let way = apart(&exactly.states, start).max(WORTH * size);
        if distance > (WORTH * size).max(0.02 * way) {
            found.push((distance / (WORTH * size), Moving::BoxFriction { distance, way }));
        } else {
            innocent.push("the box of friction (Coulomb's cone moves alike)".into());
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    Ok((found.into_iter().map(|(_, cause)| cause).collect(), innocent))
}

/// How the scene's problems are solved.
///
/// # Errors
/// If its solver is none for boxes.
pub fn practice(scene: &Scene) -> Result<Practice> {
    let entry = crate::methods::entry(&scene.solver.name)?;
    Ok(Practice { entry, options: simulation::options(scene) })
}
