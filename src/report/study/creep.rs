//! Friction that needs slip: a box that should stick creeps down its slope.
//!
//! The penalty method rubs with −d v at each contact, up to μ N. So n contacts hold the pull W sin θ of
//! a box only while it moves:
//!
//! ```text
//! n d v = W sin θ,   and with ε = μ N/d, the slip at which a contact holds all it can (N = W cos θ/n):
//! v = W sin θ/(n d) = ε tan θ/μ
//! ```
//!
//! It never comes to rest, however long the simulation or short the step. Schemes whose friction is a row of
//! an LCP have v = 0.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Study, history};
use crate::error::Result;
use crate::scene::{Scene, Scheme};

/// The box of the scene "incline", rough enough to stick.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// μ between box and slope, above the slope's tangent.
    pub friction: f64,
    /// Dampings d of the penalty method (N s/m).
    pub dampings: Vec<f64>,
    /// Simulated time (s).
    pub duration: f64,
}

/// How fast the box creeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The scheme.
    pub scheme: String,
    /// d (N s/m), of the penalty method.
    pub damping: Option<f64>,
    /// ε (m/s), of the penalty method.
    pub smoothing: Option<f64>,
    /// Its speed down the slope at the end (m/s).
    pub speed: f64,
    /// By the formula (m/s).
    pub expected: f64,
    /// Why it ended early, if it did.
    pub ending: Option<String>,
}

/// Corners that carry the box.
const CONTACTS: f64 = 4.0;

impl Plan {
    fn runs(&self) -> Vec<(Scheme, Option<f64>)> {
        let penalties = self.dampings.iter().map(|&d| (Scheme::Penalty, Some(d)));
        let others = Scheme::ALL.into_iter().filter(|f| *f != Scheme::Penalty);
        penalties.chain(others.map(|scheme| (scheme, None))).collect()
    }

    fn creep(&self, (scheme, damping): (Scheme, Option<f64>)) -> Result<Finding> {
        let mut scene = Scene::load("incline")?;
        scene.step.scheme = scheme;
        scene.contact.friction = self.friction;
        scene.bodies.iter_mut().for_each(|body| body.friction = self.friction);
        scene.step.penalty.damping = damping.unwrap_or(scene.step.penalty.damping);
        scene.validate()?;
        let down = scene.states[0].pose.q * nalgebra::Vector3::x();
        let weight = scene.gravity.norm() * scene.bodies[1].mass.mass();
        let (along, normal) = (-down.z * weight, down.x * weight / CONTACTS);
        let mut speed = 0.0;
        let history =
            history::run(&scene, self.duration, |step| speed = step.states[1].v.dot(&down))?;
        Ok(Finding {
            scheme: scheme.name().into(),
            damping,
            smoothing: damping.map(|d| self.friction * normal / d),
            speed,
            expected: damping.map_or(0.0, |d| along / (CONTACTS * d)),
            ending: history.ending,
        })
    }
}

impl Study for Plan {
    const NAME: &'static str = "creep";
    type Finding = Vec<Finding>;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec!["incline".into()]
    }

    fn run(&self, _: usize) -> Result<(Vec<Finding>, ())> {
        let findings: Result<_> = self.runs().par_iter().map(|&run| self.creep(run)).collect();
        Ok((findings?, ()))
    }
}
