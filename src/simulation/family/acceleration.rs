//! The acceleration level: impacts first, as impulses, then one LCP in forces.
//!
//! ```text
//! u' = M⁻¹(F + Jᵀλ),   u⁺ = u + dt u',   s⁺ = s + dt S u⁺
//! ```
//!
//! Baraff 1994; K&M (U2), `math §4`.

use super::moved;
use crate::assembly::{Entering, Row};
use crate::body::State;
use crate::constraint::Bounds;
use crate::formulation::Problem;
use crate::scene::Found;
use crate::simulation::Cause;
use crate::simulation::solving::Solving;

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[Found],
) -> Result<Vec<State>, Cause> {
    let states = impacts(solving, states, found)?;
    let assembly = solving.assemble(&states, found, Entering::Resting)?;
    let problem = Problem::acceleration(solving.scene, assembly)?;
    let dt = solving.scene.step.dt;
    Ok(moved(solving.solve(problem), &states, dt))
}

/// The states after the impacts, where bodies touch or limits are met, and approach.
fn impacts(solving: &mut Solving, states: &[State], found: &[Found]) -> Result<Vec<State>, Cause> {
    let assembly = solving.assemble(states, found, Entering::Touching)?;
    let limit = -solving.scene.contact.resting_speed;
    let hits = |row: &Row| row.bounds == Bounds::Unilateral && row.velocity < limit;
    if !assembly.rows.iter().any(hits) {
        return Ok(states.to_vec());
    }
    let solve = solving.solve_bouncing(Problem::impact(assembly)?)?;
    let u = solve.problem.next_velocity(&solve.solution.x, 0.0);
    Ok(solve.problem.assembly.with_velocities(states, &u))
}
