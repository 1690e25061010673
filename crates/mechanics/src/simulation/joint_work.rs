//! Joints of bodies that turn far in a substep.
//!
//! XPBD, the soft step and the penalty method push joints with the directions at the beginning of a
//! substep, or repair them at its end. If a body turns far meanwhile, these directions no longer
//! match the joint, and its forces do work, although those of a rigid joint do none. Where nothing
//! else can change the energy, the change shows it.

use nalgebra::Vector3;

use super::{Motion, Touch};
use crate::body::State;
use crate::constraint::{Bodies, Bounds, Constraint, Row};
use crate::scene::Scene;
use lcplab_lcp::number::readable;

/// Bodies that turn less in a substep (rad) are not examined.
const FAST: f64 = 0.1;
/// Smaller changes of the energy, relative to the kinetic energy before, do not count.
const NOTABLE: f64 = 0.01;

/// The work of rigid joints in a step in which a body turned fast.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointWork {
    /// The bodies of the joint whose body turned fastest.
    pub bodies: Bodies,
    /// By how much that body turned in a substep (rad).
    pub angle: f64,
    /// The energy before and after the step (J).
    pub energy: [f64; 2],
}

impl JointWork {
    /// That of a step that led from the first states to the second, if it is notable and nothing
    /// but joints could change the energy.
    pub(super) fn of(
        scene: &Scene,
        [before, after]: [&[State]; 2],
        touches: &[Touch],
    ) -> Option<JointWork> {
        if !scene.step.scheme.spreads_impacts() || !touches.is_empty() {
            return None;
        }
        let h = scene.step.dt / scene.step.substeps as f64;
        let speed = |bodies: Bodies| {
            bodies.into_iter().flatten().map(|k| before[k].omega.norm()).fold(0.0, f64::max)
        };
        let turning = scene.constraints.iter().map(|own| (own.bodies(), h * speed(own.bodies())));
        let (bodies, angle) = turning.max_by(|a, b| a.1.total_cmp(&b.1))?;
        if !(angle > FAST && only_joints_act(scene, before)) {
            return None;
        }
        let [then, now] = [before, after].map(|states| Motion::overlapping(scene, states, 0, &[]));
        let energy = [then.energy(), now.energy()];
        let is_notable = !((energy[1] - energy[0]).abs() <= NOTABLE * then.kinetic);
        is_notable.then_some(JointWork { bodies, angle, energy })
    }

    /// The work in a sentence.
    pub(super) fn message(&self, scene: &Scene, step: usize) -> String {
        let names = self.bodies.map(|body| body.map(|k| scene.bodies[k].name.as_str()));
        let bodies: Vec<String> = names.iter().flatten().map(|name| format!("{name:?}")).collect();
        let [before, after] = self.energy.map(|energy| readable(energy, 3));
        format!(
            "{} turned by {} rad in a substep of step {step}, in which joints changed the energy from \
             {before} J to {after} J. Forces of rigid joints do no work; the scheme {} needs rotations \
             far below 1 rad in a substep. Increase step.substeps, or use the scheme velocity.",
            bodies.join(" or "),
            readable(self.angle, 2),
            scene.step.scheme.name()
        )
    }
}

/// Whether nothing but gravity, ideal springs and rigid joints acts on the bodies.
///
/// A stop or a rope, whose rows have one side, takes energy when it is reached.
fn only_joints_act(scene: &Scene, states: &[State]) -> bool {
    let is_free = |body: usize| {
        let own = &scene.bodies[body];
        let is_still = own.mass.dof() > 0 || states[body].velocity().norm() == 0.0;
        is_still && own.force == Vector3::zeros() && own.torque == own.force
    };
    let does_no_work = |row: &Row| {
        matches!(row.bounds, Bounds::Bilateral)
            && row.spring.is_none_or(|spring| spring.damping == 0.0)
    };
    let keeps_energy = |own: &dyn Constraint| {
        let states = own.bodies().map(|body| body.map_or(&State::WORLD, |k| &states[k]));
        own.rows(states).is_ok_and(|rows| rows.iter().all(does_no_work))
    };
    scene.driven.is_empty()
        && (0..scene.bodies.len()).all(is_free)
        && scene.constraints.iter().all(|own| keeps_energy(&**own))
}
