//! Nonlinear Gauss-Seidel (NGS): a velocity step, then positions corrected row by row.
//!
//! ```text
//! e = c            an equation
//!     min(c, 0)    a limit; min(c + slop, 0) a contact that overlaps
//! y = −e/(J M⁻¹Jᵀ),   s ← s + S M⁻¹Jᵀ y        c, J and M⁻¹ at the newest s, row after row
//! ```
//!
//! No linear problem is solved for the positions, so what curves is no trouble; but as in any
//! Gauss-Seidel news travels one row at a time, and `sweeps` says how often it may. Velocities are
//! not touched. Springs, motors and friction have no error to correct. Restitution: as at velocity
//! level. Catto, *Box2D*, GDC 2007.

use super::velocity;
use crate::body::State;
use crate::constraint::{Bounds, Kind, Row};
use crate::scene::{Contacts, DetectedContact};
use crate::simulation::Cause;
use crate::simulation::correction::{Lever, rows, sources};
use crate::simulation::solving::Solving;

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let mut states = velocity::unbiased(solving, states, found)?;
    let scene = solving.scene;
    for _ in 0..scene.step.sweeps {
        for (source, constraint) in sources(scene, found) {
            for k in 0..rows(source, constraint, &states)?.len() {
                let row = rows(source, constraint, &states)?[k];
                let error = error(&row, &scene.contact);
                let lever = Lever::new(scene, constraint, &row, &states);
                if error != 0.0 && lever.mobility > 0.0 {
                    let y = -error / lever.mobility;
                    lever.shift(y, &mut states);
                    lever.moves(y).for_each(|shift| solving.note(shift));
                }
            }
        }
    }
    Ok(states)
}

/// What of c is to go (m or rad).
fn error(row: &Row, contacts: &Contacts) -> f64 {
    let slop = if row.kind == Kind::Normal { contacts.slop } else { 0.0 };
    match row.bounds {
        _ if row.spring.is_some() => 0.0,
        Bounds::Bilateral => row.c,
        Bounds::Unilateral => (row.c + slop).min(0.0),
        Bounds::Effort(_) | Bounds::Friction { .. } => 0.0,
    }
}
