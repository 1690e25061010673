//! Pendulums: period, tension and position, compared with elliptic integrals and reduced
//! coordinates.
//!
//! From step to step, semi-implicit Euler shifted by half a step is the leapfrog scheme, which is
//! time-reversible: a period, which does not depend on the shift, is of second order, a position at
//! a given time of first.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;

use super::measure::{Case, Known, Method, ROUNDING, after, first, last, passages};
use super::{Row, Size};
use crate::body::State;
use crate::error::Result;
use crate::scene::catalogue::pendulum::{Conical, DoublePendulum, Pendulum, Swing};

/// Methods with the orders of a period and of a position.
const METHODS: [(Method, f64, f64); 4] = [
    (Method::Velocity, 2.0, 1.0),
    (Method::Acceleration, 2.0, 1.0),
    (Method::Midpoint, 2.0, 2.0),
    (Method::Rk4, 4.0, 4.0),
];

const AGM: &str = "2\\pi\\sqrt{l/g}\\,/\\,\\mathrm{agm}(1, \\cos 45°)";

/// The angle φ from the vertical and its rate, in the x-z plane.
fn angle(states: &[State]) -> (f64, f64) {
    let State { pose, v, .. } = states[0];
    let p = pose.p;
    (p.x.atan2(-p.z), (p.x * v.z - p.z * v.x) / p.norm_squared())
}

fn end(angle: f64) -> Vector3<f64> {
    Vector3::new(angle.sin(), 0.0, -angle.cos())
}

/// The period at 90 degrees: the time between two crossings of the lowest point.
pub(super) fn swing(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("pendulum", "pendulum", size)?;
    let pendulum = Pendulum { length: 1.0, gravity: -case.scene.gravity.z };
    let period = pendulum.period(FRAC_PI_2);
    let mut rows = Vec::new();
    for (method, order, _) in METHODS {
        case.scene.step.dt = if method == Method::Rk4 { 0.04 } else { 0.005 };
        let known = vec![Known::order(order, "period at 90°", AGM, "s", period)];
        rows.extend(case.rows(method, known, |scene| {
            let times = passages(scene, (2, 1.5 * period), angle)?;
            Some(vec![times[1] - times[0]])
        }));
    }
    Ok(rows)
}

/// The rod's force at an instant is m (g cos φ + l ω²): exact at acceleration level.
pub(super) fn tension(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("pendulum-tension", "pendulum", size)?;
    let g = -case.scene.gravity.z;
    let (phi, rate) = (0.7f64, 1.3);
    let state = &mut case.scene.states[0];
    state.pose.p = end(phi);
    state.v = rate * Vector3::new(phi.cos(), 0.0, phi.sin());
    let formula = "-m\\,(g\\cos\\varphi + l\\,\\omega^2)";
    let expected = -(g * phi.cos() + rate * rate);
    let what = "force of the rod at φ = 0.7 rad, ω = 1.3 rad/s";
    let mut rows = Vec::new();
    for method in [Method::Acceleration, Method::Rk4] {
        let known = vec![Known::exact(ROUNDING, what, formula, "N", expected)];
        rows.extend(
            case.rows(method, known, |scene| Some(vec![first(scene)?.solves[0].solution.x[0]])),
        );
    }
    Ok(rows)
}

/// The published benchmark: the position of the mass after 10 s, and the tension in the rod.
pub(super) fn iftomm(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("iftomm-pendulum", "iftomm_pendulum", size)?;
    let g = -case.scene.gravity.z;
    let (time, pendulum) = (10.0, Pendulum { length: 1.0, gravity: g });
    let start = Swing { angles: [-FRAC_PI_2], rates: [0.0] };
    let exact = end(pendulum.after(time, start).angles[0]);
    let place = "\\mathrm{sn},\\ k = \\sin 45°";
    let sampled = (
        2.5e-4,
        r"sampled once per step: the largest sample can be below the maximum by $\frac{3}{2} m g (\omega\, dt/2)^2$ at dt = 0.01 s",
    );
    let mut rows = Vec::new();
    for (method, _, order) in [METHODS[2], METHODS[3]] {
        let known = vec![
            Known::order(order, "x after 10 s", place, "m", exact.x),
            Known::order(order, "z after 10 s", place, "m", exact.z),
            Known::order(
                order,
                "tension in the rod at 10 s",
                "3\\,m\\,g\\cos\\varphi",
                "N",
                -3.0 * g * exact.z,
            ),
            Known::exact(sampled, "largest tension", "3\\,m\\,g", "N", 3.0 * g),
        ];
        rows.extend(case.rows(method, known, |scene| {
            let mut simulation = super::measure::start(scene)?;
            let mut greatest: f64 = 0.0;
            for _ in 0..(time / scene.step.dt).round() as usize {
                let step = simulation.step().ok()?;
                greatest = greatest.max(-step.solves[0].solution.x[0]);
            }
            let p = simulation.states()[0].pose.p;
            // At the beginning of the step.
            let pull = -simulation.step().ok()?.solves[0].solution.x[0];
            Some(vec![p.x, p.z, pull, greatest])
        }));
    }
    Ok(rows)
}

/// A circle at constant height.
pub(super) fn conical(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("conical-pendulum", "conical_pendulum", size)?;
    let conical = Conical { length: 1.0, angle: TAU / 6.0, gravity: -case.scene.gravity.z };
    case.scene.step.dt = conical.period() / 200.0;
    let pull = "m\\,g / \\cos\\theta";
    let round = "2\\pi";
    let known = vec![Known::exact(ROUNDING, "tension in the rod", pull, "N", conical.tension(1.0))];
    let pulls = |scene: &crate::scene::Scene| Some(vec![-first(scene)?.solves[0].solution.x[0]]);
    let mut rows = case.rows(Method::Acceleration, known, pulls);
    for (method, order) in [(Method::Midpoint, 2.0), (Method::Rk4, 4.0)] {
        let known = vec![Known::order(order, "angle swept in one period", round, "rad", TAU)];
        rows.extend(case.rows(method, known, |scene| {
            let p = after(scene, conical.period())?[0].pose.p;
            Some(vec![TAU + p.y.atan2(p.x)])
        }));
    }
    Ok(rows)
}

/// Two masses compared with Lagrange's equations for two angles.
pub(super) fn double(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("double-pendulum", "double_pendulum", size)?;
    let gravity = -case.scene.gravity.z;
    let double = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity };
    let time = 0.5;
    let swing = double.after(time, Swing { angles: [FRAC_PI_2; 2], rates: [0.0; 2] });
    let exact = end(swing.angles[0]) + end(swing.angles[1]);
    let formula = "l_1 \\sin\\varphi_1 + l_2 \\sin\\varphi_2";
    let mut rows = Vec::new();
    for (method, _, order) in METHODS {
        case.scene.step.dt = if method == Method::Rk4 { 0.02 } else { 0.0025 };
        let known =
            vec![Known::order(order, "x of the lower mass at 0.5 s", formula, "m", exact.x)];
        rows.extend(
            case.rows(method, known, |scene| Some(vec![last(scene, time)?.states[1].pose.p.x])),
        );
    }
    Ok(rows)
}
