//! The integrators of the acceleration level, compared with pendulums in reduced coordinates and
//! free bodies.

use lcplab_mechanics::body::Gyroscopic;
use lcplab_mechanics::scene::catalogue::pendulum::{DoublePendulum, Pendulum, Swing};
use lcplab_mechanics::scene::{Integrator, Scene, Scheme};
use lcplab_mechanics::simulation::{Cause, Simulation};
use nalgebra::Vector3;

use super::{assert_near, scene, simulation};

const G: f64 = 9.81;
const ALL: [Integrator; 4] = [
    Integrator::ExplicitEuler,
    Integrator::SemiImplicitEuler,
    Integrator::Rk4,
    Integrator::ImplicitMidpoint,
];

/// The scene with an integrator, without feedback of errors, after a time.
fn after(name: &str, integrator: Integrator, dt: f64, time: f64) -> Simulation {
    let mut scene = scene(name, Scheme::Acceleration);
    (scene.step.dt, scene.step.alpha, scene.step.integrator) = (dt, 0.0, integrator);
    let mut simulation = simulation(scene);
    for _ in 0..(time / dt).round() as usize {
        simulation.step().unwrap();
    }
    simulation
}

/// The end of a rod of length 1 at this angle from the vertical.
fn end(angle: f64) -> Vector3<f64> {
    Vector3::new(angle.sin(), 0.0, -angle.cos())
}

#[test]
fn the_pendulum_in_angles_has_the_elliptic_period() {
    let pendulum = Pendulum { length: 1.0, gravity: G };
    for amplitude in [0.1, 1.0, 3.0] {
        let start = Swing { angles: [amplitude], rates: [0.0] };
        let half = pendulum.after(0.5 * pendulum.period(amplitude), start);
        assert_near(half.angles[0], -amplitude, 1e-10);
    }
    // IFToMM A01: released horizontally at x = −1 m; its position after 10 s.
    let start = Swing { angles: [-std::f64::consts::FRAC_PI_2], rates: [0.0] };
    let p = end(pendulum.after(10.0, start).angles[0]);
    assert!((p - Vector3::new(-0.2750874626, 0.0, -0.9614192051)).norm() < 1e-7, "{p}");
}

#[test]
fn the_double_pendulum_in_angles_keeps_its_energy() {
    let double = DoublePendulum { masses: [1.0, 2.0], lengths: [1.0, 0.7], gravity: G };
    let start = Swing { angles: [1.5, 2.0], rates: [0.3, -1.0] };
    assert_near(double.energy(&double.after(2.0, start)), double.energy(&start), 1e-10);
    // Small swings of equal masses and rods: the modes √(g/l (2 ∓ √2)) with φ2 = ±√2 φ1.
    let equal = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: G };
    let omega = (G * (2.0 - 2f64.sqrt())).sqrt();
    let start = Swing { angles: [1e-5, 2f64.sqrt() * 1e-5], rates: [0.0; 2] };
    let later = equal.after(0.7, start);
    assert!((later.angles[0] / 1e-5 - (0.7 * omega).cos()).abs() < 1e-8);
}

#[test]
fn each_integrator_has_its_order_on_the_pendulum() {
    let start = Swing { angles: [std::f64::consts::FRAC_PI_2], rates: [0.0] };
    let exact = end(Pendulum { length: 1.0, gravity: G }.after(1.0, start).angles[0]);
    let error =
        |integrator, dt| (after("pendulum", integrator, dt, 1.0).states()[0].pose.p - exact).norm();
    for (integrator, order, dt) in [
        (Integrator::ExplicitEuler, 1.0, 1.0 / 2000.0),
        (Integrator::SemiImplicitEuler, 1.0, 1.0 / 2000.0),
        (Integrator::Rk4, 4.0, 1.0 / 50.0),
        (Integrator::ImplicitMidpoint, 2.0, 1.0 / 50.0),
    ] {
        let (coarse, fine) = (error(integrator, dt), error(integrator, dt / 2.0));
        let observed = (coarse / fine).log2();
        assert!((observed - order).abs() < 0.1, "{integrator:?}: {observed}, {coarse} {fine}");
    }
}

