//! The velocity level: one LCP in impulses, and a second one if something bounces.
//!
//! ```text
//! u⁺ = u + dt M⁻¹F + M⁻¹Jᵀx,   s⁺ = s + dt S u⁺
//! ```
//!
//! Stewart & Trinkle 1996, Anitescu & Potra 1997.

use super::moved;
use crate::assembly::ConstraintFilter;
use crate::body::State;
use crate::formulation::Problem;
use crate::scene::DetectedContact;
use crate::simulation::Cause;
use crate::simulation::solving::Solving;

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let assembly = solving.assemble(states, found, ConstraintFilter::Near)?;
    let problem = Problem::velocity(solving.scene, assembly)?;
    let dt = solving.scene.step.dt;
    solving.solve_bouncing(problem)?;
    Ok(moved(solving, states, dt))
}

/// The same without feedback of position errors, for schemes that correct them afterwards.
pub(super) fn unbiased(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let assembly = solving.assemble(states, found, ConstraintFilter::Near)?;
    let problem = Problem::unbiased(solving.scene, assembly)?;
    let dt = solving.scene.step.dt;
    solving.solve_bouncing(problem)?;
    Ok(moved(solving, states, dt))
}
