//! One row at the present states, and moves along it: what NGS and XPBD do row by row.
//!
//! Nothing is assembled: c, J and M⁻¹ are those of the instant, after all moves so far.

use nalgebra::Vector6;

use super::{Cause, StepEvent};
use crate::assembly::{Source, Undefined};
use crate::body::State;
use crate::constraint::{Constraint, Row};
use crate::scene::{DetectedContact, Scene};

/// All constraints, then all contacts, in the order of assembly.
pub(super) fn sources<'a>(
    scene: &'a Scene,
    found: &'a [DetectedContact],
) -> Vec<(Source, &'a dyn Constraint)> {
    let constraints = scene.constraints.iter().enumerate();
    let constraints = constraints.map(|(k, c)| (Source::Constraint(k), c.as_ref()));
    let contacts = found.iter().map(|f| (Source::Contact(f.id), &f.contact as &dyn Constraint));
    constraints.chain(contacts).collect()
}

/// The rows of a constraint at these states.
pub(super) fn rows(
    source: Source,
    constraint: &dyn Constraint,
    states: &[State],
) -> Result<Vec<Row>, Cause> {
    let bodies = constraint.bodies();
    let pair = bodies.map(|body| body.map_or(&State::WORLD, |k| &states[k]));
    constraint.rows(pair).map_err(|cause| Cause::Undefined(Undefined { source, bodies, cause }))
}

/// How the bodies of a row answer to it.
pub(super) struct Lever {
    /// J u (m/s or rad/s).
    pub velocity: f64,
    /// J M⁻¹ Jᵀ; 0 if nothing can move.
    pub mobility: f64,
    /// For each moving body M⁻¹ Jᵀ.
    responses: Vec<(usize, Vector6<f64>)>,
}

impl Lever {
    /// A row of a constraint between these bodies.
    pub fn new(scene: &Scene, constraint: &dyn Constraint, row: &Row, states: &[State]) -> Self {
        let (mut velocity, mut mobility, mut responses) = (0.0, 0.0, Vec::new());
        for (body, j) in constraint.bodies().into_iter().zip(row.jacobian) {
            if let Some(k) = body {
                let response = scene.bodies[k].mass.accelerate(&states[k].pose, &j);
                velocity += j.dot(&states[k].velocity());
                mobility += j.dot(&response);
                responses.push((k, response));
            }
        }
        Lever { velocity, mobility, responses }
    }

    /// s ← s + S M⁻¹Jᵀ y.
    pub fn shift(&self, y: f64, states: &mut [State]) {
        for (k, response) in &self.responses {
            states[*k] = states[*k].displaced(&(response * y));
        }
    }

    /// What such a shift does, to be written down.
    pub fn moves(&self, y: f64) -> impl Iterator<Item = StepEvent> {
        self.responses
            .iter()
            .map(move |(body, response)| StepEvent::Shift { body: *body, by: response * y })
    }

    /// u ← u + M⁻¹Jᵀ x.
    pub fn push(&self, x: f64, states: &mut [State]) {
        for (k, response) in &self.responses {
            states[*k] = states[*k].with_velocity(&(states[*k].velocity() + response * x));
        }
    }
}