#[test]
fn the_double_pendulum_follows_the_one_in_angles() {
    let double = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: G };
    let level = std::f64::consts::FRAC_PI_2;
    let swing = double.after(0.5, Swing { angles: [level; 2], rates: [0.0; 2] });
    let upper = end(swing.angles[0]);
    let exact = [upper, upper + end(swing.angles[1])];
    let error = |integrator, dt| {
        let moved = after("double_pendulum", integrator, dt, 0.5);
        let apart = moved.states().iter().zip(&exact).map(|(s, p)| (s.pose.p - p).norm());
        apart.fold(0.0, f64::max)
    };
    assert!(error(Integrator::Rk4, 0.005) < 1e-7);
    for (integrator, order) in [(Integrator::Rk4, 4.0), (Integrator::ImplicitMidpoint, 2.0)] {
        let (coarse, fine) = (error(integrator, 0.01), error(integrator, 0.005));
        let observed = (coarse / fine).log2();
        assert!((observed - order).abs() < 0.15, "{integrator:?}: {observed}, {coarse} {fine}");
    }
}

#[test]
fn the_explicit_pendulum_gains_energy_and_the_midpoint_keeps_it() {
    let gained = |integrator| {
        let moved = after("pendulum", integrator, 0.01, 10.0);
        moved.motion().energy() // 0 at the start
    };
    assert!(gained(Integrator::ExplicitEuler) > 1.0);
    assert!(gained(Integrator::ImplicitMidpoint).abs() < 0.01);
    assert!(gained(Integrator::Rk4).abs() < 1e-3);
}

#[test]
fn free_fall_is_exact_for_methods_of_second_order_and_above() {
    let text = "[[bodies]]\nname = \"stone\"\nshape = \"point\"\nmass = 3\nvelocity = [1, 2, 3]\n";
    for integrator in ALL {
        let mut scene = Scene::from_toml("falling.toml", text).unwrap();
        scene.step.scheme = Scheme::Acceleration;
        scene.step.integrator = integrator;
        let mut stone = simulation(scene);
        for _ in 0..100 {
            stone.step().unwrap();
        }
        // Explicit Euler is g t dt/2 above the parabola, semi-implicit Euler as much below.
        let late = match integrator {
            Integrator::ExplicitEuler => 0.5 * G * 0.01,
            Integrator::SemiImplicitEuler => -0.5 * G * 0.01,
            _ => 0.0,
        };
        assert_near(stone.states()[0].v.z, 3.0 - G, 1e-13);
        assert_near(stone.states()[0].pose.p.z, 3.0 - 0.5 * G + late, 1e-12);
    }
}

/// A brick that flips (Dzhanibekov); its largest relative errors of energy and of momentum.
fn brick(integrator: Integrator, dt: f64) -> (f64, f64) {
    let text = "
        gravity = [0, 0, 0]
        [[bodies]]
        name = \"brick\"
        shape = { box = [3, 2, 1] }
        mass = 12
        inertia = [5, 10, 13]
        angular_velocity = [0.01, 3, 0.01]
    ";
    let mut scene = Scene::from_toml("brick.toml", text).unwrap();
    (scene.step.dt, scene.step.integrator) = (dt, integrator);
    scene.step.scheme = Scheme::Acceleration;
    scene.step.gyroscopic = Gyroscopic::Implicit; // at this level always the term in F
    let mut brick = simulation(scene);
    let start = brick.motion();
    let (mut energy, mut momentum, mut least) = (0f64, 0f64, f64::INFINITY);
    for _ in 0..(8.0 / dt) as usize {
        let now = brick.step().unwrap().motion;
        energy = energy.max((now.kinetic / start.kinetic - 1.0).abs());
        let change = (now.angular_momentum - start.angular_momentum).norm();
        momentum = momentum.max(change / start.angular_momentum.norm());
        let state = brick.states()[0];
        least = least.min((state.pose.q.inverse() * state.omega).y);
    }
    assert!(least < -2.9, "{integrator:?}: never turned over, {least}");
    (energy, momentum)
}

