//! Numbers that are known without a computer, measured with shorter and shorter steps.
//!
//! A row names a scene, how it is stepped, a quantity and its closed form. It is measured with dt,
//! dt/2, dt/4 and dt/8. What the step length spoils must come right at the order that theory gives
//! for this quantity and this method,
//!
//! ```text
//! observed order = log2(|error(2h)| / |error(h)|),   within 0.1 of the derived one
//! ```
//!
//! which no wrong constant can pass: an error that stays has the order 0. What it does not spoil
//! must be right at every step length, within a tolerance that has a reason. Cases are one file a
//! group.

mod bricard;
mod collisions;
mod contact;
mod free;
mod impact;
mod joint;
mod measure;
mod mechanism;
mod painleve;
mod pendulum;
mod rolling;
mod rope;
mod rotation;
mod schemes;
mod surfaces;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::error::{Error, Result};
use crate::lcp::friction::Model;
use crate::scene::Scheme;

/// How far an observed order may lie from the derived one.
pub const ORDER_SLACK: f64 = 0.1;

/// The known numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// How many step lengths.
    pub size: Size,
    /// These cases alone, by name; all without it.
    #[serde(default = "all_cases")]
    pub cases: Vec<String>,
}

/// The names of all cases.
fn all_cases() -> Vec<String> {
    names().into_iter().map(String::from).collect()
}

impl Study for Plan {
    const NAME: &'static str = "verification";
    type Finding = Vec<Row>;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.cases.clone()
    }

    fn run(&self, task: usize) -> Result<(Vec<Row>, ())> {
        Ok((run(self.size, Some(&self.cases[task]))?, ()))
    }
}

/// How much is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Size {
    /// With dt, dt/2, dt/4 and dt/8.
    Full,
    /// Without dt/8.
    Fast,
}

impl Size {
    /// How many step lengths, each half of the one before.
    pub fn levels(self) -> usize {
        match self {
            Size::Full => 4,
            Size::Fast => 3,
        }
    }
}

/// A closed form and what is measured of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The case that it belongs to.
    pub case: String,
    /// The scene.
    pub scene: String,
    /// The family of methods and, where there is a choice, the integrator.
    pub method: String,
    /// What is measured.
    pub quantity: String,
    /// The formula as text.
    pub formula: String,
    /// The formula as LaTeX.
    pub latex: String,
    /// The unit; empty for a pure number.
    pub unit: String,
    /// The value of the formula.
    pub expected: f64,
    /// What was measured, with the longest step first.
    pub samples: Vec<Sample>,
    /// What the numbers must do.
    pub criterion: Criterion,
}

/// A number measured with one step length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// The step (s).
    pub dt: f64,
    /// The number; NaN if the simulation failed.
    #[serde(with = "lcplab_study::number::always")]
    pub measured: f64,
}

/// What the measured numbers must do.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Criterion {
    /// Their errors shrink like dt to this power.
    Order(f64),
    /// They are right whatever the step.
    Exact {
        /// The largest error of any of them, relative unless 0 is expected.
        tolerance: f64,
        /// Why it is not smaller.
        because: String,
    },
}

impl Row {
    /// |measured − expected|, relative unless 0 is expected, for each step length.
    pub fn errors(&self) -> Vec<f64> {
        let scale = if self.expected == 0.0 { 1.0 } else { self.expected.abs() };
        let error = |sample: &Sample| (sample.measured - self.expected).abs() / scale;
        self.samples.iter().map(error).collect()
    }

    /// The order that the two shortest steps show; NaN if there are no two.
    pub fn observed_order(&self) -> f64 {
        match self.errors()[..] {
            [.., coarse, fine] => (coarse / fine).log2(),
            _ => f64::NAN,
        }
    }

    /// The order that theory gives, if the step matters at all.
    pub fn derived_order(&self) -> Option<f64> {
        match self.criterion {
            Criterion::Order(order) => Some(order),
            Criterion::Exact { .. } => None,
        }
    }

    /// Whether the numbers do what they must.
    pub fn passes(&self) -> bool {
        match self.criterion {
            Criterion::Order(order) => (self.observed_order() - order).abs() <= ORDER_SLACK,
            Criterion::Exact { tolerance, .. } => {
                !self.samples.is_empty() && self.errors().iter().all(|error| *error <= tolerance)
            }
        }
    }
}

