//! The acceleration level: forces x (N), w = d²c/dt² + 2α dc/dt + α² c (m/s²).
//!
//! ```text
//! b = J M⁻¹F + J'u + 2α J u + α² c       errors of position and velocity decay like e^(−αt)
//! b = J M⁻¹F + J'u + J u/dt              friction: the slip after the step, over dt
//! ```
//!
//! A friction force opposes the slip, not its acceleration. With J u/dt in its row the force stops
//! the slip within the step where its bound allows, and is at the bound, against the slip, where it
//! does not: the box model of the velocity level, on accelerations. Without it, a force at its bound
//! would flip to whichever side the other forces pull, even against the slip. `math §4`.

use crate::assembly::{Assembly, Row};
use crate::constraint::Kind;
use crate::scene::Scene;

pub(super) fn bias(assembly: &Assembly, scene: &Scene) -> Vec<f64> {
    let (dt, alpha) = (scene.step.dt, scene.step.alpha);
    let bias = |row: &Row| match row.kind {
        Kind::Friction => row.velocity_product + row.velocity / dt,
        _ => row.velocity_product + 2.0 * alpha * row.velocity + alpha * alpha * row.c,
    };
    assembly.rows.iter().map(bias).collect()
}
