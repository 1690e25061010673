//! Causes of errors, each identified by what happens without it.

use std::fmt;

use lcplab_page::number::{counted, readable};

use super::show::percent;
use crate::diagnosis::Mistake;

/// Significant digits in text.
const DIGITS: usize = 2;

/// A body that moves less than this (m) counts as not moving.
const NOWHERE: f64 = 1e-6;

/// The number of sweeps without a cause that is responsible for this factor, compared with those
/// that `they_need` names: "it takes now".
fn part_of_sweeps(factor: f64, they_need: &str) -> String {
    match percent(1.0 / factor) {
        none if none == "0 %" => format!("far fewer sweeps than {they_need}"),
        part => format!("{part} of the sweeps that {they_need}"),
    }
}

/// The effect of removing a cause.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Without {
    /// The number of sweeps to a good answer with the cause, divided by the number without.
    pub factor: f64,
    /// The error with the cause, after the same number of sweeps as before.
    pub with: f64,
    /// The error without the cause.
    pub without: f64,
}

impl Without {
    /// The part of the error that the cause explains.
    pub(crate) fn share(&self) -> f64 {
        self.with - self.without
    }
}

/// Why sweeps converge too slowly.
#[derive(Debug, Clone, PartialEq)]
pub enum Slow {
    /// The solver itself: after the same number of sweeps plain Gauss-Seidel has a much smaller
    /// error.
    Solver {
        /// The number of sweeps.
        sweeps: usize,
        /// The error of its answer.
        with: f64,
        /// The error of plain Gauss-Seidel from the same start.
        plain: f64,
        /// Why it gave no answer, if it gave none.
        refusal: Option<String>,
        /// The known mistakes that give its answer, the nearest first.
        mistakes: Vec<Mistake>,
    },
    /// A direct method was stopped before its last step.
    Stopped {
        /// The solver.
        solver: String,
        /// The number of steps with their name, after which it was stopped.
        after: String,
        /// The number that it needs; `None` if it finds no accepted answer.
        needs: Option<usize>,
    },
    /// Motors at their limits that work against each other or against an obstacle; tested by
    /// reducing the limits to a hundredth.
    Motors {
        /// The pairs of bodies between which they act.
        between: Vec<String>,
        /// The effect of a hundredth of their limits.
        without: Without,
    },
    /// Bodies of different mass; tested by making all masses equal.
    MassRatio {
        /// The heaviest body of the slowest mode and its mass (kg).
        heavy: (String, f64),
        /// The lightest body and its mass (kg).
        light: (String, f64),
        /// The effect of equal masses.
        without: Without,
    },
    /// A tall column or a long chain; tested by decoupling the pairs of bodies, with equal masses
    /// in both cases.
    Tall {
        /// The number of bodies on the path of an impulse, if known.
        bodies: Option<usize>,
        /// The effect of decoupling the pairs.
        without: Without,
    },
    /// The order of the rows; tested by taking them from the last to the first.
    Order {
        /// The effect of the other order.
        without: Without,
    },
    /// The start; tested by starting sweeps from x = 0.
    Stale {
        /// The effect of that start.
        without: Without,
    },
    /// None of these: sweeps are slow on this problem.
    Other,
}

impl Slow {
    /// A few words for the start of a line.
    pub fn name(&self) -> &'static str {
        match self {
            Slow::Solver { .. } => "suspect the solver",
            Slow::Stopped { .. } => "iteration limit",
            Slow::Motors { .. } => "strong motors",
            Slow::MassRatio { .. } => "mass ratio",
            Slow::Tall { bodies: Some(_), .. } => "bodies in series",
            Slow::Tall { bodies: None, .. } => "long chain of rows",
            Slow::Order { .. } => "order of rows",
            Slow::Stale { .. } => "stale start",
            Slow::Other => "slow sweeps",
        }
    }

    /// The rank among the causes by how easily they are removed: a solver, a start, an order, the
    /// limit of a motor, masses, a height.
    pub(crate) fn ease(&self) -> usize {
        match self {
            Slow::Solver { .. } | Slow::Stopped { .. } => 0,
            Slow::Stale { .. } => 1,
            Slow::Order { .. } => 2,
            Slow::Motors { .. } => 3,
            Slow::MassRatio { .. } => 4,
            Slow::Tall { .. } => 5,
            Slow::Other => 6,
        }
    }
}

