//! Free bodies.

use lcplab_mechanics::body::{Gyroscopic, Mass, Pose, State};
use lcplab_mechanics::scene::{Scene, Scheme};

use lcplab_mechanics::scene::catalogue::spin::SteadyTop;
use nalgebra::{UnitQuaternion, Vector3};

use super::{assert_near, simulation};

const FALLING: &str = "
    [[bodies]]
    name = \"stone\"
    shape = \"point\"
    mass = 3
    velocity = [1, 2, 3]
";

/// A brick that rotates about its middle axis, slightly disturbed.
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
    for level in Scheme::LEVELS {
        let mut scene = Scene::from_toml("falling.toml", FALLING).unwrap();
        scene.step.scheme = level;
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

/// The schemes whose steps consist of impulses and motion.
fn impulsive() -> impl Iterator<Item = Scheme> {
    Scheme::ALL.into_iter().filter(|&scheme| scheme != Scheme::Acceleration)
}

#[test]
fn a_turning_brick_keeps_its_angular_momentum_and_its_energy_under_every_impulsive_scheme() {
    for scheme in impulsive() {
        let mut scene = Scene::from_toml("brick.toml", BRICK).unwrap();
        (scene.step.scheme, scene.step.dt) = (scheme, 0.01);
        let mut brick = simulation(scene);
        let start = brick.motion();
        // XPBD divides differences of positions by a substep of 1.25 ms.
        let rounding = if scheme == Scheme::Xpbd { 1e-11 } else { 1e-12 };
        let size = rounding * start.angular_momentum.norm();
        for _ in 0..1000 {
            let before = brick.motion();
            brick.step().unwrap();
            let now = brick.motion();
            let change = (now.angular_momentum - before.angular_momentum).norm();
            assert!(change < size, "{scheme:?} {change:e}");
            let energy = (now.kinetic - start.kinetic) / start.kinetic;
            assert!(energy.abs() < 1e-9, "{scheme:?} {energy:e}");
        }
    }
}

#[test]
fn a_free_body_keeps_momentum_and_energy_however_fast_it_turns_and_thin_it_is() {
    // About all three axes at once, by 0.1, 2 and 20 radians a step of 1 s.
    for moments in [[5.0, 10.0, 13.0], [1e-9, 1.0, 1.0], [1.0, 1.0, 2.0], [1e-3, 1.0, 1.0]] {
        let moments = Vector3::from(moments);
        let mass = Mass::Rigid { mass: 1.0, moments };
        for speed in [0.1, 2.0, 20.0] {
            let q = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.7, 1.1));
            let omega = q * Vector3::new(1.0, 0.5, -0.25) * speed;
            let mut state = State { pose: Pose { q, ..State::WORLD.pose }, omega, ..State::WORLD };
            let kept = |state: &State| {
                let own = state.pose.q.inverse() * state.omega;
                let momentum = state.pose.q * moments.component_mul(&own);
                (momentum, own.component_mul(&own).dot(&moments))
            };
            let (momentum, energy) = kept(&state);
            for _ in 0..100 {
                state = Gyroscopic::Conserving.advanced(&mass, &state, 1.0);
            }
            let (momentum_now, energy_now) = kept(&state);
            let change = (momentum_now - momentum).norm() / momentum.norm();
            assert!(change < 1e-12, "{moments:?} {speed}: {change:e}");
            let change = (energy_now - energy).abs() / energy;
            assert!(change < 1e-9, "{moments:?} {speed}: {change:e}");
        }
    }
}

