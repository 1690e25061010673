//! Time-dependent forces and supports, compared with closed forms.

use lcplab_mechanics::scene::{Integrator, Scene, Scheme, saved};
use lcplab_mechanics::simulation::Simulation;

use super::{assert_near, simulation};

/// A mass of 2 kg without gravity under 3 N · sin(4 t).
const SHAKEN: &str = "gravity = [0, 0, 0]\n[[bodies]]\nname = \"mass\"\nshape = \"point\"\nmass = 2\n\
    force_over_time = { sine = { amplitude = [3, 0, 0], angular_frequency = 4 } }\n";

/// x = a/ω (t − sin(ω t)/ω), v = a/ω (1 − cos(ω t)), with a = 1.5 m/s² and ω = 4/s.
fn shaken(t: f64) -> (f64, f64) {
    let (a, omega) = (1.5, 4.0);
    (a / omega * (t - (omega * t).sin() / omega), a / omega * (1.0 - (omega * t).cos()))
}

fn after(mut scene: Scene, dt: f64, steps: usize) -> Simulation {
    scene.step.dt = dt;
    let mut simulation = simulation(scene);
    for _ in 0..steps {
        simulation.step().unwrap();
    }
    simulation
}

#[test]
fn every_scheme_gives_the_impulse_of_a_sine_exactly() {
    let (_, v) = shaken(1.3);
    for scheme in Scheme::ALL {
        let mut scene = Scene::from_toml("shaken.toml", SHAKEN).unwrap();
        scene.step.scheme = scheme;
        let state = after(scene, 0.01, 130).states()[0];
        assert_near(state.v.x, v, 1e-10);
    }
}

#[test]
fn integrators_follow_a_sine_at_their_order() {
    let (x, _) = shaken(1.0);
    let orders = [
        (Integrator::SemiImplicitEuler, 1.0),
        (Integrator::ExplicitEuler, 1.0),
        (Integrator::ImplicitMidpoint, 2.0),
        (Integrator::Rk4, 4.0),
    ];
    for (integrator, order) in orders {
        let error = |steps: usize| {
            let mut scene = Scene::from_toml("shaken.toml", SHAKEN).unwrap();
            (scene.step.scheme, scene.step.integrator) = (Scheme::Acceleration, integrator);
            (after(scene, 1.0 / steps as f64, steps).states()[0].pose.p.x - x).abs()
        };
        let observed = (error(20) / error(40)).log2();
        assert!((observed - order).abs() < 0.1, "{integrator:?} {observed}");
    }
}

#[test]
fn what_is_saved_goes_on_at_its_time() {
    let scene = Scene::from_toml("shaken.toml", SHAKEN).unwrap();
    let path = std::env::temp_dir().join(format!("lcplab-shaken-{}.toml", std::process::id()));
    std::fs::write(&path, SHAKEN).unwrap();
    let half = after(scene.clone(), 0.01, 70);
    let text = saved(path.to_str().unwrap(), &[], &scene, half.states(), half.time()).unwrap();
    std::fs::remove_file(&path).unwrap();
    let later = after(Scene::from_toml("later.toml", &text).unwrap(), 0.01, 60);
    assert_near(later.states()[0].v.x, shaken(1.3).1, 1e-10);
}

#[test]
fn a_block_pushed_harder_and_harder_moves_at_the_static_threshold_and_slides_with_mu() {
    // 10 N/s · t reaches μ_s m g = 11.772 N at 1.1772 s; then m v = ∫ (10 t − 7.848) dt.
    let text = "contact.friction = 0.4\ncontact.static_friction = 0.6\n\
        [[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n\
        [[bodies]]\nname = \"block\"\nmass = 2\nshape = { box = [0.4, 0.4, 0.2] }\n\
        position = [0, 0, 0.1]\nforce_at = [0, 0, -0.1]\n\
        force_over_time = { table = [[0, 0, 0, 0], [2, 20, 0, 0]] }\n";
    let begins = 1.1772;
    let impulse = |t: f64| 5.0 * (t * t - begins * begins) - 7.848 * (t - begins);
    let schemes = [
        Scheme::Velocity,
        Scheme::Acceleration,
        Scheme::SplitImpulse,
        Scheme::GaussSeidel,
        Scheme::SequentialImpulses,
    ];
    for scheme in schemes {
        let mut scene = Scene::from_toml("ramp.toml", text).unwrap();
        scene.step.scheme = scheme;
        let still = after(scene.clone(), 0.001, 1177).states()[1].v.x;
        assert!(still.abs() < 1e-6, "{scheme:?} {still}");
        // The threshold is crossed within a step, during which the block slides or sticks: 4 N · 1
        // ms / 2 kg.
        let moving = after(scene, 0.001, 1500).states()[1].v.x;
        assert!((moving - impulse(1.5) / 2.0).abs() < 0.002, "{scheme:?} {moving}");
    }
}

