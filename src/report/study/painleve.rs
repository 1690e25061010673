//! Painlevé's rod by its friction: where forces have no answer, and what impulses do there.
//!
//! A rod slides with its lower end ahead. The end's normal acceleration by a normal force f with its friction
//! μ f, in the plane, r being the end from the rod's middle and n the normal:
//!
//! ```text
//! a_n = A f,   A = 1/m + (r_x (r_x + μ r_z))/I        r_x > 0 ahead, r_z < 0 below
//! ```
//!
//! At μ* = (I/m + r_x²)/(−r_x r_z) it is 0; beyond, to press is to be pressed harder, and no force stops the end
//! from sinking in.

use crate::simulation::Simulation;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::body::{Mass, Shape};
use crate::constraint::Kind;
use crate::error::{Error, Result};
use crate::scene::{Scene, Scheme};
use crate::simulation::Cause;

/// The rod with several coefficients of friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The coefficients.
    pub frictions: Vec<f64>,
}

/// One coefficient.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// μ.
    pub mu: f64,
    /// μ*, at which A is 0.
    pub critical: f64,
    /// m A.
    pub mobility: f64,
    /// The impulse of the first step by geometry, in weights times dt: 1/(m A) while the end slides through the step, at
    /// most what ends its slip.
    pub expected: f64,
    /// What the first step answers at acceleration level.
    pub forces: Forces,
    /// The normal impulse of the first step at velocity level, in weights times dt.
    pub impulse: f64,
    /// The rod's speed along the ground after that step, in parts of that before.
    pub speed: f64,
}

/// What a step with forces answers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Forces {
    /// A normal force, in weights.
    Found(f64),
    /// It is proved that there is none.
    Impossible,
    /// It failed in another way.
    Failed(String),
}

/// Half the width of the rod (m).
const BLADE: f64 = 1e-6;

/// The rod of the scene, as narrow as a blade: of a wide one either lower corner may carry all, and the answer would not
/// be unique.
fn rod(mu: f64, scheme: Scheme) -> Result<Scene> {
    let mut scene = Scene::load("painleve")?;
    for body in &mut scene.bodies {
        if let Shape::Box { half } = &mut body.shape {
            half.y = BLADE;
        }
    }
    scene.step.scheme = scheme;
    scene.contact.friction = mu;
    scene.bodies.iter_mut().for_each(|body| body.friction = mu);
    scene.validate()?;
    Ok(scene)
}

/// m A, μ*, and the impulse of a step in weights times dt. With the end at r from the middle, x ahead and z up,
///
/// ```text
/// slides:  m A f = m g,                 m A = 1 + (m/I) r_x (r_x + μ r_z)
/// stops:   [ 1 + (m/I) r_x²    −(m/I) r_x r_z ] [f_n]         [ g dt ]
///          [ −(m/I) r_x r_z    1 + (m/I) r_z² ] [f_t] dt = m  [ −v   ]
/// ```
fn by_geometry(scene: &Scene, mu: f64) -> Result<[f64; 3]> {
    let Mass::Rigid { mass, moments } = scene.bodies[1].mass else {
        return Err(Error::invalid("painleve", "bodies[1]", "is no rigid body"));
    };
    let Shape::Box { half } = scene.bodies[1].shape else {
        return Err(Error::invalid("painleve", "bodies[1]", "is no box"));
    };
    let turn = scene.states[1].pose.q;
    let ends = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let corners = ends.map(|[x, z]| turn * nalgebra::Vector3::new(x * half.x, 0.0, z * half.z));
    let lowest = corners.into_iter().min_by(|a, b| a.z.total_cmp(&b.z));
    let r = lowest.unwrap_or_default();
    let inertia = moments.y / mass;
    let ahead = r.x * scene.states[1].v.x.signum();
    let mobility = 1.0 + ahead * (ahead + mu * r.z) / inertia;
    let critical = (inertia + ahead * ahead) / (-ahead * r.z);
    let [normal, coupling, tangent] =
        [ahead * ahead, -ahead * r.z, r.z * r.z].map(|product| product / inertia);
    let slip = scene.states[1].v.x.abs() / (scene.gravity.norm() * scene.step.dt);
    let determinant = (1.0 + normal) * (1.0 + tangent) - coupling * coupling;
    let stops = (1.0 + tangent + slip * coupling) / determinant;
    let slides = if mobility > 0.0 { 1.0 / mobility } else { f64::INFINITY };
    Ok([mobility, critical, f64::min(slides, stops)])
}

fn measure(mu: f64) -> Result<Finding> {
    let scene = rod(mu, Scheme::Acceleration)?;
    let weight = scene.gravity.norm() * scene.bodies[1].mass.mass();
    let [mobility, critical, expected] = by_geometry(&scene, mu)?;
    let normal = |step: &crate::simulation::Step| {
        let solve = step.solves.last()?;
        let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
        let normals = rows.filter(|(row, _)| row.kind == Kind::Normal);
        Some(normals.map(|(_, x)| x).sum::<f64>())
    };
    let forces = match Simulation::of(&scene)?.step() {
        Ok(step) => Forces::Found(normal(&step).unwrap_or(0.0) / weight),
        Err(failure) if matches!(failure.cause, Cause::NoSolution { .. }) => Forces::Impossible,
        Err(failure) => Forces::Failed(failure.to_string()),
    };
    let scene = rod(mu, Scheme::Velocity)?;
    let before = scene.states[1].v.x;
    let step = Simulation::of(&scene)?.step();
    let step = step.map_err(|f| Error::invalid("painleve", "velocity level", f.to_string()))?;
    Ok(Finding {
        mu,
        critical,
        mobility,
        expected,
        forces,
        impulse: normal(&step).unwrap_or(0.0) / (weight * scene.step.dt),
        speed: step.states[1].v.x / before,
    })
}

impl Study for Plan {
    const NAME: &'static str = "painleve";
    type Finding = Vec<Finding>;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec!["painleve".into()]
    }

    fn run(&self, _: usize) -> Result<(Vec<Finding>, ())> {
        let findings: Result<_> = self.frictions.par_iter().map(|&mu| measure(mu)).collect();
        Ok((findings?, ()))
    }
}
