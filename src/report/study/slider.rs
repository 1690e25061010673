//! The shipped scene "sliding" under each friction model: the path of the block, and where geometry
//! predicts that it stops.
//!
//! Friction is the corner of the model's figure that is nearest to the direction of the slip. The
//! slip therefore turns away from that corner until it has turned to the middle of an edge; from
//! there on the friction is between the two corners of the edge, and the block moves straight:
//!
//! ```text
//! a = r μ g,   β = half the angle of an edge,   ψ = from its middle to the slip at the start
//! t = v sin ψ/(a sin β)                           duration of the turning
//! (v cos ψ) t − a cos β t²/2 + u²/(2 a cos β)     along the middle,   u = v cos ψ − a cos β t
//! (v sin ψ) t − a sin β t²/2                      across it
//! ```
//!
//! On the disk it moves straight from the start, for v²/(2 μ g). If sliding bodies float in a
//! model, the block starts at the floating height dt μ v: from the floor it would be thrown up.

use crate::report::study::tally::Tally;
use crate::simulation::{Simulation, Solve};
use std::f64::consts::TAU;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::sliding::Figure;
use crate::error::Result;
use crate::judge::Demand;
use crate::lcp::friction::Model;
use crate::scene::Scene;

/// The duration of a step (s).
pub const DT: f64 = 0.005;
/// The step after which the gap is measured, while the block still slides.
const FLOATING: usize = 20;
/// The interval, in steps, between recorded positions.
const KEPT: usize = 4;

/// The path of a block over the floor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// The model.
    pub model: Model,
    /// The solver of the steps' problems.
    pub solver: String,
    /// The number of problems.
    pub problems: usize,
    /// The number of answers that the judge accepts.
    pub accepted: usize,
    /// The positions x, y (m) at a fixed interval of steps, from the start on.
    pub points: Vec<[f64; 2]>,
    /// Where it stops (m).
    pub stop: [f64; 2],
    /// The theoretical position (m), up to the error of the steps.
    pub expected: [f64; 2],
    /// The distance traveled in the first step (m): the size of that error.
    pub travel: f64,
    /// The gap under it while it slides (m).
    pub gap: f64,
    /// dt μ |v| if sliding bodies float in its model, otherwise 0 (m).
    pub expected_gap: f64,
}

/// The block under each model with this coefficient of friction.
///
/// # Errors
/// If the scene cannot be stepped with it.
pub fn run(mu: f64) -> Result<Vec<Path>> {
    Model::ALL.par_iter().map(|&model| path(model, mu)).collect()
}

fn path(model: Model, mu: f64) -> Result<Path> {
    let mut scene = Scene::load("sliding")?;
    scene.contact.model = model;
    scene.step.dt = DT;
    for body in &mut scene.bodies {
        body.friction = mu;
    }
    let (start, v) = (scene.states[1].pose.p, scene.states[1].v);
    let (speed, angle) = (v.norm(), v.y.atan2(v.x));
    let floats = if model == Model::AssociatedCone { DT * mu } else { 0.0 };
    scene.states[1].pose.p.z += floats * speed;
    scene.validate()?;
    let mu_g = mu * scene.gravity.norm();
    // Friction with a polygon decelerates by at least μ g/√2.
    let steps = (1.5 * speed / (mu_g * DT)).ceil() as usize;
    let mut simulation = Simulation::of(&scene)?;
    let mut path = Path {
        model,
        solver: String::new(),
        problems: 0,
        accepted: 0,
        points: vec![[start.x, start.y]],
        stop: [start.x, start.y],
        expected: stop(Figure::of(model), speed, angle, mu_g),
        travel: speed * DT,
        gap: 0.0,
        expected_gap: 0.0,
    };
    let mut tally = Tally::default();
    for number in 1..=steps {
        // The number of problems shows an early end.
        let Ok(step) = simulation.step() else { break };
        let named = |solve: &Solve, _: &_| path.solver = solve.solver.to_string();
        tally.add_step(&step, Demand::default().tolerance, named);
        let state = &step.states[1];
        path.stop = [state.pose.p.x, state.pose.p.y];
        if number % KEPT == 0 {
            path.points.push(path.stop);
        }
        if number == FLOATING {
            path.gap = state.pose.p.z - start.z;
            path.expected_gap = floats * state.v.xy().norm();
        }
    }
    (path.problems, path.accepted) = (tally.solves, tally.accepted);
    Ok(path)
}

/// Where a block that starts at the origin stops, with friction of at most μ g times the figure.
pub fn stop(figure: Figure, speed: f64, angle: f64, mu_g: f64) -> [f64; 2] {
    let Figure::Polygon { corners, radius, first } = figure else {
        let reach = speed * speed / (2.0 * mu_g);
        return [reach * angle.cos(), reach * angle.sin()];
    };
    let (a, beta) = (radius * mu_g, TAU / (2 * corners) as f64);
    let edge = ((angle - first) / (2.0 * beta)).floor();
    let middle = first + (2.0 * edge + 1.0) * beta;
    let (sin, cos) = (angle - middle).sin_cos();
    let side = sin.signum();
    let turning = speed * sin.abs() / (a * beta.sin());
    let rest = speed * cos - a * beta.cos() * turning;
    let along = turning * (speed * cos + rest) / 2.0 + rest * rest / (2.0 * a * beta.cos());
    let across = side * turning * speed * sin.abs() / 2.0;
    let (sin, cos) = middle.sin_cos();
    [along * cos - across * sin, along * sin + across * cos]
}