impl fmt::Display for Slow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let saves = |own: &Without, they_need: &str| {
            format!(
                "the error of the motion would be {} instead of {}, and an error of 0.1 % would take {}",
                percent(own.without),
                percent(own.with),
                part_of_sweeps(own.factor, they_need)
            )
        };
        match self {
            Slow::Solver { sweeps, with, plain, refusal, mistakes } => {
                write!(
                    f,
                    "its error is {}; plain projected Gauss-Seidel has {} after {} from the same start.",
                    percent(*with),
                    percent(*plain),
                    counted(*sweeps, "sweep")
                )?;
                match (refusal, mistakes.first()) {
                    (Some(refusal), _) => write!(f, " It gave no answer: {refusal}."),
                    (None, Some(mistake)) => {
                        write!(f, " A known mistake gives the same answer: {}.", mistake.what)
                    }
                    (None, None) => write!(f, " No known mistake gives the same answer."),
                }
            }
            Slow::Stopped { solver, after, needs } => {
                write!(f, "{solver} was stopped after {after}")?;
                match needs {
                    Some(needs) => write!(f, ", and this problem takes {needs}.")?,
                    None => write!(f, ".")?,
                }
                write!(f, " It is a direct method, whose answer is right only after its last step.")
            }
            Slow::Motors { between, without } => write!(
                f,
                "motors ({}) push at their force limit against an obstacle. With a hundredth of the limit, {}.",
                between.join(", "),
                saves(without, "it takes now")
            ),
            Slow::MassRatio { heavy, light, without } => write!(
                f,
                "the slowest error pattern of Gauss-Seidel moves {} ({} kg) together with {} ({} kg). With equal \
                 masses, {}.",
                heavy.0,
                readable(heavy.1, DIGITS),
                light.0,
                readable(light.1, DIGITS),
                saves(without, "it takes with the present masses")
            ),
            Slow::Tall { bodies: Some(bodies), without } => write!(
                f,
                "impulses propagate through {bodies} bodies, one after the other. In a test with equal \
                 masses, if each pair of bodies were a separate problem, {}.",
                saves(without, "the coupled pairs need")
            ),
            Slow::Tall { bodies: None, without } => write!(
                f,
                "impulses propagate over a long chain of rows. The file names no bodies, so the influence \
                 of the masses is not known. If each pair of bodies were a separate problem, {}.",
                saves(without, "it takes now")
            ),
            Slow::Order { without } => write!(
                f,
                "the sweeps process the rows against the direction in which impulses propagate. From the \
                 last row to the first, the error would be {} instead of {}.",
                percent(without.without),
                percent(without.with)
            ),
            Slow::Stale { without } => write!(
                f,
                "the sweeps start from forces that are worse than x = 0. From x = 0 the error would be {} \
                 instead of {}.",
                percent(without.without),
                percent(without.with)
            ),
            Slow::Other => write!(
                f,
                "neither the mass ratio, nor a long chain, nor the order of the rows explains the slow \
                 convergence. Look for nearly dependent rows."
            ),
        }
    }
}

