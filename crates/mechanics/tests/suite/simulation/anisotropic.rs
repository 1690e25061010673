//! Friction that is different along and across a direction of a surface.
//!
//! The law: x_t lies in the ellipse (x1/μ1)² + (x2/μ2)² ≤ x_n² and dissipates as much as it allows,
//! so that a contact that slips with s has x_t = −x_n (μ1² s1, μ2² s2)/√(μ1² s1² + μ2² s2²).

use lcplab_lcp::friction::Model;
use lcplab_mechanics::scene::{Scene, Scheme, Sliding};
use nalgebra::{Rotation2, Vector2};
use proptest::prelude::*;

use super::{assert_near, simulation};

const MU: [f64; 2] = [0.6, 0.2];
const MASS: f64 = 2.0;
const WEIGHT: f64 = MASS * 9.81;
/// The angle (degrees) from the world's x axis to the direction on the ground.
const TURN: f64 = 30.0;

/// A flat block on a ground with μ = 0.6 along a direction and 0.2 across it, pushed at its bottom.
fn block(force: Vector2<f64>) -> Scene {
    let text = format!(
        "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         rotation = {{ z = {TURN} }}\n\
         [[bodies]]\nname = \"block\"\nmass = {MASS}\nshape = {{ box = [0.4, 0.4, 0.02] }}\n\
         position = [0, 0, 0.01]\nforce = [{}, {}, 0]\nforce_at = [0, 0, -0.01]\n\
         [[pairs]]\nbodies = [\"ground\", \"block\"]\nfriction = {}\n\
         friction_direction = [1, 0, 0]\nfriction_across = {}\n",
        force.x, force.y, MU[0], MU[1]
    );
    let mut scene = Scene::from_toml("runner.toml", &text).unwrap();
    scene.step.dt = 0.005;
    scene.contact.model = Model::CoulombCone;
    scene
}

/// A vector along and across the direction on the ground, in world axes.
fn on_ground(vector: Vector2<f64>) -> Vector2<f64> {
    Rotation2::new(TURN.to_radians()) * vector
}

/// The velocity of the block after these steps, along and across the direction.
fn velocity(scene: Scene, steps: usize) -> Vector2<f64> {
    let mut simulation = simulation(scene);
    for _ in 0..steps {
        simulation.step().unwrap();
    }
    on_ground_inverse(simulation.states()[1].v.xy())
}

fn on_ground_inverse(world: Vector2<f64>) -> Vector2<f64> {
    Rotation2::new(-TURN.to_radians()) * world
}

/// The friction impulse divided by x_n of a contact that slips with s, along and across.
fn strongest(s: Vector2<f64>) -> Vector2<f64> {
    let m = Vector2::from(MU);
    -m.component_mul(&m).component_mul(&s) / m.component_mul(&s).norm()
}

/// The polygon with the name `polygon-16`.
fn polygon() -> Model {
    "polygon-16".parse().unwrap()
}

#[test]
fn a_push_along_either_axis_is_held_up_to_its_own_coefficient() {
    for model in [Model::CoupledBox, Model::CoulombCone, polygon()] {
        for (k, mu) in MU.into_iter().enumerate() {
            for (part, speed) in [(0.99, 0.0), (1.01, 0.01 * mu * 9.81 * 0.1)] {
                let mut push = Vector2::zeros();
                push[k] = part * mu * WEIGHT;
                let mut scene = block(on_ground(push));
                scene.contact.model = model;
                assert_near(velocity(scene, 20)[k], speed, 1e-5);
            }
        }
    }
}

