//! Rotating bodies: the brick that flips, and the top.

use std::f64::consts::FRAC_PI_2;

use super::measure::{Case, Known, Method, ROUNDING, after, first, last, passages};
use super::{Row, Size};
use crate::body::{Mass, State};
use crate::error::Result;
use crate::scene::catalogue::spin::{FreeBody, SteadyTop};

/// The first zero of the middle rate, a quarter of the period after the start; energy and angular
/// momentum half a second later, when the brick has flipped. At velocity level the body rotates by
/// the midpoint rule, which is of second order and conserves both.
pub(super) fn flip(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("flip", "dzhanibekov", size)?;
    let Mass::Rigid { moments, .. } = case.scene.bodies[0].mass else { return Ok(Vec::new()) };
    let [i1, i2, i3] = [moments.x, moments.y, moments.z];
    let omega = case.scene.states[0].omega;
    let body = FreeBody { moments: [i1, i2, i3], rates: [omega.x, omega.y, omega.z] };
    let quarter = 0.25 * body.period();
    let energy = 0.5 * (i2 * omega.y * omega.y + i3 * omega.z * omega.z);
    let momentum = (i2 * omega.y).hypot(i3 * omega.z);
    let middle = |states: &[State]| {
        let own = states[0].pose.q.inverse() * states[0].omega;
        (own.y, (i3 - i1) * own.z * own.x / i2)
    };
    let formula = "K(k)\\sqrt{\\frac{I_1 I_2 I_3}{(I_3 - I_2)(L^2 - 2 E I_1)}}";
    let mut rows = Vec::new();
    for (method, order) in [(Method::Velocity, 2.0), (Method::Midpoint, 2.0), (Method::Rk4, 4.0)] {
        case.scene.step.dt = if method == Method::Rk4 { 0.016 } else { 0.01 };
        let mut known = vec![Known::order(order, "time until ω2 = 0", formula, "s", quarter)];
        let kept = [
            ("energy after 2 s", "E_0", "J", energy),
            ("angular momentum after 2 s", "L_0", "N m s", momentum),
        ];
        known.extend(kept.map(|(what, formula, unit, value)| match method {
            Method::Velocity => Known::exact(ROUNDING, what, formula, unit, value),
            _ => Known::order(order, what, formula, unit, value),
        }));
        rows.extend(case.rows(method, known, |scene| {
            let time = passages(scene, (1, 2.0 * quarter), middle)?[0];
            let motion = last(scene, 2.0)?.motion;
            Some(vec![time, motion.kinetic, motion.angular_momentum.norm()])
        }));
    }
    Ok(rows)
}

/// The spin and the force on the pivot, and the precession angle after a quarter revolution.
pub(super) fn top(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("top", "top", size)?;
    let (precession, length) = (3.0, 0.3);
    let top = SteadyTop {
        mass: 1.0,
        length,
        moments: [0.06 + length * length, 0.1],
        angle: std::f64::consts::PI / 6.0,
        gravity: -case.scene.gravity.z,
    };
    // The file must contain the steady top: its spin about the axis.
    let state = case.scene.states[0];
    let axis = state.pose.p / length;
    let spin = top.spin(precession);
    let time = FRAC_PI_2 / precession;
    case.scene.step.dt = time / 64.0;
    let bears = "m\\sqrt{g^2 + (\\Omega^2 l\\sin\\theta)^2}";
    let about = "(m g l/\\Omega + I_1\\Omega\\cos\\theta)/I_3";
    let known = vec![
        Known::exact(ROUNDING, "angular velocity about the axis", about, "rad/s", spin),
        Known::exact(ROUNDING, "force of the pivot", bears, "N", top.load(precession)),
    ];
    let mut rows = case.rows(Method::Acceleration, known, |scene| {
        let x = &first(scene)?.solves[0].solution.x;
        Some(vec![state.omega.dot(&axis), x.iter().map(|x| x * x).sum::<f64>().sqrt()])
    });
    let swept = "\\Omega\\,t";
    for (method, order) in [(Method::Velocity, 1.0), (Method::Midpoint, 2.0), (Method::Rk4, 4.0)] {
        let what = "angle swept in a quarter of a period";
        let known = vec![Known::order(order, what, swept, "rad", FRAC_PI_2)];
        rows.extend(case.rows(method, known, |scene| {
            let p = after(scene, time)?[0].pose.p;
            Some(vec![p.y.atan2(p.x)])
        }));
    }
    Ok(rows)
}
