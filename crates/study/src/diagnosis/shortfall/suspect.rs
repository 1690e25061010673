//! What moves bodies as they should not move: each suspect is taken away, and the run is done again.

use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::{Persistence, Scene, Scheme};
use lcplab_problem::error::Result;
use lcplab_problem::friction::Model;

use super::cause::Moving;
use super::examine::HEALTHY;
use super::run::{End, WORTH, end_of, exact, is_of_impulses, sunk};

/// Each of several constraints that yield together yields this part of it at least.
const YIELDS: f64 = 0.1;

/// A cause explains at least this part of what is seen.
const TELLING: f64 = 0.5;

/// How far two runs end apart (m).
fn apart(one: &[State], other: &[State]) -> f64 {
    let distance = |(a, b): (&State, &State)| (a.pose.p - b.pose.p).norm();
    one.iter().zip(other).map(distance).fold(0.0, f64::max)
}

/// What is left of a motion when what is suspected is taken away; each is a run of its own. Then what is innocent.
pub(super) fn causes(
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
    if !is_of_impulses(scene.step.scheme) {
        let rigid = end_of(&exact(scene).at_level(Scheme::Velocity), count)?;
        let yields = own.error > YIELDS * WORTH * size && own.error > rigid.error / TELLING;
        let sunk = sunk(scene, &own.states, &rigid.states);
        let deep = sunk.filter(|(_, depth)| yields && *depth > WORTH * size);
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
