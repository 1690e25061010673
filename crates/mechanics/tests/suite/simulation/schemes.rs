//! Differences between the schemes, and requirements on all of them.

use std::ops::ControlFlow;

use lcplab_mechanics::scene::{Feedback, Scene, Scheme, catalogue};
use lcplab_mechanics::simulation::Simulation;
use lcplab_solver as solver;
use lcplab_solver::{Options, Settings};
use nalgebra::{DMatrix, Vector3};
use rayon::prelude::*;

use super::{assert_near, scene, simulation};
use lcplab_testing::Iterates;

/// A ball that is 0.1 m deep in the ground, at rest without gravity.
fn sunk(scheme: Scheme) -> Scene {
    let text = "
        gravity = [0, 0, 0]
        step.baumgarte = 0.2
        [[bodies]]
        name = \"ground\"
        fixed = true
        shape = { plane = [0, 0, 1] }
        [[bodies]]
        name = \"ball\"
        shape = { sphere = 0.5 }
        mass = 2
        position = [0, 0, 0.4]
    ";
    let mut scene = Scene::from_toml("sunk.toml", text).unwrap();
    scene.step.scheme = scheme;
    scene
}

/// A bob at rest on a rod that is 0.1 m too long, without gravity.
fn stretched(scheme: Scheme) -> Scene {
    let mut scene = scene("pendulum", scheme);
    scene.gravity = Vector3::zeros();
    scene.states[0].pose.p.x = 1.1;
    scene.step.baumgarte = 0.2;
    scene
}

#[test]
fn position_corrections_add_no_kinetic_energy_and_baumgarte_does() {
    use Scheme::{GaussSeidel, SplitImpulse, Velocity, Xpbd};
    for scheme in [SplitImpulse, GaussSeidel, Xpbd] {
        let mut ball = simulation(sunk(scheme));
        let motion = ball.step().unwrap().motion;
        assert!(motion.penetration < 1e-12, "{scheme:?}: {}", motion.penetration);
        assert!(motion.kinetic < 1e-20, "{scheme:?}: {}", motion.kinetic);
    }
    for scheme in [SplitImpulse, GaussSeidel] {
        let mut bob = simulation(stretched(scheme));
        let motion = bob.step().unwrap().motion;
        assert!(motion.drift < 1e-12 && motion.kinetic == 0.0, "{scheme:?}: {motion:?}");
    }
    // Baumgarte: v = β c/dt = 0.2 · 0.1/0.01 = 2 m/s, and the ball continues to fly.
    let mut ball = simulation(sunk(Velocity));
    assert_near(ball.step().unwrap().motion.kinetic, 0.5 * 2.0 * 4.0, 1e-12);
    for _ in 0..20 {
        ball.step().unwrap();
    }
    assert!(ball.states()[1].pose.p.z > 0.7);
}

#[test]
fn xpbd_turns_the_error_of_a_joint_into_speed() {
    let mut scene = stretched(Scheme::Xpbd);
    scene.step.substeps = 1;
    let mut bob = simulation(scene);
    let motion = bob.step().unwrap().motion;
    assert!(motion.drift < 1e-12);
    assert_near(bob.states()[0].v.x, -0.1 / 0.01, 1e-10); // −c/h
}

#[test]
fn a_stack_of_ten_under_xpbd_gains_no_energy_from_its_own_corrections() {
    let text = "
        contact.friction = 0.5
        step.scheme = 'xpbd'
        [generate]
        kind = 'stack'
        count = 10
        size = 1
        mass = 1
        [[bodies]]
        name = 'ground'
        fixed = true
        shape = { plane = [0, 0, 1] }
    ";
    let mut stack = simulation(Scene::from_toml("stack_of_ten.toml", text).unwrap());
    let start = stack.motion().energy();
    let end = (0..60).map(|_| stack.step().unwrap().motion.energy()).last().unwrap();
    // One ten-thousandth. Contacts whose x starts every substep at 0 gain 0.13 J of 490 in this
    // second, and more in each following one.
    assert!(end - start < 1e-4 * start, "{} J of {start}", end - start);
}

#[test]
fn the_feedback_of_the_chapter_grows_the_error_and_the_corrected_one_shrinks_it() {
    let (beta, dt) = (0.2f64, 1.0 / 60.0);
    for (feedback, factor) in [
        (Feedback::Corrected, 1.0 - beta),
        (Feedback::Unscaled, 1.0 - beta * dt), // E34
        (Feedback::Printed, 1.0 + beta * dt),  // E35: 1.00333 a step
    ] {
        let mut scene = stretched(Scheme::Velocity);
        (scene.step.dt, scene.step.feedback) = (dt, feedback);
        let mut bob = simulation(scene);
        for k in 1..=60 {
            let drift = bob.step().unwrap().motion.drift;
            assert!((drift - 0.1 * factor.powi(k)).abs() < 1e-12, "{feedback:?} {k}: {drift}");
        }
    }
}

