//! The acceleration level: impacts first, as impulses, then LCPs in forces.
//!
//! ```text
//! u' = M⁻¹(F + Jᵀλ),   and an integrator;   semi-implicit: u⁺ = u + dt u',   s⁺ = s + dt S u⁺
//! ```
//!
//! A step is divided where a body arrives at another one: it hits there, and the rest of the step
//! goes on from what the impact left. Which contacts rest ([`Resting`](crate::scene::Resting)) is
//! decided at the beginning of each part; each stage of an integrator solves for their forces anew.
//! The gyroscopic torque is always part of F. Errors are fed back by α. Friction and motors look
//! one dt ahead in every stage, so with them an integrator of higher order is of first order again;
//! springs do so only under the semi-implicit Euler method.
//!
//! Where friction of sliding contacts is substituted, a contact whose slip would turn round within
//! the step sticks. Restitution is part of the impacts. Baraff 1989, 1994; K&M (U2).

use std::borrow::Cow;

use super::arrival::Interval;
use crate::assembly::{Assembly, ConstraintFilter, Row, RowId};
use crate::body::State;
use crate::constraint::Bounds;
use crate::formulation::{Problem, Slide};
use crate::scene::{DetectedContact, Integrator, Scene, Step, step_contacts};
use crate::simulation::integrator::{self, Rate};
use crate::simulation::solving::{Solving, assembled};
use crate::simulation::{Cause, Solve, StepEvent};
use lcplab_judge::ray::refute;
use lcplab_solver::Status;

/// A step is divided no more often than this; a ball that has nearly stopped bouncing would go on
/// for ever.
const MOST_ARRIVALS: usize = 64;
/// A contact that approaches faster than this part of the speed at which one rests is hit.
const HIT: f64 = 1e-6;

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let after = parts(solving, states, found)?;
    if solving.scene.step.integrator != Integrator::SemiImplicitEuler {
        // The work of forces along the path of the stages is not known.
        solving.events = None;
    }
    Ok(after)
}

/// The parts of a step, from one arrival to the next.
fn parts(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let mut found = found.to_vec();
    let mut states = impacts(solving, states, &found)?;
    let dt = solving.scene.step.dt;
    let mut left = dt;
    for _ in 0..MOST_ARRIVALS {
        let kept = Mark::of(solving);
        let (after, resting) = part(solving, &states, &found, (dt - left, left))?;
        let way = Interval { scene: solving.scene, before: &states, after: &after, h: left };
        let arrival = solving.scene.step.events.then(|| way.arrival(&resting)).flatten();
        let Some(theta) = arrival else { return Ok(after) };
        kept.restore(solving);
        if theta > 0.0 {
            (states, _) = part(solving, &states, &found, (dt - left, theta * left))?;
            left *= 1.0 - theta;
        }
        found = step_contacts(solving.scene, &states);
        states = impacts(solving, &states, &found)?;
    }
    Ok(part(solving, &states, &found, (dt - left, left))?.0)
}

/// What was solved and done before an attempt.
struct Mark {
    solves: usize,
    events: Option<usize>,
}

impl Mark {
    fn of(solving: &Solving) -> Self {
        Mark { solves: solving.solves.len(), events: solving.events.as_ref().map(Vec::len) }
    }

    fn restore(&self, solving: &mut Solving) {
        solving.solves.truncate(self.solves);
        match (&mut solving.events, self.events) {
            (Some(events), Some(count)) => events.truncate(count),
            (events, _) => *events = None,
        }
    }
}

/// The states after a part of h (s) of the step that begins so long after it, without arrivals, and
/// the rows that took part.
fn part(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
    (begins, h): (f64, f64),
) -> Result<(Vec<State>, Vec<RowId>), Cause> {
    let whole = solving.scene;
    let scene: Cow<'_, Scene> = match h == whole.step.dt {
        true => Cow::Borrowed(whole),
        false => Cow::Owned(Scene { step: Step { dt: h, ..whole.step.clone() }, ..whole.clone() }),
    };
    let scene = scene.as_ref();
    let first = solving.solves.len();
    let assembly = solving.assemble(states, found, ConstraintFilter::Resting)?;
    let resting: Vec<RowId> = assembly.rows.iter().map(|row| row.id).collect();
    let method = match scene.step.integrator {
        Integrator::SemiImplicitEuler => {
            let solve = forces(solving, scene, assembly)?;
            let after = solve.problem.next_states(states, &solve.solution.x, h);
            solving.note_answer();
            solving.note(StepEvent::Advance(h));
            set_impulse_factors(&mut solving.solves[first..], h, &[1.0]);
            return Ok((after, resting));
        }
        Integrator::ExplicitEuler => integrator::explicit_euler,
        Integrator::Rk4 => integrator::rk4,
        Integrator::ImplicitMidpoint => integrator::implicit_midpoint,
    };
    let from = solving.from + begins;
    let after = method(h, states, &mut |later, stage| {
        let scene = scene.forced(from + later, 0.0);
        rates(solving, &scene, stage, found, &resting)
    })?;
    let weights: &[f64] = match scene.step.integrator {
        Integrator::Rk4 => &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
        // Only the last iterate of the midpoint counts.
        _ => &[1.0],
    };
    set_impulse_factors(&mut solving.solves[first..], h, weights);
    Ok((after, resting))
}

