//! What happened in the steps of a run although every problem was solved: bodies that overlap or
//! went through each other, impacts that were not located, and impacts whose energy is not what the
//! coefficient of restitution says.

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
#[derive(Debug, Clone, Default)]
pub struct Warnings(Vec<Warning>);

/// Number of pairs of bodies that a text names after the first.
const PAIRS: usize = 4;

/// What happened to a pair of bodies, in one step or in several.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// What happened, in one word: `passed_through`, `deep_overlap`, `lasting_overlap`,
    /// `impact_not_located`, or why energy changed.
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
            self.note(
                scene,
                own.word(),
                own.bodies,
                step.number,
                Amount::Depth(own.depth),
                message,
            );
        }
        for own in &step.impact_energy {
            let message = ImpactEnergy::message(own, scene, step.number);
            let amount = Amount::Energy(own.energy);
            let first = own.first_step(step.number);
            self.note(scene, own.word(), own.bodies, first, amount, message);
        }
        for own in &step.unlocated {
            let message = own.message(scene, step.number);
            let amount = Amount::Speed(own.speed);
            self.note(scene, "impact_not_located", own.bodies, step.number, amount, message);
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
        scene: &Scene,
        word: &'static str,
        bodies: [usize; 2],
        step: usize,
        amount: Amount,
        message: String,
    ) {
        let bodies = bodies.map(|body| scene.bodies[body].name.clone());
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
