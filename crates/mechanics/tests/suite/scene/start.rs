//! The start of a scene: speeds on joints, and saved states.

use lcplab_mechanics::scene::catalogue::SHIPPED;
use lcplab_mechanics::scene::{Scene, saved};
use lcplab_mechanics::simulation::Simulation;
use lcplab_solver::Dantzig;
use nalgebra::Vector3;

fn after(scene: Scene, steps: usize) -> Simulation {
    let mut simulation = Simulation::new(scene, Box::new(Dantzig::default()));
    (0..steps).for_each(|_| {
        simulation.step().unwrap();
    });
    simulation
}

#[test]
fn a_start_speed_is_that_of_the_hinge_on_whatever_it_hangs() {
    // An arm of 1 m rotates with 2 rad/s, the next one with 3 rad/s relative to it.
    let text = "
        [[bodies]]
        name = 'upper'
        shape = { box = [1, 0.1, 0.1] }
        mass = 1
        position = [0.5, 0, 0]
        [[bodies]]
        name = 'lower'
        shape = { box = [1, 0.1, 0.1] }
        mass = 1
        position = [1.5, 0, 0]
        [[constraints]]
        kind = 'hinge'
        bodies = ['upper']
        point = [0, 0, 0]
        axis = [0, 0, 2]
        start_speed = 2
        [[constraints]]
        kind = 'hinge'
        bodies = ['upper', 'lower']
        point = [1, 0, 0]
        axis = [0, 0, 1]
        start_speed = 3
    ";
    let scene = Scene::from_toml("arms.toml", text).unwrap();
    let [upper, lower] = scene.states[..] else { unreachable!() };
    assert_eq!((upper.omega, upper.v), (Vector3::new(0.0, 0.0, 2.0), Vector3::new(0.0, 1.0, 0.0)));
    assert_eq!((lower.omega, lower.v), (Vector3::new(0.0, 0.0, 5.0), Vector3::new(0.0, 4.5, 0.0)));
    for constraint in &scene.constraints {
        let states = constraint
            .bodies()
            .map(|body| body.map_or(&lcplab_mechanics::body::State::WORLD, |k| &scene.states[k]));
        for row in constraint.rows(states).unwrap() {
            let rate = row.jacobian[0].dot(&states[0].velocity())
                + row.jacobian[1].dot(&states[1].velocity());
            assert!(rate.abs() < 1e-15, "{rate}");
        }
    }
    let refused =
        text.replace("position = [1.5, 0, 0]", "position = [1.5, 0, 0]\nvelocity = [1, 0, 0]");
    let error = Scene::from_toml("arms.toml", &refused).unwrap_err().to_string();
    assert!(
        error.contains("constraints[1].start_speed: \"lower\" has velocities of its own"),
        "{error}"
    );
    let refused = text.replace("name = 'lower'", "name = 'lower'\nfixed = true");
    let error = Scene::from_toml("arms.toml", &refused).unwrap_err().to_string();
    assert!(error.contains("constraints[1].start_speed: \"lower\" is fixed"), "{error}");
}

#[test]
fn a_saved_scene_begins_with_every_bit_of_the_states() {
    for shipped in SHIPPED {
        let scene = shipped.scene().unwrap();
        let few = if scene.bodies.len() > 40 { 0 } else { 3 };
        let states = after(scene.clone(), few).states().to_vec();
        let text = saved(shipped.name, &[], &scene, &states, 0.03).unwrap();
        let later = Scene::from_toml("later.toml", &text).unwrap();
        for ((a, b), body) in later.states.iter().zip(&states).zip(&scene.bodies) {
            assert_eq!(
                (a.pose.p, a.v, a.omega),
                (b.pose.p, b.v, b.omega),
                "{} {}",
                shipped.name,
                body.name
            );
            let turned = (a.pose.q.coords - b.pose.q.coords).norm();
            // Normalizing again rounds.
            assert!(turned < 4e-16, "{} {} {turned:e}", shipped.name, body.name);
        }
    }
}

#[test]
fn a_motion_goes_on_from_where_it_was_saved() {
    for name in ["double_pendulum", "bricard", "atwood", "stack"] {
        let scene = Scene::load(name).unwrap();
        let whole = after(scene.clone(), 100);
        let half = after(scene.clone(), 50);
        let text = saved(name, &[], &scene, half.states(), half.time()).unwrap();
        let later = after(Scene::from_toml("later.toml", &text).unwrap(), 50);
        for (a, b) in later.states().iter().zip(whole.states()) {
            assert!((a.pose.p - b.pose.p).norm() < 1e-9, "{name}: {} {}", a.pose.p, b.pose.p);
        }
    }
}

#[test]
fn a_start_of_an_unknown_body_is_refused() {
    let text = "[[start]]\nbody = 'nobody'\nposition = [0, 0, 0]\n";
    let error = Scene::from_toml("a.toml", text).unwrap_err().to_string();
    assert_eq!(error, "a.toml: line 2: start[0].body: there is no body named \"nobody\"");
}
