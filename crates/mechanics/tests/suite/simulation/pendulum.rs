//! The pendulum: tension and the period of large swings.

use std::f64::consts::{FRAC_PI_2, PI};

use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
use lcplab_mechanics::formulation::Problem;
use lcplab_mechanics::scene::Scheme;
use nalgebra::Vector3;

use super::{assert_near, scene, simulation, x};

const G: f64 = 9.81;

#[test]
fn the_rod_pulls_with_the_weight_and_the_centripetal_force() {
    // At the angle φ from the vertical with the speed ω: x = −m (g cos φ + l ω²), m = l = 1.
    for (phi, omega) in [(0.0, 0.0), (0.3, 2.0), (-1.0, 0.5), (FRAC_PI_2, 3.0), (2.5, 4.0)] {
        let mut pendulum = scene("pendulum", Scheme::Acceleration);
        let (sin, cos) = f64::sin_cos(phi);
        pendulum.states[0].pose.p = Vector3::new(sin, 0.0, -cos);
        pendulum.states[0].v = omega * Vector3::new(cos, 0.0, sin);
        let step = simulation(pendulum).step().unwrap();
        assert_near(x(&step)[0], -(G * cos + omega * omega), 1e-12);
    }
}

/// The arithmetic-geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// The period (s) of a pendulum of length 1 with this amplitude: 2π √(l/g) / agm(1, cos(φ0/2)).
fn period(amplitude: f64) -> f64 {
    2.0 * PI / G.sqrt() / agm(1.0, (0.5 * amplitude).cos())
}

/// The time (s) of the first return to rest on the right, interpolated to fourth order between
/// steps.
fn measured(dt: f64) -> f64 {
    let mut pendulum = scene("pendulum", Scheme::Velocity);
    pendulum.step.dt = dt;
    pendulum.step.baumgarte = 0.5;
    let mut pendulum = simulation(pendulum);
    // The angle passes the vertical from right to left once a period, at a quarter and at five
    // quarters of it.
    let mut crossings = Vec::new();
    let mut before = pendulum.states()[0].pose.p;
    while crossings.len() < 2 {
        pendulum.step().unwrap();
        let now = pendulum.states()[0].pose.p;
        if before.x > 0.0 && now.x <= 0.0 && now.z < 0.0 {
            let angle = |p: &Vector3<f64>| p.x.atan2(-p.z);
            let part = angle(&before) / (angle(&before) - angle(&now));
            crossings.push(pendulum.time() - dt + part * dt);
        }
        before = now;
    }
    crossings[1] - crossings[0]
}

#[test]
fn the_period_of_a_large_swing_is_the_elliptic_one_to_second_order() {
    assert_near(period(FRAC_PI_2), 2.36784, 1e-5); // the textbook's 1.18034 times 2π √(l/g)
    let exact = period(FRAC_PI_2);
    let error = |dt: f64| (measured(dt) - exact).abs();
    let (coarse, fine) = (error(4e-3), error(2e-3));
    let order = (coarse / fine).log2();
    assert!((order - 2.0).abs() < 0.1, "order {order}: {coarse} {fine}");
}

#[test]
fn both_levels_give_one_motion_as_dt_shrinks() {
    let end = |level, dt: f64| {
        let mut pendulum = scene("pendulum", level);
        (pendulum.step.dt, pendulum.step.alpha) = (dt, 0.2 / dt);
        let mut pendulum = simulation(pendulum);
        for _ in 0..(0.5 / dt).round() as usize {
            pendulum.step().unwrap();
        }
        pendulum.states()[0].pose.p
    };
    let apart = |dt| (end(Scheme::Velocity, dt) - end(Scheme::Acceleration, dt)).norm();
    let (coarse, fine) = (apart(2e-3), apart(1e-3));
    assert!(fine < 5e-3 && (coarse / fine).log2() > 0.9, "{coarse} {fine}");
}

#[test]
fn a_coordinate_check_of_the_bias_at_acceleration_level() {
    // b = n·g + |v|²/l + 2α n·v + α² c with n the rod's direction.
    let mut pendulum = scene("pendulum", Scheme::Acceleration);
    pendulum.step.alpha = 3.0;
    pendulum.states[0].pose.p = Vector3::new(0.0, 0.0, -1.1);
    pendulum.states[0].v = Vector3::new(2.0, 0.0, -0.5);
    let assembly =
        Assembly::new(&pendulum, &pendulum.states, &[], ConstraintFilter::Resting).unwrap();
    let b = Problem::acceleration(&pendulum, assembly).unwrap().lcp.b()[0];
    assert_near(b, G + 4.0 / 1.1 + 2.0 * 3.0 * 0.5 + 9.0 * 0.1, 1e-13);
}
