//! Dry friction.

use lcplab_mechanics::scene::Scheme;
use nalgebra::Vector3;

use super::{assert_near, scene, simulation};

const G: f64 = 9.81;

/// The velocity down the slope after one second with this μ.
fn slide(mu: f64, level: Scheme) -> f64 {
    let mut incline = scene("incline", level);
    for body in &mut incline.bodies {
        body.friction = mu;
    }
    let mut incline = simulation(incline);
    for _ in 0..100 {
        incline.step().unwrap();
    }
    let theta = 20f64.to_radians();
    incline.states()[1].v.dot(&Vector3::new(theta.cos(), 0.0, -theta.sin()))
}

#[test]
fn a_box_sticks_just_above_the_tangent_of_the_slope_and_slides_below() {
    let theta = 20f64.to_radians();
    for level in Scheme::LEVELS {
        assert!(slide(theta.tan() * 1.001, level).abs() < 1e-9);
        assert!(slide(theta.tan() * 0.999, level) > 1e-3);
        for mu in [0.0, 0.1, 0.3] {
            assert_near(slide(mu, level), G * (theta.sin() - mu * theta.cos()), 1e-6);
        }
    }
}

#[test]
fn a_sliding_ball_rolls_at_five_sevenths_of_its_speed() {
    for level in Scheme::LEVELS {
        let mut ball = scene("sphere_plane", level);
        ball.states[1].v.x = 1.0;
        let mut ball = simulation(ball);
        // Sliding lasts 2 v/(7 μ g) = 0.058 s.
        for _ in 0..20 {
            ball.step().unwrap();
        }
        let state = ball.states()[1];
        assert_near(state.v.x, 5.0 / 7.0, 1e-9);
        assert_near(state.omega.y * 0.5, state.v.x, 1e-9);
    }
}
