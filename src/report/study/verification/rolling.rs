//! Rolling balls.

use super::measure::{Case, Known, Method, last};
use super::{Row, Size};
use crate::error::Result;
use crate::scene::Scene;
use crate::scene::catalogue::rolling::{PushedBox, SlidingBall};

const LEVELS: [Method; 2] = [Method::Velocity, Method::Acceleration];
const SUMMED: (f64, &str) = (1e-7, "the tolerance of the solver, accumulated over the steps");

/// A ball thrown without spin slides until it rolls, at 5/7 of its speed.
pub(super) fn sphere(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("rolling-sphere", "rolling_sphere", size)?;
    let (g, time) = (-case.scene.gravity.z, 0.5);
    let ball = SlidingBall {
        speed: case.scene.states[1].v.x,
        friction: case.scene.contact.friction,
        gravity: g,
    };
    let mut rows = Vec::new();
    for level in LEVELS {
        let known = vec![
            Known::exact(
                SUMMED,
                "speed when rolling starts",
                "\\tfrac57 v_0",
                "m/s",
                ball.rolling_speed(),
            ),
            Known::exact(
                SUMMED,
                "time until rolling starts",
                "\\frac{2 v_0}{7\\mu g}",
                "s",
                ball.sliding_time(),
            ),
            Known::order(
                1.0,
                "distance after 0.5 s",
                "v_0 T - \\tfrac12\\mu g T^2 + \\tfrac57 v_0 (t - T)",
                "m",
                ball.way_after(time),
            ),
        ];
        rows.extend(case.rows(level, known, |scene| {
            let mut simulation = super::measure::start(scene)?;
            // The slip v − ω R decreases by 7/2 μ g dt per step, and in the last step to 0.
            let slip = |state: &crate::body::State| state.v.x - 0.5 * state.omega.y;
            let (mut before, mut slid) = (slip(&simulation.states()[1]), 0.0);
            for _ in 0..(time / scene.step.dt).round() as usize {
                let now = slip(&simulation.step().ok()?.states[1]);
                slid += (before - now) / (3.5 * ball.friction * ball.gravity);
                before = now;
            }
            let state = simulation.states()[1];
            Some(vec![state.v.x, slid, state.pose.p.x])
        }));
    }
    Ok(rows)
}

/// Twenty-five balls on a pushed box: relative to the box they roll backwards.
pub(super) fn balls(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("rolling-balls", "rolling_balls", size)?;
    case.scene.step.dt = 0.02;
    let known_as = PushedBox {
        push: 150.0,
        mass: 10.0,
        balls: 25.0,
        ball_mass: 1.0,
        friction: 0.4,
        gravity: -case.scene.gravity.z,
    };
    let time = 0.08;
    let formulas = ["\\frac{F - \\mu (M + n m) g}{M + \\tfrac27 n m}", "\\tfrac27 a"];
    let mut rows = Vec::new();
    for level in LEVELS {
        let known = vec![
            Known::exact(
                SUMMED,
                "acceleration of the box",
                formulas[0],
                "m/s²",
                known_as.acceleration(),
            ),
            Known::exact(
                SUMMED,
                "acceleration of a ball",
                formulas[1],
                "m/s²",
                known_as.acceleration_of_ball(),
            ),
        ];
        rows.extend(case.rows(level, known, |scene| {
            let states = last(scene, time)?.states;
            Some(vec![states[1].v.x / time, states[2].v.x / time])
        }));
    }
    Ok(rows)
}

/// A solid cylinder and a thin disk that roll down 10° with ⅔ g sin θ, on a plane and on a box.
pub(super) fn cylinder(size: Size) -> Result<Vec<Row>> {
    let (time, angle) = (0.5, 10f64.to_radians());
    let expected = 2.0 / 3.0 * 9.81 * libm::sin(angle) * time;
    let grounds = [
        ("plane", "shape = { plane = [0, 0, 1] }"),
        ("box", "shape = { box = [9, 9, 1] }\nposition = [0, 0, -0.5]"),
    ];
    let mut rows = Vec::new();
    for (ground, fields) in grounds {
        for (body, length) in [("cylinder", 0.4), ("disk", 0.01)] {
            let text = format!(
                "tilt = {{ y = 10 }}\ncontact.friction = 0.5\n[[bodies]]\nname = \"ground\"\n\
                 fixed = true\n{fields}\n[[bodies]]\nname = \"round\"\nmass = 1\n\
                 shape = {{ cylinder = {{ length = {length}, radius = 0.2 }} }}\n\
                 position = [0, 0, 0.2]\nrotation = {{ x = 90 }}\n"
            );
            let scene = Scene::from_toml(&format!("{body}-on-{ground}"), &text)?;
            let case = Case::of("rolling-cylinder", scene, size);
            for level in LEVELS {
                let what = format!("speed of the {body} on a {ground} after 0.5 s");
                let formula = "\\tfrac23 g\\sin\\theta\\,t";
                let known = vec![Known::exact(SUMMED, what, formula, "m/s", expected)];
                rows.extend(
                    case.rows(level, known, |scene| Some(vec![last(scene, time)?.states[1].v.x])),
                );
            }
        }
    }
    Ok(rows)
}
