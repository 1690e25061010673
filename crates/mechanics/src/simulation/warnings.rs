//! What happened in the steps of a run although every problem was solved: bodies that overlap or
//! went through each other, impacts that were not located, impacts whose energy is not what the
//! coefficient of restitution says, and rigid joints that do work.

use std::fmt;

use lcplab_lcp::file::number;
use lcplab_lcp::number::readable;
use serde_json::{Value, json};

use super::{ImpactEnergy, Interpenetration, Step};
use crate::scene::Scene;

/// The warnings of a run, one a pair of bodies and kind, in the order of their first steps.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::{Simulation, Warnings};
///
/// let scene = Scene::load_with("sphere_plane", &[("bodies.ball.position".into(), "[0, 0, 0.2]".into())])?;
/// let (mut simulation, mut warnings) = (Simulation::of(&scene)?, Warnings::default());
/// for _ in 0..40 {
///     warnings.add(&scene, &simulation.step().expect("a step that can be taken"));
/// }
/// let [lasting] = warnings.as_slice() else { panic!() };
/// assert_eq!((lasting.word, lasting.step), ("lasting_overlap", 30)); // 0.3 m deep, and nothing lifts it out
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::{Simulation, Warnings};
/// use lcplab_solver::Dantzig;
///
/// let mut simulation = Simulation::new(Scene::load("fig7")?, Box::new(Dantzig::default()));
/// let mut warnings = Warnings::default();
/// let step = simulation.step().expect("a step that can be taken");
/// warnings.add(simulation.scene(), &step);
/// assert!(warnings.as_slice().is_empty() && warnings.texts().is_empty());
/// assert_eq!(warnings.to_json(), serde_json::json!([]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Warnings(Vec<Warning>);

/// The name of the fixed world.
const WORLD: &str = "world";
/// Number of pairs of bodies that a text names after the first.
const PAIRS: usize = 4;

/// What happened to a pair of bodies, in one step or in several.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// What happened, in one word: `passed_through`, `deep_overlap`, `lasting_overlap`,
    /// `impact_not_located`, `joint_work`, or why energy changed.
    pub word: &'static str,
    /// The names of the bodies.
    pub bodies: [String; 2],
    /// The first step in which it happened, from 1.
    pub step: usize,
    /// How much in that step.
    pub amount: Amount,
    /// What happened in that step, why, and what helps.
    pub message: String,
    /// In how many steps it happened.
    pub steps: usize,
    /// The sum of the energies of all these steps (J), or the greatest depth (m) or speed (m/s).
    pub total: f64,
}

/// The size of what happened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// An overlap (m).
    Depth(f64),
    /// An energy that was added (J), negative where it was lost.
    Energy(f64),
    /// A velocity that is off (m/s).
    Speed(f64),
}

impl Warnings {
    /// Adds those of a step.
    pub fn add(&mut self, scene: &Scene, step: &Step) {
        for own in &step.interpenetrations {
            let message = Interpenetration::message(own, scene, step.number);
            let amount = Amount::Depth(own.depth);
            self.note(own.word(), names(scene, own.bodies), step.number, amount, message);
        }
        for own in &step.impact_energy {
            let message = ImpactEnergy::message(own, scene, step.number);
            let amount = Amount::Energy(own.energy);
            let first = own.first_step(step.number);
            self.note(own.word(), names(scene, own.bodies), first, amount, message);
        }
        for own in &step.unlocated {
            let message = own.message(scene, step.number);
            let amount = Amount::Speed(own.speed);
            let bodies = names(scene, own.bodies);
            self.note("impact_not_located", bodies, step.number, amount, message);
        }
        if let Some(own) = &step.joint_work {
            let message = own.message(scene, step.number);
            let amount = Amount::Energy(own.energy[1] - own.energy[0]);
            let name = |body: Option<usize>| body.map_or(WORLD, |k| &scene.bodies[k].name);
            let bodies = own.bodies.map(|body| name(body).to_string());
            self.note("joint_work", bodies, step.number, amount, message);
        }
    }