#[test]
fn every_scheme_has_both_coefficients() {
    // 1 m/s is lost at μ g: after 0.1 s, 0.4114 m/s along and 0.8038 m/s across the direction.
    let schemes = [
        Scheme::Velocity,
        Scheme::Acceleration,
        Scheme::SplitImpulse,
        Scheme::GaussSeidel,
        Scheme::Xpbd,
        Scheme::Soft,
        Scheme::Penalty,
        Scheme::SequentialImpulses,
    ];
    for scheme in schemes {
        for (k, mu) in MU.into_iter().enumerate() {
            let mut start = Vector2::zeros();
            start[k] = 1.0;
            let mut scene = block(Vector2::zeros());
            (scene.step.scheme, scene.contact.model) = (scheme, Model::CoupledBox);
            // Its friction is a damper below the limit.
            scene.step.penalty.damping = 500.0;
            let world = on_ground(start);
            (scene.states[1].v.x, scene.states[1].v.y) = (world.x, world.y);
            let expected = 1.0 - mu * 9.81 * 0.1;
            let accuracy = match scheme {
                // A soft contact carries less until it has settled, a spring more.
                Scheme::Penalty | Scheme::Soft | Scheme::Xpbd => 0.02,
                _ => 1e-6,
            };
            assert_near(velocity(scene, 20)[k], expected, accuracy);
        }
    }
}

#[test]
fn substituted_friction_slides_within_the_ellipse() {
    let s = Vector2::new(1.0, -2.0);
    let mut scene = block(Vector2::zeros());
    (scene.step.scheme, scene.contact.sliding) = (Scheme::Acceleration, Sliding::Substituted);
    scene.contact.model = Model::CoupledBox;
    let world = on_ground(s);
    (scene.states[1].v.x, scene.states[1].v.y) = (world.x, world.y);
    let change = (velocity(scene, 1) - s) / (9.81 * 0.005);
    assert_near((change - strongest(s)).norm(), 0.0, 1e-6);
}

#[test]
fn a_block_that_is_pushed_on_sticks_within_the_ellipse_and_slides_outside() {
    for k in 0..12 {
        let (sin, cos) = (f64::from(k) * 0.5).sin_cos();
        let edge = Vector2::new(MU[0] * cos, MU[1] * sin) * WEIGHT;
        assert!(velocity(block(on_ground(0.99 * edge)), 20).norm() < 1e-6);
        assert!(velocity(block(on_ground(1.01 * edge)), 20).norm() > 1e-3);
    }
}

#[test]
fn the_direction_on_a_moving_body_turns_with_it() {
    // The direction belongs to the block, which is turned by 30° itself: along it, 0.6.
    let text = format!(
        "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\nfriction = 1\n\
         [[bodies]]\nname = \"block\"\nmass = 1\nshape = {{ box = [0.4, 0.4, 0.02] }}\n\
         position = [0, 0, 0.01]\nrotation = {{ z = {TURN} }}\nfriction = 0.36\n\
         friction_direction = [2, 0, 0]\nfriction_across = 0.04\n"
    );
    for (k, mu) in MU.into_iter().enumerate() {
        let mut start = Vector2::zeros();
        start[k] = 1.0;
        let mut scene = Scene::from_toml("skate.toml", &text).unwrap();
        scene.step.dt = 0.005;
        let world = on_ground(start);
        (scene.states[1].v.x, scene.states[1].v.y) = (world.x, world.y);
        assert_near(velocity(scene, 20)[k], 1.0 - mu * 9.81 * 0.1, 1e-6);
    }
}

#[test]
fn a_contact_that_keeps_the_law_of_the_ellipse_is_no_deviation() {
    let mut scene = block(Vector2::zeros());
    (scene.states[1].v.x, scene.states[1].v.y) = (1.0, 1.0);
    let mut simulation = simulation(scene);
    for _ in 0..10 {
        let step = simulation.step().unwrap();
        let [slip] = step.slips[..] else { panic!("one pair rubs") };
        assert!(slip.angle.unwrap() < 1e-4 && slip.excess < 1e-5, "{slip:?}");
        assert!(slip.error.norm() < 1e-6, "{slip:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn friction_of_a_sliding_block_is_the_strongest_of_the_ellipse(x in -2.0..2.0, y in -2.0..2.0) {
        prop_assume!(f64::hypot(x, y) > 0.2);
        let mut scene = block(Vector2::zeros());
        let world = on_ground(Vector2::new(x, y));
        (scene.states[1].v.x, scene.states[1].v.y) = (world.x, world.y);
        let after = velocity(scene, 1);
        let change = (after - Vector2::new(x, y)) / (9.81 * 0.005);
        assert_near((change - strongest(after)).norm(), 0.0, 1e-5);
    }
}
