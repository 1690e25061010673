//! Limits stop bodies and support loads.

use std::f64::consts::PI;

use lcplab_mechanics::body::{Pose, State};
use lcplab_mechanics::constraint::{ConeLimit, Constraint};
use lcplab_mechanics::scene::Scheme;
use nalgebra::{UnitQuaternion, Vector3};

use super::{angle, assert_near, forces, simulation};

const WEIGHT: f64 = 2.0 * 9.81;

/// A ball of 2 kg with I = 0.2 kg m² at this place, and constraints that each name it.
fn ball(place: &str, constraints: &[&str]) -> String {
    let mut text = format!(
        "[step]\ndt = 0.01\nbaumgarte = 0.2\n\
         [[bodies]]\nname = \"ball\"\nshape = {{ sphere = 0.5 }}\nmass = 2\nposition = {place}\n"
    );
    for constraint in constraints {
        text += &format!("[[constraints]]\nbodies = [\"ball\"]\n{constraint}\n");
    }
    text
}

#[test]
fn a_falling_body_ends_on_its_stop_and_leans_on_it_with_its_weight() {
    let text = ball(
        "[0, 0, 0]",
        &[
            "kind = \"limit_translation\"\naxis = [0, 0, 1]\nlimits = [-0.5, inf]",
            "kind = \"slider\"\naxis = [0, 0, 1]",
        ],
    );
    for level in Scheme::LEVELS {
        let mut slider = simulation(&text, level);
        let mut lowest: f64 = 0.0;
        for _ in 0..300 {
            slider.step().unwrap();
            lowest = lowest.min(slider.states()[0].pose.p.z);
        }
        // Impulses know the gap before it closes; forces only afterwards, one step late at √(2 g
        // 0.5) m/s.
        let late = if level == Scheme::Velocity { 1e-12 } else { 9.81_f64.sqrt() * 0.01 };
        assert!(lowest >= -0.5 - late, "{level:?} {lowest}");
        let step = slider.step().unwrap();
        assert_near(slider.states()[0].pose.p.z, -0.5, late);
        assert_near(forces(&step, &slider, 0)[0], WEIGHT, 1e-9);
    }
}

#[test]
fn an_arm_falls_on_its_stop_and_leans_on_it_with_its_torque() {
    let text = ball(
        "[0.4, 0, 0]",
        &[
            "kind = \"limit_rotation\"\naxis = [0, 1, 0]\nlimits = [-1, 0.5]",
            "kind = \"hinge\"\npoint = [0, 0, 0]\naxis = [0, 1, 0]",
        ],
    );
    for level in Scheme::LEVELS {
        let mut arm = simulation(&text, level);
        for _ in 0..500 {
            arm.step().unwrap();
        }
        // As above: one step late at √(2 m g l sin 0.5/(I + m l²)) = 3.8 rad/s.
        let late = if level == Scheme::Velocity { 1e-9 } else { 0.038 };
        let step = arm.step().unwrap();
        let at = angle(&arm.states()[0], &Vector3::y());
        assert_near(at, 0.5, late);
        let stops = forces(&step, &arm, 0); // at acceleration level only the one that is met enters
        assert_near(*stops.last().unwrap(), WEIGHT * 0.4 * at.cos(), 1e-7);
        assert!(stops.len() == 1 || stops[0] == 0.0);
    }
}

#[test]
fn stops_three_quarters_of_a_turn_apart_are_distinguished() {
    let text = ball(
        "[0, 0, 0]",
        &[
            "kind = \"limit_rotation\"\naxis = [0, 0, 1]\nlimits = [0, 4.71238898038469]",
            "kind = \"motor_rotation\"\naxis = [0, 0, 1]\nspeed = 1\neffort = 3",
            "kind = \"hinge\"\naxis = [0, 0, 1]",
        ],
    );
    let mut wheel = simulation(&text, Scheme::Velocity);
    let (mut turned, mut before) = (0.0, 0.0);
    for _ in 0..600 {
        wheel.step().unwrap();
        let now = angle(&wheel.states()[0], &Vector3::z());
        turned += (now - before + PI).rem_euclid(2.0 * PI) - PI;
        before = now;
    }
    assert_near(turned, 1.5 * PI, 1e-9);
    let step = wheel.step().unwrap();
    assert_near(forces(&step, &wheel, 0)[1], 3.0, 1e-9); // what the motor has
}

#[test]
fn an_arm_that_stands_in_a_cone_falls_on_its_edge() {
    let text = ball(
        "[0, 0, 0.4]",
        &[
            "kind = \"limit_cone\"\naxis = [0, 0, 1]\nangle = 0.6",
            "kind = \"nail\"\npoint = [0, 0, 0]",
            "kind = \"limit_rotation\"\naxis = [0, 0, 1]\nlimits = [-0.1, 0.1]",
        ],
    );
    let text = text.replace(
        "mass = 2",
        "mass = 2\nvelocity = [0.04, 0.032, 0]\nangular_velocity = [-0.08, 0.1, 0]",
    );
    let mut arm = simulation(&text, Scheme::Velocity);
    let swing = |p: &Vector3<f64>| p.xy().norm().atan2(p.z);
    for _ in 0..600 {
        arm.step().unwrap();
        // A step to the limit along its tangent overshoots by at most (ωh)²/2.
        assert!(swing(&arm.states()[0].pose.p) < 0.6 + 1e-3);
    }
    let step = arm.step().unwrap();
    assert_near(swing(&arm.states()[0].pose.p), 0.6, 1e-9);
    assert_near(forces(&step, &arm, 0)[0], WEIGHT * 0.4 * 0.6_f64.sin(), 1e-6);
}

#[test]
fn the_apex_of_a_cone_has_a_row_that_never_pushes_and_its_back_has_none() {
    let cone = ConeLimit { bodies: [None, Some(0)], axes: [Vector3::z(); 2], angle: 0.6 };
    let turned = |angle: f64| State {
        pose: Pose {
            p: Vector3::zeros(),
            q: UnitQuaternion::from_scaled_axis(Vector3::x() * angle),
        },
        omega: Vector3::new(1.0, 2.0, 3.0),
        ..State::WORLD
    };
    for angle in [0.0, 1e-300, 1e-12] {
        let rows = cone.rows([&State::WORLD, &turned(angle)]).unwrap();
        assert_near(rows[0].c, 0.6, 1e-11);
        assert_near(rows[0].jacobian[1].norm(), 1.0, 1e-15);
        assert_eq!(rows[0].velocity_product, 0.0);
    }
    assert!(cone.rows([&State::WORLD, &turned(PI)]).is_err());
}