#[test]
fn the_sweeps_of_sequential_impulses_are_those_of_pgs() {
    for name in ["fig7", "stack", "incline", "ball_chain", "net", "sphere_plane"] {
        let sweeps = 30;
        let mut scene = scene(name, Scheme::Velocity);
        scene.step.sweeps = sweeps;
        let settings =
            Settings::default().with_max_iterations(sweeps).with_tolerance(0.0).with_check_every(1);
        let options = Options::default().with_settings(settings);
        let pgs = solver::Registry::standard().entry("pgs").unwrap().build(&options);
        let mut with_matrix = Simulation::new(scene.clone(), pgs);
        scene.step.scheme = Scheme::SequentialImpulses;
        let mut without = simulation(scene);
        let mut compared = 0;
        for _ in 0..2 {
            let (mut a, mut b) = (Iterates::default(), Iterates::default());
            with_matrix.observed_step(&mut a).unwrap();
            without.observed_step(&mut b).unwrap();
            let scale = a.0.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
            assert!(b.0.len() >= a.0.len(), "{name}");
            compared += a.0.len();
            for (k, (x, y)) in a.0.iter().zip(&b.0).enumerate() {
                let apart = x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                assert!(apart <= 1e-10 * scale, "{name}, sweep {k}: {apart}");
            }
        }
        assert!(compared >= 3, "{name}: nothing swept");
    }
}

/// Two particles on a line, the second 167.8 times as heavy: inverse masses and the step of Catto's
/// `soft_constraint.m`.
const INVERSE: [f64; 2] = [0.167, 0.000995];
const H: f64 = 1.0 / 60.0;

/// One soft step with ζ = 0, implemented independently: (c1, c1 + c2, v1, v2, x1, x2) with
/// velocities along the line; without gravity it is linear.
fn soft_step(s: [f64; 6], hertz: f64, relax: bool) -> [f64; 6] {
    let [mut y1, mut y2, mut v1, mut v2, mut x1, mut x2] = s;
    let [m1, m2] = INVERSE;
    let omega = std::f64::consts::TAU * hertz;
    let (bias, scale) = (1.0 / H, (H * omega).powi(2));
    let (mass, impulse) = (scale / (1.0 + scale), 1.0 / (1.0 + scale));
    v1 += m1 * (x1 - x2);
    v2 += m2 * x2;
    let d = -mass / m1 * (v1 + bias * y1) - impulse * x1;
    (x1, v1) = (x1 + d, v1 + m1 * d);
    let d = -mass / (m1 + m2) * (v2 - v1 + bias * (y2 - y1)) - impulse * x2;
    (x2, v1, v2) = (x2 + d, v1 - m1 * d, v2 + m2 * d);
    (y1, y2) = (y1 + H * v1, y2 + H * v2);
    if relax {
        let d = -v1 / m1;
        (x1, v1) = (x1 + d, v1 + m1 * d);
        let d = -(v2 - v1) / (m1 + m2);
        (x2, v1, v2) = (x2 + d, v1 - m1 * d, v2 + m2 * d);
    }
    [y1, y2, v1, v2, x1, x2]
}

/// The spectral radius of that map.
fn soft_radius(hertz: f64, relax: bool) -> f64 {
    let unit = |j: usize| std::array::from_fn(|i| f64::from(u8::from(i == j)));
    let columns: Vec<[f64; 6]> = (0..6).map(|j| soft_step(unit(j), hertz, relax)).collect();
    let map = DMatrix::from_fn(6, 6, |i, j| columns[j][i]);
    map.complex_eigenvalues().iter().map(|z| z.norm()).fold(0.0, f64::max)
}