#[test]
fn a_body_that_turns_at_a_constant_rate_turns_by_the_exact_angle_under_every_scheme() {
    // A coin and a brick about a principal axis, free and on a hinge, by 0.01 to 60 radians a step,
    // under XPBD up to 7.5 in each of eight substeps: after t, q = exp(ω t) q₀. At acceleration
    // level the gyroscopic torque is part of F, and beyond a radian a step an explicit one
    // multiplies the rounding of ω.
    for scheme in Scheme::ALL {
        for (moments, hinged) in
            [([1.0, 1.0, 1.9], false), ([2.0, 3.0, 4.5], false), ([2.0, 3.0, 4.5], true)]
        {
            let fast: &[f64] = if scheme == Scheme::Xpbd { &[30.0, 60.0] } else { &[] };
            for &angle in [0.01, 0.7, 3.0, 50.0].iter().chain(fast) {
                if scheme == Scheme::Acceleration && angle > 1.0 {
                    continue;
                }
                let dt = 0.01;
                let q = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -1.3, 0.6));
                let axis = q * Vector3::z();
                let [x, y, z] = [axis.x, axis.y, axis.z];
                let hinge = match hinged {
                    true => format!(
                        "[[constraints]]\nkind = \"hinge\"\nbodies = [\"wheel\"]\n\
                         point = [0, 0, 0]\naxis = [{x}, {y}, {z}]\n"
                    ),
                    false => String::new(),
                };
                let text = format!(
                    "gravity = [0, 0, 0]\nstep.dt = {dt}\n[[bodies]]\nname = \"wheel\"\n\
                     shape = {{ sphere = 0.1 }}\nmass = 2\ninertia = {moments:?}\n\
                     rotation = {{ quaternion = [{}, {}, {}, {}] }}\n\
                     without_contact = true\n{hinge}",
                    q.w, q.i, q.j, q.k
                );
                let mut scene = Scene::from_toml("wheel.toml", &text).unwrap();
                scene.step.scheme = scheme;
                scene.states[0].omega = axis * (angle / dt);
                let mut wheel = simulation(scene);
                let steps = 20;
                for _ in 0..steps {
                    let step = wheel.step();
                    assert!(step.is_ok(), "{scheme:?}, {moments:?}, {hinged}, {angle}: {step:?}");
                }
                let state = wheel.states()[0];
                let turn = UnitQuaternion::from_scaled_axis(axis * (angle * f64::from(steps)));
                let error = state.pose.q.angle_to(&(turn * q));
                let what = format!("{scheme:?}, {moments:?}, {hinged}, {angle}");
                assert!(error < 1e-9 * angle.max(1.0), "{what}: {error:e} rad");
                let change = (state.omega - axis * (angle / dt)).norm() * dt / angle;
                // The springs of the penalty scheme hold the axis to 1e-9 only.
                let allowed = if scheme == Scheme::Penalty { 1e-8 } else { 1e-9 };
                assert!(change < allowed, "{what}: {change:e}");
            }
        }
    }
}

#[test]
fn the_midpoint_turn_of_a_free_body_is_of_second_order() {
    // The rates after T of Euler's equations by Runge-Kutta with a step of 1e-4.
    let (moments, time) = ([5.0, 10.0, 13.0], 2.0);
    let rate = |w: [f64; 3]| {
        let [a, b, c] = moments;
        [(b - c) / a * w[1] * w[2], (c - a) / b * w[2] * w[0], (a - b) / c * w[0] * w[1]]
    };
    let plus = |w: [f64; 3], h: f64, k: [f64; 3]| std::array::from_fn(|i| w[i] + h * k[i]);
    let (mut exact, h) = ([0.01, 3.0, 0.01], 1e-4);
    for _ in 0..(time / h) as usize {
        let k1 = rate(exact);
        let k2 = rate(plus(exact, h / 2.0, k1));
        let k3 = rate(plus(exact, h / 2.0, k2));
        let k4 = rate(plus(exact, h, k3));
        exact = std::array::from_fn(|i| {
            exact[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i])
        });
    }
    let error = |dt: f64| {
        let mut scene = Scene::from_toml("brick.toml", BRICK).unwrap();
        scene.step.dt = dt;
        let mut brick = simulation(scene);
        for _ in 0..(time / dt).round() as usize {
            brick.step().unwrap();
        }
        let state = brick.states()[0];
        (state.pose.q.inverse() * state.omega - nalgebra::Vector3::from(exact)).norm()
    };
    let (coarse, fine) = (error(0.02), error(0.01));
    assert!(((coarse / fine).log2() - 2.0).abs() < 0.1, "{coarse:e} {fine:e}");
}