    /// One text for each kind of event: the first warning, and the other pairs of bodies to which
    /// the same happened.
    pub fn texts(&self) -> Vec<String> {
        let mut kinds: Vec<Vec<&Warning>> = Vec::new();
        for own in &self.0 {
            match kinds.iter_mut().find(|kind| kind[0].word == own.word) {
                Some(kind) => kind.push(own),
                None => kinds.push(vec![own]),
            }
        }
        kinds.iter().map(|kind| text_of_kind(kind)).collect()
    }

    /// All of them.
    pub fn as_slice(&self) -> &[Warning] {
        &self.0
    }

    /// The same for machines.
    pub fn to_json(&self) -> Value {
        self.0.iter().map(Warning::to_json).collect()
    }

    fn note(
        &mut self,
        word: &'static str,
        bodies: [String; 2],
        step: usize,
        amount: Amount,
        message: String,
    ) {
        let is_same = |own: &&mut Warning| {
            let [a, b] = &own.bodies;
            own.word == word && (bodies == own.bodies || bodies == [b.clone(), a.clone()])
        };
        match self.0.iter_mut().find(is_same) {
            Some(own) => own.again(amount),
            None => {
                let total = amount.value();
                self.0.push(Warning { word, bodies, step, amount, message, steps: 1, total });
            }
        }
    }
}

fn names(scene: &Scene, bodies: [usize; 2]) -> [String; 2] {
    bodies.map(|body| scene.bodies[body].name.clone())
}

/// The first of several warnings of the same kind, and the pairs of bodies of the others.
fn text_of_kind(kind: &[&Warning]) -> String {
    let [first, others @ ..] = kind else { return String::new() };
    let names = |own: &&Warning| own.bodies.join("–");
    let pairs: Vec<String> = others.iter().take(PAIRS).map(names).collect();
    let pairs = pairs.join(", ");
    match others.len() {
        0 => first.to_string(),
        1 => format!("{first} The same happened to {pairs}."),
        all if all <= PAIRS => format!("{first} The same happened to {all} other pairs: {pairs}."),
        all => {
            let more = all - PAIRS;
            format!("{first} The same happened to {all} other pairs: {pairs} and {more} more.")
        }
    }
}

impl Warning {
    fn again(&mut self, amount: Amount) {
        self.steps += 1;
        self.total = match amount {
            Amount::Depth(value) | Amount::Speed(value) => self.total.max(value),
            Amount::Energy(energy) => self.total + energy,
        };
    }

    fn to_json(&self) -> Value {
        let mut object = json!({
            "kind": self.word, "bodies": self.bodies, "step": self.step, "steps": self.steps, "message": self.message,
        });
        let (first, total) = match self.amount {
            Amount::Depth(_) => ("depth", "greatest_depth"),
            Amount::Energy(_) => ("energy", "total_energy"),
            Amount::Speed(_) => ("speed", "greatest_speed"),
        };
        object[first] = number(self.amount.value());
        object[total] = number(self.total);
        object
    }
}

impl Amount {
    /// In m, J or m/s.
    fn value(self) -> f64 {
        match self {
            Amount::Depth(value) | Amount::Energy(value) | Amount::Speed(value) => value,
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)?;
        let total = readable(self.total, 3);
        match (self.steps, self.amount) {
            (1, _) => Ok(()),
            (steps, Amount::Depth(_)) => {
                write!(f, " This happened in {steps} steps, with up to {total} m.")
            }
            (steps, Amount::Speed(_)) => {
                write!(f, " This happened in {steps} steps, with up to {total} m/s.")
            }
            (steps, Amount::Energy(_)) => {
                write!(f, " This happened in {steps} steps, with a total of {total} J.")
            }
        }
    }
}
