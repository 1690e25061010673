//! Numbers that are known without a computer, beside what the program measures.

use serde::{Deserialize, Serialize};

use super::{STEPPER, at_level, problem_of, scene_options, step_of};
use crate::constraint::Kind;
use crate::error::Result;
use crate::formulation::Stage;
use crate::scene::{Formulation, Scene};
use crate::simulation::{Simulation, Step};
use crate::solver::{Start, by_name};

/// One number, known and measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClosedForm {
    /// The scene.
    pub scene: String,
    /// The level.
    pub formulation: String,
    /// What is measured.
    pub quantity: String,
    /// The formula, as LaTeX.
    pub formula: String,
    /// The unit.
    pub unit: String,
    /// The value of the formula.
    pub expected: f64,
    /// What the program finds; NaN if it finds nothing.
    #[serde(with = "crate::report::results::number")]
    pub measured: f64,
    /// The largest |measured − expected| / |expected| (or the largest |measured| where 0 is
    /// expected) that passes, and why it is not smaller.
    pub tolerance: f64,
    /// Why the tolerance is what it is.
    pub because: String,
}

impl ClosedForm {
    /// |measured − expected| / |expected|, or |measured| where 0 is expected.
    pub fn error(&self) -> f64 {
        let scale = if self.expected == 0.0 { 1.0 } else { self.expected.abs() };
        (self.measured - self.expected).abs() / scale
    }

    /// Whether the number is as it should be.
    pub fn passes(&self) -> bool {
        self.error() <= self.tolerance
    }
}

/// All of them.
///
/// # Errors
/// None for the shipped scenes.
pub fn run() -> Result<Vec<ClosedForm>> {
    let mut rows = Vec::new();
    for level in Formulation::LEVELS {
        rows.extend(figure_6(level)?);
        rows.extend(figure_7(level)?);
        rows.extend(stack(level)?);
        rows.extend(incline(level)?);
        rows.extend(pendulum_period(level)?);
    }
    rows.extend(pendulum_tension()?);
    Ok(rows)
}

const ROUNDING: (f64, &str) = (1e-9, "rounding and the solver's tolerance");

fn load(name: &str, level: Formulation) -> Result<Scene> {
    Ok(at_level(&Scene::load(name)?, level))
}

/// x of all normal rows in the step's first LCP, by its own unit.
fn normals(step: &Step) -> Vec<f64> {
    let solve = &step.solves[0];
    let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
    rows.filter(|(row, _)| row.kind == Kind::Normal).map(|(_, x)| *x).collect()
}

fn row(
    scene: &Scene,
    (quantity, formula, unit): (&str, &str, &str),
    (expected, measured): (f64, f64),
    (tolerance, because): (f64, &str),
) -> ClosedForm {
    ClosedForm {
        scene: scene.name.clone(),
        formulation: scene.step.formulation.name().into(),
        quantity: quantity.into(),
        formula: formula.into(),
        unit: unit.into(),
        expected,
        measured,
        tolerance,
        because: because.into(),
    }
}

/// The blow that stops the body; at acceleration level the impact alone, the weight comes after.
fn figure_6(level: Formulation) -> Result<Vec<ClosedForm>> {
    let scene = load("fig6", level)?;
    let found = step_of(&scene, 1).map_or(f64::NAN, |step| normals(&step)[0]);
    let (what, expected) = match level {
        Formulation::Acceleration => (("impulse of the impact", "m\\,v", "N s"), 1.0),
        _ => (("impulse of the ground", "m\\,(v + g\\,\\Delta t)", "N s"), 2.0),
    };
    Ok(vec![row(&scene, what, (expected, found), ROUNDING)])
}

/// The three impulses of the stack that is hit, and their sum with the weights.
fn figure_7(level: Formulation) -> Result<Vec<ClosedForm>> {
    let scene = load("fig7", level)?;
    let found = step_of(&scene, 1).map_or(vec![f64::NAN; 3], |step| normals(&step));
    let (formula, expected) = match level {
        Formulation::Acceleration => ("(1,1,0)_k", [1.0, 1.0, 0.0]),
        _ => ("\\Delta t\\,g\\,(3,2,1)_k + (1,1,0)_k", [4.0, 3.0, 1.0]),
    };
    let names = ["ground on bottom", "bottom on middle", "middle on top"];
    let entry = |k: usize| {
        let what = format!("impulse, {}", names[k]);
        let measured = found.get(k).copied().unwrap_or(f64::NAN);
        row(&scene, (&what, formula, "N s"), (expected[k], measured), ROUNDING)
    };
    Ok((0..3).map(entry).collect())
}

