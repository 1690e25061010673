//! The velocity level: impulses x (N s), w = J u⁺ + bias (m/s).
//!
//! ```text
//! u* = u + dt M⁻¹ F
//! bias = c/dt                       a gap: it may close within the step, not more (speculative)
//!        β/dt min(c + slop, 0)      a contact that overlaps; a limit likewise, without slop
//!        β/dt c                     an equality
//!        0 − v                      friction, v = 0, and motors
//!        β/dt c, γ on the diagonal  a spring, with its own β
//! ```
//!
//! β/dt is the corrected feedback; the chapter prints others, see [`Feedback`]. A row that bounces
//! has the bias e J u⁻ instead, never beside: a bias added to the bounce would turn a position error
//! into energy. K&M Code 7 has −x (see the errata), `math §4`.

use super::{Problem, Stage};
use crate::assembly::{Assembly, Row};
use crate::constraint::{Bounds, Kind};
use crate::scene::{Feedback, Scene};

/// u* = u + dt M⁻¹ F.
pub(super) fn target(assembly: &Assembly, dt: f64) -> Vec<f64> {
    let rate = assembly.accelerate(&assembly.force);
    assembly.u.iter().zip(rate).map(|(u, rate)| u + dt * rate).collect()
}

/// The bias of each row, with the part `beta` of the errors fed back.
pub(super) fn bias(assembly: &Assembly, scene: &Scene, beta: f64) -> Vec<f64> {
    let dt = scene.step.dt;
    let feedback = match scene.step.feedback {
        Feedback::Corrected => beta / dt,
        Feedback::Unscaled => beta,
        Feedback::Printed => -beta,
    };
    let slop = |row: &Row| if row.kind == Kind::Normal { scene.contact.slop } else { 0.0 };
    let bias = |row: &Row| match (row.spring, row.bounds) {
        (Some(spring), _) => spring.feedback(dt) * row.c,
        (None, Bounds::Friction { .. } | Bounds::Effort(_)) => 0.0 - row.speed,
        (None, Bounds::Unilateral) if row.c > 0.0 => row.c / dt,
        (None, Bounds::Unilateral) => feedback * (row.c + slop(row)).min(0.0),
        (None, Bounds::Bilateral) => feedback * row.c,
    };
    assembly.rows.iter().map(bias).collect()
}

/// The bias with e J u⁻ in the rows that bounce after the answer x, if any does.
pub(super) fn bouncing(problem: &Problem, scene: &Scene, x: &[f64]) -> Option<Vec<f64>> {
    debug_assert!(matches!(problem.stage, Stage::Velocity | Stage::Impact));
    let e = scene.contact.restitution;
    let mut bias = problem.bias.clone();
    let mut any = false;
    for ((row, x), bias) in problem.assembly.rows.iter().zip(x).zip(&mut bias) {
        let hit =
            row.kind == Kind::Normal && *x > 0.0 && row.velocity < -scene.contact.bounce_speed;
        if hit && e > 0.0 {
            *bias = e * row.velocity;
            any = true;
        }
    }
    any.then_some(bias)
}
