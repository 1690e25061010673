//! The gyroscopic torque −ω × I ω, which the chapter leaves out.
//!
//! Taken at the old velocity it feeds energy into a spinning body, without bound. Taken at the new
//! one it is unconditionally stable: with Euler's equations in the body's frame,
//!
//! ```text
//! f(ω⁺) = I (ω⁺ − ω) + dt ω⁺ × I ω⁺ = 0,   f' = I + dt ([ω⁺]× I − [I ω⁺]×)
//! ```
//!
//! solved by Newton's method from ω (Catto, Numerical Methods, GDC 2015). The body-frame axes of
//! the step's start are used, where I is constant.

use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Mass, State};

/// Newton's method converges quadratically from ω; more steps than these change nothing.
const NEWTON_STEPS: usize = 4;

/// What becomes of the gyroscopic torque.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Gyroscopic {
    /// It is left out, as in the chapter: a free body keeps ω, not its angular momentum.
    Omitted,
    /// At the velocity before the step; gains energy.
    Explicit,
    /// At the velocity after the step; loses energy, never diverges.
    #[default]
    Implicit,
}

impl Gyroscopic {
    /// The torque (N m, world) that acts on a body during a step of dt (s).
    pub fn torque(self, mass: &Mass, state: &State, dt: f64) -> Vector3<f64> {
        let Mass::Rigid { moments, .. } = mass else { return Vector3::zeros() };
        let (q, omega) = (state.pose.q, state.pose.q.inverse() * state.omega);
        let inertia = Matrix3::from_diagonal(moments);
        match self {
            Gyroscopic::Omitted => Vector3::zeros(),
            Gyroscopic::Explicit => q * -omega.cross(&(inertia * omega)),
            Gyroscopic::Implicit => {
                q * (inertia * (implicit_spin(&inertia, &omega, dt) - omega) / dt)
            }
        }
    }
}

/// ω⁺ of the implicit step, in the body's frame.
fn implicit_spin(inertia: &Matrix3<f64>, omega: &Vector3<f64>, dt: f64) -> Vector3<f64> {
    let mut next = *omega;
    for _ in 0..NEWTON_STEPS {
        let spin = inertia * next;
        let f = inertia * (next - omega) + dt * next.cross(&spin);
        let slope = inertia + dt * (next.cross_matrix() * inertia - spin.cross_matrix());
        let Some(correction) = slope.lu().solve(&f) else { break };
        next -= correction;
    }
    next
}