/// The same two particles as a scene: rods of 1 m, hanging, pulled down by these errors (m).
fn particles(hertz: f64, relax: usize, errors: [f64; 2]) -> Simulation {
    let text = format!(
        "gravity = [0, 0, 0]\n\
         [step]\ndt = {H}\nscheme = \"soft\"\nsubsteps = 1\n\
         [step.soft]\njoint_hertz = {hertz}\njoint_damping = 0\nrate_limit = 10\nrelax = {relax}\n\
         [[bodies]]\nname = \"light\"\nshape = \"point\"\nmass = {}\nposition = [0, 0, -1]\n\
         [[bodies]]\nname = \"heavy\"\nshape = \"point\"\nmass = {}\nposition = [0, 0, -2]\n\
         [[constraints]]\nkind = \"distance\"\nbodies = [\"light\"]\n\
         points = [[0, 0, 0], [0, 0, -1]]\n\
         [[constraints]]\nkind = \"distance\"\nbodies = [\"light\", \"heavy\"]\n",
        1.0 / INVERSE[0],
        1.0 / INVERSE[1],
    );
    let mut scene = Scene::from_toml("particles.toml", &text).unwrap();
    scene.states[0].pose.p.z -= errors[0];
    scene.states[1].pose.p.z -= errors[0] + errors[1];
    simulation(scene)
}

#[test]
fn the_soft_step_is_the_linear_map_whose_spectral_radius_decides() {
    for (hertz, relax) in [(10.0, 0), (13.0, 0), (15.0, 0), (10.0, 1), (20.0, 1), (23.0, 1)] {
        let errors = [1e-3, -2e-3];
        let mut simulated = particles(hertz, relax, errors);
        let mut s = [errors[0], errors[0] + errors[1], 0.0, 0.0, 0.0, 0.0];
        for k in 0..100 {
            simulated.step().unwrap();
            s = soft_step(s, hertz, relax > 0);
            let states = simulated.states();
            let found = [-1.0 - states[0].pose.p.z, -2.0 - states[1].pose.p.z];
            let found = [found[0], found[1], -states[0].v.z, -states[1].v.z];
            for (ours, exact) in found.iter().zip(&s) {
                assert!((ours - exact).abs() < 1e-10, "{hertz} Hz, step {k}: {ours} {exact}");
            }
        }
    }
}

#[test]
fn the_soft_step_is_stable_up_to_13_57_hz_and_with_relaxing_to_20_94() {
    for (relax, threshold) in [(false, 13.5654), (true, 20.9428)] {
        assert!(soft_radius(threshold - 1e-4, relax) < 1.0);
        assert!(soft_radius(threshold + 1e-4, relax) > 1.0);
        assert!(soft_radius(0.9 * threshold, relax) < 1.0);
        assert!(soft_radius(1.1 * threshold, relax) > 1.0);
    }
    // The simulation agrees: 60 s, 5 % below and 10 % above the threshold with relaxation.
    let swing = |hertz| {
        let mut particles = particles(hertz, 1, [1e-4, -1e-4]);
        let recording = particles.run(3600, |_| ControlFlow::Continue(()));
        recording.motion.last().unwrap().drift
    };
    assert!(swing(0.95 * 20.9428) < 1e-4);
    assert!(swing(1.1 * 20.9428) > 1e-2);
}

#[test]
fn an_explicit_spring_is_stable_below_two_over_omega() {
    // ω² = k/m; semi-implicit Euler on a line has the trace 2 − (h ω)² and the determinant 1.
    let swing = |h_omega: f64| {
        let mut scene = stretched(Scheme::Penalty);
        scene.states[0].pose.p.x = 1.0 + 1e-4;
        (scene.step.substeps, scene.step.penalty.damping) = (1, 0.0);
        scene.step.penalty.stiffness = (h_omega / scene.step.dt).powi(2);
        let mut bob = simulation(scene);
        let mut largest = 0f64;
        for _ in 0..40 {
            largest = largest.max(bob.step().unwrap().motion.drift);
        }
        largest
    };
    assert!(swing(1.99) < 2e-3); // at most 1/√(1 − (hω/2)²) = 10 times the start
    assert!(swing(2.01) > 2e-2); // each step −1.22 times the one before
}

#[test]
fn a_penalty_spring_carries_its_load_by_an_error() {
    let mut ball = scene("sphere_plane", Scheme::Penalty);
    ball.step.penalty.damping = 200.0;
    let k = ball.step.penalty.stiffness;
    let weight = 9.81 * ball.bodies[1].mass.mass();
    let mut ball = simulation(ball);
    for _ in 0..300 {
        ball.step().unwrap();
    }
    assert_near(ball.motion().penetration / (weight / k), 1.0, 1e-3);
}

