//! Boxes on one ramp, from rough to smooth: who sticks, and how fast the others slide.
//!
//! ```text
//! a = max(0, g (sin θ − μ cos θ)),   μ = √(μ_ramp μ_box)
//! ```

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Table;

use super::footage::Way;
use super::variation::Variation;
use super::{Study, history};
use crate::error::{Error, Result};
use crate::scene::Scene;

/// A ramp with boxes, stepped in several ways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// A scene whose first body is a plane turned about y, the others boxes that rest on it.
    #[serde(default = "ramp")]
    pub scene: String,
    /// Fields of the scene that are changed in every run.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub change: Table,
    /// Simulated time (s).
    pub duration: f64,
    /// How it is stepped.
    pub ways: Vec<Way>,
    /// The names of those ways that may miss the formula, because their friction needs some slip
    /// before it holds or their sweeps end early; all others must keep it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub may_miss: Vec<String>,
}

fn ramp() -> String {
    "friction_ramp".into()
}

/// The boxes, stepped in one way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The way.
    pub name: String,
    /// The tangent of the ramp's angle.
    pub slope: f64,
    /// sin θ and cos θ times g (m/s²).
    pub pull: [f64; 2],
    /// The boxes.
    pub boxes: Vec<Slid>,
    /// Why it ended early, if it did.
    pub ending: Option<String>,
}

/// One box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slid {
    /// Its coefficient of friction with the ramp.
    pub mu: f64,
    /// Speed down the ramp at the end over the time (m/s²).
    pub acceleration: f64,
    /// By the formula (m/s²).
    pub expected: f64,
    /// Time (s) and speed down the ramp (m/s) at some instants.
    pub speeds: Vec<(f64, f64)>,
}

/// Instants that are kept.
const KEPT: usize = 25;

impl Plan {
    fn measure(&self, way: &Way) -> Result<Finding> {
        let scene = Variation::of(&self.scene, &self.change).and(&way.change).scene()?;
        let down = scene.states[0].pose.q * nalgebra::Vector3::x();
        let (sin, cos) = (-down.z, down.x);
        let g = scene.gravity.norm();
        let steps = (self.duration / scene.step.dt).round() as usize;
        let kept = crate::film::instants(steps, KEPT);
        let mut boxes: Vec<Slid> = (1..scene.bodies.len())
            .map(|k| {
                let mu = pair_friction(&scene, k);
                let expected = (g * (sin - mu * cos)).max(0.0);
                Slid { mu, acceleration: 0.0, expected, speeds: vec![(0.0, 0.0)] }
            })
            .collect();
        let history = history::run(&scene, self.duration, |step| {
            for (own, state) in boxes.iter_mut().zip(&step.states[1..]) {
                let speed = state.v.dot(&down);
                own.acceleration = speed / step.motion.time;
                if kept.binary_search(&step.number).is_ok() {
                    own.speeds.push((step.motion.time, speed));
                }
            }
        })?;
        let (name, ending) = (way.name.clone(), history.ending);
        Ok(Finding { name, slope: sin / cos, pull: [g * sin, g * cos], boxes, ending })
    }
}

/// The geometric mean of a body's friction and the ramp's.
fn pair_friction(scene: &Scene, body: usize) -> f64 {
    (scene.bodies[0].friction * scene.bodies[body].friction).sqrt()
}

impl Study for Plan {
    const NAME: &'static str = "ramp";
    type Finding = Vec<Finding>;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec![self.scene.clone()]
    }

    fn run(&self, _: usize) -> Result<(Vec<Finding>, ())> {
        let is_way = |name: &&String| self.ways.iter().any(|way| way.name == **name);
        if let Some(name) = self.may_miss.iter().find(|name| !is_way(name)) {
            let reason = format!("there is no way named {name:?}");
            return Err(Error::invalid("ramp", "may_miss", reason));
        }
        let findings: Result<_> = self.ways.par_iter().map(|way| self.measure(way)).collect();
        Ok((findings?, ()))
    }
}
