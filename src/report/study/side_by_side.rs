//! Records one scene by several solvers for the player.

use crate::simulation::Simulation;
use rayon::prelude::*;

use super::comparison::Run;
use crate::animation::{Animation, Recording};
use crate::scene::{Scene, Scheme};
use crate::solver::{Method, Registry, Stop};

/// A solver with its scheme and iteration limit in an animation.
#[derive(Debug, Clone)]
pub struct AnimatedSolver {
    /// The scheme.
    pub scheme: Scheme,
    /// The solver.
    pub method: Method,
    /// The maximum number of sweeps or pivots; by default the scene's own.
    pub max_iterations: Option<usize>,
}

impl AnimatedSolver {
    /// The solver with this name; an iteration limit other than the scene's follows after a colon:
    /// `pgs:5`.
    ///
    /// # Errors
    /// If there is no such solver, or the number is invalid.
    pub(crate) fn named(
        text: &str,
        scene: &Scene,
        solvers: &Registry,
    ) -> crate::error::Result<Self> {
        let (name, most) = text.split_once(':').map_or((text, None), |(n, m)| (n, Some(m)));
        let number = |most: &str| {
            let reason = || format!("{most:?} is not a number of sweeps");
            most.parse().ok().filter(|n| *n > 0).ok_or_else(reason)
        };
        let most = most.map(number).transpose();
        let max_iterations =
            most.map_err(|reason| crate::error::Error::invalid("solver", text, reason))?;
        let method = solvers.method(name, Some(scene.contact.model))?.clone();
        Ok(AnimatedSolver { scheme: scene.step.scheme, method, max_iterations })
    }

    /// The solver, its level and its iteration limit; the part after the comma marks a variant of
    /// the name before it.
    pub(crate) fn name(&self) -> String {
        let sweeps = self.max_iterations.map_or(String::new(), |n| match n {
            1 => ", 1 sweep".into(),
            n => format!(", {n} sweeps"),
        });
        format!("{}, {}{sweeps}", self.method.name(), self.scheme.name())
    }
}

/// Steps a scene with each of these solvers, and keeps as many instants as an animation needs; ends
/// early at a stop.
pub fn animation(
    id: &str,
    scene: &Scene,
    solvers: &[(String, AnimatedSolver)],
    steps: usize,
    stop: &Stop,
) -> Animation {
    let samples = Animation::samples_each(solvers.len());
    let record = |(name, solver): &(String, AnimatedSolver)| {
        let mut own = scene.at_level(solver.scheme);
        own.solver.max_iterations = solver.max_iterations.unwrap_or(own.solver.max_iterations);
        let mut simulation = Simulation::by(&own, &solver.method);
        Recording::until(stop, name, &mut simulation, [steps, samples], |_| ())
    };
    Animation::new(id, scene, solvers.par_iter().map(record).collect())
}

/// The contenders of a comparison that represent a group each, under the group's name.
pub(crate) fn alike(
    contenders: &[(Scheme, Method)],
    groups: &[(String, &Run)],
) -> Vec<(String, AnimatedSolver)> {
    let solver = |(name, run): &(String, &Run)| {
        let is = |(scheme, method): &&(Scheme, Method)| {
            scheme.name() == run.scheme && method.name() == run.solver
        };
        let (scheme, method) = contenders.iter().find(is)?.clone();
        Some((name.clone(), AnimatedSolver { scheme, method, max_iterations: None }))
    };
    groups.iter().filter_map(solver).collect()
}
