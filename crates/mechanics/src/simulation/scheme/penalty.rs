//! The penalty method: no LCP; springs and dampers push where a constraint is broken.
//!
//! ```text
//! x = −k c − d J u                         equations and springs (which have a k and d of their own)
//!     max(0, −k c − d J u) where c < 0     contacts and limits: they never pull
//!     Π(−d (J u − v))                      friction, within its bounds
//!     Π(−(J (u + h M⁻¹F) − v)/(h J M⁻¹Jᵀ)) motors: what brings the row to its speed in a substep
//! u⁺ = u + h M⁻¹(F + Jᵀx),   s⁺ = s + h S u⁺
//! ```
//!
//! Forces are explicit, so a step has a largest length: without damping h < 2/ω with ω² the largest
//! eigenvalue of k J M⁻¹Jᵀ. Loads are carried by errors, c = −x/k, and friction creeps. There is no
//! coefficient of restitution: damping decides how a body bounces, and e is not looked at.
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
        let pull = assembly.pull_back(&x);
        let force: Vec<f64> = assembly.force.iter().zip(pull).map(|(f, x)| f + x).collect();
        let rates = assembly.accelerate(&force);
        let u: Vec<f64> = assembly.u.iter().zip(rates).map(|(u, rate)| u + h * rate).collect();
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
    let drives = drives(assembly, h);
    let mut x: Vec<f64> = Vec::with_capacity(assembly.rows.len());
    for (row, drive) in assembly.rows.iter().zip(drives) {
        let force = drive.unwrap_or_else(|| force(row, settings, &x));
        x.push(force);
    }
    x
}

/// The forces of motors; `None` of all other rows.
fn drives(assembly: &Assembly, h: f64) -> Vec<Option<f64>> {
    let mut drives = vec![None; assembly.rows.len()];
    let is_motor = |row: &Row| matches!(row.bounds, Bounds::Effort(_)) && row.spring.is_none();
    if !assembly.rows.iter().any(is_motor) {
        return drives;
    }
    let sweeper = Sweeper::new(assembly, h);
    let free = assembly.push_forward(&assembly.accelerate(&assembly.force));
    for (i, row) in assembly.rows.iter().enumerate() {
        let mobility = sweeper.diagonal(i);
        if let Bounds::Effort(effort) = row.bounds
            && is_motor(row)
            && mobility > 0.0
        {
            let missing = row.speed - row.velocity - h * free[i];
            drives[i] = Some((missing / (h * mobility)).clamp(-effort, effort));
        }
    }
    drives
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
