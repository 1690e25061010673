//! The acceleration level: forces x (N), w = d²c/dt² + 2α dc/dt + α² c (m/s²).
//!
//! ```text
//! b = J M⁻¹F + J'u + 2α J u + α² c          errors of position and velocity decay like e^(−αt)
//! b = J M⁻¹F + J'u + J u/dt                 friction: the slip after the step, over dt
//! b = J M⁻¹F + J'u + (J u − v)/dt           a motor: the speed v is reached within the step
//! b = J M⁻¹F + J'u + (J u + (β/dt) c)/dt    a spring, with γ on the diagonal: x = −(k c⁺ + d ċ⁺)
//! ```
//!
//! A spring anticipates the step in this way under the semi-implicit Euler method. The other
//! integrators can evaluate forces that depend on the state, so they get lo = hi = −(k c + d ċ) at
//! each of their stages.
//!
//! A contact or limit that separates no faster than a resting one may
//! ([`Resting`](crate::scene::Resting)) is treated as closed only as far as the body would return
//! within the step: with ċ beyond the speed at which α pushes an overlap apart,
//!
//! ```text
//! b = J M⁻¹F + J'u + 2α J u + α² c + max(0, 1/dt − 2α) max(0, J u − α max(−c, 0))
//! ```
//!
//! A friction force opposes the slip, not its acceleration. With J u/dt in its row, the force stops
//! the slip within the step if its bound allows, and otherwise is at the bound, against the slip:
//! this is the box model of the velocity level, for accelerations. Without this term, a force at
//! its bound could point either way depending on the other forces, even along the slip. A motor is
//! dry friction relative to a speed other than 0.

use crate::assembly::{Assembly, Row};
use crate::constraint::Bounds;
use crate::scene::{Integrator, Scene};

use super::Stage;

/// The force (N, N m) of a spring's row that its integrator evaluates explicitly; `None` for rows
/// whose force is unknown.
pub(super) fn spring_force(row: &Row, stage: Stage, scene: &Scene) -> Option<f64> {
    let spring = row.spring.filter(|_| stage == Stage::Acceleration)?;
    let is_bilateral = row.bounds == Bounds::Bilateral;
    let looks_ahead = scene.step.integrator == Integrator::SemiImplicitEuler;
    let force = || 0.0 - spring.stiffness * row.c - spring.damping * row.velocity;
    (is_bilateral && !looks_ahead).then(force)
}

pub(super) fn bias(assembly: &Assembly, scene: &Scene) -> Vec<f64> {
    let (dt, alpha) = (scene.step.dt, scene.step.alpha);
    let bias = |row: &Row| {
        let error = match (row.spring, row.bounds) {
            (Some(spring), _) => (row.velocity + spring.feedback(dt) * row.c) / dt,
            (None, Bounds::Friction { .. } | Bounds::Effort(_)) => (row.velocity - row.speed) / dt,
            (None, bounds) => {
                let feedback = 2.0 * alpha * row.velocity + alpha * alpha * row.c;
                let parting = row.velocity - alpha * (-row.c).max(0.0);
                match bounds == Bounds::Unilateral && parting > 0.0 {
                    true => feedback + (1.0 / dt - 2.0 * alpha).max(0.0) * parting,
                    false => feedback,
                }
            }
        };
        row.velocity_product + error
    };
    assembly.rows.iter().map(bias).collect()
}
