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
/// Bodies that are looked at so often, one gliding along the other, say, are taken to meet.
const MOST_LOOKS: usize = 1_000;

/// Where bodies are if no contact and no joint acts in a step.
pub(super) struct Paths {
    /// At the end.
    after: Vec<State>,
    /// On the way: that of the two bodies that are looked at.
    moved: Vec<State>,
}

impl Paths {
    pub fn of(scene: &Scene, states: &[State]) -> Self {
        let after = (0..states.len()).map(|body| free(scene, states, body)).collect();
        Paths { after, moved: states.to_vec() }
    }
}

impl Detector {
    /// Whether two parts meet in the step, if no contact and no joint acts.
    pub(super) fn may_meet(
        &mut self,
        scene: &Scene,
        states: &[State],
        pair: [usize; 2],
        Paths { after, moved }: &mut Paths,
    ) -> bool {
        if pair.iter().any(|&solid| self.solids[solid].is_none()) {
            return true; // a half space is its own plane
        }
        let bodies = pair.map(|solid| self.owners[solid].body);
        let path = Path::of(states, after, pair, bodies, &self.arms);
        let (mut theta, mut may_meet) = (0.0_f64, true);
        for _ in 0..MOST_LOOKS {
            let gap = self.nearest(scene, &path, moved, theta).map_or(0.0, |(gap, _)| gap);
            may_meet = gap <= MEETING || theta < 1.0;
            if gap <= MEETING || theta == 1.0 {
                break;
            }
            theta = (theta + gap / path.travel).min(1.0);
        }
        for (solid, body) in pair.into_iter().zip(bodies) {
            moved[body] = states[body];
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
