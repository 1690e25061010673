//! The schemes, one a file: how a step is taken from the states at its beginning.

mod acceleration;
mod arrival;
mod gauss_seidel;
mod penalty;
mod sequential;
mod soft;
mod split_impulse;
mod velocity;
mod xpbd;

use super::solving::Solving;
use super::{Cause, Solve, StepEvent};
use crate::body::State;
use crate::formulation::Scheme;
use crate::scene::{DetectedContact, Scene, Step};

/// The states after a step; `found` are the contacts at its beginning.
pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    match solving.scene.step.scheme {
        Scheme::Velocity => velocity::step(solving, states, found),
        Scheme::Acceleration => acceleration::step(solving, states, found),
        Scheme::SplitImpulse => split_impulse::step(solving, states, found),
        Scheme::GaussSeidel => gauss_seidel::step(solving, states, found),
        Scheme::Xpbd => xpbd::step(solving, states, found),
        Scheme::Soft => soft::step(solving, states, found),
        Scheme::Penalty => penalty::step(solving, states, found),
        Scheme::SequentialImpulses => sequential::step(solving, states, found),
    }
}

/// The states that the last answer leads to: its impulses, then a move for dt.
fn moved(solving: &mut Solving, states: &[State], dt: f64) -> Vec<State> {
    solving.note_answer();
    solving.note(StepEvent::Advance(dt));
    let Solve { problem, solution, .. } = solving.last();
    problem.next_states(states, &solution.x, dt)
}

/// The scene with the length of a substep.
fn substepped(scene: &Scene) -> Scene {
    let dt = scene.step.dt / scene.step.substeps as f64;
    Scene { step: Step { dt, ..scene.step.clone() }, ..scene.clone() }
}

/// The states at the beginning of a substep (its number from 0), with the supports moving as they
/// do in it. The scene is that of substeps.
fn supported(solving: &Solving, scene: &Scene, states: &[State], substep: usize) -> Vec<State> {
    let h = scene.step.dt;
    scene.supported(states, solving.from + substep as f64 * h, h).into_owned()
}
