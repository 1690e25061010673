//! Tests which separated bodies can meet within a step.
//!
//! A contact that is detected before it touches keeps a body on one side of a plane through the
//! nearest points. Such a plane would deflect a ball that flies past a post without touching it. A
//! contact with a gap above [`LEAST`](super::reach::LEAST) therefore counts only if the bodies meet
//! on the paths given by their velocities and the forces of the step.

use super::Detector;
use super::passage::{Move, Path};
use super::reach::after_forces;
use crate::body::State;
use crate::scene::Scene;

/// Bodies with a smaller gap (m) count as meeting.
const MEETING: f64 = 1e-3;
/// After this number of positions, for example if one body slides along the other, they count as
/// meeting.
const MOST_LOOKS: usize = 1_000;

/// The motion of all bodies in a step without contacts and joints.
pub(super) struct FreeMotion {
    /// The states at the end of the step.
    after: Vec<State>,
    /// Intermediate states of the two bodies under examination.
    moved: Vec<State>,
}

impl FreeMotion {
    pub fn of(scene: &Scene, states: &[State]) -> Self {
        let after = (0..states.len()).map(|body| free(scene, states, body)).collect();
        FreeMotion { after, moved: states.to_vec() }
    }
}

impl Detector {
    /// Whether two parts meet in the step if no contact and no joint acts.
    pub(super) fn may_meet(
        &mut self,
        scene: &Scene,
        states: &[State],
        pair: [usize; 2],
        FreeMotion { after, moved }: &mut FreeMotion,
    ) -> bool {
        if pair.iter().any(|&solid| self.solids[solid].is_none()) {
            // A half space is its own plane.
            return true;
        }
        let bodies = pair.map(|solid| self.owners[solid].body);
        let of = |k: usize| Move::of(&states[k], &after[k], scene.step.dt, self.arms[k]);
        let [a, b] = bodies.map(of);
        let path = Path::of(states, pair, bodies, [&a, &b]);
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

/// The state of a body after the step without contacts and joints, as the scheme moves it: a fast
/// body turns by less than dt ω.
fn free(scene: &Scene, states: &[State], body: usize) -> State {
    let [v, omega] = after_forces(scene, states, body);
    let start = State { v, omega, ..states[body] };
    scene.step.gyroscopic().advanced(&scene.bodies[body].mass, &start, scene.step.dt)
}
