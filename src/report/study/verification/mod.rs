//! Verification against closed-form solutions, with decreasing step lengths.
//!
//! A row names a scene, the method of stepping, a quantity and its closed form. It is measured with
//! dt, dt/2, dt/4 and dt/8, or with the first two if it does not depend on the step length. A
//! quantity that does must converge with the order that theory gives for it and the method,
//!
//! ```text
//! observed order = log2(|error(2h)| / |error(h)|),   within 0.1 of the derived one
//! ```
//!
//! which no wrong constant can pass: an error that remains has order 0. A quantity that does not
//! must be right at every step length, within a tolerance with a stated reason. Cases
//! are one file per group.

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
mod statements;
mod surfaces;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::error::{Error, Result};
use crate::lcp::friction::Model;
use crate::scene::Scheme;
use crate::solver::Registry;

/// The allowed difference between an observed order and the derived one.
pub const ORDER_SLACK: f64 = 0.1;

/// The closed forms to verify.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The number of step lengths.
    pub size: Size,
    /// Only these cases, by name; by default all.
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

    fn run(&self, task: usize, _: &Registry) -> Result<(Vec<Row>, ())> {
        Ok((run(self.size, Some(&self.cases[task]))?, ()))
    }
}

/// The extent of the measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Size {
    /// With dt, dt/2, dt/4 and dt/8.
    Full,
    /// Without dt/8, and with dt alone where the quantity does not depend on it.
    Fast,
}

impl Size {
    /// The number of step lengths, each half of the previous one.
    pub(crate) fn levels(self) -> usize {
        match self {
            Size::Full => 4,
            Size::Fast => 3,
        }
    }
}

/// A closed form with its measurements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its case.
    pub case: String,
    /// The scene.
    pub scene: String,
    /// The scheme, or an integrator of the acceleration level that is not the default.
    pub method: String,
    /// The measured quantity.
    pub quantity: String,
    /// The formula as LaTeX.
    pub formula: String,
    /// The unit; empty for a pure number.
    pub unit: String,
    /// The value of the formula.
    pub expected: f64,
    /// The measurements, the longest step first.
    pub samples: Vec<Sample>,
    /// The criterion for the measurements.
    pub criterion: Criterion,
}

/// A measurement with one step length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// The step (s).
    pub dt: f64,
    /// The value; NaN if the simulation failed.
    #[serde(with = "lcplab_analysis::number::always")]
    pub measured: f64,
}

