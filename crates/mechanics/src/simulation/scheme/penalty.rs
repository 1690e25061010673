//! The penalty method: no LCP; springs and dampers push where a constraint is broken.
//!
//! ```text
//! x = −k c − d J u                         equations and springs (which have a k and d of their own)
//!     max(0, −k c − d J u) where c < 0     contacts and limits: they never pull
//!     Π(−d (J u − v))                      friction and motors, within their bounds
//! u⁺ = u + h M⁻¹(F + Jᵀx),   s⁺ = s + h S u⁺
//! ```
//!
//! Forces are explicit, so a step has a largest length: without damping h < 2/ω with ω² the largest
//! eigenvalue of k J M⁻¹Jᵀ. Loads are carried by errors, c = −x/k, and friction creeps. There is no
//! coefficient of restitution: damping decides how a body bounces, and e is not looked at.
//! K&M, the first of the chapter's schemes.

use super::substepped;
use crate::assembly::{Assembly, Entering, Row};
use crate::body::State;
use crate::constraint::Bounds;
use crate::scene::{Found, Penalty};
use crate::simulation::solving::{Solving, assembled};
use crate::simulation::{Act, Cause, Push};

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[Found],
) -> Result<Vec<State>, Cause> {
    let scene = substepped(solving.scene);
    let h = scene.step.dt;
    let mut states = states.to_vec();
    for _ in 0..scene.step.substeps {
        let assembly = assembled(&scene, &states, found, Entering::Near)?;
        let x = forces(&assembly, &scene.step.penalty);
        let pull = assembly.pull_back(&x);
        let force: Vec<f64> = assembly.force.iter().zip(pull).map(|(f, x)| f + x).collect();
        let rates = assembly.accelerate(&force);
        let u: Vec<f64> = assembly.u.iter().zip(rates).map(|(u, rate)| u + h * rate).collect();
        let moved = assembly.with_velocities(&states, &u);
        states = assembly.advanced(&moved, h);
        let impulses: Vec<f64> = x.iter().map(|x| h * x).collect();
        let feedback = vec![0.0; impulses.len()];
        solving.note(Act::Push(Push { assembly, h, impulses, feedback, bounces: false }));
        solving.note(Act::Advance(h));
    }
    Ok(states)
}

/// x (N, N m), a row each.
fn forces(assembly: &Assembly, settings: &Penalty) -> Vec<f64> {
    let mut x: Vec<f64> = Vec::with_capacity(assembly.rows.len());
    for row in &assembly.rows {
        let force = force(row, settings, &x);
        x.push(force);
    }
    x
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
