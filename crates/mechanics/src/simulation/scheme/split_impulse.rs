//! Split impulse: velocities and positions are corrected by two LCPs that do not know each other.
//!
//! ```text
//! velocity:  u⁺ = u + dt M⁻¹F + M⁻¹Jᵀx,   s* = s + dt S u⁺     gaps may close, errors are not fed back
//! position:  w = A y + c(s*), bounded like x,   s⁺ = s* + S M⁻¹Jᵀy
//! ```
//!
//! The push y out of an error never becomes a velocity, so it adds no kinetic energy, unlike
//! Baumgarte's. What it lifts gains potential energy all the same. One step of Newton's method in
//! c: errors that curve are gone to second order. Restitution: as at velocity level. Coumans,
//! *Bullet*, 2005.

use super::velocity;
use crate::assembly::ConstraintFilter;
use crate::body::State;
use crate::formulation::Problem;
use crate::scene::DetectedContact;
use crate::simulation::solving::Solving;
use crate::simulation::{Cause, Solve, StepEvent};

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let states = velocity::unbiased(solving, states, found)?;
    let assembly = solving.assemble(&states, found, ConstraintFilter::Near)?;
    let problem = Problem::position(solving.scene, assembly)?;
    let Solve { problem, solution, .. } = solving.solve(problem)?;
    let (shifts, x) = (problem.motion(&solution.x), &solution.x);
    let shifted = problem.next_states(&states, x, 0.0);
    let blocks = problem.assembly.blocks.iter();
    let shifts: Vec<StepEvent> = blocks
        .map(|block| StepEvent::Shift { body: block.body, by: block.gather(&shifts) })
        .collect();
    shifts.into_iter().for_each(|shift| solving.note(shift));
    Ok(shifted)
}
