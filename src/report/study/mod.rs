//! What a report measures, one study a file: each runs simulations or solvers and returns plain
//! results that can be stored, compared and drawn later without solving anything again.
//!
//! A [`Study`] is a list of tasks that do not depend on each other.

pub mod attempt;
pub mod comparison;
pub mod contest;
pub mod convergence;
pub mod creep;
pub mod cross_check;
pub mod direct_speed;
pub mod drift;
pub mod families;
pub mod film;
pub mod footage;
pub mod force_path;
pub mod formulations;
pub mod friction;
pub mod friction_solvers;
pub mod history;
pub mod ledger;
pub mod merits;
pub mod order;
pub mod painleve;
pub mod peers;
pub mod plane;
pub mod posed;
pub mod profiles;
pub mod published;
pub mod race;
pub mod ramp;
pub mod rates;
pub mod ratio;
pub mod relaxation;
pub mod residual_map;
pub mod scaling;
pub mod settings;
pub mod singular;
pub mod sinking;
pub mod slider;
pub mod sliding;
pub mod sparse_speed;
pub mod sparsity;
pub mod step_speed;
pub mod storage;
pub mod sweep_speed;
pub mod timing;
pub mod variation;
pub mod verification;
pub mod warm_factor;
pub mod warm_start;
pub mod worst_cases;
pub mod yardstick;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::{Error, Result};
use crate::formulation::{Problem, friction_model};
use crate::report::methods;
use crate::scene::{self, Formulation, Scene};
use crate::simulation::{Simulation, Step};
use crate::solver::{Damping, Dantzig, Method, Options, Order, Settings, Solver, by_name};

/// A kind of study; a value holds the settings that one section of a report file states.
pub trait Study: Serialize + DeserializeOwned + Send + Sync {
    /// The kind's name in report files.
    const NAME: &'static str;
    /// Whether its tasks run one after the other and beside nothing else, because they are timed.
    const ALONE: bool = false;
    /// What a task finds out: the same in every run on the same kind of processor.
    type Finding: Serialize + DeserializeOwned + Send;
    /// What differs from machine to machine; `()` where nothing is timed.
    type Times: Serialize + DeserializeOwned + Send;

    /// What tells the tasks apart: a scene's name, a size.
    fn tasks(&self) -> Vec<String>;

    /// Carries out the task of this place in [`Study::tasks`].
    ///
    /// # Errors
    /// What it cannot do, with the reason: a row of the report. Other tasks go on.
    fn run(&self, task: usize) -> Result<(Self::Finding, Self::Times)>;
}

/// The solver that studies use where the solver is not what they study.
const STEPPER: &str = "dantzig";

/// The options that a scene states for its solver.
pub fn scene_options(scene: &Scene) -> Options {
    let settings = Settings {
        tolerance: scene.solver.tolerance,
        max_iterations: scene.solver.max_iterations,
        memory: scene.memory,
        ..Settings::default()
    };
    let order = match scene.solver.order {
        scene::Order::Natural => Order::Natural,
        scene::Order::Reverse => Order::Reverse,
        scene::Order::Shuffled => Order::Shuffled { seed: scene.solver.seed },
    };
    let damping = scene.solver.damping.map_or(Damping::Safe, Damping::Factor);
    Options { settings, omega: scene.solver.omega, order, damping }
}

/// The solver that a scene states.
///
/// # Errors
/// If there is none of that name.
pub fn scene_solver(scene: &Scene) -> Result<Box<dyn Solver>> {
    by_name(&scene.solver.name, &scene_options(scene)).map_err(|error| error.within(&scene.name))
}

/// The scene at its start, to be stepped by the solver that it states: one for LCPs, or, if its
/// friction is in cones, one for cones.
///
/// # Errors
/// If there is none of that name.
pub fn scene_simulation(scene: &Scene) -> Result<Simulation> {
    let model = friction_model(&scene.contact);
    match methods::by_name(&scene.solver.name, model) {
        Ok(method @ Method::Cone(_)) => Ok(simulation_by(scene, &method)),
        _ => Ok(Simulation::new(scene.clone(), scene_solver(scene)?)),
    }
}

/// The scene at its start, to be stepped by a method; what a cone solver is not made for, problems
/// without friction, are left to another one.
fn simulation_by(scene: &Scene, method: &Method) -> Simulation {
    let options = scene_options(scene);
    match method {
        Method::Boxed(entry) => Simulation::new(scene.clone(), (entry.build)(&options)),
        Method::Cone(entry) => {
            let boxed = Box::new(Dantzig { settings: options.settings.clone() });
            let cone_solver = (entry.build)(&options.settings);
            Simulation::new(scene.clone(), boxed).with_cone_solver(cone_solver)
        }
    }
}

/// The scene stepped at another level.
fn at_level(scene: &Scene, formulation: Formulation) -> Scene {
    let mut scene = scene.clone();
    scene.step.formulation = formulation;
    scene
}

/// The scene's step of this number, from 1.
///
/// # Errors
/// If the simulation fails before.
fn step_of(scene: &Scene, number: usize) -> Result<Step> {
    let mut simulation = Simulation::new(scene.clone(), by_name(STEPPER, &scene_options(scene))?);
    let refused = |reason: String| Error::invalid(&*scene.name, format!("step {number}"), reason);
    let mut last = None;
    for _ in 0..number {
        last = Some(simulation.step().map_err(|failure| refused(failure.to_string()))?);
    }
    last.ok_or_else(|| refused("steps are counted from 1".into()))
}

/// The last LCP of the scene's step of this number.
///
/// # Errors
/// If the simulation fails before, or the step solves none.
fn problem_of(scene: &Scene, number: usize) -> Result<Problem> {
    let solve = step_of(scene, number)?.solves.pop().ok_or_else(|| {
        Error::invalid(&*scene.name, format!("step {number}"), "it solves no problem")
    })?;
    Ok(solve.problem)
}
