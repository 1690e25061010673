//! What a report measures, one study a file: each runs simulations or solvers and returns plain
//! results that can be stored, compared and drawn later without solving anything again.

pub mod attempt;
pub mod comparison;
pub mod convergence;
pub mod cross_check;
pub mod drift;
pub mod families;
pub mod film;
pub mod friction;
pub mod merits;
pub mod plane;
pub mod posed;
pub mod profiles;
pub mod race;
pub mod rates;
pub mod ratio;
pub mod relaxation;
pub mod residual_map;
pub mod scaling;
pub mod slider;
pub mod sliding;
pub mod sparsity;
pub mod storage;
pub mod verification;
pub mod warm_start;
pub mod worst_cases;

use crate::error::Result;
use crate::formulation::{Problem, friction_model};
use crate::report::methods;
use crate::scene::{self, Formulation, Scene};
use crate::simulation::{Simulation, Step};
use crate::solver::{Damping, Dantzig, Method, Options, Order, Settings, Solver, by_name};

/// The solver that studies use where the solver is not what they study.
const STEPPER: &str = "dantzig";

/// The options that a scene states for its solver.
pub fn scene_options(scene: &Scene) -> Options {
    let settings = Settings {
        tolerance: scene.solver.tolerance,
        max_iterations: scene.solver.max_iterations,
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

/// The scene's step of this number, from 1; `None` if the simulation fails before.
fn step_of(scene: &Scene, number: usize) -> Option<Step> {
    let solver = by_name(STEPPER, &scene_options(scene)).ok()?;
    let mut simulation = Simulation::new(scene.clone(), solver);
    (0..number).map(|_| simulation.step()).last()?.ok()
}

/// The last LCP of the scene's step of this number.
fn problem_of(scene: &Scene, number: usize) -> Option<Problem> {
    step_of(scene, number)?.solves.pop().map(|solve| solve.problem)
}