/// Sets the durations of the forces: the last stages have these parts of h, earlier ones were
/// replaced.
fn set_impulse_factors(stages: &mut [Solve], h: f64, weights: &[f64]) {
    let replaced = stages.len() - weights.len();
    for (k, stage) in stages.iter_mut().enumerate() {
        stage.impulse_factor = if k < replaced { 0.0 } else { h * weights[k - replaced] };
    }
}

/// y' at a stage, with the rows that were chosen at the beginning.
fn rates(
    solving: &mut Solving,
    scene: &Scene,
    stage: &[State],
    found: &[DetectedContact],
    resting: &[RowId],
) -> Result<Vec<Rate>, Cause> {
    let unit = integrator::normalised(stage);
    let assembly = assembled(scene, &unit, found, ConstraintFilter::Only(resting))?;
    let solve = forces(solving, scene, assembly)?;
    let accelerations = solve.problem.motion(&solve.solution.x);
    let still = vec![State::WORLD; stage.len()];
    let accelerations = solve.problem.assembly.with_velocities(&still, &accelerations);
    let rate = |(state, a): (&State, &State)| Rate::of(state, &a.velocity());
    Ok(stage.iter().zip(&accelerations).map(rate).collect())
}

/// The force LCP at an instant. Contacts that slide and would turn round are made to stick, one
/// round after the other.
fn forces<'s>(
    solving: &'s mut Solving,
    scene: &Scene,
    assembly: Assembly,
) -> Result<&'s Solve, Cause> {
    let mut slides = Slide::of_scene(scene, &assembly);
    while !slides.is_empty() {
        let problem = Problem::sliding(scene, assembly.clone(), slides.clone())?;
        let solve = solving.solve(problem)?;
        if let Some(cause) = impossible(solve, scene) {
            return Err(cause);
        }
        let u = solve.problem.next_velocity(&solve.solution.x, scene.step.dt);
        let before: Vec<f64> = assembly.rows.iter().map(|row| row.velocity).collect();
        let moved = assembly.push_forward(&u).into_iter().zip(&assembly.rows);
        let after: Vec<f64> = moved.map(|(speed, row)| speed + row.drift).collect();
        let count = slides.len();
        slides.retain(|slide| !slide.reverses(&before, &after));
        if slides.len() == count {
            return Ok(solving.last());
        }
        // The answer belongs to a problem that was discarded.
        solving.solves.pop();
    }
    solving.solve(Problem::acceleration(scene, assembly)?)
}

/// The proof that the problem has no solution, if it was not solved and there is one: a sliding
/// contact alone, the sliding contacts of two bodies together, the solver's ray; or that all active
/// sets were tried.
fn impossible(solve: &Solve, scene: &Scene) -> Option<Cause> {
    let Solve { problem, solution, .. } = solve;
    if solution.status == Status::Solved || problem.slides.is_empty() {
        return None;
    }
    let rows = &problem.assembly.rows;
    let normals = || problem.slides.iter().map(|slide| slide.normal);
    let alone = normals().map(|row| (row, vec![row]));
    let pairs = normals().map(|row| {
        let same = |&other: &usize| rows[other].bodies == rows[row].bodies;
        (row, normals().filter(same).collect())
    });
    let indicator = |(row, ones): (usize, Vec<usize>)| {
        let d = (0..rows.len()).map(|j| if ones.contains(&j) { 1.0 } else { 0.0 });
        (row, d.collect::<Vec<f64>>())
    };
    let ray = match &solution.status {
        Status::Ray { row, direction } => Some((*row, direction.clone())),
        _ => None,
    };
    let guesses = alone.chain(pairs).map(indicator).chain(ray);
    let proofs = guesses.filter_map(|(row, d)| Some((row, refute(&problem.lcp, row, &d)?)));
    let (row, proof) = match proofs.map(|(row, proof)| (row, Some(proof))).next() {
        Some(found) => found,
        None if solution.status == Status::NoSolution => (normals().next()?, None),
        None => return None,
    };
    Some(Cause::NoSolution { row: rows[row].label(scene), proof })
}

/// The states after the impacts, where bodies touch or limits are met, and approach.
fn impacts(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let assembly = solving.assemble(states, found, ConstraintFilter::Touching)?;
    let limit = -HIT * solving.scene.resting().speed;
    let hits = |row: &Row| row.bounds == Bounds::Unilateral && row.velocity < limit;
    if !assembly.rows.iter().any(hits) {
        return Ok(states.to_vec());
    }
    let solve = solving.solve_bouncing(Problem::impact(solving.scene, assembly)?)?;
    let u = solve.problem.next_velocity(&solve.solution.x, 0.0);
    let states = solve.problem.assembly.with_velocities(states, &u);
    solving.note_answer();
    Ok(states)
}
