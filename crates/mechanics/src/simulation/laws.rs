//! What must hold in every step, measured and never assumed.
//!
//! ```text
//! no attraction    x_n ≥ 0                      the cone   |x_t| ≤ μ x_n  (a box allows √2 μ x_n)
//! friction opposes the slip    x_t = −μ x_n w_t/|w_t|  (a box and a polygon turn it aside)
//! dissipation      work of friction ≤ 0         momentum   rows between bodies change neither
//!                                                          Σ m v nor Σ p × m v + I ω
//! ```
//!
//! Penetration and drift stand in [`Motion`](super::Motion).

use nalgebra::{Vector2, Vector3};

use super::{Ledger, Solve};
use crate::assembly::{Assembly, Row};
use crate::body::{State, angular, linear};
use crate::constraint::Bounds;
use crate::formulation::Stage;
use crate::scene::Scene;

/// How far a step is from the laws of contact and of momentum; 0 is perfect.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Laws {
    /// The strongest pull of a contact or limit (N s, or N at acceleration level).
    pub attraction: f64,
    /// How far friction reaches out of the cone: the largest |x_t| − μ x_n beyond what the solver's
    /// tolerance allows, in parts of the largest μ x_n of the solve. Up to √2 − 1 in the corners of a
    /// box.
    pub cone_excess: f64,
    /// The largest angle (rad) between the friction of a contact that slides and the line of its
    /// slip at the end of the step, at velocity level.
    pub askew: f64,
    /// The work that friction put in (J), 0 if it took some out, and where no ledger knows it. The belt of a
    /// fixed body that moves may put some in.
    pub friction_gain: f64,
    /// The momentum (N s) that rows between two moving bodies made.
    pub internal_impulse: f64,
    /// The angular momentum (N m s) that rows between two moving bodies made.
    pub internal_torque: f64,
}

impl Laws {
    /// The laws in a step of a scene that started from these states.
    pub(super) fn of(
        scene: &Scene,
        states: &[State],
        solves: &[Solve],
        ledger: Option<&Ledger>,
    ) -> Self {
        let friction_gain = ledger.map_or(0.0, |ledger| ledger.friction.max(0.0));
        let mut laws = Laws { friction_gain, ..Laws::default() };
        for Solve { problem, solution, .. } in solves {
            let (rows, x) = (&problem.assembly.rows, problem.efforts(&solution.x));
            let tolerated = scene.solver.tolerance * problem.lcp.scale();
            laws.cone_excess = laws.cone_excess.max(cone_excess(rows, &x, tolerated));
            if problem.stage == Stage::Velocity {
                let slip = scene.resting().speed;
                laws.askew = laws.askew.max(askew(rows, &x, &solution.w, slip));
            }
            for (i, row) in rows.iter().enumerate() {
                if row.bounds == Bounds::Unilateral {
                    laws.attraction = laws.attraction.max(-x[i]);
                }
                let (force, torque) = internal(&problem.assembly, row, states);
                laws.internal_impulse = laws.internal_impulse.max((x[i] * force).norm());
                laws.internal_torque = laws.internal_torque.max((x[i] * torque).norm());
            }
        }
        laws
    }

    /// The worse of two steps, law by law.
    pub fn worse(self, other: Laws) -> Laws {
        Laws {
            attraction: self.attraction.max(other.attraction),
            cone_excess: self.cone_excess.max(other.cone_excess),
            askew: self.askew.max(other.askew),
            friction_gain: self.friction_gain.max(other.friction_gain),
            internal_impulse: self.internal_impulse.max(other.internal_impulse),
            internal_torque: self.internal_torque.max(other.internal_torque),
        }
    }
}

/// The largest |x_t| − μ x_n beyond what is tolerated, over the largest μ x_n or |x_t|, at least 0.
fn cone_excess(rows: &[Row], x: &[f64], tolerated: f64) -> f64 {
    let (mut excess, mut limit, mut largest) = (0.0f64, 0.0f64, 0.0f64);
    for (i, row) in rows.iter().enumerate() {
        let Bounds::Friction { normal, mu } = row.bounds else { continue };
        let second = rows.get(i + 1).is_some_and(|next| next.bounds == row.bounds);
        let size = if second { x[i].hypot(x[i + 1]) } else { x[i].abs() };
        excess = excess.max(size - mu * x[normal].max(0.0) - tolerated);
        limit = limit.max(mu * x[normal]);
        largest = largest.max(size);
    }
    let beside = if limit > 0.0 { limit } else { largest };
    if excess > 0.0 { excess / beside } else { 0.0 }
}

/// The largest angle (rad) between x_t and −w_t of contacts that slip faster than this (m/s) and
/// whose friction is as strong as it may be.
fn askew(rows: &[Row], x: &[f64], w: &[f64], slip: f64) -> f64 {
    let angle = |(i, pair): (usize, &[Row])| {
        let Bounds::Friction { normal, mu } = pair[0].bounds else { return 0.0 };
        if pair[1].bounds != pair[0].bounds || pair[0].id.source != pair[1].id.source {
            return 0.0;
        }
        let [friction, speed] = [x, w].map(|v| Vector2::new(v[i], v[i + 1]));
        let is_full = friction.norm() > 0.5 * mu * x[normal] && friction.norm() > 0.0;
        if is_full && speed.norm() > slip { friction.angle(&-speed) } else { 0.0 }
    };
    rows.windows(2).enumerate().map(angle).fold(0.0, f64::max)
}

/// The force and the torque about the world's origin that a unit x of a row leaves over, if both
/// of its bodies move.
fn internal(assembly: &Assembly, row: &Row, states: &[State]) -> (Vector3<f64>, Vector3<f64>) {
    let mut sum = (Vector3::zeros(), Vector3::zeros());
    if row.parts().count() == 2 {
        for part in row.parts() {
            let (force, torque) = (linear(&part.jacobian), angular(&part.jacobian));
            let arm = states[assembly.blocks[part.block].body].pose.p;
            sum.0 += force;
            sum.1 += arm.cross(&force) + torque;
        }
    }
    sum
}
