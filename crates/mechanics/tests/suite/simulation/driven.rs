//! Fixed bodies with a prescribed motion: belts, lifts, turntables.

use lcplab_mechanics::scene::{Scene, Scheme};

use super::simulation;

fn scene(scheme: Scheme, ground: &str, body: &str) -> Scene {
    let text = format!(
        "contact.friction = 0.5\n[[bodies]]\nname = \"floor\"\nfixed = true\n{ground}\n\
         [[bodies]]\nname = \"body\"\nmass = 2\n{body}\n"
    );
    let mut scene = Scene::from_toml("driven.toml", &text).unwrap();
    (scene.step.scheme, scene.step.dt) = (scheme, 0.005);
    scene
}

/// The remaining error of a scheme (m/s, m): springs compress and creep.
fn loose(scheme: Scheme) -> f64 {
    match scheme {
        Scheme::Penalty => 0.05,
        Scheme::Soft | Scheme::Xpbd => 1e-3,
        _ => 1e-8,
    }
}

#[test]
fn a_crate_on_a_belt_is_dragged_until_it_has_the_belts_speed() {
    // μ g = 4.905 m/s²: 1 m/s after 0.204 s, and at 0.1 s 0.4905 m/s.
    let belt = "shape = { plane = [0, 0, 1] }\nvelocity = [1, 0, 0]";
    let body = "shape = { box = [1, 1, 0.4] }\nposition = [0, 0, 0.2]";
    for scheme in Scheme::ALL {
        let mut crate_ = simulation(scene(scheme, belt, body));
        for _ in 0..20 {
            crate_.step().unwrap();
        }
        let dragged = crate_.states()[1].v.x;
        assert!((dragged - 0.4905).abs() < loose(scheme).max(1e-6), "{scheme:?} {dragged}");
        for _ in 0..80 {
            crate_.step().unwrap();
        }
        let [belt, state] = crate_.states() else { unreachable!() };
        assert!((state.v.x - 1.0).abs() < loose(scheme), "{scheme:?} {}", state.v);
        assert!((belt.pose.p.x - 0.5).abs() < 1e-12, "{scheme:?} {}", belt.pose.p);
    }
}

#[test]
fn a_lift_carries_what_stands_on_it() {
    let lift = "shape = { box = [2, 2, 0.2] }\nposition = [0, 0, -0.1]\nvelocity = [0, 0, 0.5]";
    let body = "shape = { box = [1, 1, 0.4] }\nposition = [0, 0, 0.2]\nvelocity = [0, 0, 0.5]";
    for scheme in Scheme::ALL {
        let mut lifted = simulation(scene(scheme, lift, body));
        for _ in 0..200 {
            lifted.step().unwrap();
        }
        let state = lifted.states()[1];
        assert!((state.v.z - 0.5).abs() < loose(scheme), "{scheme:?} {}", state.v);
        assert!((state.pose.p.z - 0.7).abs() < loose(scheme), "{scheme:?} {}", state.pose.p);
    }
}

#[test]
fn a_ball_thrown_on_a_rising_lift_leaves_with_e_of_the_approach() {
    // Relative to the lift it approaches with 3 m/s and separates with 1.5, so with 2.5 in the
    // world.
    let lift = "shape = { box = [2, 2, 0.2] }\nposition = [0, 0, -0.1]\nvelocity = [0, 0, 1]";
    let body = "shape = { sphere = 0.1 }\nposition = [0, 0, 0.101]\nvelocity = [0, 0, -2]";
    let schemes =
        [Scheme::Velocity, Scheme::Acceleration, Scheme::SequentialImpulses, Scheme::SplitImpulse];
    for scheme in schemes {
        let mut scene = scene(scheme, lift, body);
        scene.gravity = nalgebra::Vector3::zeros();
        scene.contact.restitution = 0.5;
        let mut ball = simulation(scene);
        for _ in 0..10 {
            ball.step().unwrap();
        }
        let speed = ball.states()[1].v.z;
        assert!((speed - 2.5).abs() < 1e-9, "{scheme:?} {speed}");
    }
}

#[test]
fn a_turntable_takes_a_crate_round_while_friction_can() {
    // ω² r = 0.32 m/s² is below μ g; after a quarter of a turn it is at a right angle.
    let table =
        "shape = { box = [4, 4, 0.2] }\nposition = [0, 0, -0.1]\nangular_velocity = [0, 0, 0.8]";
    let body = "shape = { box = [0.2, 0.2, 0.1] }\nposition = [0.5, 0, 0.05]\n\
                velocity = [0, 0.4, 0]\nangular_velocity = [0, 0, 0.8]";
    for scheme in [Scheme::Velocity, Scheme::Acceleration, Scheme::Xpbd] {
        let mut table = simulation(scene(scheme, table, body));
        for _ in 0..393 {
            table.step().unwrap(); // 1.965 s of the quarter's 1.9635
        }
        let p = table.states()[1].pose.p;
        assert!((p.y - 0.5).abs() < 0.01 && p.x.abs() < 0.01, "{scheme:?} {p}");
    }
}
