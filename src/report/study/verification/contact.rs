//! Bodies that land, support each other, slide and stick.

use super::measure::{Case, Known, Method, first, last, start};
use super::{Row, Size};
use crate::constraint::Kind;
use crate::error::Result;
use crate::formulation::Stage;
use crate::scene::Scene;
use crate::scene::catalogue::ladder::Ladder;
use crate::simulation::Step;

const LEVELS: [Method; 2] = [Method::Velocity, Method::Acceleration];
const SOLVED: (f64, &str) = (1e-9, "rounding and the tolerance of the solver");
const SUMMED: (f64, &str) = (1e-6, "the tolerance of the solver, accumulated over the steps");
/// The tolerance where a gap with a rounding error closes within a step.
const RESTS: (f64, &str) =
    (1e-7, "the gap has a rounding error, and removing it within one step changes the velocity");

/// x of all normal rows of a step's first LCP.
fn normals(step: &Step) -> Vec<f64> {
    let solve = &step.solves[0];
    let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
    rows.filter(|(row, _)| row.kind == Kind::Normal).map(|(_, x)| *x).collect()
}

/// The chapter's Figures 6 and 7: impacts that stop one body, and a stack whose middle is hit.
pub(super) fn landing(size: Size) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for level in LEVELS {
        // The weight's part is m g dt: the impact is what remains at any step length.
        let weight = |scene: &Scene| match level {
            Method::Velocity => scene.step.dt,
            _ => 0.0,
        };
        let what = "impulse of the ground";
        let known = vec![Known::exact(SOLVED, what, "m\\,v", "N s", 1.0)];
        let one = Case::load("landing", "fig6", size)?;
        rows.extend(
            one.rows(level, known, |scene| Some(vec![normals(&first(scene)?)[0] - weight(scene)])),
        );
        let names = ["ground on bottom", "bottom on middle", "middle on top"];
        let impulses = names.iter().zip([1.0, 1.0, 0.0]).map(|(name, impulse)| {
            let formula = "(1, 1, 0)_k\\,m\\,v";
            Known::exact(SOLVED, format!("impulse, {name}"), formula, "N s", impulse)
        });
        let three = Case::load("landing", "fig7", size)?;
        rows.extend(three.rows(level, impulses.collect(), |scene| {
            let x = normals(&first(scene)?);
            Some((0..3).map(|k| x[k] - (3 - k) as f64 * weight(scene)).collect())
        }));
    }
    Ok(rows)
}

/// Each layer supports the weight above it.
pub(super) fn stack(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("stack", "stack", size)?;
    let weight = -case.scene.gravity.z * case.scene.bodies.last().map_or(0.0, |b| b.mass.mass());
    let layers = case.scene.bodies.len() - 1;
    let mut rows = Vec::new();
    for level in LEVELS {
        let known = (0..layers).map(|layer| {
            let formula = "(n - k + 1)\\,m\\,g";
            let what = format!("force under box {}", layer + 1);
            Known::exact(SOLVED, what, formula, "N", (layers - layer) as f64 * weight)
        });
        rows.extend(case.rows(level, known.collect(), |scene| {
            let step = first(scene)?;
            Some((1..=layers).map(|box_| carried(scene, &step, box_)).collect())
        }));
    }
    Ok(rows)
}

/// The sum of the normal forces (N) under a box; body 0 is the ground.
fn carried(scene: &Scene, step: &Step, body: usize) -> f64 {
    let Some(solve) = step.solves.last() else { return f64::NAN };
    let unit = if solve.problem.stage == Stage::Acceleration { 1.0 } else { scene.step.dt };
    let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
    let under = |bodies: [Option<usize>; 2]| bodies.into_iter().flatten().max() == Some(body);
    let below = rows.filter(|(row, _)| row.kind == Kind::Normal && under(row.bodies));
    below.map(|(_, x)| *x).sum::<f64>() / unit
}

