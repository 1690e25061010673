//! Every constraint: exact derivatives, removed degrees of freedom, the supported weight, and the
//! closed form of the remaining motion. Every joint of the registry is in each of the first three;
//! [`joints`] has the table.

mod dual;
mod friction;
mod gear;
mod joints;
mod limit;
mod motor;
mod rank;
mod rope;
mod spring;
mod weight;

use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{Simulation, Step};
use lcplab_solver as solver;
use nalgebra::Vector3;

/// A simulation of the scene in this text at this level, with Dantzig's method.
fn simulation(text: &str, level: Scheme) -> Simulation {
    let mut scene = Scene::from_toml("test.toml", text).unwrap();
    scene.step.scheme = level;
    start(scene)
}

fn start(scene: Scene) -> Simulation {
    Simulation::new(scene, Box::new(solver::Dantzig::default()))
}

/// The forces (N, N m) of a step's rows of the constraint with this index: x at acceleration level,
/// x/dt at velocity level.
fn forces(step: &Step, simulation: &Simulation, constraint: usize) -> Vec<f64> {
    let scene = simulation.scene();
    let unit = match scene.step.scheme {
        Scheme::Acceleration => 1.0,
        _ => scene.step.dt,
    };
    let solve = step.solves.last().unwrap();
    let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
    let source = lcplab_mechanics::assembly::Source::Constraint(constraint);
    rows.filter(|(row, _)| row.id.source == source).map(|(_, x)| x / unit).collect()
}

/// The angle (rad) of a body that has only rotated about this axis, −π to π.
fn angle(state: &State, axis: &Vector3<f64>) -> f64 {
    state.pose.q.scaled_axis().dot(axis)
}

#[track_caller]
fn assert_near(ours: f64, exact: f64, tolerance: f64) {
    assert!((ours - exact).abs() <= tolerance * exact.abs().max(1.0), "{ours}, exactly {exact}");
}
