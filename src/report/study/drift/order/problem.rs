//! The problems with closed forms, and the distances of a simulation from them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::Scene;
use crate::scene::catalogue::bounce::Drop;
use crate::scene::catalogue::fall::Fall;
use crate::scene::catalogue::pendulum::{Pendulum, Swing};
use crate::simulation::{Simulation, Step};

/// A problem with a closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Problem {
    /// A falling stone.
    Fall,
    /// A pendulum released from the height of its pivot.
    Swing,
    /// A ball with e = ½.
    Bounce,
    /// A box on a slope.
    Slide,
}

impl Problem {
    /// The name of the shipped scene.
    pub(crate) fn scene(self) -> &'static str {
        match self {
            Problem::Fall => "free_fall",
            Problem::Swing => "pendulum",
            Problem::Bounce => "bouncing_ball",
            Problem::Slide => "incline",
        }
    }

    /// The measured quantities and their units.
    pub(super) fn quantities(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Problem::Fall => &[("height", "m")],
            Problem::Swing => &[("position", "m"), ("energy", "J"), ("length of the rod", "m")],
            Problem::Bounce => &[("height after a bounce", "m")],
            Problem::Slide => &[("distance", "m")],
        }
    }

    /// The longest step (s).
    pub(super) fn longest(self) -> f64 {
        match self {
            Problem::Fall | Problem::Swing => 0.02,
            Problem::Bounce | Problem::Slide => 0.01,
        }
    }

    /// The errors of the quantities; `None` if the simulation fails.
    pub(super) fn measure(self, scene: &Scene) -> Option<Vec<f64>> {
        let mut simulation = Simulation::of(scene).ok()?;
        let g = scene.gravity.norm();
        let start = scene.states[scene.states.len() - 1];
        match self {
            Problem::Fall => {
                let fall = Fall { height: start.pose.p.z, speed: start.v.z, gravity: g };
                let z = last(&mut simulation, 1.0)?.states[0].pose.p.z;
                Some(vec![(z - fall.height_after(1.0)).abs()])
            }
            Problem::Swing => swing(&mut simulation, g),
            Problem::Bounce => {
                let height = start.pose.p.z - RADIUS;
                let e = scene.contact.restitution;
                let drop = Drop { height, restitution: e, gravity: g };
                let top = top_of_first_flight(&mut simulation, drop.time_of(2))?;
                Some(vec![(top - drop.height_after(1)).abs()])
            }
            Problem::Slide => {
                let (time, angle) = (0.5, 20f64.to_radians());
                let rate = g * (angle.sin() - scene.contact.friction * angle.cos());
                let p = last(&mut simulation, time)?.states[1].pose.p;
                Some(vec![((p - start.pose.p).norm() - 0.5 * rate * time * time).abs()])
            }
        }
    }
}

/// The ball's radius (m).
const RADIUS: f64 = 0.1;

/// The step that ends at this time.
fn last(simulation: &mut Simulation, time: f64) -> Option<Step> {
    let steps = (time / simulation.scene().step.dt).round() as usize;
    (0..steps).map(|_| simulation.step().ok()).last()?
}

/// The position after 1 s, and the largest errors of energy and length until then.
fn swing(simulation: &mut Simulation, gravity: f64) -> Option<Vec<f64>> {
    let first = simulation.motion().energy();
    let (mut energy, mut length) = (0.0f64, 0.0f64);
    let steps = (1.0 / simulation.scene().step.dt).round() as usize;
    for _ in 0..steps {
        let step = simulation.step().ok()?;
        energy = energy.max((step.motion.energy() - first).abs());
        length = length.max(step.motion.drift);
    }
    let pendulum = Pendulum { length: 1.0, gravity };
    let start = Swing { angles: [std::f64::consts::FRAC_PI_2], rates: [0.0] };
    let (sin, cos) = pendulum.after(1.0, start).angles[0].sin_cos();
    let p = simulation.states()[0].pose.p;
    Some(vec![(p.x - sin).hypot(p.z + cos), energy, length])
}

/// The greatest height of the ball's lowest point between its first and second bounce.
fn top_of_first_flight(simulation: &mut Simulation, second: f64) -> Option<f64> {
    let (mut bounces, mut top) = (0, 0.0f64);
    while simulation.time() < second + 0.1 {
        let before = simulation.states()[1].v.z;
        let state = simulation.step().ok()?.states[1];
        bounces += usize::from(before < 0.0 && state.v.z > 0.0);
        if bounces == 1 {
            top = top.max(state.pose.p.z - RADIUS);
        }
    }
    (bounces > 0).then_some(top)
}
