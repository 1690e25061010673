//! Cylinders, disks and wheels that roll, lie and stand.

use lcplab_mechanics::scene::{Integrator, Scene, Scheme};
use nalgebra::{UnitQuaternion, Vector3};

use super::{assert_near, simulation};

const PLANE: &str = "shape = { plane = [0, 0, 1] }";
const BOX: &str = "shape = { box = [9, 9, 1] }\nposition = [0, 0, -0.5]";

/// A cylinder of 0.2 m radius on its side, on a ground inclined by this angle (degrees).
fn rolling(scheme: Scheme, ground: &str, tilt: f64, length: f64) -> Scene {
    let text = format!(
        "tilt = {{ y = {tilt} }}\ncontact.friction = 0.5\n[[bodies]]\nname = \"ground\"\nfixed = true\n\
         {ground}\n[[bodies]]\nname = \"round\"\nmass = 1\n\
         shape = {{ cylinder = {{ length = {length}, radius = 0.2 }} }}\nposition = [0, 0, 0.2]\n\
         rotation = {{ x = 90 }}\n"
    );
    let mut scene = Scene::from_toml("rolling.toml", &text).unwrap();
    scene.step.scheme = scheme;
    scene
}

#[test]
fn a_cylinder_rolls_down_with_two_thirds_of_g_sin_under_every_scheme() {
    let expected = 2.0 / 3.0 * 9.81 * 10f64.to_radians().sin(); // after 1 s
    for scheme in Scheme::ALL {
        for ground in [PLANE, BOX] {
            for length in [0.4, 0.01] {
                let mut simulation = simulation(rolling(scheme, ground, 10.0, length));
                for _ in 0..100 {
                    simulation.step().unwrap();
                }
                let speed = simulation.states()[1].v.x;
                let loose = match scheme {
                    Scheme::Penalty => 0.05, // friction creeps
                    Scheme::Soft | Scheme::Xpbd => 1e-2,
                    _ => 1e-6,
                };
                assert!(
                    (speed / expected - 1.0).abs() < loose,
                    "{scheme:?} {ground} {speed} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_cylinder_lies_still_and_stands_still() {
    for ground in [PLANE, BOX] {
        for standing in [false, true] {
            let mut scene = rolling(Scheme::Velocity, ground, 0.0, 0.4);
            if standing {
                scene.states[1].pose.q = UnitQuaternion::identity();
            }
            let mut simulation = simulation(scene);
            for _ in 0..100 {
                simulation.step().unwrap();
            }
            let state = simulation.states()[1];
            assert!(state.v.norm() + state.omega.norm() < 1e-8, "{ground} {standing}");
            assert_near(state.pose.p.z, 0.2, 1e-9);
        }
    }
}

#[test]
fn a_line_of_touch_ends_where_its_face_ends() {
    // A cylinder of 0.4 m across a beam of 0.2 m: each end of the line supports half of the weight.
    let beam = "shape = { box = [9, 0.2, 1] }\nposition = [0, 0, -0.5]";
    let scene = rolling(Scheme::Velocity, beam, 0.0, 0.4);
    let found = lcplab_mechanics::scene::contacts(&scene, &scene.states, 0.01);
    let mut ends: Vec<f64> = found.iter().map(|found| found.point.y).collect();
    ends.sort_by(f64::total_cmp);
    assert_eq!(ends.len(), 2);
    assert_near(ends[0], -0.1, 1e-12);
    assert_near(ends[1], 0.1, 1e-12);
    let weight = 9.81 * scene.step.dt;
    let step = simulation(scene).step().unwrap();
    for x in super::x(&step).iter().step_by(3) {
        assert_near(*x, 0.5 * weight, 1e-9);
    }
}

#[test]
fn a_coin_settles_as_eulers_disc_with_its_centre_at_rest() {
    // A thin disk inclined by θ rotates about the vertical with Ω, its center at rest, and rolls
    // without slip: it rotates about the line t to the contact point with −Ω sin θ, and m r²/4 Ω²
    // sin θ cos θ = m g r cos θ.
    let (radius, lean, half) = (0.2, 0.6_f64, 5e-5);
    let turn = (4.0 * 9.81 / (radius * lean.sin())).sqrt();
    let height = radius * lean.sin() + half * lean.cos();
    let text = format!(
        "contact.friction = 2\n[[bodies]]\nname = \"ground\"\nfixed = true\n{PLANE}\n[[bodies]]\n\
         name = \"coin\"\nmass = 1\nshape = {{ cylinder = {{ length = {}, radius = {radius} }} }}\n\
         position = [0, 0, {height}]\nrotation = {{ y = {} }}\n",
        2.0 * half,
        lean.to_degrees()
    );
    let mut scene = Scene::from_toml("coin.toml", &text).unwrap();
    scene.step.dt = 5e-5;
    (scene.step.scheme, scene.step.integrator) = (Scheme::Acceleration, Integrator::Rk4);
    let t = Vector3::new(lean.cos(), 0.0, -lean.sin());
    scene.states[1].omega = t * (-turn * lean.sin());
    let mut simulation = simulation(scene);
    let quarter = 0.25 * std::f64::consts::TAU / turn;
    for _ in 0..(quarter / 5e-5).round() as usize {
        simulation.step().unwrap();
    }
    let state = simulation.states()[1];
    assert!(state.pose.p.xy().norm() < 2e-3, "{}", state.pose.p);
    assert!((state.pose.p.z - height).abs() < 1e-3, "{}", state.pose.p);
    // Its axis was inclined along x, and now along y.
    let axis = state.pose.direction(&Vector3::z());
    assert!((axis - Vector3::new(0.0, lean.sin(), lean.cos())).norm() < 2e-2, "{axis}");
}
