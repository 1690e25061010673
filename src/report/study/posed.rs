//! The LCPs of solver studies, as settings: a step of a scene, a problem file, a problem of the
//! library, or a stack with a heavy load on top. Of a stack also the weight that an answer
//! supports.

use crate::simulation;
use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::settings::{AtStep, first};
use crate::error::Result;
use crate::formulation::Problem;
use crate::lcp::{Lcp, library};
use crate::scene::Scene;

/// Gravity in the stacks (m/s²).
const GRAVITY: f64 = 9.81;
/// g dt (m/s): the speed that bodies gain in a step of 1/60 s.
pub const STEP_SPEED: f64 = GRAVITY / 60.0;

/// The source of an LCP.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, try_from = "Keys")]
#[schemars(!try_from)]
pub enum Source {
    /// A step of a scene, or a file.
    Scene(AtStep),
    /// A problem of the library.
    Family(OfFamily),
    /// Boxes with a load on top.
    Stack(Loaded),
}

/// The keys of all sources, so that a wrong key is reported with its line.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    #[serde(alias = "problem")]
    scene: Option<String>,
    step: Option<usize>,
    family: Option<String>,
    values: Option<BTreeMap<String, f64>>,
    boxes: Option<usize>,
    ratio: Option<f64>,
    friction: Option<f64>,
}

impl TryFrom<Keys> for Source {
    type Error = &'static str;

    fn try_from(keys: Keys) -> std::result::Result<Self, Self::Error> {
        match keys {
            Keys {
                scene: Some(scene),
                step,
                family: None,
                values: None,
                boxes: None,
                ratio: None,
                friction: None,
            } => Ok(Source::Scene(AtStep { scene, step: step.unwrap_or_else(first) })),
            Keys {
                family: Some(family),
                values,
                scene: None,
                step: None,
                boxes: None,
                ratio: None,
                friction: None,
            } => Ok(Source::Family(OfFamily { family, values: values.unwrap_or_default() })),
            Keys {
                boxes: Some(boxes),
                ratio: Some(ratio),
                friction,
                scene: None,
                step: None,
                family: None,
                values: None,
            } => Ok(Source::Stack(Loaded { boxes, ratio, friction: friction.unwrap_or(FRICTION) })),
            _ => Err(
                "a problem is { scene, step }, { problem = file }, { family, values } or { boxes, ratio, friction }",
            ),
        }
    }
}

/// A problem of the library.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OfFamily {
    /// The family.
    pub family: String,
    /// Its parameters; the others have their defaults.
    #[serde(default)]
    pub values: BTreeMap<String, f64>,
}

/// Equal boxes on the ground with friction, with a heavier one on top.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Loaded {
    /// The number of boxes, including the heavy one: at least 2.
    pub boxes: usize,
    /// The mass of the heavy box relative to the others.
    pub ratio: f64,
    /// The coefficient of friction.
    #[serde(default = "friction", skip_serializing_if = "is_default")]
    pub friction: f64,
}

/// The default coefficient of friction.
pub const FRICTION: f64 = 0.5;

fn friction() -> f64 {
    FRICTION
}

fn is_default(friction: &f64) -> bool {
    *friction == FRICTION
}

impl Source {
    /// A unique name.
    pub fn name(&self) -> String {
        match self {
            Source::Scene(at) => at.name(),
            Source::Family(OfFamily { family, values }) => {
                let values: Vec<String> =
                    values.iter().map(|(k, v)| format!("{k} = {v}")).collect();
                if values.is_empty() {
                    family.clone()
                } else {
                    format!("{family}, {}", values.join(", "))
                }
            }
            Source::Stack(Loaded { boxes, ratio, friction }) => {
                let slips =
                    if is_default(friction) { String::new() } else { format!(", μ = {friction}") };
                format!("{boxes} boxes, mass ratio {ratio}{slips}")
            }
        }
    }

    /// The problem.
    ///
    /// # Errors
    /// If the scene, step, file or family does not exist.
    pub fn posed(&self) -> Result<Posed> {
        let lcp = match self {
            Source::Scene(at) => at.given()?.lcp,
            Source::Family(OfFamily { family, values }) => {
                let values: Vec<(&str, f64)> =
                    values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
                library::by_name(family)?.generate(&values)?.lcp
            }
            Source::Stack(stack) => {
                let problem = stack.problem()?;
                return Ok(Posed { lcp: problem.lcp.clone(), stack: Some(problem) });
            }
        };
        Ok(Posed { lcp, stack: None })
    }
}

/// An LCP, and the problem of mechanics that it comes from if that is a stack at rest.
pub struct Posed {
    /// The LCP.
    pub lcp: Lcp,
    stack: Option<Problem>,
}

impl Posed {
    /// The fraction of the weight that the contact forces x do not balance: the vertical momentum
    /// after the step, divided by the weight times dt. `None` if the problem is not that of a stack
    /// at rest.
    pub fn unsupported(&self, x: &[f64]) -> Option<f64> {
        let problem = self.stack.as_ref()?;
        let Problem { assembly, dt, .. } = problem;
        let u = problem.next_velocity(x, *dt);
        let falls = assembly.blocks.iter().map(|own| own.mass * u[own.offset + 2].abs());
        let weight: f64 = assembly.blocks.iter().map(|own| own.mass * GRAVITY * dt).sum();
        Some(falls.sum::<f64>() / weight)
    }
}

impl Loaded {
    /// The problem of the first step.
    ///
    /// # Errors
    /// Those of `Loaded::scene`.
    pub(crate) fn problem(&self) -> Result<Problem> {
        simulation::problem_of(&self.scene()?, 1)
    }

    /// The scene at rest, with boxes of 1 kg and 1 m.
    ///
    /// # Errors
    /// If there are fewer than two boxes, or a mass is not positive.
    pub(crate) fn scene(&self) -> Result<Scene> {
        let below = self.boxes.saturating_sub(1);
        let text = format!(
            r#"
title = "{} boxes, the top one of {} kg"

[generate]
kind = "stack"
count = {below}
size = 1
mass = 1

[step]
dt = 0.016666666666666666
count = 1

[contact]
friction = {}

[[bodies]]
name = "ground"
fixed = true
shape = {{ plane = [0, 0, 1] }}

[[bodies]]
name = "load"
shape = {{ box = [1, 1, 1] }}
mass = {}
position = [0, 0, {}]
"#,
            self.boxes,
            self.ratio,
            self.friction,
            self.ratio,
            below as f64 + 0.5
        );
        Scene::from_toml("the loaded stack", &text)
    }
}

/// The library's frictionless column of bodies, with a top body that is `ratio` times as heavy as
/// the others, after a step of free fall.
///
/// # Errors
/// If the library cannot generate the column.
pub(crate) fn column(bodies: usize, ratio: f64) -> Result<Lcp> {
    let lcp = library::by_name("stack")?.generate(&[("n", bodies as f64), ("ratio", ratio)])?.lcp;
    let b = lcp.b().iter().map(|b| b * STEP_SPEED).collect();
    lcp.with_b(b)
}
