//! Piles held only by contacts and friction: Solver2D's scenes, and the chapter's tower.

use lcplab_mechanics::constraint::Kind;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation;
use lcplab_mechanics::simulation::{Simulation, Step};
use nalgebra::Vector3;
use rayon::prelude::*;

use super::{assert_near, changed, scene, simulation, x};

const G: f64 = 9.81;

/// The sums of the normal impulses (or forces) of each layer of boxes 1 m high, from the ground up.
fn layers(step: &Step, count: usize) -> Vec<f64> {
    let mut carried = vec![0.0; count];
    let rows = &step.solves.last().unwrap().problem.assembly.rows;
    for (row, x) in rows.iter().zip(x(step)).filter(|(row, _)| row.kind == Kind::Normal) {
        let [a, b] = row.bodies.map(|body| step.states[body.unwrap()].pose.p.z);
        if (a - b).abs() > 0.4 {
            carried[(a.min(b) + 0.75) as usize] += x; // the ground is at 0, the first box at 0.5
        }
    }
    carried
}

/// Steps it, and asserts that nothing moves and that the layers support these weights (kg).
fn assert_rests(scene: Scene, steps: usize, weights: &[f64]) {
    let name = scene.name.clone();
    let unit = match scene.step.scheme {
        Scheme::Acceleration => G,
        _ => G * scene.step.dt,
    };
    let mut resting = simulation(scene);
    let before = resting.states().to_vec();
    for _ in 0..steps {
        let step = resting.step().unwrap();
        for (carried, weight) in layers(&step, weights.len()).into_iter().zip(weights) {
            assert_near(carried, weight * unit, 1e-6);
        }
    }
    for (was, is) in before.iter().zip(resting.states()) {
        assert!((was.pose.p - is.pose.p).norm() < 1e-6, "{name}");
    }
    assert!(resting.motion().penetration < 1e-6, "{name}");
}

#[test]
fn boxes_on_a_ramp_stick_and_slide_as_coulomb_says() {
    // μ is the geometric mean of the box's and the ramp's 0.2; tan 0.25 = 0.2553.
    let (sin, cos) = 0.25f64.sin_cos();
    let downhill = Vector3::new(cos, 0.0, -sin);
    for level in Scheme::LEVELS {
        let mut ramp = simulation(scene("friction_ramp", level));
        for _ in 0..100 {
            ramp.step().unwrap();
        }
        let exact = [0.0, 0.0, 0.0, 1.1038, 2.4740]; // m/s after a second
        for (state, exact) in ramp.states()[1..].iter().zip(exact) {
            assert!((state.v.dot(&downhill) - exact).abs() < 1e-4, "{level:?} {}", state.v);
        }
    }
}

#[test]
fn tall_stacks_stay_up() {
    let weights = |count: usize| -> Vec<f64> { (1..=count).rev().map(|k| k as f64).collect() };
    for level in Scheme::LEVELS {
        assert_rests(scene("stack15", level), 5, &weights(15));
    }
    assert_rests(scene("stack50", Scheme::Velocity), 3, &weights(50));
}

#[test]
fn a_pyramid_carries_its_weight() {
    assert_rests(changed("pyramid", &[("base = 8", "base = 5")]), 10, &[15.0, 10.0, 6.0, 3.0, 1.0]);
}

#[test]
fn light_boxes_carry_heavy_ones() {
    for level in Scheme::LEVELS {
        let one = [310.0, 306.0, 303.0, 301.0, 300.0];
        assert_rests(scene("mass_ratio1", level), 5, &one);
        assert_rests(scene("mass_ratio2", level), 20, &[402.0, 400.0]);
        assert_rests(scene("mass_ratio3", level), 20, &[1111.0, 1110.0, 1100.0, 1000.0]);
    }
}

#[test]
fn a_stack_far_from_the_origin_stands_like_one_at_it() {
    assert_rests(scene("far", Scheme::Velocity), 100, &[5.0, 4.0, 3.0, 2.0, 1.0]);
}

#[test]
fn a_house_of_cards_stands_if_they_are_rough() {
    let mut house = simulation(scene("card_house", Scheme::Velocity));
    let before = house.states().to_vec();
    for _ in 0..100 {
        house.step().unwrap();
    }
    for (was, is) in before.iter().zip(house.states()) {
        assert!((was.pose.p - is.pose.p).norm() < 1e-3);
    }
    let mut smooth = simulation(changed("card_house", &[("friction = 0.8", "friction = 0.1")]));
    let top = smooth.scene().body("left 2 0").unwrap();
    let before = smooth.states()[top].pose.p.z;
    for _ in 0..30 {
        smooth.step().unwrap();
    }
    assert!(smooth.states()[top].pose.p.z < before - 0.1);
}

#[test]
fn an_arch_stands_if_it_is_thick_enough() {
    // Milankovitch: 0.1075 of the middle radius, here 2 m.
    let crown = |thickness: &str| {
        let mut arch = simulation(changed("arch", &[("thickness = 0.4", thickness)]));
        let stone = arch.scene().body("stone8").unwrap();
        let before = arch.states()[stone].pose.p.z;
        for _ in 0..50 {
            arch.step().unwrap();
        }
        before - arch.states()[stone].pose.p.z
    };
    // 0.2, 0.13 and 0.08
    let thicknesses = ["thickness = 0.4", "thickness = 0.26", "thickness = 0.16"];
    let falls: Vec<f64> = thicknesses.par_iter().map(|thickness| crown(thickness)).collect();
    assert!(falls[0].abs() < 1e-6 && falls[1].abs() < 1e-6 && falls[2] > 0.01, "{falls:?}");
}

#[test]
fn all_dominoes_fall() {
    let mut row = simulation(changed("dominoes", &[("count = 8", "count = 4")]));
    for _ in 0..400 {
        row.step().unwrap();
    }
    for state in &row.states()[1..] {
        let up = state.pose.q * Vector3::z();
        assert!(up.z < 0.5, "{up}"); // at least 60 degrees from upright
    }
}

#[test]
fn boxes_that_overlap_part_without_speed() {
    let mut boxes = simulation(scene("overlap_recovery", Scheme::SplitImpulse));
    assert_near(boxes.motion().penetration, 0.1, 1e-9);
    for _ in 0..20 {
        boxes.step().unwrap();
    }
    assert!(boxes.motion().penetration < 1.1e-5);
    assert!(boxes.motion().kinetic < 1e-9);
    // Feedback into the velocities throws them apart.
    let mut thrown = simulation(scene("overlap_recovery", Scheme::Velocity));
    for _ in 0..10 {
        thrown.step().unwrap();
    }
    assert!(thrown.motion().kinetic > 1.0);
}

#[test]
fn a_tower_stands_on_few_sweeps() {
    let (count, ring) = (60, 20);
    let small = changed(
        "tower",
        &[("count = 700", "count = 60"), ("ring = 35", &format!("ring = {ring}"))],
    );
    let dt = small.step.dt;
    let solver = simulation::solver(&small).unwrap();
    let mut tower = Simulation::new(small, solver);
    let mut carried = Vec::new();
    for _ in 0..60 {
        carried = layers(&tower.step().unwrap(), 3);
    }
    for (layer, carried) in carried.into_iter().enumerate() {
        assert_near(carried, (count - layer * ring) as f64 * G * dt, 0.01);
    }
    assert!(tower.motion().penetration < 0.01);
    assert!(tower.motion().kinetic < 1e-3);
}
