//! Friction and restitution of pairs, and static friction above kinetic friction.

use lcplab_lcp::friction::Model;
use lcplab_mechanics::scene::{Scene, Scheme};

use super::{assert_near, simulation};

/// The schemes that can distinguish sticking from sliding.
const TELLING: [Scheme; 5] = [
    Scheme::Velocity,
    Scheme::Acceleration,
    Scheme::SplitImpulse,
    Scheme::GaussSeidel,
    Scheme::SequentialImpulses,
];

/// A block of 2 kg on the ground, pulled along x, with μ_s = 0.6 and μ = 0.4.
fn pulled(scheme: Scheme, force: f64) -> Scene {
    let text = format!(
        "contact.friction = 0.4\ncontact.static_friction = 0.6\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"block\"\nmass = 2\nshape = {{ box = [0.4, 0.4, 0.2] }}\n\
         position = [0, 0, 0.1]\nforce = [{force}, 0, 0]\nforce_at = [0, 0, -0.1]\n"
    );
    let mut scene = Scene::from_toml("pulled.toml", &text).unwrap();
    (scene.step.scheme, scene.step.dt) = (scheme, 0.005);
    scene
}

/// The speed along x of the last body after `steps` steps.
fn speed(scene: Scene, steps: usize) -> f64 {
    let mut simulation = simulation(scene);
    for _ in 0..steps {
        simulation.step().unwrap();
    }
    simulation.states().last().unwrap().v.x
}

#[test]
fn static_friction_holds_what_kinetic_friction_would_not() {
    // m g = 19.62 N: kinetic friction is exceeded at 7.848 N, static friction at 11.772 N.
    for scheme in TELLING {
        assert!(speed(pulled(scheme, 11.7), 100).abs() < 1e-6, "{scheme:?}");
    }
}

#[test]
fn what_breaks_loose_has_kinetic_friction() {
    // (11.8 − 7.848)/2 = 1.976 m/s² for 0.5 s.
    for scheme in TELLING {
        assert_near(speed(pulled(scheme, 11.8), 100), 0.988, 1e-6);
    }
}

#[test]
fn what_slides_is_held_again_only_when_it_has_stopped() {
    // Pulled with 9 N, between both thresholds: at 1 m/s it accelerates by 0.576 m/s², at rest it
    // stays at rest.
    for scheme in TELLING {
        let mut scene = pulled(scheme, 9.0);
        scene.states[1].v.x = 1.0;
        assert_near(speed(scene, 100), 1.288, 1e-6);
        assert!(speed(pulled(scheme, 9.0), 100).abs() < 1e-6, "{scheme:?}");
    }
}

#[test]
fn polygons_and_the_cone_have_both_coefficients() {
    let models = ["polygon-8", "polygon-16", "coulomb-cone"];
    for model in models.map(|name| name.parse::<Model>().unwrap()) {
        for (force, expected) in [(11.7, 0.0), (11.8, 0.988)] {
            let mut scene = pulled(Scheme::Velocity, force);
            scene.contact.model = model;
            assert_near(speed(scene, 100), expected, 1e-4);
        }
    }
}

#[test]
fn substituted_friction_slides_with_the_kinetic_coefficient() {
    for (force, expected) in [(11.7, 0.0), (11.8, 0.988)] {
        let mut scene = pulled(Scheme::Acceleration, force);
        scene.contact.sliding = lcplab_mechanics::scene::Sliding::Substituted;
        assert_near(speed(scene, 100), expected, 1e-6);
    }
}

#[test]
fn schemes_without_an_answer_refuse_static_friction() {
    for scheme in [Scheme::Xpbd, Scheme::Soft, Scheme::Penalty] {
        let error = pulled(scheme, 1.0).validate().unwrap_err().to_string();
        let name = scheme.name();
        let expected = format!(
            "pulled: contact.static_friction: the scheme {name} cannot decide which contacts \
             stick, so it supports only one coefficient of friction"
        );
        assert_eq!(error, expected);
    }
}

#[test]
fn a_frozen_box_refuses_static_friction() {
    let mut scene = pulled(Scheme::Velocity, 1.0);
    scene.contact.model = Model::FrozenBox;
    let error = scene.validate().unwrap_err().to_string();
    assert!(error.starts_with("pulled: contact.model: a frozen box is empty"), "{error}");
}

/// Two blocks side by side on a slope of 20°; the pair of one of them with the slope has its own
/// friction.
fn two_on_a_slope(scheme: Scheme) -> Scene {
    let text = "tilt = { y = 20 }\ncontact.friction = 0.5\n\
        [[bodies]]\nname = \"slope\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n\
        [[bodies]]\nname = \"rough\"\nmass = 1\nshape = { box = [0.4, 0.4, 0.1] }\n\
        position = [0, 0, 0.05]\n\
        [[bodies]]\nname = \"smooth\"\nmass = 1\nshape = { box = [0.4, 0.4, 0.1] }\n\
        position = [0, 2, 0.05]\n\
        [[pairs]]\nbodies = [\"smooth\", \"slope\"]\nfriction = 0.1\n";
    let mut scene = Scene::from_toml("slope.toml", text).unwrap();
    (scene.step.scheme, scene.step.dt) = (scheme, 0.005);
    scene
}

#[test]
fn a_pair_has_its_own_friction_on_a_slope_that_holds_others() {
    // g (sin 20° − 0.1 cos 20°) = 2.433 m/s²; tan 20° = 0.364 is below 0.5.
    let down = 9.81 * (20f64.to_radians().sin() - 0.1 * 20f64.to_radians().cos());
    for scheme in Scheme::ALL {
        let mut simulation = simulation(two_on_a_slope(scheme));
        for _ in 0..100 {
            simulation.step().unwrap();
        }
        // Penalties creep with the load over four points' damping: 3.355 N / (4 · 10 N s/m).
        let loose = if scheme == Scheme::Penalty { 0.085 } else { 1e-3 };
        let [_, rough, smooth] = simulation.states() else { unreachable!() };
        assert!(rough.v.norm() < loose, "{scheme:?} {}", rough.v);
        assert!((smooth.v.x - 0.5 * down).abs() < loose, "{scheme:?} {} {down}", smooth.v);
    }
}

#[test]
fn two_balls_bounce_on_one_floor_each_with_its_pairs_restitution() {
    let text = "gravity = [0, 0, 0]\ncontact.restitution = 0.2\n\
        [[bodies]]\nname = \"floor\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n\
        [[bodies]]\nname = \"first\"\nmass = 1\nshape = { sphere = 0.1 }\nposition = [0, 0, 0.1]\n\
        velocity = [0, 0, -2]\n\
        [[bodies]]\nname = \"second\"\nmass = 1\nshape = { sphere = 0.1 }\nposition = [1, 0, 0.1]\n\
        velocity = [0, 0, -2]\n\
        [[pairs]]\nbodies = [\"floor\", \"first\"]\nrestitution = 0.9\n";
    for scheme in [Scheme::Velocity, Scheme::Acceleration, Scheme::SequentialImpulses, Scheme::Soft]
    {
        let mut scene = Scene::from_toml("bounces.toml", text).unwrap();
        scene.step.scheme = scheme;
        let mut simulation = simulation(scene);
        simulation.step().unwrap();
        let [_, first, second] = simulation.states() else { unreachable!() };
        assert_near(first.v.z, 1.8, 1e-9);
        assert_near(second.v.z, 0.4, 1e-9);
    }
}