/// Each layer carries the weight above it.
fn stack(level: Formulation) -> Result<Vec<ClosedForm>> {
    let scene = load("stack", level)?;
    let Some(problem) = problem_of(&scene, 1) else { return Ok(Vec::new()) };
    let mut options = scene_options(&scene);
    options.settings.tolerance = 1e-12;
    let x = by_name(STEPPER, &options)?.solve(&problem.lcp, &Start::default(), &mut ()).x;
    let weight = -scene.gravity.z * scene.bodies.last().map_or(0.0, |body| body.mass.mass());
    let dt = match problem.stage {
        Stage::Acceleration => 1.0,
        _ => scene.step.dt,
    };
    let layers = scene.bodies.len() - 1;
    let carried = |layer: usize| -> f64 {
        let rows = problem.assembly.rows.iter().zip(&x);
        let of_layer = rows.filter(|(row, _)| {
            row.kind == Kind::Normal && row.bodies.contains(&Some(layer + 1)) // body 0 is the ground
                && (layer + 1..=layers).all(|above| above == layer + 1 || !row.bodies.contains(&Some(above)))
        });
        of_layer.map(|(_, x)| *x).sum()
    };
    let entry = |layer: usize| {
        let what = format!("sum of normal x under box {}", layer + 1);
        let unit = problem.stage.unit(false);
        let formula =
            if dt == 1.0 { "(n - k + 1)\\,m\\,g" } else { "(n - k + 1)\\,m\\,g\\,\\Delta t" };
        let expected = (layers - layer) as f64 * weight * dt;
        row(&scene, (&what, formula, unit), (expected, carried(layer)), ROUNDING)
    };
    Ok((0..layers).map(entry).collect())
}

/// The box slides with g (sin θ − μ cos θ), and stays where it is for μ > tan θ.
fn incline(level: Formulation) -> Result<Vec<ClosedForm>> {
    let mut scene = load("incline", level)?;
    let angle = 20f64.to_radians();
    let (mu, g) = (scene.contact.friction, -scene.gravity.z);
    let speed = |scene: &Scene| {
        let end = step_of(scene, scene.step.count).and_then(|step| step.states.last().copied());
        end.map_or(f64::NAN, |state| state.v.norm())
    };
    let time = scene.step.dt * scene.step.count as f64;
    let slides = row(
        &scene,
        ("acceleration down the slope", "g\\,(\\sin\\theta - \\mu\\cos\\theta)", "m/s²"),
        (g * (angle.sin() - mu * angle.cos()), speed(&scene) / time),
        (1e-6, "the solver's tolerance, summed over the steps"),
    );
    scene = with_friction(&scene, 1.01 * angle.tan());
    let stays = row(
        &scene,
        ("speed after 1 s with μ 1 % above tan θ", "0", "m/s"),
        (0.0, speed(&scene)),
        (1e-6, "the solver's tolerance, summed over the steps"),
    );
    Ok(vec![slides, stays])
}

fn with_friction(scene: &Scene, friction: f64) -> Scene {
    let mut scene = scene.clone();
    scene.contact.friction = friction;
    for body in &mut scene.bodies {
        body.friction = friction;
    }
    scene
}

/// The period at 90 degrees, by the arithmetic-geometric mean: T = 2π √(l/g) / agm(1, cos(φ₀/2)).
fn pendulum_period(level: Formulation) -> Result<Vec<ClosedForm>> {
    let mut scene = load("pendulum", level)?;
    scene.step.dt /= 4.0;
    let g = -scene.gravity.z;
    let (mut a, mut b) = (1.0, 45f64.to_radians().cos());
    for _ in 0..6 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    let expected = 2.0 * std::f64::consts::PI / g.sqrt() / a;
    let measured = swing_period(&scene, 1.5 * expected).unwrap_or(f64::NAN);
    let what = ("period at 90°", "2\\pi\\sqrt{l/g}\\,/\\,\\mathrm{agm}(1, \\cos 45°)", "s");
    Ok(vec![row(&scene, what, (expected, measured), (3e-4, "second order in the step of 2.5 ms"))])
}

/// The time between two passages through the lowest point from right to left.
fn swing_period(scene: &Scene, limit: f64) -> Option<f64> {
    let solver = by_name(STEPPER, &scene_options(scene)).ok()?;
    let mut simulation = Simulation::new(scene.clone(), solver);
    let angle = |p: &nalgebra::Vector3<f64>| p.x.atan2(-p.z);
    let (mut before, mut first) = (simulation.states()[0].pose.p, None);
    while simulation.time() < limit {
        let now = simulation.step().ok()?.states[0].pose.p;
        if before.x > 0.0 && now.x <= 0.0 && now.z < 0.0 {
            let part = angle(&now) / (angle(&now) - angle(&before));
            let passage = simulation.time() - part * scene.step.dt;
            match first {
                None => first = Some(passage),
                Some(first) => return Some(passage - first),
            }
        }
        before = now;
    }
    None
}

/// The rod's force at every instant is m (g cos φ + l ω²): exact at acceleration level.
fn pendulum_tension() -> Result<Vec<ClosedForm>> {
    let mut scene = load("pendulum", Formulation::Acceleration)?;
    scene.step.alpha = 0.0;
    let g = -scene.gravity.z;
    let (angle, rate) = (0.7f64, 1.3);
    let state = &mut scene.states[0];
    state.pose.p = nalgebra::Vector3::new(angle.sin(), 0.0, -angle.cos());
    state.v = rate * nalgebra::Vector3::new(angle.cos(), 0.0, angle.sin());
    let solve = step_of(&scene, 1).map(|step| step.solves[0].solution.x[0]);
    let what =
        ("force of the rod at φ = 0.7, ω = 1.3/s", "-m\\,(g\\cos\\varphi + l\\,\\omega^2)", "N");
    let expected = -(g * angle.cos() + rate * rate);
    Ok(vec![row(&scene, what, (expected, solve.unwrap_or(f64::NAN)), ROUNDING)])
}
