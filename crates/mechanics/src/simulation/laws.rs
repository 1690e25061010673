//! What must hold in every step, measured and never assumed.
//!
//! ```text
//! no attraction    x_n ≥ 0                      the cone   |x_t| ≤ μ x_n  (a box allows √2 μ x_n)
//! dissipation      work of friction ≤ 0         momentum   rows between bodies change neither
//!                                                          Σ m v nor Σ p × m v + I ω
//! ```
//!
//! Penetration and drift stand in [`Motion`](super::Motion), the direction of friction in
//! [`Slip`](super::Slip).

use nalgebra::Vector3;

use super::slip::Totals;
use super::{Ledger, Slip, Solve};
use crate::assembly::{Assembly, Row};
use crate::body::{Body, Gyroscopic, State, angular, linear};
use crate::constraint::Bounds;
use crate::scene::Scene;

/// How far a step is from the laws of contact and of momentum; 0 is perfect.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LawErrors {
    /// The strongest pull of a contact or limit (N s, or N at acceleration level).
    pub attraction: f64,
    /// How far friction reaches out of the cone: the largest |x_t| − μ x_n beyond what the solver's
    /// tolerance allows, in parts of the largest μ x_n of the solve. Up to √2 − 1 in the corners of
    /// a box. Where the scheme poses no problem, of all contacts of two bodies together.
    pub cone_excess: f64,
    /// The work that friction put in (J), 0 if it took some out, and where no ledger knows it. The
    /// belt of a fixed body that moves may put some in.
    pub friction_gain: f64,
    /// The momentum (N s) that rows between two moving bodies made; where the scheme poses no
    /// problem, what is measured in a step in which only such rows act.
    pub internal_impulse: f64,
    /// The angular momentum (N m s) that rows between two moving bodies made; likewise, and only
    /// without gravity and forces and where the integrator itself keeps it.
    pub internal_torque: f64,
}

impl LawErrors {
    /// The laws in a step of a scene that started from these states.
    pub(super) fn of(
        scene: &Scene,
        states: &[State],
        solves: &[Solve],
        ledger: Option<&Ledger>,
    ) -> Self {
        let friction_gain = ledger.map_or(0.0, |ledger| ledger.friction.max(0.0));
        let mut laws = LawErrors { friction_gain, ..LawErrors::default() };
        for Solve { problem, solution, .. } in solves {
            let (rows, x) = (&problem.assembly.rows, problem.efforts(&solution.x));
            let tolerated = scene.solver.tolerance * problem.lcp.scale();
            laws.cone_excess = laws.cone_excess.max(cone_excess(rows, &x, tolerated));
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

    /// The same, measured from the motion, for a scheme that poses no problem. Momentum counts in a
    /// step in which contacts and joints between moving bodies act and no others.
    pub(super) fn of_pushes(
        self,
        scene: &Scene,
        [before, after]: [&[State]; 2],
        totals: &Totals,
        slips: &[Slip],
    ) -> Self {
        let cone_excess = slips.iter().map(|slip| slip.excess).fold(0.0, f64::max);
        let moves = |body: usize| scene.bodies[body].mass.dof() > 0;
        let is_internal = |row: &Row| row.bodies.iter().all(|body| body.is_some_and(moves));
        let acting: Vec<&Row> =
            totals.rows().filter(|(_, impulse)| *impulse != 0.0).map(|(row, _)| row).collect();
        if acting.is_empty() || !acting.iter().all(|row| is_internal(row)) {
            return LawErrors { cone_excess, ..self };
        }
        let bodies = || scene.bodies.iter().zip(before.iter().zip(after));
        let gained = bodies().map(|(body, (old, new))| {
            let given = scene.step.dt * (body.mass.mass() * scene.gravity + body.force);
            body.mass.momentum(new) - body.mass.momentum(old) - given
        });
        let turned = bodies().map(|(body, (old, new))| {
            body.mass.angular_momentum(new) - body.mass.angular_momentum(old)
        });
        let is_free = |body: &Body| body.force == Vector3::zeros() && body.torque == body.force;
        let is_free = scene.gravity == Vector3::zeros() && scene.bodies.iter().all(is_free);
        let keeps_turning = scene.step.gyroscopic == Gyroscopic::Conserving;
        LawErrors {
            cone_excess,
            internal_impulse: gained.sum::<Vector3<f64>>().norm(),
            internal_torque: if is_free && keeps_turning {
                turned.sum::<Vector3<f64>>().norm()
            } else {
                0.0
            },
            ..self
        }
    }

    /// The worse of two steps, law by law.
    ///
    /// ```
    /// use lcplab_mechanics::simulation::LawErrors;
    ///
    /// let pulls = LawErrors { attraction: 0.5, ..LawErrors::default() };
    /// let gains = LawErrors { friction_gain: 2.0, ..LawErrors::default() };
    /// let worse = pulls.worse(gains);
    /// assert_eq!((worse.attraction, worse.friction_gain), (0.5, 2.0));
    /// ```
    pub fn worse(self, other: LawErrors) -> LawErrors {
        LawErrors {
            attraction: self.attraction.max(other.attraction),
            cone_excess: self.cone_excess.max(other.cone_excess),
            friction_gain: self.friction_gain.max(other.friction_gain),
            internal_impulse: self.internal_impulse.max(other.internal_impulse),
            internal_torque: self.internal_torque.max(other.internal_torque),
        }
    }
}

fn cone_excess(rows: &[Row], x: &[f64], tolerated: f64) -> f64 {
    let contacts = rows.iter().enumerate().filter_map(|(i, row)| {
        let Bounds::Friction { normal, mu } = row.bounds else { return None };
        let second = rows.get(i + 1).is_some_and(|next| next.bounds == row.bounds);
        let size = if second { x[i].hypot(x[i + 1]) } else { x[i].abs() };
        Some([size, mu * x[normal].max(0.0)])
    });
    excess_of(contacts, tolerated)
}

/// The largest |x_t| − μ x_n of contacts with these |x_t| and μ x_n beyond what is tolerated, over
/// the largest μ x_n, or |x_t| where all limits are 0; at least 0.
pub(super) fn excess_of(contacts: impl Iterator<Item = [f64; 2]>, tolerated: f64) -> f64 {
    let (mut excess, mut limit, mut largest) = (0.0f64, 0.0f64, 0.0f64);
    for [size, most] in contacts {
        excess = excess.max(size - most - tolerated);
        limit = limit.max(most);
        largest = largest.max(size);
    }
    let beside = if limit > 0.0 { limit } else { largest };
    if excess > 0.0 { excess / beside } else { 0.0 }
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
