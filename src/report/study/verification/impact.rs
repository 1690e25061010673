//! Impacts with restitution.

use super::measure::{Case, Known, Method, ROUNDING, start};
use super::{Row, Size};
use crate::error::Result;
use crate::scene::catalogue::bounce::{Drop, chain_of_three};

/// A ball falls from rest and bounces with e = 1/2: heights e² and e⁴ of the first. The fall time T
/// is a whole number of steps, and so is each flight after it, 2 e T and 2 e² T: with integrators
/// of second order and above the ball touches the ground up to rounding. Semi-implicit Euler is one
/// step too low, and of first order.
pub(super) fn bouncing(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("bouncing-ball", "bouncing_ball", size)?;
    let radius = 0.1;
    let (e, z0) = (case.scene.contact.restitution, case.scene.states[1].pose.p.z - radius);
    let drop = Drop { height: z0, restitution: e, gravity: -case.scene.gravity.z };
    let formula = "e^{2k} h";
    let times = "T (1 + 2 (e + \\dots + e^{k-1}))";
    let mut rows = Vec::new();
    for method in [Method::Velocity, Method::Midpoint, Method::Rk4] {
        let quantity = |what: &str, formula, unit, value| match method {
            Method::Velocity => Known::order(1.0, what, formula, unit, value),
            _ => Known::exact(ROUNDING, what, formula, unit, value),
        };
        let mut known = vec![
            quantity("height after one bounce", formula, "m", drop.height_after(1)),
            quantity("height after two bounces", formula, "m", drop.height_after(2)),
        ];
        if method != Method::Velocity {
            known.push(quantity("time of the third bounce", times, "s", drop.time_of(3)));
        }
        rows.extend(case.rows(method, known, |scene| {
            let mut simulation = start(scene)?;
            // Between two bounces the ball reaches the greatest height of that flight.
            let (mut heights, mut third, mut bounces) = ([0.0f64; 3], f64::NAN, 0);
            let end = drop.time_of(3) + 0.05;
            while simulation.time() < end && bounces < 3 {
                let before = simulation.states()[1].v.z;
                let begin = simulation.time();
                let state = simulation.step().ok()?.states[1];
                if before < 0.0 && state.v.z > 0.0 {
                    bounces += 1;
                    third = begin;
                }
                if bounces < 3 {
                    heights[bounces] = heights[bounces].max(state.pose.p.z - radius);
                }
            }
            Some(vec![heights[1], heights[2], if bounces == 3 { third } else { f64::NAN }])
        }));
    }
    Ok(rows)
}

/// Balls with gaps hit each other one after the other, and the last one leaves with v. Three balls
/// in contact are one LCP, in which all pairs that press and approach bounce at once: a different
/// result, which follows from the law of restitution and not from Newton's cradle.
pub(super) fn cradle(size: Size) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    let speeds = |scene: &crate::scene::Scene| {
        let mut simulation = start(scene)?;
        for _ in 0..(0.2 / scene.step.dt).round() as usize {
            simulation.step().ok()?;
        }
        Some(simulation.states().iter().map(|state| state.v.x).collect::<Vec<f64>>())
    };
    for method in [Method::Velocity, Method::Acceleration, Method::Rk4] {
        let case = Case::load("cradle", "cradle", size)?;
        let last = case.scene.bodies.len() - 1;
        let known = (0..=last).map(|k| {
            let formula = "(0, 0, 0, 0, 1)_k\\,v";
            let value = if k == last { 1.0 } else { 0.0 };
            Known::exact(ROUNDING, format!("speed of ball {}", k + 1), formula, "m/s", value)
        });
        rows.extend(case.rows(method, known.collect(), speeds));
        let case = Case::load("cradle", "cradle_touching", size)?;
        let known = chain_of_three(1.0, 1.0).into_iter().enumerate().map(|(k, value)| {
            let formula = "(1 - 2e,\\ 1 + e,\\ 1 + e)_k\\,v/3";
            Known::exact(
                ROUNDING,
                format!("speed of touching ball {}", k + 1),
                formula,
                "m/s",
                value,
            )
        });
        rows.extend(case.rows(method, known.collect(), speeds));
    }
    Ok(rows)
}