/// The rows of a case.
type Case = fn(Size) -> Result<Vec<Row>>;

/// The cases by name, in the order of the page.
const CASES: &[(&str, Case)] = &[
    ("free-fall", free::fall),
    ("pendulum", pendulum::swing),
    ("pendulum-tension", pendulum::tension),
    ("iftomm-pendulum", pendulum::iftomm),
    ("conical-pendulum", pendulum::conical),
    ("double-pendulum", pendulum::double),
    ("flip", rotation::flip),
    ("top", rotation::top),
    ("free-body", schemes::free_body),
    ("top-lean", schemes::lean),
    ("landing", contact::landing),
    ("stack", contact::stack),
    ("incline", contact::incline),
    ("ladder", contact::ladder),
    ("rolling-sphere", rolling::sphere),
    ("rolling-balls", rolling::balls),
    ("rolling-cylinder", rolling::cylinder),
    ("bouncing-ball", impact::bouncing),
    ("bounce-to-rest", schemes::rest),
    ("cradle", impact::cradle),
    ("catenary", rope::catenary),
    ("atwood", rope::atwood),
    ("massive-pulley", rope::massive_pulley),
    ("capstan", rope::capstan),
    ("capstan-two-turns", rope::two_turns),
    ("static-friction", surfaces::ramp),
    ("shaking-table", surfaces::table),
    ("sine-force", surfaces::sine),
    ("pairs", surfaces::pairs),
    ("groove", surfaces::groove),
    ("feedback", joint::feedback),
    ("spring", joint::spring),
    ("spring-ellipse", joint::ellipse),
    ("motor", joint::motor),
    ("joints-turning", mechanism::turning),
    ("joints-falling", mechanism::falling),
    ("belt", mechanism::belt),
    ("redundant-joints", mechanism::redundant),
    ("impact-with-friction", collisions::friction_in_impact),
    ("oblique-slip", collisions::oblique_slip),
    ("three-bounces", collisions::bounces),
    ("flat-bounce", collisions::flat),
    ("gap-below-a-step", collisions::gap),
    ("blocked-motor", mechanism::blocked),
    ("bricard", bricard::bricard),
    ("painleve", painleve::rod),
];

/// A case with settings of its own.
type Chosen = Box<dyn Fn(Size) -> Result<Vec<Row>> + Send + Sync>;

/// A simulated minute each, a stack of ten and a pendulum by every scheme: an hour of work in all,
/// so that they run only where a report file names them.
fn long() -> Vec<(String, Chosen)> {
    let stack = |(scheme, model): (Scheme, Model)| -> (String, Chosen) {
        let name = format!("long-stack-{}-{model}", scheme.name());
        (name, Box::new(move |size| schemes::long_stack(scheme, model, size)))
    };
    let pendulum: (String, Chosen) = ("long-pendulum".into(), Box::new(schemes::long_pendulum));
    [pendulum].into_iter().chain(schemes::long_stacks().map(stack)).collect()
}

/// The names of the cases but the long ones.
pub fn names() -> Vec<&'static str> {
    CASES.iter().map(|(name, _)| *name).collect()
}

/// The rows of a case, a long one too, or of all but the long ones. They do not depend on the
/// number of threads.
///
/// # Errors
/// If there is no case of that name.
pub fn run(size: Size, only: Option<&str>) -> Result<Vec<Row>> {
    let usual = CASES.iter().map(|&(name, study)| (name.to_string(), Box::new(study) as Chosen));
    let chosen: Vec<(String, Chosen)> = match only {
        None => usual.collect(),
        Some(only) => vec![one(usual.chain(long()).collect(), only)?],
    };
    let rows: Result<Vec<Vec<Row>>> = chosen.par_iter().map(|(_, study)| study(size)).collect();
    Ok(rows?.concat())
}

/// The case of this name.
fn one(all: Vec<(String, Chosen)>, only: &str) -> Result<(String, Chosen)> {
    let known = all.iter().map(|(name, _)| name.clone()).collect();
    let found = all.into_iter().find(|(name, _)| name == only);
    found.ok_or_else(|| Error::Unknown { kind: "closed form", name: only.into(), known })
}
