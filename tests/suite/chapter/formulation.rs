//! Errata of the formulation and the integration, E13 to E27: their figures, from theory.

use lcplab::body::State;
use lcplab::chapter::exhibit::Outcome;
use lcplab::constraint::{Coincidence, Constraint};
use lcplab::lcp::library;
use lcplab::scene::catalogue::pendulum::{Pendulum, Swing};
use lcplab::scene::{Scene, Scheme};
use lcplab::simulation::Simulation;
use lcplab::solver::{Options, Registry};
use nalgebra::Vector3;

use super::{assert_near, both, outcomes};

#[test]
fn e13_the_printed_force_stops_a_second_of_the_blow_in_any_step() {
    // λ = 1 + g, so v⁺ = −1 + dt.
    for (dt, name) in [(1.0 / 60.0, "1/60"), (1e-3, "1/1000"), (1.0, "1")] {
        let [printed, corrected] = both("E13", &format!("v⁺ on the floor, dt = {name} s"));
        assert_near(printed, dt - 1.0, 1e-12);
        assert_near(corrected, 0.0, 1e-12);
    }
}

#[test]
fn e14_a_single_velocity_step_lacks_the_square_of_the_rate() {
    let [printed, corrected] = both("E14", "λ of the rod");
    assert_near(printed, -9.81 * 0.7f64.cos(), 1e-9);
    assert_near(printed - corrected, 1.3 * 1.3, 1e-9);
}

#[test]
fn e14_along_a_run_the_velocity_level_recovers_the_force() {
    let (angle, rate, dt) = (0.7f64, 1.3, 1e-4);
    let mut scene = Scene::load("pendulum").unwrap();
    (scene.step.scheme, scene.step.dt, scene.step.baumgarte) = (Scheme::Velocity, dt, 0.0);
    scene.states[0].pose.p = Vector3::new(angle.sin(), 0.0, -angle.cos());
    scene.states[0].v = rate * Vector3::new(angle.cos(), 0.0, angle.sin());
    let mut simulation = Simulation::new(
        scene,
        Registry::standard().entry("dantzig").unwrap().build(&Options::default()),
    );
    let mut force = 0.0;
    for _ in 0..200 {
        force = simulation.step().unwrap().solves[0].solution.x[0] / dt;
    }
    let pendulum = Pendulum { length: 1.0, gravity: 9.81 };
    let now = pendulum.after(200.0 * dt, Swing { angles: [angle], rates: [rate] });
    let exact = -(9.81 * now.angles[0].cos() + now.rates[0].powi(2));
    assert_near(exact, -8.7176, 5e-4);
    assert_near(force, exact, 3e-3);
    assert!((force + 9.81 * now.angles[0].cos()).abs() > 1.0, "J'u is in it: {force}");
}

#[test]
fn e14_friction_turns_the_rod_into_the_ground() {
    // 1 + 3 cos² 60° − 3 μ sin 60° cos 60° with μ = 1.8: below 0, as is b.
    let given = [("mu", 1.8), ("tan", 3f64.sqrt())];
    let lcp = library::by_name("painleve").unwrap().generate(&given).unwrap().lcp;
    let exact = 1.0 + 0.75 - 1.8 * 3.0 * 3f64.sqrt() / 4.0;
    assert_near(lcp.matrix().diagonal(0), exact, 1e-12);
    assert_near(exact, -0.5883, 5e-5);
    let [printed, Outcome::Numbers(corrected)] = outcomes("E14", "push on the rod's end") else {
        panic!("the velocity level has an answer")
    };
    assert_eq!(printed, Outcome::Impossible("no solution".into()));
    assert_near(corrected[0], 0.33273, 5e-7);
}

#[test]
fn e15_e16_e22_e27_shapes_are_refused_with_their_numbers() {
    for (id, quantity, shapes) in [
        ("E15", "rates of the gaps", "18 × 2 by 18 × 1"),
        ("E16", "rate of the height", "1 × 3 by 6 × 1"),
        ("E22", "forces", "1 × 2 by 1 × 1"),
        ("E27", "Figure 5, as read", "1 × 6 by 7 × 6"),
    ] {
        let [printed, _] = outcomes(id, quantity);
        assert_eq!(printed, Outcome::Impossible(format!("no product: {shapes}")), "{id}");
    }
}