/// The criterion for the measured values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Criterion {
    /// Their errors decrease like dt to this power.
    Order(f64),
    /// They are right for every step length.
    Exact {
        /// The maximum error, relative unless 0 is expected.
        tolerance: f64,
        /// The reason for this tolerance.
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

    /// The order from the two shortest steps; NaN if there are fewer than two.
    pub fn observed_order(&self) -> f64 {
        match self.errors()[..] {
            [.., coarse, fine] => (coarse / fine).log2(),
            _ => f64::NAN,
        }
    }

    /// The theoretical order, if the step length matters at all.
    pub(crate) fn derived_order(&self) -> Option<f64> {
        match self.criterion {
            Criterion::Order(order) => Some(order),
            Criterion::Exact { .. } => None,
        }
    }

    /// Whether the measurements satisfy the criterion.
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

/// The cases, each with its name and title, in the order of the page.
const CASES: &[(&str, &str, Case)] = &[
    ("free-fall", "free fall", free::fall),
    ("pendulum", "pendulum from 90°", pendulum::swing),
    ("pendulum-tension", "force in a moving pendulum", pendulum::tension),
    ("iftomm-pendulum", "pendulum of the IFToMM benchmark", pendulum::iftomm),
    ("conical-pendulum", "conical pendulum", pendulum::conical),
    ("double-pendulum", "double pendulum", pendulum::double),
    ("flip", "free body that flips over", rotation::flip),
    ("top", "steady precession of a top", rotation::top),
    ("free-body", "free rotation", schemes::free_body),
    ("top-lean", "fast top that leans", schemes::lean),
    ("landing", "boxes that land in a stack", contact::landing),
    ("stack", "five boxes at rest", contact::stack),
    ("incline", "block on an incline", contact::incline),
    ("ladder", "ladder against a wall", contact::ladder),
    ("rolling-sphere", "sphere that begins to roll", rolling::sphere),
    ("rolling-balls", "box pulled on balls", rolling::balls),
    ("rolling-cylinder", "cylinder and disk on a slope", rolling::cylinder),
    ("bouncing-ball", "bouncing ball", impact::bouncing),
    ("bounce-to-rest", "ball that comes to rest", schemes::rest),
    ("cradle", "Newton's cradle", impact::cradle),
    ("catenary", "hanging chain", rope::catenary),
    ("atwood", "Atwood's machine", rope::atwood),
    ("massive-pulley", "Atwood's machine, massive pulley", rope::massive_pulley),
    ("capstan", "rope around a post", rope::capstan),
    ("capstan-two-turns", "rope around a post, two turns", rope::two_turns),
    ("static-friction", "static friction above kinetic", surfaces::ramp),
    ("shaking-table", "block on a shaking table", surfaces::table),
    ("moving-support", "moving supports", surfaces::supports),
    ("sine-force", "sinusoidal force", surfaces::sine),
    ("pairs", "friction and restitution of pairs", surfaces::pairs),
    ("groove", "block in a V-shaped groove", surfaces::groove),
    ("feedback", "feedback of a length error", joint::feedback),
    ("spring", "mass on a spring", joint::spring),
    ("spring-ellipse", "mass on a spring, in the plane", joint::ellipse),
    ("motor", "motor with a limit", joint::motor),
    ("joints-turning", "joints that turn", mechanism::turning),
    ("joints-falling", "joints under gravity", mechanism::falling),
    ("belt", "conveyor belt", mechanism::belt),
    ("redundant-joints", "redundant joints", mechanism::redundant),
    ("impact-with-friction", "impact with friction", collisions::friction_in_impact),
    ("oblique-slip", "slip at 30° to the axes", collisions::oblique_slip),
    ("three-bounces", "three bounces", collisions::bounces),
    ("flat-bounce", "bounce of a flat box", collisions::flat),
    ("off-center-impact", "off-center impact", collisions::off_center),
    ("gap-below-a-step", "impacts closer than a step", collisions::gap),
    ("blocked-motor", "blocked motor", mechanism::blocked),
    ("bricard", "Bricard's ring", bricard::bricard),
    ("painleve", "Painlevé's rod", painleve::rod),
    ("diagnosis", "cause found by diagnose", statements::reference),
    ("friction-excess", "friction at the limit", statements::at_the_limit),
    ("measured-laws", "laws as measured by compare", statements::measured_laws),
    ("counts", "numbers stated in messages", statements::counts),
];

/// A case with its own settings.
type Chosen = Box<dyn Fn(Size) -> Result<Vec<Row>> + Send + Sync>;

/// One simulated minute each, a stack of ten and a pendulum with every scheme: an hour of
/// computation in total, so they run only if a report file names them.
fn long() -> Vec<(String, Chosen)> {
    let stack = |(scheme, model): (Scheme, Model)| -> (String, Chosen) {
        let name = format!("long-stack-{}-{model}", scheme.name());
        (name, Box::new(move |size| schemes::long_stack(scheme, model, size)))
    };
    let pendulum: (String, Chosen) = ("long-pendulum".into(), Box::new(schemes::long_pendulum));
    [pendulum].into_iter().chain(schemes::long_stacks().map(stack)).collect()
}

/// The names of the cases except the long ones.
pub fn names() -> Vec<&'static str> {
    CASES.iter().map(|(name, ..)| *name).collect()
}

/// The title of a case on the page; its name if it has none, as the long cases.
pub(crate) fn title(case: &str) -> &str {
    CASES.iter().find(|(name, ..)| *name == case).map_or(case, |(_, title, _)| title)
}

/// The rows of one case, including long ones, or of all except the long ones. They do not depend on
/// the number of threads.
///
/// # Errors
/// If there is no case with this name.
pub fn run(size: Size, only: Option<&str>) -> Result<Vec<Row>> {
    let usual = CASES.iter().map(|&(name, _, study)| (name.to_string(), Box::new(study) as Chosen));
    let chosen: Vec<(String, Chosen)> = match only {
        None => usual.collect(),
        Some(only) => vec![one(usual.chain(long()).collect(), only)?],
    };
    let rows: Result<Vec<Vec<Row>>> = chosen.par_iter().map(|(_, study)| study(size)).collect();
    Ok(rows?.concat())
}

/// The case with this name.
fn one(all: Vec<(String, Chosen)>, only: &str) -> Result<(String, Chosen)> {
    let known = all.iter().map(|(name, _)| name.clone()).collect();
    let found = all.into_iter().find(|(name, _)| name == only);
    found.ok_or_else(|| Error::Unknown { kind: "closed form", name: only.into(), known })
}