#[test]
fn bodies_that_collide_in_space_keep_their_angular_momentum() {
    let text = "
        gravity = [0, 0, 0]
        contact = { friction = 0.3, restitution = 0.5 }
        [step]
        dt = 0.005
        [[bodies]]
        name = \"a\"
        shape = { box = [1, 0.4, 0.2] }
        mass = 1
        velocity = [2, 0.1, 0]
        angular_velocity = [1, 2, 3]
        [[bodies]]
        name = \"b\"
        shape = { box = [0.3, 1, 0.5] }
        mass = 3
        position = [1.5, 0.3, 0.1]
        angular_velocity = [-3, 0.5, 1]
    ";
    for scheme in [Scheme::Velocity, Scheme::SequentialImpulses] {
        let mut scene = Scene::from_toml("space.toml", text).unwrap();
        scene.step.scheme = scheme;
        let mut boxes = simulation(scene);
        let before = boxes.motion();
        let mut touched = 0;
        for _ in 0..200 {
            let step = boxes.step().unwrap();
            touched += step.solves.iter().flat_map(|s| &s.solution.x).filter(|x| **x > 0.0).count();
        }
        let change = (boxes.motion().angular_momentum - before.angular_momentum).norm();
        assert!(touched > 0 && change < 1e-12 * before.angular_momentum.norm(), "{change:e}");
    }
}

/// The largest deviation (degrees) of the shipped top's inclination from 30.
fn lean(scheme: Scheme, spin: f64, seconds: f64) -> f64 {
    let top = SteadyTop {
        mass: 1.0,
        length: 0.3,
        moments: [0.06 + 0.09, 0.1],
        angle: 30f64.to_radians(),
        gravity: 9.81,
    };
    // Ω from ω3 = (m g l/Ω + I1 Ω cos θ)/I3, the slow one.
    let [i1, i3] = top.moments;
    let cos = top.angle.cos();
    let root = ((i3 * spin).powi(2) - 4.0 * i1 * cos * 9.81 * 0.3).sqrt();
    let precession = 2.0 * 9.81 * 0.3 / (i3 * spin + root);
    assert_near(top.spin(precession), spin, 1e-9 * spin);
    let mut scene = Scene::load("top").unwrap();
    (scene.step.scheme, scene.step.dt) = (scheme, 0.001);
    let axis = Vector3::new(top.angle.sin(), 0.0, cos);
    // ω = Ω z + (ω3 − Ω cos θ) axis.
    scene.states[0].omega = Vector3::z() * precession + axis * (spin - precession * cos);
    scene.states[0].v = scene.states[0].omega.cross(&(0.3 * axis));
    let mut top = simulation(scene);
    let mut worst: f64 = 0.0;
    for _ in 0..(seconds / 0.001) as usize {
        top.step().unwrap();
        let axis = top.states()[0].pose.q * Vector3::z();
        worst = worst.max((axis.z.acos().to_degrees() - 30.0).abs());
    }
    worst
}

#[test]
fn a_top_keeps_its_lean_for_five_seconds() {
    for scheme in [Scheme::Velocity, Scheme::SequentialImpulses] {
        for spin in [14.0, 140.0] {
            let lean = lean(scheme, spin, 5.0);
            assert!(lean < 0.5, "{scheme:?} at {spin} rad/s: {lean}°");
        }
    }
}

#[test]
fn the_middle_axis_is_unstable() {
    // Dzhanibekov: rotation about the axis of the middle moment is unstable. The disturbance grows
    // like exp(ω t √((I2 − I1)(I3 − I2)/(I1 I3))) = exp(3 t √(15/65)), a factor e² in 1.4 s.
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
    // If omitted, ω is constant, so the energy of a body that flips is not.
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
    for level in Scheme::LEVELS {
        let mut scene = Scene::from_toml("pair.toml", text).unwrap();
        scene.step.scheme = level;
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
