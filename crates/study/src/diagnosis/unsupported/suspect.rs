//! Causes of wrong motion: each suspect is removed, and the run is repeated.

use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::{Persistence, Scene, Scheme};
use lcplab_problem::error::Result;
use lcplab_problem::friction::{Form, Model};

use super::cause::Moving;
use super::examine::HEALTHY;
use super::run::{End, WORTH, end_of, exact, is_of_impulses, sunk};

/// If several compliant constraints act together, each contributes at least this part.
const YIELDS: f64 = 0.1;

/// A cause must explain at least this part of the symptom.
const LARGE_FACTOR: f64 = 0.5;

/// Feedback is wrong if the error without it is below this fraction.
const LARGER: f64 = 0.9;

/// Friction is reported from this fraction of the distance moved on.
const FAR: f64 = 0.02;

/// The distance between the ends of two runs (m).
pub(super) fn apart(one: &[State], other: &[State]) -> f64 {
    let distance = |(a, b): (&State, &State)| (a.pose.p - b.pose.p).norm();
    one.iter().zip(other).map(distance).fold(0.0, f64::max)
}

/// The reference for energy gains (J): the work of all weights over the thickness of the thinnest
/// body; without gravity the kinetic energy, or that of all bodies when they move by this thickness
/// during the run.
fn energy_scale(scene: &Scene, size: f64, own: &End) -> f64 {
    let mass: f64 = scene.bodies.iter().map(|body| body.mass.mass()).sum();
    let weight = mass * scene.gravity.norm();
    let speed = size / (own.steps as f64 * scene.step.dt);
    if weight > 0.0 { weight * size } else { own.kinetic.max(0.5 * mass * speed * speed) }
}

/// Removes each suspect in a separate run; returns the causes, and the suspects that were ruled
/// out.
pub(super) fn causes(
    scene: &Scene,
    count: usize,
    own: &End,
    exactly: &End,
) -> Result<(Vec<Moving>, Vec<String>)> {
    let mut ruled_out = Vec::new();
    let size = scene.thinnest().unwrap_or(1.0);
    let mut found = Vec::new();
    if scene.contact.persistence == Persistence::None && own.missing > HEALTHY {
        let mut warm = scene.clone();
        warm.contact.persistence = Persistence::Features;
        let without = end_of(&warm, count)?.missing;
        if without < LARGE_FACTOR * own.missing {
            found.push((own.missing / without, Moving::Cold { with: own.missing, without }));
        } else {
            ruled_out.push("the cold start".into());
        }
    }
    if scene.step.baumgarte > 0.0 {
        let mut plain = scene.clone();
        plain.step.baumgarte = 0.0;
        let plain = end_of(&plain, count)?;
        let counts = WORTH * energy_scale(scene, size, own);
        let gains = own.gained > counts;
        let (with, without) = (own.gained, plain.gained.max(0.0));
        if gains && without < LARGE_FACTOR * with {
            let exactly = exactly.gained.max(0.0);
            let cause = Moving::Feedback { with, without, exactly };
            found.push((with / counts, cause));
        }
        let errs = exactly.error > WORTH * size;
        let (with, without) = (own.error, plain.error);
        // Feedback is meant to reduce errors, so it is wrong even if it does not double them.
        if errs && own.error > WORTH * size && without < LARGER * with {
            found.push((with / (WORTH * size), Moving::Away { with, without }));
        }
        if !gains && !errs {
            ruled_out.push("Baumgarte feedback (it adds no energy)".into());
        }
    }
    let has_friction = scene.bodies.iter().any(|body| body.friction > 0.0);
    let model = scene.contact.model;
    let is_cone = matches!(model.form(), Form::Cone(_));
    let law = match has_friction && !is_cone {
        true => friction(scene, count, own, exactly)?,
        false => None,
    };
    if has_friction && !is_cone && law.is_none() && scene.step.scheme.solves_lcps() {
        ruled_out.push("the friction model (Coulomb's cone gives the same motion)".into());
    }
    if !is_of_impulses(scene.step.scheme) && law.is_none() {
        let rigid = end_of(&exact(scene).at_level(Scheme::Velocity), count)?;
        let yields = own.error > YIELDS * WORTH * size && own.error > rigid.error / LARGE_FACTOR;
        let sunk = sunk(scene, &own.states, &rigid.states);
        let deep = sunk.filter(|(_, depth)| yields && *depth > WORTH * size);
        if let Some((body, depth)) = deep {
            let scheme = scene.step.scheme.name();
            found.push((depth / (WORTH * size), Moving::Soft { scheme, body, depth }));
        }
    }
    found.extend(law);
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    Ok((found.into_iter().map(|(_, cause)| cause).collect(), ruled_out))
}

/// Friction as the cause, if a body moves differently under Coulomb's cone: compared with exact
/// answers if the scheme solves problems, otherwise with the measured deviation from Coulomb's law.
fn friction(
    scene: &Scene,
    count: usize,
    own: &End,
    exactly: &End,
) -> Result<Option<(f64, Moving)>> {
    let scheme = scene.step.scheme;
    let states = match scheme.solves_lcps() {
        true => &exactly.states,
        false if own.slips.speed_error(scene).is_some() => &own.states,
        false => return Ok(None),
    };
    let mut round = exact(scene);
    round.contact.model = Model::CoulombCone;
    if round.validate().is_err() {
        round = round.at_level(Scheme::Velocity);
    }
    if round.validate().is_err() {
        return Ok(None);
    }
    let round = end_of(&round, count)?.states;
    let size = scene.thinnest().unwrap_or(1.0);
    let (distance, way) = (apart(states, &round), apart(states, &scene.states));
    let off = |k: &usize| (states[*k].pose.p - round[*k].pose.p).norm();
    let farthest = (0..round.len()).max_by(|a, b| off(a).total_cmp(&off(b)));
    let Some(body) = farthest.filter(|_| distance > (WORTH * size).max(FAR * way)) else {
        return Ok(None);
    };
    let cause = Moving::Friction {
        is_polygon: matches!(scene.contact.model.form(), Form::Polygon { .. }),
        only_of: (!scheme.poses_friction()).then(|| scheme.name()),
        body: scene.bodies[body].name.clone(),
        distance,
        way: (states[body].pose.p - scene.states[body].pose.p).norm(),
    };
    Ok(Some((distance / (WORTH * size), cause)))
}
