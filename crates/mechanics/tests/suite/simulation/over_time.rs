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