/// A cause of wrong motion even if every problem is solved, each identified by a run without it.
#[derive(Debug, Clone, PartialEq)]
pub enum Moving {
    /// Every step starts from x = 0.
    Cold {
        /// The error over the second half of the run.
        with: f64,
        /// The same if steps start from the last answer.
        without: f64,
    },
    /// Feedback of errors adds energy.
    Feedback {
        /// The energy gained (J).
        with: f64,
        /// The same without feedback.
        without: f64,
        /// The same with feedback and exact answers.
        exactly: f64,
    },
    /// Feedback drives rows away from their targets.
    Away {
        /// The largest position error (m).
        with: f64,
        /// The same without feedback.
        without: f64,
    },
    /// The scheme's constraints are compliant.
    Soft {
        /// The scheme.
        scheme: &'static str,
        /// The body that sinks most.
        body: String,
        /// The distance (m) below its position with rigid constraints.
        depth: f64,
    },
    /// Contacts are compliant (CFM), so that bodies creep under a load.
    Creep {
        /// The largest remaining approach velocity, γ x of a row (m/s).
        speed: f64,
        /// The error of the solution compared with that of rigid contacts.
        missing: f64,
    },
    /// The friction model holds or turns a body that Coulomb's cone lets slide, or the other way
    /// round.
    Friction {
        /// Whether friction is limited by a polygon, otherwise along two tangents.
        is_polygon: bool,
        /// The scheme, if it supports no other model.
        only_of: Option<&'static str>,
        /// The body whose final positions differ most between the two models.
        body: String,
        /// That distance (m).
        distance: f64,
        /// The distance (m) that it moves with the scene's model.
        way: f64,
    },
}

impl Moving {
    /// A few words for the start of a line.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Moving::Cold { .. } => "cold start",
            Moving::Feedback { .. } => "energy from Baumgarte feedback",
            Moving::Away { .. } => "feedback increases errors",
            Moving::Soft { .. } | Moving::Creep { .. } => "compliant constraints",
            Moving::Friction { is_polygon: true, .. } => "polygon friction",
            Moving::Friction { .. } => "box friction",
        }
    }
}

impl fmt::Display for Moving {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |value: &f64| readable(*value, DIGITS);
        match self {
            Moving::Cold { with, without } => write!(
                f,
                "every step starts from x = 0, and the error is {}. With a warm start (contact.persistence = \
                 \"features\") it is {}.",
                percent(*with),
                percent(*without)
            ),
            Moving::Feedback { with, without, exactly } => write!(
                f,
                "feedback of position errors adds {} J. Without feedback the energy increases by {} J; \
                 with feedback and exact answers, by {} J. Correct positions separately from velocities \
                 (split-impulse, gauss-seidel).",
                number(with),
                number(without),
                number(exactly)
            ),
            Moving::Away { with, without } => write!(
                f,
                "with feedback a position error grows to {} m, without feedback to {} m. The feedback has a \
                 wrong sign or is too strong.",
                number(with),
                number(without)
            ),
            Moving::Soft { scheme, body, depth } => write!(
                f,
                "the constraints of {scheme} are compliant: {body} ends {} m lower than with rigid \
                 constraints. Increase their stiffness, or use a scheme with rigid constraints (velocity).",
                number(depth)
            ),
            Moving::Creep { speed, missing } => write!(
                f,
                "contacts are compliant: γ x allows an approach velocity of {} m/s. Compared with rigid \
                 contacts, even the exact solution has an error of {}. With γ = 0 it has none.",
                number(speed),
                percent(*missing)
            ),
            Moving::Friction { is_polygon, only_of, body, distance, way } => {
                let law = match is_polygon {
                    true => "friction has the direction of a corner of its polygon",
                    false => "friction is limited along each of two tangents separately",
                };
                let cone = match only_of {
                    None => "With Coulomb's cone (contact.model = \"coulomb-cone\")".into(),
                    Some(scheme) => format!(
                        "{scheme} supports no other model; with Coulomb's cone (step.scheme = \"velocity\", \
                         contact.model = \"coulomb-cone\")"
                    ),
                };
                let distance = number(distance);
                match *way < NOWHERE {
                    true => {
                        write!(f, "{law}: {body} does not move. {cone} it moves {distance} m.")
                    }
                    false => write!(
                        f,
                        "{law}: {body} moves {} m. {cone} it ends {distance} m away from there.",
                        number(way)
                    ),
                }
            }
        }
    }
}
