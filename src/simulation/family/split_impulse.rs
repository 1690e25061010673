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
//! *Bullet*, 2005; `math §4`.

use super::{moved, velocity};
use crate::assembly::Entering;
use crate::body::State;
use crate::formulation::Problem;
use crate::scene::Found;
use crate::simulation::Cause;
use crate::simulation::solving::Solving;

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[Found],
) -> Result<Vec<State>, Cause> {
    let states = velocity::unbiased(solving, states, found)?;
    let assembly = solving.assemble(&states, found, Entering::Near)?;
    let problem = Problem::position(solving.scene, assembly)?;
    Ok(moved(solving.solve(problem)?, &states, 0.0))
}