#[test]
fn e17_the_printed_ratio_is_the_reciprocal() {
    let [Outcome::Numbers(printed), _] = outcomes("E17", "J") else { panic!("numbers") };
    assert_near(printed[0], 5.0 / 3.0, 1e-6);
    assert_near(printed[1], 5.0 / 4.0, 1e-6);
    assert_near(both("E17", "rate of the distance")[0], 25.0 / 6.0, 1e-5);
    assert_near(both("E17", "rate of the distance")[1], 11.0 / 5.0, 1e-12);
}

#[test]
fn e19_two_nails_allow_the_turn_about_the_line_through_them() {
    let places = [Vector3::new(0.5, 0.2, 0.0), Vector3::new(-0.4, 0.1, 0.3)];
    let omega = places[1] - places[0];
    let v = -omega.cross(&places[0]); // the first nail is on the axis
    for place in places {
        let nail = Coincidence { bodies: [None, Some(0)], anchors: [place; 2] };
        for row in nail.rows([&State::WORLD, &State::WORLD]).unwrap() {
            let j = row.jacobian[1];
            let rate = j.fixed_rows::<3>(0).dot(&v) + j.fixed_rows::<3>(3).dot(&omega);
            assert_near(rate, 0.0, 1e-15);
        }
    }
    assert_eq!(both("E19", "removed by two nails"), [6.0, 5.0]);
}

#[test]
fn e22_the_printed_sign_doubles_the_velocity() {
    let [printed, corrected] = both("E22", "v⁺ on the floor");
    assert_near(printed, 2.0 * (-1.0 - 9.81 / 60.0), 1e-12);
    assert_near(corrected, 0.0, 1e-12);
}

#[test]
fn e24_the_corrected_rotation_is_exact() {
    let rate = Vector3::new(0.3, -1.1, 0.7).norm();
    let [printed, corrected] = both("E24", "off the exact pose by");
    assert_near(printed, rate, 1e-12);
    assert_near(corrected, 0.0, 1e-12);
}

#[test]
fn e25_the_printed_line_is_compound_interest() {
    assert_eq!(both("E25", "driven from rest")[0], 0.0);
    assert_near(both("E25", "left alone at 1 rad/s")[0], 1.005f64.powi(100), 1e-12);
}

#[test]
fn e26_without_the_term_the_momentum_goes_round_with_the_body() {
    // ω stays, so L is L₀ turned about ω by φ: |L − L₀| = 2 |L₀| sin(φ/2) sin(angle of L₀ to ω).
    let omega: Vector3<f64> = Vector3::new(0.5, 5.0, 0.5);
    let momentum = Vector3::new(1.0, 15.0, 2.0);
    let angle = omega.norm();
    let part = 2.0 * (angle / 2.0).sin().abs() * momentum.angle(&omega).sin();
    let [printed, corrected] = both("E26", "error of I ω at 1 s");
    assert_near(printed, 100.0 * part, 1e-9);
    assert_near(part, 0.054, 5e-4);
    assert!(corrected < 0.01);
    assert_near(both("E26", "axis 1 rate at 1 s")[0], 0.5, 1e-12);
}

#[test]
fn e26_the_middle_axis_turns_over_when_jacobis_integral_says() {
    // 2E = 76.5 and L² = 230 leave ω2 = √(76/3) sin φ with φ' = √(77 − 76 sin² φ) / √24.
    let rate = |phi: f64| ((77.0 - 76.0 * phi.sin().powi(2)) / 24.0).sqrt();
    let start = (5.0 / (76f64 / 3.0).sqrt()).asin();
    let (steps, mut time) = (200_000, 0.0);
    let h = (std::f64::consts::PI - start) / f64::from(steps);
    for k in 0..steps {
        time += h / rate(start + (f64::from(k) + 0.5) * h);
    }
    assert_near(time, 2.4875, 5e-5);
    let [printed, Outcome::Numbers(corrected)] = outcomes("E26", "middle rate flips at") else {
        panic!("with the term it turns over")
    };
    assert_eq!(printed, Outcome::Impossible("never".into()));
    assert_near(corrected[0], time, 3e-3);
}