/// A block on a table that shakes with A sin(ω t), ω = 10/s, μ_s = 0.5 and μ = 0.3.
fn table(scheme: Scheme, amplitude: f64) -> Scene {
    let text = format!(
        "contact.friction = 0.3\ncontact.static_friction = 0.5\n[[bodies]]\nname = \"table\"\nfixed = true\n\
         shape = {{ box = [4, 4, 0.2] }}\nposition = [0, 0, -0.1]\n\
         displacement_over_time = {{ sine = {{ amplitude = [{amplitude}, 0, 0], \
         angular_frequency = 10, phase = {} }} }}\n\
         [[bodies]]\nname = \"block\"\nmass = 1\nshape = {{ box = [0.4, 0.4, 0.1] }}\n\
         position = [{amplitude}, 0, 0.05]\n",
        std::f64::consts::FRAC_PI_2 // from its end, where it stands still
    );
    let mut scene = Scene::from_toml("table.toml", &text).unwrap();
    scene.step.scheme = scheme;
    scene
}

#[test]
fn a_block_stays_on_a_shaking_table_as_long_as_its_acceleration_is_below_mu_s_g() {
    // A ω² = μ_s g at A = 49.05 mm.
    let schemes = [Scheme::Velocity, Scheme::SplitImpulse, Scheme::SequentialImpulses];
    for scheme in schemes {
        for (amplitude, sticks) in [(0.0486, true), (0.0495, false)] {
            let mut simulation = after(table(scheme, amplitude), 0.002, 1);
            let mut slipped = 0.0_f64;
            for _ in 0..314 {
                simulation.step().unwrap();
                let [table, block] = simulation.states() else { unreachable!() };
                slipped = slipped.max((block.pose.p.x - table.pose.p.x).abs());
            }
            assert_eq!(slipped < 1e-5, sticks, "{scheme:?} {amplitude}: slipped by {slipped}");
        }
    }
}

#[test]
fn a_support_is_where_its_course_says_under_every_scheme_that_moves_it() {
    for scheme in Scheme::ALL.into_iter().filter(|scheme| *scheme != Scheme::Acceleration) {
        let mut scene = table(Scheme::Velocity, 0.03);
        scene.bodies.iter_mut().for_each(|body| body.static_friction = None);
        scene.step.scheme = scheme;
        let simulation = after(scene, 0.01, 77);
        assert_near(simulation.states()[0].pose.p.x, 0.03 * 7.7f64.cos(), 1e-12);
    }
}

#[test]
fn the_acceleration_level_refuses_a_support_that_moves_in_time() {
    let error = table(Scheme::Acceleration, 0.03).validate().unwrap_err().to_string();
    let expected = "table: bodies[0].displacement_over_time: is not supported by the scheme \
                    acceleration; use another scheme";
    assert_eq!(error, expected);
}

/// A box of 1.3 kg on a table that moves like this, μ = 0.4 and g = 9.81 m/s².
fn carried(scheme: Scheme, moves: &str) -> Scene {
    let text = format!(
        "contact.friction = 0.4\n[[bodies]]\nname = \"table\"\nfixed = true\n\
         shape = {{ box = [9, 9, 0.4] }}\nposition = [0, 0, -0.2]\n\
         displacement_over_time = {moves}\n[[bodies]]\nname = \"box\"\nmass = 1.3\n\
         shape = {{ box = [0.4, 0.3, 0.2] }}\nposition = [0, 0, 0.1]\n"
    );
    let mut scene = Scene::from_toml("carried.toml", &text).unwrap();
    scene.step.scheme = scheme;
    scene
}

/// The schemes that move a support, with what their contacts allow: a position error (m) and a part
/// of a speed. Springs give way, and the friction of the penalty method is a damper.
const MOVING: [(Scheme, f64, f64); 7] = [
    (Scheme::Velocity, 1e-7, 1e-7),
    (Scheme::SplitImpulse, 1e-7, 1e-7),
    (Scheme::GaussSeidel, 1e-7, 1e-7),
    (Scheme::SequentialImpulses, 1e-7, 1e-7),
    (Scheme::Xpbd, 1e-7, 1e-6),
    (Scheme::Soft, 1e-3, 1e-2),
    (Scheme::Penalty, 2e-2, 5e-2),
];