/// The box slides with g (sin θ − μ cos θ), and does not move for μ > tan θ.
pub(super) fn incline(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("incline", "incline", size)?;
    let angle = 20f64.to_radians();
    let (mu, g) = (case.scene.contact.friction, -case.scene.gravity.z);
    let time = 0.25;
    let speed = |scene: &Scene| Some(last(scene, time)?.states.last()?.v.norm());
    let slides = "g\\,(\\sin\\theta - \\mu\\cos\\theta)";
    let expected = g * (angle.sin() - mu * angle.cos());
    let mut rows = Vec::new();
    for level in LEVELS {
        let known =
            vec![Known::exact(SUMMED, "acceleration down the incline", slides, "m/s²", expected)];
        rows.extend(case.rows(level, known, |scene| Some(vec![speed(scene)? / time])));
    }
    rub(&mut case.scene, 1.01 * angle.tan());
    for level in LEVELS {
        let what = "speed after 0.25 s with μ 1 % above tan θ";
        let known = vec![Known::exact(SUMMED, what, "0", "m/s", 0.0)];
        rows.extend(case.rows(level, known, |scene| Some(vec![speed(scene)?])));
    }
    Ok(rows)
}

fn rub(scene: &mut Scene, friction: f64) {
    scene.contact.friction = friction;
    scene.bodies.iter_mut().for_each(|body| body.friction = friction);
}

/// The force of the wall; whether the ladder holds 1 % above the critical friction; and its initial
/// acceleration at nine tenths of it.
pub(super) fn ladder(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("ladder", "ladder", size)?;
    let (floor, ladder) = (0, 2);
    let g = -case.scene.gravity.z;
    let known_as =
        Ladder { mass: 10.0, length: 4.0, radius: 0.05, angle: std::f64::consts::PI / 3.0 };
    let mut rows = Vec::new();
    let pushes = "\\frac{m\\,g\\,L\\cos\\theta}{2 (L\\sin\\theta + r)}";
    for level in LEVELS {
        let known = vec![
            Known::exact(SOLVED, "force of the wall", pushes, "N", known_as.push_of_wall(g)),
            Known::exact(RESTS, "speed after 0.1 s, μ 1 % above critical", "0", "m/s", 0.0),
        ];
        rows.extend(case.rows(level, known, |scene| {
            let step = first(scene)?;
            let solve = step.solves.last()?;
            let unit = if level == Method::Velocity { scene.step.dt } else { 1.0 };
            let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
            let wall = rows
                .filter(|(row, _)| row.kind == Kind::Normal && !row.bodies.contains(&Some(floor)));
            let push = wall.map(|(_, x)| *x).sum::<f64>() / unit;
            Some(vec![push, last(scene, 0.1)?.states[ladder].v.norm()])
        }));
    }
    let mut slippery = case;
    let mu = 0.9 * known_as.push_of_wall(g) / (known_as.mass * g);
    slippery.scene.bodies[floor].friction = mu;
    slippery.scene.bodies[ladder].friction = mu;
    let turns = "\\frac{m\\,g\\,\\tau}{I + m L^2/4 - \\tfrac12 m L\\cos\\theta\\,\\mu(L\\sin\\theta + r)},\\ \\tau = \
         \\mu(L\\sin\\theta + r) - \\tfrac12 L\\cos\\theta";
    let moment = match slippery.scene.bodies[ladder].mass {
        crate::body::Mass::Rigid { moments, .. } => moments.y,
        _ => f64::NAN,
    };
    for level in LEVELS {
        let what = "initial θ'', μ 10 % below critical";
        let expected = known_as.angular_acceleration(g, mu, moment);
        let known = vec![Known::exact(RESTS, what, turns, "rad/s²", expected)];
        rows.extend(slippery.rows(level, known, |scene| {
            let mut simulation = start(scene)?;
            let omega = simulation.step().ok()?.states[ladder].omega.y;
            // θ grows with the rotation about +y.
            Some(vec![omega / scene.step.dt])
        }));
    }
    Ok(rows)
}
