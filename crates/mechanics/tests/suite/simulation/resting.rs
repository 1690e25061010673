//! Resting bodies.

use lcplab_mechanics::constraint::Kind;
use lcplab_mechanics::scene::Scheme;

use lcplab_mechanics::simulation::{Simulation, carried};
use lcplab_solver as solver;
use nalgebra::Vector3;

use super::{assert_near, scene, simulation, x};

#[test]
fn figure_6_stops_within_a_step() {
    // m (v + g dt) = 1 · (1 + 1 · 1) = 2 N s, then the weight, 1 N s a step.
    let mut fig6 = simulation(scene("fig6", Scheme::Velocity));
    assert_eq!(x(&fig6.step().unwrap()), [2.0]);
    assert_eq!(fig6.states()[1].v.z, 0.0);
    assert_eq!(x(&fig6.step().unwrap()), [1.0]);
}

#[test]
fn figure_7_has_the_impulses_of_the_errata() {
    // x = dt g (3, 2, 1) + (1, 1, 0), from the ground up.
    for (g, dt) in [(1.0, 1.0), (10.0, 1.0), (9.81, 1.0 / 60.0)] {
        let mut fig7 = scene("fig7", Scheme::Velocity);
        (fig7.gravity.z, fig7.step.dt) = (-g, dt);
        let mut fig7 = simulation(fig7);
        let exact = [3.0 * g * dt + 1.0, 2.0 * g * dt + 1.0, g * dt];
        for (ours, exact) in x(&fig7.step().unwrap()).iter().zip(exact) {
            assert_near(*ours, exact, 1e-12);
        }
        assert!(fig7.states().iter().all(|state| state.v.norm() < 1e-12));
    }
}

#[test]
fn figure_7_at_acceleration_level_is_an_impact_and_then_forces() {
    // The impact alone gives (1, 1, 0): the middle body stops. Then the weights above: (3, 2, 1) g.
    let mut fig7 = simulation(scene("fig7", Scheme::Acceleration));
    let step = fig7.step().unwrap();
    let [impact, forces] = &step.solves[..] else { panic!("two solves") };
    for (ours, exact) in impact.solution.x.iter().zip([1.0, 1.0, 0.0]) {
        assert_near(*ours, exact, 1e-12);
    }
    for (ours, exact) in forces.solution.x.iter().zip([3.0, 2.0, 1.0]) {
        assert_near(*ours, exact, 1e-12);
    }
}

#[test]
fn each_layer_of_the_stack_carries_the_weight_above() {
    // Impulses at velocity level, forces at acceleration level: 5, 4, 3, 2, 1 times m g (dt).
    for (level, unit) in [(Scheme::Velocity, 9.81 * 0.01), (Scheme::Acceleration, 9.81)] {
        let mut stack = simulation(scene("stack", level));
        // After about fifty steps the corners' positions differ by rounding, so that the last
        // digits decide which contacts are linearly dependent.
        for _ in 0..60 {
            let step = stack.step().unwrap();
            assert_eq!(step.solves.last().unwrap().solver, "dantzig");
            let rows = &step.solves.last().unwrap().problem.assembly.rows;
            let mut carried = [0.0; 5];
            for (row, x) in rows.iter().zip(x(&step)).filter(|(row, _)| row.kind == Kind::Normal) {
                let upper = row.bodies.into_iter().flatten().max().unwrap();
                let bodies: Vec<_> = row.bodies.into_iter().flatten().collect();
                let ground = stack.scene().body("ground").unwrap();
                let layer = if bodies.contains(&ground) {
                    bodies.into_iter().find(|&body| body != ground).unwrap() - 1
                } else {
                    upper - 1
                };
                carried[layer] += x;
            }
            for (layer, carried) in carried.into_iter().enumerate() {
                assert_near(carried, (5 - layer) as f64 * unit, 1e-9);
            }
        }
        assert!(stack.motion().kinetic < 1e-16);
        assert!(stack.motion().penetration < 1e-9);
    }
}

#[test]
fn a_resting_ball_stays_where_it_is_for_ever() {
    for level in Scheme::LEVELS {
        let mut ball = simulation(scene("sphere_plane", level));
        for _ in 0..100 {
            let step = ball.step().unwrap();
            assert_near(x(&step)[0], if level == Scheme::Velocity { 0.0981 } else { 9.81 }, 1e-12);
        }
        assert_near(ball.states()[1].pose.p.z, 0.5, 1e-12);
    }
}

#[test]
fn the_stack_keeps_its_twenty_corners_whatever_the_rounding() {
    // Gauss-Seidel leaves errors of 1e-9 m between flush boxes.
    let pgs = Box::new(solver::Pgs::default());
    let mut stack = Simulation::new(scene("stack", Scheme::Velocity), pgs);
    let first: Vec<_> = stack.step().unwrap().contacts.iter().map(|found| found.id).collect();
    assert_eq!(first.len(), 20);
    for _ in 1..50 {
        let ids: Vec<_> = stack.step().unwrap().contacts.iter().map(|found| found.id).collect();
        assert_eq!(ids, first);
    }
}

#[test]
fn what_rests_is_carried_what_falls_is_not_and_what_stops_was_carried_twice() {
    let part = |name: &str, steps: usize| {
        let scene = scene(name, Scheme::Velocity);
        let mut moving = simulation(scene.clone());
        let start = moving.motion();
        (0..steps).for_each(|_| drop(moving.step().unwrap()));
        carried(&scene, &start, &moving.motion())
    };
    assert_near(part("stack", 20).unwrap(), 1.0, 1e-12);
    assert_near(part("free_fall", 20).unwrap(), 0.0, 1e-12);
    // Figure 6: m g dt = 1 and m v = 1, so that the first step takes 2 N s, each other one 1.
    assert_near(part("fig6", 1).unwrap(), 2.0, 1e-12);
    assert_near(part("fig6", 4).unwrap(), 5.0 / 4.0, 1e-12);
    assert_eq!(part("stack", 0), None); // no time has passed
    assert_eq!(part("dzhanibekov", 5), None); // nothing has a weight
}

#[test]
fn bodies_at_rest_get_their_weights_from_their_neighbours_and_the_ground_gets_all_of_them() {
    const WATCHED: usize = 100;
    for scheme in Scheme::ALL {
        let mut stack = simulation(scene("stack", scheme));
        (0..200).for_each(|_| drop(stack.step().unwrap())); // compliant schemes settle
        let mut mean = [Vector3::zeros(); 6];
        for _ in 0..WATCHED {
            let step = stack.step().unwrap();
            let forces = step.forces(stack.scene()).expect("no integrator with stages");
            mean.iter_mut().zip(forces).for_each(|(sum, force)| *sum += force / WATCHED as f64);
        }
        for (body, force) in mean.iter().enumerate() {
            let expected = if body == 0 { -5.0 * 9.81 } else { 9.81 };
            let off = force - Vector3::new(0.0, 0.0, expected);
            assert!(off.norm() <= 0.02 * 9.81, "{scheme:?}, body {body}: {force}");
        }
    }
}