#[test]
fn compliance_of_xpbd_is_that_of_a_spring_and_zero_is_rigid() {
    // A bob that hangs: c = α m g.
    let sag = |alpha: f64| {
        let mut bob = scene("pendulum", Scheme::Xpbd);
        bob.states[0].pose.p = Vector3::new(0.0, 0.0, -1.0);
        bob.step.xpbd.compliance = alpha;
        let mut bob = simulation(bob);
        for _ in 0..2000 {
            bob.step().unwrap();
        }
        bob.motion().drift
    };
    assert!(sag(0.0) < 1e-12);
    assert_near(sag(1e-4) / (1e-4 * 9.81), 1.0, 1e-3);
}

#[test]
fn every_family_holds_a_stack_and_a_pendulum() {
    for scheme in Scheme::ALL {
        let mut stack = simulation(scene("stack", scheme));
        let start = stack.states().to_vec();
        for _ in 0..150 {
            stack.step().unwrap_or_else(|failure| panic!("{scheme:?}: {failure}"));
        }
        let moved = stack.states().iter().zip(&start).map(|(a, b)| (a.pose.p - b.pose.p).norm());
        let moved = moved.fold(0.0, f64::max);
        assert!(moved < 0.05, "{scheme:?}: a box moved {moved} m");

        let mut bob = simulation(scene("pendulum", scheme));
        for _ in 0..300 {
            let motion = bob.step().unwrap().motion;
            assert!(motion.drift < 0.02, "{scheme:?}: {}", motion.drift);
            assert!(motion.energy() < 0.75, "{scheme:?}: {} J, 0 at the start", motion.energy());
        }
        let lowest = bob.motion();
        assert!(lowest.energy() > -3.0, "{scheme:?}: {} J of 9.81 lost", lowest.energy());
    }
}

#[test]
fn every_family_that_knows_restitution_bounces_to_e() {
    use Scheme::{GaussSeidel, SequentialImpulses, Soft, SplitImpulse, Xpbd};
    for scheme in [SplitImpulse, GaussSeidel, Xpbd, Soft, SequentialImpulses] {
        let mut scene = sunk(scheme);
        scene.states[1].pose.p.z = 0.5;
        scene.states[1].v.z = -3.0;
        scene.contact.restitution = 0.5;
        let mut ball = simulation(scene);
        ball.step().unwrap();
        assert_near(ball.states()[1].v.z, 1.5, 1e-9);
    }
}

#[test]
fn every_family_slows_a_sliding_box_by_coulombs_law() {
    // Friction along a tangent: a = g (sin θ − μ cos θ), once the penalty method's friction has
    // grown to μ N.
    let theta = 20f64.to_radians();
    let exact = 9.81 * (theta.sin() - 0.3 * theta.cos());
    for scheme in Scheme::ALL {
        let mut incline = simulation(scene("incline", scheme));
        let mut speed_after = |steps| {
            for _ in 0..steps {
                incline.step().unwrap();
            }
            incline.states()[1].v.norm()
        };
        let (early, late) = (speed_after(50), speed_after(50));
        let found = (late - early) / 0.5;
        assert!((found / exact - 1.0).abs() < 0.01, "{scheme:?}: {found}, exactly {exact}");
    }
}

#[test]
fn every_family_takes_steps_on_every_shipped_scene() {
    catalogue::SHIPPED.par_iter().for_each(|shipped| {
        for scheme in Scheme::ALL {
            let mut scene = super::shipped(shipped.name);
            scene.step.scheme = scheme;
            let few = if scene.bodies.len() > 40 { 1 } else { 3 };
            let mut moving = simulation(scene);
            for _ in 0..few {
                match moving.step() {
                    Ok(step) => assert!(step.states.iter().all(|state| state.is_finite())),
                    Err(failure) => assert!(!failure.to_string().is_empty()),
                }
            }
        }
    });
}

#[test]
fn settings_of_families_are_checked_by_name() {
    let mut scene = scene("pendulum", Scheme::Soft);
    (scene.step.substeps, scene.step.xpbd.compliance) = (0, -1.0);
    scene.step.soft.joint_hertz = 0.0;
    scene.step.penalty.stiffness = f64::NAN;
    let message = scene.validate().unwrap_err().to_string();
    for field in ["substeps", "xpbd.compliance", "soft.joint_hertz", "penalty.stiffness"] {
        assert!(message.contains(&format!("step.{field}: must")), "{message}");
    }
}

#[test]
fn a_family_is_a_word_in_the_scene_file() {
    for scheme in Scheme::ALL {
        let text = format!("step.scheme = \"{}\"", scheme.name());
        assert_eq!(Scene::from_toml("word.toml", &text).unwrap().step.scheme, scheme);
        assert_eq!(Scheme::by_name(scheme.name()), Some(scheme));
    }
}
