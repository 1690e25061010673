//! Remedies over a whole run, each one done: what is missing in the end, and how far a body sinks.

use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::{Persistence, Scene};
use lcplab_problem::error::Result;
use lcplab_solver::Group;

use super::remedy::{METHODS, Relief};
use super::run::{End, end_of, sunk};

/// A step is divided into so many.
const PARTS: usize = 8;

/// So many times as many sweeps are tried.
const MORE: usize = 4;

/// The remedies of a run of so many steps, the best first; the run as it is is one of them.
pub(super) fn reliefs(
    scene: &Scene,
    count: usize,
    own: &End,
    exact: &[State],
) -> Result<Vec<Relief>> {
    let relief = |what: String, end: &End, parts: usize| Relief {
        what,
        missing: end.missing,
        sinks: sunk(scene, &end.states, exact).map(|(_, depth)| depth.max(0.0)),
        iterations: end.iterations * parts as f64,
    };
    let mut all = vec![relief("as it is".into(), own, 1)];
    for change in changes(scene) {
        let end = end_of(&change.scene, count * change.parts)?;
        all.push(relief(change.what, &end, change.parts));
    }
    all.sort_by(|a, b| a.missing.total_cmp(&b.missing));
    Ok(all)
}

/// What is changed, and into how many parts a step is divided.
struct Change {
    what: String,
    scene: Scene,
    parts: usize,
}

fn changes(scene: &Scene) -> Vec<Change> {
    let sweeps = scene.solver.max_iterations;
    let group = crate::methods::entry(&scene.solver.name).map(|entry| entry.group);
    let mut all = Vec::new();
    let mut add = |what: String, parts: usize, change: &dyn Fn(&mut Scene)| {
        let mut scene = scene.clone();
        change(&mut scene);
        scene.step.dt /= parts as f64;
        all.push(Change { what, scene, parts });
    };
    if scene.contact.persistence == Persistence::None {
        add("start from the last answer".into(), 1, &|scene| {
            scene.contact.persistence = Persistence::Features;
        });
    }
    if matches!(group, Ok(Group::Sweeps | Group::FirstOrder)) {
        add(format!("{} sweeps", MORE * sweeps), 1, &|scene| {
            scene.solver.max_iterations = MORE * sweeps;
        });
        add(format!("{PARTS} steps for one, {sweeps} sweeps each"), PARTS, &|_| ());
        let few = sweeps.div_ceil(PARTS);
        add(format!("{PARTS} steps for one, {few} sweeps each"), PARTS, &|scene| {
            scene.solver.max_iterations = few;
        });
    }
    for name in METHODS.into_iter().filter(|name| *name != scene.solver.name) {
        let is_direct = crate::methods::entry(name)
            .is_ok_and(|entry| entry.group != Group::Sweeps && entry.group != Group::FirstOrder);
        add(name.into(), 1, &|scene| {
            scene.solver.name = name.into();
            if is_direct {
                let usual = lcplab_solver::Settings::default().max_iterations;
                scene.solver.max_iterations = usual;
            }
        });
    }
    all
}
