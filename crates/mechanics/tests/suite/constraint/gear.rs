//! Gears: the ratios of speeds and torques, without slip over many turns.

use lcplab_mechanics::scene::Scheme;

use super::{assert_near, forces, simulation};

/// I of the wheels (kg m²): ⅖ m r² of balls.
const INERTIA: [f64; 2] = [0.2, 0.9];
/// z0/z1.
const RATIO: f64 = 20.0 / 45.0;

/// Two wheels on hinges, the first driven by a torque of 3 N m up to this speed.
fn wheels(baumgarte: f64, speed: f64) -> String {
    let axis = "axis = [0, 0, 1]";
    format!(
        "gravity = [0, 0, 0]\n[step]\ndt = 0.01\nbaumgarte = {baumgarte}\n\
         [[bodies]]\nname = \"small\"\nshape = {{ sphere = 0.5 }}\nmass = 2\n\
         [[bodies]]\nname = \"large\"\nshape = {{ sphere = 0.75 }}\nmass = 4\nposition = [2, 0, 0]\n\
         [[constraints]]\nkind = \"gear\"\nbodies = [\"small\", \"large\"]\naxes = [[0, 0, 1], [0, 0, 1]]\nteeth = [20, 45]\n\
         [[constraints]]\nkind = \"motor_rotation\"\nbodies = [\"small\"]\n{axis}\nspeed = {speed}\neffort = 3\n\
         [[constraints]]\nkind = \"hinge\"\nbodies = [\"small\"]\n{axis}\n\
         [[constraints]]\nkind = \"hinge\"\nbodies = [\"large\"]\n{axis}\n"
    )
}

#[test]
fn wheels_turn_in_the_ratio_of_their_teeth_with_the_inertia_of_both() {
    // The large wheel contributes RATIO² of its inertia.
    let acceleration = 3.0 / (INERTIA[0] + RATIO * RATIO * INERTIA[1]);
    for level in Scheme::LEVELS {
        let mut pair = simulation(&wheels(0.0, 1e3), level);
        for n in 1..=50 {
            let step = pair.step().unwrap();
            let [small, large] = [0, 1].map(|k| pair.states()[k].omega.z);
            assert_near(small, acceleration * 0.01 * f64::from(n), 1e-10);
            assert_near(large, -RATIO * small, 1e-10);
            // x rotates the large wheel, and RATIO · x decelerates the small one.
            let x = forces(&step, &pair, 0)[0];
            assert_near(x, -INERTIA[1] * RATIO * acceleration, 1e-9);
            assert_near(INERTIA[0] * acceleration, 3.0 + RATIO * x, 1e-9);
        }
    }
}

#[test]
fn no_tooth_is_lost_over_many_turns() {
    let mut pair = simulation(&wheels(0.2, 8.0), Scheme::Velocity);
    let mut turned = [0.0; 2];
    for _ in 0..3000 {
        pair.step().unwrap();
        for (turned, state) in turned.iter_mut().zip(pair.states()) {
            *turned += 0.01 * state.omega.z;
        }
    }
    // 30 s at 8 rad/s are 38 turns. A step turns by exactly ω dt, so the wheels keep their ratio.
    assert!(turned[0] > 220.0);
    let parted = turned[1] + RATIO * turned[0];
    assert!(parted.abs() < 1e-9, "{parted}");
    let apart = pair.motion().drift;
    assert!(apart < 1e-9, "{apart}");
}

#[test]
fn a_yo_yo_unrolls_with_the_inertia_of_its_wheel() {
    // The rope is attached to a fixed ceiling: a = g/(1 + I/(m r²)) = g/9.
    let text = "[step]\ndt = 0.01\n\
        [[bodies]]\nname = \"ceiling\"\nfixed = true\nshape = { box = [0.1, 0.1, 0.1] }\nposition = [-0.02, 0, 1]\n\
        [[bodies]]\nname = \"yoyo\"\nshape = { sphere = 0.04 }\nmass = 0.1\ninertia = [8e-5, 8e-5, 8e-5]\n\
        [[constraints]]\nkind = \"rack\"\nbodies = [\"yoyo\", \"ceiling\"]\naxes = [[0, 1, 0], [0, 0, 1]]\n\
        length = 0.01\n";
    for level in Scheme::LEVELS {
        let mut yoyo = simulation(text, level);
        for n in 1..=100 {
            yoyo.step().unwrap();
            let state = yoyo.states()[1];
            assert_near(state.v.z, -9.81 / 9.0 * 0.01 * f64::from(n), 1e-9);
            assert_near(0.01 * state.omega.y, -state.v.z, 1e-9);
        }
    }
}
