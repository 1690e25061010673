//! Four of many points support the same load as all.

use std::f64::consts::PI;

use lcplab_mechanics::body::State;
use lcplab_mechanics::constraint::Kind;
use lcplab_mechanics::scene::{Manifold, Scene, contacts};
use lcplab_mechanics::simulation::Simulation;
use lcplab_solver as solver;
use lcplab_solver::Options;
use nalgebra::Vector3;

/// A prism of 16 sides and height 1 about the z axis, its center ½ above z = 0.
fn prism() -> String {
    let around = (0..16).map(|k| f64::from(k) * PI / 8.0);
    let corner = |angle: f64, z: f64| format!("[{}, {}, {z}]", angle.cos(), angle.sin());
    let corners: Vec<String> =
        around.flat_map(|angle| [corner(angle, -0.5), corner(angle, 0.5)]).collect();
    format!(
        "[[bodies]]\nname = \"prism\"\nmass = 2\nposition = [0, 0, 0.5]\nshape = {{ hull = [{}] }}\n",
        corners.join(", ")
    )
}

fn resting(ground: &str, manifold: Manifold) -> Scene {
    let text = format!(
        "[contact]\nfriction = 0.5\n{}[[bodies]]\nname = \"ground\"\nfixed = true\n{ground}\n",
        prism()
    );
    let mut scene = Scene::from_toml("prism.toml", &text).unwrap();
    scene.contact.manifold = manifold;
    scene
}

const GROUNDS: [&str; 2] =
    ["shape = { plane = [0, 0, 1] }", "shape = { box = [4, 4, 1] }\nposition = [0, 0, -0.5]"];

#[test]
fn four_points_carry_the_weight_that_sixteen_carry() {
    for ground in GROUNDS {
        for (manifold, points) in [(Manifold::Full, 16), (Manifold::Four, 4)] {
            let scene = resting(ground, manifold);
            let dt = scene.step.dt;
            let solver =
                solver::Registry::standard().entry("dantzig").unwrap().build(&Options::default());
            let mut simulation = Simulation::new(scene, solver);
            for _ in 0..5 {
                let step = simulation.step().unwrap();
                assert_eq!(step.contacts.len(), points, "{ground}");
                let solve = step.solves.last().unwrap();
                let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
                let normal: Vec<f64> =
                    rows.filter(|(row, _)| row.kind == Kind::Normal).map(|(_, x)| *x).collect();
                // The resultant: the weight, and no torque about the center.
                assert!((normal.iter().sum::<f64>() - 2.0 * 9.81 * dt).abs() < 1e-12);
                let arms = step.contacts.iter().map(|found| found.point);
                let torque: Vector3<f64> =
                    arms.zip(&normal).map(|(arm, x)| arm.cross(&(Vector3::z() * *x))).sum();
                assert!(torque.norm() < 1e-12, "{torque}");
                assert!(simulation.states()[0].velocity().norm() < 1e-12);
            }
        }
    }
}

#[test]
fn the_four_points_span_most_of_the_area_and_are_the_same_in_every_step() {
    // The largest quadrilateral in a regular 16-gon of radius 1 is a square of area 2; the polygon
    // has 8 sin 22.5° = 3.06.
    let scene = resting(GROUNDS[0], Manifold::Four);
    let found = contacts(&scene, &scene.states, 0.01);
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| found[k].point);
    // Whatever the order of four points on a circle, the largest of the three products is the
    // square.
    let area = |p: Vector3<f64>, q: Vector3<f64>| 0.5 * p.cross(&q).norm();
    let areas = [area(c - a, d - b), area(b - a, d - c), area(b - a, c - d), area(d - a, c - b)];
    assert!((areas.into_iter().fold(0.0, f64::max) - 2.0).abs() < 1e-9, "{areas:?}");
    let ids =
        |states: &[State]| contacts(&scene, states, 0.01).iter().map(|f| f.id).collect::<Vec<_>>();
    let mut states = scene.states.clone();
    for k in 0..50 {
        states[0].pose.p.z = 0.5 + 1e-9 * f64::from(k % 7);
        assert_eq!(ids(&states), ids(&scene.states));
    }
}

#[test]
fn the_deepest_point_is_kept() {
    let scene = resting(GROUNDS[0], Manifold::Four);
    for k in 0..16 {
        let angle = f64::from(k) * 0.4 + 0.1;
        let axis = Vector3::new(-angle.sin(), angle.cos(), 0.0); // leans over towards the angle
        let mut states = scene.states.clone();
        states[0].pose.q = nalgebra::UnitQuaternion::from_scaled_axis(axis * 0.01);
        let mut all = scene.clone();
        all.contact.manifold = Manifold::Full;
        let deepest = |scene: &Scene| {
            contacts(scene, &states, 0.1).iter().map(|found| found.gap).fold(0.0, f64::min)
        };
        assert_eq!(deepest(&scene), deepest(&all));
    }
}
