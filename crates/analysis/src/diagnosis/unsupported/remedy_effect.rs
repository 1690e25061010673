//! Remedies over a whole run, each one carried out: the final position error, and the error of the
//! answers.

use lcplab_lcp::error::Result;
use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::{Persistence, Scene};
use lcplab_solver::{Group, Registry};

use super::cause::Slow;
use super::examination::Examination;
use super::moving::apart;
use super::remedy::{METHODS, RemedyEffect, UNCHANGED};
use super::run::{End, end_of};
use super::thresholds::CREDIBLE;

/// The number of parts into which a step is divided.
const PARTS: usize = 8;

/// The factor on the number of sweeps.
const MORE: usize = 4;

/// The remedy for a start that is worse than none.
const COLD: &str = "cold start in every step";

/// The remedies of a run of this number of steps, the best first; the unchanged run is one of them.
pub(super) fn remedy_effects(
    scene: &Scene,
    count: usize,
    own: &End,
    exact: &[State],
) -> Result<Vec<RemedyEffect>> {
    let remedy_effect = |what: String, end: &End, parts: usize| RemedyEffect {
        what,
        missing: end.missing,
        off: apart(&end.states, exact),
        iterations: end.iterations * parts as f64,
    };
    let mut all = vec![remedy_effect(UNCHANGED.into(), own, 1)];
    for change in changes(scene) {
        let end = end_of(&change.scene, count * change.parts)?;
        all.push(remedy_effect(change.what, &end, change.parts));
    }
    all.sort_by(|a, b| a.off.total_cmp(&b.off));
    Ok(all)
}

/// The change, and the number of parts into which a step is divided.
struct Change {
    what: String,
    scene: Scene,
    parts: usize,
}

fn changes(scene: &Scene) -> Vec<Change> {
    let sweeps = scene.solver.max_iterations;
    let group = scene.solvers.entry(&scene.solver.name).map(|entry| entry.group);
    let mut all = Vec::new();
    let mut add = |what: String, parts: usize, change: &dyn Fn(&mut Scene)| {
        let mut scene = scene.clone();
        change(&mut scene);
        scene.step.dt /= parts as f64;
        all.push(Change { what, scene, parts });
    };
    let (start, other) = match scene.contact.persistence {
        Persistence::None => ("warm start", Persistence::Features),
        Persistence::Features => (COLD, Persistence::None),
    };
    add(start.into(), 1, &|scene| scene.contact.persistence = other);
    if scene.step.baumgarte > 0.0 {
        add("without feedback".into(), 1, &|scene| scene.step.baumgarte = 0.0);
    }
    if matches!(group, Ok(Group::Sweeps | Group::FirstOrder)) {
        add(format!("{} sweeps", MORE * sweeps), 1, &|scene| {
            scene.solver.max_iterations = MORE * sweeps;
        });
        add(format!("{PARTS} substeps, {sweeps} sweeps each"), PARTS, &|_| ());
        let few = sweeps.div_ceil(PARTS);
        add(format!("{PARTS} substeps, {few} sweeps each"), PARTS, &|scene| {
            scene.solver.max_iterations = few;
        });
    }
    for name in METHODS.into_iter().filter(|name| *name != scene.solver.name) {
        let is_direct = Registry::standard()
            .entry(name)
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

impl Examination {
    /// Drops a start that is worse than none in the examined step as a cause, unless the run is
    /// better without it.
    pub(super) fn clear_the_start(&mut self) {
        let of = |what: &str| {
            self.remedy_effects.iter().find(|remedy_effect| remedy_effect.what == what)
        };
        let (Some(own), Some(cold)) = (of(UNCHANGED), of(COLD)) else { return };
        let helps = cold.missing < CREDIBLE * own.missing;
        let Some(found) = self.unsupported.as_mut().filter(|_| !helps) else { return };
        let before = found.causes.len();
        found.causes.retain(|cause| !matches!(cause, Slow::Stale { .. }));
        let was_alone = before > 0 && found.causes.is_empty();
        if was_alone && self.moving.is_empty() {
            found.causes.push(Slow::Other);
        }
    }
}
