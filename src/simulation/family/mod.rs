//! The families of methods, one a file: how a step is taken from the states at its beginning.

mod acceleration;
mod velocity;

use super::solving::Solving;
use super::{Cause, Solve};
use crate::body::State;
use crate::formulation::Formulation;
use crate::scene::Found;

/// The states after a step; `found` are the contacts at its beginning.
pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[Found],
) -> Result<Vec<State>, Cause> {
    match solving.scene.step.formulation {
        Formulation::Velocity => velocity::step(solving, states, found),
        Formulation::Acceleration => acceleration::step(solving, states, found),
    }
}

/// How near (m) contacts must be to matter to a step.
pub(super) fn reach(scene: &crate::scene::Scene) -> f64 {
    match scene.step.formulation {
        Formulation::Velocity => scene.contact.margin,
        Formulation::Acceleration => scene.contact.resting_gap,
    }
}

/// The states that an answer leads to.
fn moved(solve: &Solve, states: &[State], dt: f64) -> Vec<State> {
    solve.problem.next_states(states, &solve.solution.x, dt)
}