#[test]
fn a_brick_that_turns_over_keeps_energy_and_momentum_to_the_order_of_its_integrator() {
    for (integrator, order, bound) in
        [(Integrator::Rk4, 4.0, 1e-6), (Integrator::ImplicitMidpoint, 2.0, 1e-3)]
    {
        let (coarse, fine) = (brick(integrator, 0.02), brick(integrator, 0.01));
        assert!(fine.0 < bound && fine.1 < bound, "{integrator:?}: {fine:?}");
        for (coarse, fine) in [(coarse.0, fine.0), (coarse.1, fine.1)] {
            let observed = (coarse / fine).log2();
            assert!(observed > order - 0.2, "{integrator:?}: {observed}, {coarse} {fine}");
        }
    }
}

#[test]
fn a_box_rests_whatever_the_integrator() {
    for integrator in ALL {
        let mut stack = scene("stack", Scheme::Acceleration);
        stack.step.integrator = integrator;
        let mut stack = simulation(stack);
        for _ in 0..10 {
            stack.step().unwrap();
        }
        assert!(stack.motion().kinetic < 1e-16, "{integrator:?}");
        assert!(stack.motion().penetration < 1e-9, "{integrator:?}");
    }
}

#[test]
fn the_midpoint_converges_where_repetition_alone_does_not() {
    let mut pendulum = scene("pendulum", Scheme::Acceleration);
    pendulum.step.integrator = Integrator::ImplicitMidpoint;
    pendulum.step.alpha = 1000.0; // repetition contracts only below 2/dt = 200/s
    let mut pendulum = simulation(pendulum);
    for _ in 0..10 {
        pendulum.step().unwrap();
    }
    // A straight step of g t dt along the circle of 1 m leaves it by the square of that over 8.
    let sagitta = (9.81 * 0.1 * 0.01_f64).powi(2) / 8.0;
    let drift = pendulum.motion().drift;
    assert!(drift < sagitta, "{drift} {sagitta}");
}

#[test]
fn a_step_too_long_for_the_midpoint_is_an_error_not_an_answer() {
    let mut pendulum = scene("pendulum", Scheme::Acceleration);
    pendulum.step.integrator = Integrator::ImplicitMidpoint;
    pendulum.step.dt = 1.0; // almost half of a period
    let failure = simulation(pendulum).step().unwrap_err();
    assert!(matches!(failure.cause, Cause::Unsettled { .. }), "{failure}");
}

/// A weight of 1 kg on a spring of 50 N/m and 2 N s/m, 0.1 m from its rest position, without
/// gravity.
fn swinging(integrator: Integrator, steps: usize) -> f64 {
    let text = "gravity = [0, 0, 0]\n[[bodies]]\nname = \"weight\"\nshape = \"point\"\nmass = 1\n\
                position = [0, 0, -1.1]\n[[constraints]]\nkind = \"spring\"\nbodies = [\"weight\"]\n\
                points = [[0, 0, 0], [0, 0, -1.1]]\nlength = 1\nstiffness = 50\ndamping = 2\n";
    let mut scene = Scene::from_toml("swinging.toml", text).unwrap();
    (scene.step.scheme, scene.step.integrator) = (Scheme::Acceleration, integrator);
    scene.step.dt = 1.0 / steps as f64;
    let mut simulation = simulation(scene);
    for _ in 0..steps {
        simulation.step().unwrap();
    }
    -1.0 - simulation.states()[0].pose.p.z
}

#[test]
fn a_damped_spring_is_integrated_at_the_order_of_its_integrator() {
    // 0.1 e^(−t) (cos 7 t + sin(7 t)/7): ω² = 50 − 1 for m = 1, d = 2.
    let exact = 0.1 * (-1.0f64).exp() * (7.0f64.cos() + 7.0f64.sin() / 7.0);
    let orders = [
        (Integrator::ExplicitEuler, 1.0),
        (Integrator::SemiImplicitEuler, 1.0),
        (Integrator::ImplicitMidpoint, 2.0),
        (Integrator::Rk4, 4.0),
    ];
    for (integrator, order) in orders {
        let error = |steps: usize| (swinging(integrator, steps) - exact).abs();
        let observed = (error(1600) / error(3200)).log2();
        assert!((observed - order).abs() < 0.1, "{integrator:?} {observed}");
    }
}
