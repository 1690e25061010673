//! Motors: full effort until the speed is reached, then the effort that keeps it.

use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::Simulation;

use super::{assert_near, forces, start};

/// A ball of 2 kg with I = 0.2 kg m² on a guide, driven at speed 3 with this effort.
fn driven(guide: &str, motor: &str, velocity: &str, level: Scheme, effort: f64) -> Scene {
    let text = format!(
        "gravity = [0, 0, 0]\n[step]\ndt = 0.01\n\
         [[bodies]]\nname = \"body\"\nshape = {{ sphere = 0.5 }}\nmass = 2\n{velocity}\n\
         [[constraints]]\nkind = \"{motor}\"\nbodies = [\"body\"]\naxis = [0, 0, 1]\nspeed = 3\neffort = {effort}\n\
         [[constraints]]\nkind = \"{guide}\"\nbodies = [\"body\"]\naxis = [0, 0, 1]\n"
    );
    let mut scene = Scene::from_toml("motor.toml", &text).unwrap();
    scene.step.scheme = level;
    scene
}

/// From this speed on, the speed follows constant effort until 3, and the reported effort is 4, 0
/// or in between.
fn follows(
    scene: Scene,
    inertia: f64,
    from: f64,
    speed: impl Fn(&lcplab_mechanics::body::State) -> f64,
) {
    let mut motor = start(scene);
    let (mut before, full) = (from, 4.0 / inertia * 0.01);
    for _ in 0..400 {
        let step = motor.step().unwrap();
        let exact = before + (3.0 - before).clamp(-full, full);
        assert_near(speed(&motor.states()[0]), exact, 1e-12);
        assert_near(forces(&step, &motor, 0)[0], inertia * (exact - before) / 0.01, 1e-9);
        before = exact;
    }
    assert_eq!(before, 3.0);
}

#[test]
fn a_motor_speeds_up_with_its_effort_and_then_keeps_its_speed() {
    for level in Scheme::LEVELS {
        follows(driven("hinge", "motor_rotation", "", level, 4.0), 0.2, 0.0, |s| s.omega.z);
        follows(driven("slider", "motor_translation", "", level, 4.0), 2.0, 0.0, |s| s.v.z);
    }
}

#[test]
fn a_motor_brakes_what_is_too_fast() {
    for level in Scheme::LEVELS {
        let fast = "angular_velocity = [0, 0, 20]";
        follows(driven("hinge", "motor_rotation", fast, level, 4.0), 0.2, 20.0, |s| s.omega.z);
        let back = "velocity = [0, 0, -1]";
        follows(driven("slider", "motor_translation", back, level, 4.0), 2.0, -1.0, |s| s.v.z);
    }
}

/// Without a limit the speed is there after one step, with the effort I v / dt = 0.2 · 3 / 0.01;
/// after that the effort that keeps it is 0.
#[test]
fn a_motor_without_a_limit_keeps_its_speed_from_the_first_step_on() {
    for level in Scheme::LEVELS {
        let mut motor = start(driven("hinge", "motor_rotation", "", level, f64::INFINITY));
        for effort in [60.0, 0.0] {
            let step = motor.step().unwrap();
            assert_near(motor.states()[0].omega.z, 3.0, 1e-12);
            assert_near(forces(&step, &motor, 0)[0], effort, 1e-9);
        }
    }
}

#[test]
fn a_motor_of_the_penalty_method_keeps_its_speed_against_a_weight() {
    // The joint's springs carry the lever, and the motor turns it against its weight.
    let text = "
        step = { scheme = \"penalty\", count = 20 }
        [[bodies]]
        name = \"lever\"
        shape = { box = [1.2, 0.1, 0.1] }
        mass = 6
        position = [0.6, 0, 0]
        [[constraints]]
        kind = \"hinge\"
        bodies = [\"lever\"]
        axis = [0, 1, 0]
        point = [0, 0, 0]
        [[constraints]]
        kind = \"motor_rotation\"
        bodies = [\"lever\"]
        axis = [0, 1, 0]
        speed = -1
        effort = 500
    ";
    let scene = Scene::from_toml("lever.toml", text).unwrap();
    let mut simulation = Simulation::of(&scene).unwrap();
    for _ in 0..60 {
        simulation.step().unwrap();
    }
    let speed = simulation.states()[0].omega.y;
    assert!((speed + 1.0).abs() < 1e-3, "{speed}");
}
