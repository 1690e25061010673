//! Which bodies that are far apart may meet within a step.
//!
//! A contact that is known before it touches keeps a body behind a plane: the one through the nearest
//! points of the two bodies as they stand. A ball that flies past a post would be turned away by the plane
//! of a post that it never touches. So from a gap of [`LEAST`](super::reach::LEAST) on a contact counts only if
//! the bodies meet on the paths that their velocities and the forces of the step give them.

use super::Detector;
use super::passage::Path;
use super::reach::after_forces;
use crate::body::{Pose, State};
use crate::scene::Scene;
use nalgebra::UnitQuaternion;

/// Bodies that come as near as this (m) meet.
const MEETING: f64 = 1e-3;

impl Detector {
    /// Whether two parts meet in the step, if no contact and no joint acts.
    pub(super) fn may_meet(&mut self, scene: &Scene, states: &[State], pair: [usize; 2]) -> bool {
        if pair.iter().any(|&solid| self.solids[solid].is_none()) {
            return true; // a half space is its own plane
        }
        let bodies = pair.map(|solid| self.owners[solid].body);
        let mut after = states.to_vec();
        for body in bodies {
            after[body] = free(scene, states, body);
        }
        let path = Path::of(states, &after, pair, bodies, &self.arms);
        let mut moved = states.to_vec();
        let mut theta = 0.0_f64;
        let may_meet = loop {
            let gap = self.nearest(scene, &path, &mut moved, theta).map_or(0.0, |(gap, _)| gap);
            if gap <= MEETING || theta == 1.0 {
                break gap <= MEETING;
            }
            theta = (theta + gap / path.travel).min(1.0);
        };
        for (solid, body) in pair.into_iter().zip(bodies) {
            if let Some(solid) = &mut self.solids[solid] {
                solid.place(&states[body].pose);
            }
        }
        may_meet
    }
}

/// Where a body is after the step without contacts and joints.
fn free(scene: &Scene, states: &[State], body: usize) -> State {
    let (state, dt) = (&states[body], scene.step.dt);
    let [v, omega] = after_forces(scene, states, body);
    let q = UnitQuaternion::from_scaled_axis(dt * omega) * state.pose.q;
    State { pose: Pose { p: state.pose.p + dt * v, q }, ..*state }
}
