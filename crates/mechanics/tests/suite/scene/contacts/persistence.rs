//! The benefit of contact identifiers: solves that start from the last impulses.

use std::collections::BTreeSet;

use lcplab_mechanics::scene::{Persistence, Scene};
use lcplab_mechanics::simulation::Simulation;
use lcplab_solver as solver;
use lcplab_solver::{Options, Settings};

/// The shipped scene with its own solver.
fn simulation(
    persistence: Persistence,
    baumgarte: f64,
    max_iterations: Option<usize>,
) -> Simulation {
    let mut scene = Scene::load("persistence").unwrap();
    scene.step.baumgarte = baumgarte;
    scene.contact.persistence = persistence;
    let settings = Settings::default()
        .with_max_iterations(max_iterations.unwrap_or(scene.solver.max_iterations))
        .with_tolerance(scene.solver.tolerance);
    let options = Options::default().with_settings(settings);
    let solver = solver::Registry::standard().entry(&scene.solver.name).unwrap().build(&options);
    Simulation::new(scene, solver)
}

/// The root mean square speed (m/s) of the moving bodies over the second half of the run.
fn jitter(persistence: Persistence, baumgarte: f64) -> f64 {
    let mut simulation = simulation(persistence, baumgarte, None);
    let count = simulation.scene().step.count;
    let mut squares = Vec::new();
    for k in 0..count {
        let step = simulation.step().unwrap();
        if 2 * k >= count {
            squares.extend(step.states.iter().skip(1).map(|state| state.v.norm_squared()));
        }
    }
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn a_stack_under_few_sweeps_jitters_less_with_persistent_contacts() {
    let both = [Persistence::Features, Persistence::None];
    let [with, without] = both.map(|persistence| jitter(persistence, 0.0));
    assert!(with < 0.01 * without, "{with} m/s with, {without} m/s without");
    // With position errors in the bias the last impulses contain outdated corrections.
    let [with, without] = both.map(|persistence| jitter(persistence, 0.2));
    assert!(with > without, "{with} m/s with, {without} m/s without");
}

#[test]
fn a_solve_from_the_last_impulses_takes_fewer_sweeps() {
    let sweeps = |persistence| {
        let mut simulation = simulation(persistence, 0.0, Some(100_000));
        let step = |_| {
            let step = simulation.step().unwrap();
            step.solves.iter().map(|solve| solve.solution.iterations).sum::<usize>()
        };
        (0..20).map(step).sum::<usize>()
    };
    let [with, without] = [Persistence::Features, Persistence::None].map(sweeps);
    assert!(2 * with < without, "{with} sweeps with, {without} without");
}

#[test]
fn a_resting_stack_has_the_same_contacts_in_every_step() {
    let mut simulation = simulation(Persistence::Features, 0.0, Some(100_000));
    let mut names = || {
        let contacts = simulation.step().unwrap().contacts;
        contacts.iter().map(|found| found.id).collect::<BTreeSet<_>>()
    };
    let first = names();
    assert!((0..50).all(|_| names() == first));
}