#[test]
fn a_belt_that_starts_and_stops_drags_a_box_with_mu_g_and_takes_it_as_far_as_it_went() {
    // 1 m/s for a second, along either axis. The box lags v²/(2 μ g) behind and slides as far after
    // the stop; at 0.1 s it has μ g t.
    for (scheme, near, part) in MOVING {
        for (axis, moves) in ["[1, 1, 0, 0]", "[1, 0, 1, 0]"].into_iter().enumerate() {
            let scene = carried(scheme, &format!("{{ table = [[0, 0, 0, 0], {moves}] }}"));
            let speed = after(scene.clone(), 0.01, 10).states()[1].v[axis];
            assert_near(speed, 0.4 * 9.81 * 0.1, part);
            let end = after(scene, 0.01, 160).states()[1];
            let error = (end.pose.p[axis] - 1.0).abs();
            assert!(error < near && end.v.norm() < part, "{scheme:?}, {axis}: {error} {}", end.v);
        }
    }
}

/// A sine with A ω² = `part` of this acceleration (m/s²) along an axis, ω = 20/s.
fn sine(part: f64, acceleration: f64, axis: usize, phase: f64) -> (f64, String) {
    let a = part * acceleration / 400.0;
    let mut amplitude = [0.0; 3];
    amplitude[axis] = a;
    let moves = format!(
        "{{ sine = {{ amplitude = {amplitude:?}, angular_frequency = 20, phase = {phase} }} }}"
    );
    (a, moves)
}

#[test]
fn a_box_rides_on_a_table_that_shakes_with_less_than_mu_g_and_slips_above_under_every_scheme() {
    for (scheme, near, _) in MOVING {
        for (part, axis) in [(0.98, 0), (0.98, 1), (1.1, 0), (1.1, 1)] {
            // From its end, where the table is at rest, for two periods.
            let (a, moves) = sine(part, 0.4 * 9.81, axis, std::f64::consts::FRAC_PI_2);
            let mut scene = carried(scheme, &moves);
            scene.states[1].pose.p[axis] = a;
            let mut running = after(scene, 0.002, 1);
            let mut slipped = 0.0_f64;
            for _ in 0..314 {
                running.step().unwrap();
                let [table, block] = running.states() else { unreachable!() };
                slipped = slipped.max((block.pose.p[axis] - table.pose.p[axis]).abs());
            }
            let what = format!("{scheme:?}, {part}, {axis}: {slipped}");
            if part < 1.0 {
                assert!(slipped < near, "{what}");
            } else {
                assert!(slipped > 1e-4, "{what}");
            }
        }
    }
}

#[test]
fn a_table_throws_what_is_on_it_where_its_acceleration_exceeds_g_and_not_below() {
    for (scheme, near, _) in MOVING {
        for part in [0.9, 0.98, 1.3, 2.0] {
            let (a, moves) = sine(part, 9.81, 2, 0.0);
            let omega = 20.0;
            let mut scene = carried(scheme, &moves);
            scene.states[1].v.z = a * omega;
            // z'' = −g at sin ω t₀ = 1/part: from there on the box flies.
            let begins = (1.0_f64 / part).min(1.0).asin() / omega;
            let (z, v) = (a * (omega * begins).sin(), a * omega * (omega * begins).cos());
            let dt = 0.001;
            let mut running = after(scene, dt, 0);
            let (mut highest, mut landed) = (0.0_f64, false);
            for k in 1..=300 {
                running.step().unwrap();
                let [table, block] = running.states() else { unreachable!() };
                let gap = block.pose.p.z - 0.1 - (table.pose.p.z + 0.2);
                highest = highest.max(gap);
                let t = dt * f64::from(k) - begins;
                let flight = z + v * t - 0.5 * 9.81 * t * t;
                let under = a * (omega * dt * f64::from(k)).sin();
                landed |= t > 0.0 && flight < under;
                if part > 1.0 && t > 0.0 && !landed {
                    // The start is known to within a step, in which speeds change by g dt.
                    let error = (block.pose.p.z - 0.1 - flight).abs();
                    let most = near.max(2.0 * 9.81 * dt * t + 9.81 * dt * dt);
                    assert!(error < most, "{scheme:?}, {part}, {t}: {error}");
                }
            }
            match part > 1.0 {
                true => assert!(landed && highest > 1e-3, "{scheme:?}, {part}: {highest}"),
                false => assert!(highest < near.max(1e-12), "{scheme:?}, {part}: {highest}"),
            }
        }
    }
}
