//! The penalty method: no LCP; springs and dampers push where a constraint is broken.
//!
//! ```text
//! x = −k c − d J u                         equations and springs (which have a k and d of their own)
//!     max(0, −k c − d J u) where c < 0     contacts and limits: they never pull
//!     Π(−d (J u − v))                      friction, within its bounds
//!     Π(−(J u' − v)/(h J M⁻¹Jᵀ))           motors: what brings the row to its speed in a substep,
//!                                          with u' the velocity under all other forces
//! u⁺ = u + h M⁻¹(F + Jᵀx),   s⁺ = s + h S u⁺
//! ```
//!
//! Forces are explicit, so a step has a largest length: without damping h < 2/ω with ω² the largest
//! eigenvalue of k J M⁻¹Jᵀ. Loads are carried by errors, c = −x/k, and friction creeps. There is no
//! coefficient of restitution: damping decides how a body bounces, and e has no effect.
//! K&M, the first of the chapter's schemes.

use super::{substepped, supported};
use crate::assembly::{Assembly, ConstraintFilter, Row};
use crate::body::State;
use crate::constraint::Bounds;
use crate::scene::{DetectedContact, Penalty};
use crate::simulation::solving::{Solving, assembled};
use crate::simulation::sweep::Sweeper;
use crate::simulation::{Cause, StepEvent, VelocityUpdate};

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let scene = substepped(solving.scene);
    let h = scene.step.dt;
    let mut states = states.to_vec();
    for substep in 0..scene.step.substeps {
        states = supported(solving, &scene, &states, substep);
        let assembly = assembled(&scene, &states, found, ConstraintFilter::Near)?;
        let x = forces(&assembly, &scene.step.penalty, h);
        let u = after(&assembly, h, &x);
        let moved = assembly.with_velocities(&states, &u);
        states = assembly.advanced(&moved, h);
        let impulses: Vec<f64> = x.iter().map(|x| h * x).collect();
        let feedback = vec![0.0; impulses.len()];
        solving.note(StepEvent::VelocityUpdate(VelocityUpdate {
            assembly,
            h,
            impulses,
            feedback,
            bounces: false,
        }));
        solving.note(StepEvent::Advance(h));
    }
    Ok(states)
}

/// x (N, N m), a row each.
fn forces(assembly: &Assembly, settings: &Penalty, h: f64) -> Vec<f64> {
    let mut x: Vec<f64> = Vec::with_capacity(assembly.rows.len());
    for row in &assembly.rows {
        x.push(if is_motor(row) { 0.0 } else { force(row, settings, &x) });
    }
    drive(assembly, h, &mut x);
    x
}

fn is_motor(row: &Row) -> bool {
    matches!(row.bounds, Bounds::Effort(_)) && row.spring.is_none()
}

/// Adds the forces of motors, one after the other: each brings its row to its speed at the end of
/// the substep, against all forces so far, those of joints and contacts included.
fn drive(assembly: &Assembly, h: f64, x: &mut [f64]) {
    let rows = &assembly.rows;
    if !rows.iter().any(is_motor) {
        return;
    }
    let sweeper = Sweeper::new(assembly, h);
    let mut u = after(assembly, h, x);
    for (i, row) in rows.iter().enumerate().filter(|(_, row)| is_motor(row)) {
        let mobility = sweeper.diagonal(i);
        if let Bounds::Effort(effort) = row.bounds
            && mobility > 0.0
        {
            let missing = row.speed - row.drift - sweeper.velocity(i, &u);
            x[i] = (missing / (h * mobility)).clamp(-effort, effort);
            sweeper.push(i, h * x[i], &mut u);
        }
    }
}

/// u + h M⁻¹(F + Jᵀx).
fn after(assembly: &Assembly, h: f64, x: &[f64]) -> Vec<f64> {
    let pull = assembly.pull_back(x);
    let force: Vec<f64> = assembly.force.iter().zip(pull).map(|(f, x)| f + x).collect();
    let rates = assembly.accelerate(&force);
    assembly.u.iter().zip(rates).map(|(u, rate)| u + h * rate).collect()
}

/// The force of a row after those before it: of a contact the normal row comes first.
fn force(row: &Row, settings: &Penalty, before: &[f64]) -> f64 {
    let (k, d) = match row.spring {
        Some(spring) => (spring.stiffness, spring.damping),
        None => (settings.stiffness, settings.damping),
    };
    let spring = -k * row.c - d * row.velocity;
    let drive = -d * (row.velocity - row.speed);
    match row.bounds {
        Bounds::Bilateral => spring,
        Bounds::Unilateral if row.c < 0.0 => spring.max(0.0),
        Bounds::Unilateral => 0.0,
        Bounds::Effort(effort) => drive.clamp(-effort, effort),
        Bounds::Friction { normal, mu } => drive.clamp(-mu * before[normal], mu * before[normal]),
    }
}
