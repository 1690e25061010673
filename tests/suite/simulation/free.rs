//! Bodies that nothing touches.

use lcplab::body::Gyroscopic;
use lcplab::scene::{Formulation, Scene};

use super::{assert_near, simulation};

const FALLING: &str = "
    [[bodies]]
    name = \"stone\"
    shape = \"point\"
    mass = 3
    velocity = [1, 2, 3]
";

/// A brick that turns about its middle axis, slightly disturbed.
const BRICK: &str = "
    gravity = [0, 0, 0]
    step.dt = 0.001
    [[bodies]]
    name = \"brick\"
    shape = { box = [3, 2, 1] }
    mass = 12
    inertia = [5, 10, 13]
    angular_velocity = [0.01, 3, 0.01]
";

#[test]
fn the_velocity_of_free_fall_is_exact() {
    for level in Formulation::LEVELS {
        let mut scene = Scene::from_toml("falling.toml", FALLING).unwrap();
        scene.step.formulation = level;
        let mut stone = simulation(scene);
        for _ in 0..100 {
            stone.step().unwrap();
        }
        // v = v0 − g t exactly; semi-implicit Euler's position is −g t dt/2 below the parabola.
        let (state, t, dt) = (stone.states()[0], 1.0, 0.01);
        assert_near(state.v.z, 3.0 - 9.81 * t, 1e-13);
        assert_near(state.pose.p.z, 3.0 * t - 0.5 * 9.81 * t * (t + dt), 1e-12);
        assert_near(state.pose.p.x, t, 1e-13);
    }
}

#[test]
fn a_turning_brick_keeps_its_angular_momentum_to_first_order_in_dt() {
    let error = |dt: f64| {
        let mut scene = Scene::from_toml("brick.toml", BRICK).unwrap();
        scene.step.dt = dt;
        let mut brick = simulation(scene);
        let before = brick.motion().angular_momentum;
        for _ in 0..(2.0 / dt) as usize {
            brick.step().unwrap();
        }
        (brick.motion().angular_momentum - before).norm() / before.norm()
    };
    let (coarse, fine) = (error(2e-3), error(1e-3));
    assert!(fine < 0.01, "{fine}");
    assert!((coarse / fine).log2() > 0.9, "{coarse} {fine}");
}

#[test]
fn the_middle_axis_is_unstable() {
    // Dzhanibekov: a turn about the axis of the middle moment tips over. The disturbance grows like
    // exp(ω t √((I2 − I1)(I3 − I2)/(I1 I3))) = exp(3 t √(15/65)), a factor e² in 1.4 s.
    let mut brick = simulation(Scene::from_toml("brick.toml", BRICK).unwrap());
    let mut least = f64::INFINITY;
    for _ in 0..8000 {
        brick.step().unwrap();
        let state = brick.states()[0];
        least = least.min((state.pose.q.inverse() * state.omega).y);
    }
    assert!(least < -2.5, "the brick never turned over: {least}");
}

#[test]
fn the_implicit_gyroscopic_torque_never_raises_the_energy_and_the_explicit_one_does() {
    let energy = |gyroscopic| {
        let text = BRICK.replace("step.dt = 0.001", "step.dt = 0.02");
        let mut scene = Scene::from_toml("brick.toml", &text).unwrap();
        scene.step.gyroscopic = gyroscopic;
        let mut brick = simulation(scene);
        let mut energies = vec![brick.motion().kinetic];
        for _ in 0..200 {
            brick.step().unwrap();
            energies.push(brick.motion().kinetic);
        }
        energies
    };
    let implicit = energy(Gyroscopic::Implicit);
    assert!(implicit.last().unwrap() <= &implicit[0]);
    let explicit = energy(Gyroscopic::Explicit);
    assert!(explicit.last().unwrap() > &explicit[0]);
    // Left out, ω stays, so the energy of a body that turns over does not.
    let omitted = energy(Gyroscopic::Omitted);
    assert!(omitted.iter().all(|e| e.is_finite()));
}

#[test]
fn a_free_pair_on_a_rod_keeps_its_momentum() {
    let text = "
        gravity = [0, 0, 0]
        step = { baumgarte = 0.2, alpha = 20 }
        bodies = [
            { name = \"a\", shape = \"point\", mass = 1, velocity = [0, 2, 0] },
            { name = \"b\", shape = \"point\", mass = 3, position = [1, 0, 0], velocity = [0, 0, 1] },
        ]
        [[constraints]]
        kind = \"distance\"
        bodies = [\"a\", \"b\"]
    ";
    for level in Formulation::LEVELS {
        let mut scene = Scene::from_toml("pair.toml", text).unwrap();
        scene.step.formulation = level;
        let mut pair = simulation(scene);
        let before = pair.motion();
        for _ in 0..200 {
            pair.step().unwrap();
        }
        let after = pair.motion();
        assert!((after.linear_momentum - before.linear_momentum).norm() < 1e-12);
        assert!((after.angular_momentum - before.angular_momentum).norm() < 1e-12);
        assert!(after.drift < 0.01, "{}", after.drift);
    }
}
