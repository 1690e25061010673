//! The velocity level: impulses x (N s), w = J u⁺ + bias (m/s).
//!
//! ```text
//! u* = u + dt M⁻¹ F
//! bias = c/dt                       a gap: it may close within the step, not more (speculative)
//!        β/dt min(c + slop, 0)      a contact that overlaps; a limit likewise, without slop
//!        β/dt c                     an equality
//!        0 − v                      friction, v = 0, and motors
//!        β/dt c, γ on the diagonal  a spring, with its own β
//! ```
//!
//! β/dt is the corrected feedback; the chapter prints other factors, see [`Feedback`]. A row that
//! bounces has the bias e J u⁻ instead, never both: feedback added to a bounce would turn a
//! position error into energy. K&M Code 7 has −x (see the errata).

use super::{Problem, Stage};
use crate::assembly::{Assembly, Row};
use crate::constraint::{Bounds, Kind, Spring};
use crate::scene::{Feedback, Scene};

/// u* = u + dt M⁻¹ F.
pub(super) fn target(assembly: &Assembly, dt: f64) -> Vec<f64> {
    let rate = assembly.accelerate(&assembly.force);
    assembly.u.iter().zip(rate).map(|(u, rate)| u + dt * rate).collect()
}

/// The bias of rows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bias {
    /// The duration of a step (s).
    dt: f64,
    /// The factor on errors: β/dt (1/s), or as the chapter prints it.
    feedback: f64,
    /// The overlap of a contact that is not corrected (m).
    slop: f64,
}

impl Bias {
    /// The bias for a scene's steps, with the fraction `beta` of the errors fed back.
    pub fn new(scene: &Scene, beta: f64) -> Self {
        let dt = scene.step.dt;
        let feedback = match scene.step.feedback {
            Feedback::Corrected => beta / dt,
            Feedback::Unscaled => beta,
            Feedback::Printed => -beta,
        };
        Bias { dt, feedback, slop: scene.contact.slop }
    }

    /// The bias of a row with the error c (m or rad) and the speed of its motor (m/s or rad/s).
    pub fn of(
        &self,
        kind: Kind,
        bounds: Bounds,
        spring: Option<Spring>,
        c: f64,
        speed: f64,
    ) -> f64 {
        let slop = if kind == Kind::Normal { self.slop } else { 0.0 };
        match (spring, bounds) {
            (Some(spring), _) => spring.feedback(self.dt) * c,
            (None, Bounds::Friction { .. } | Bounds::Effort(_)) => 0.0 - speed,
            (None, Bounds::Unilateral) if c > 0.0 => c / self.dt,
            (None, Bounds::Unilateral) => self.feedback * (c + slop).min(0.0),
            (None, Bounds::Bilateral) => self.feedback * c,
        }
    }
}

/// The bias of each row, with the fraction `beta` of the errors fed back.
pub(super) fn bias(assembly: &Assembly, scene: &Scene, beta: f64) -> Vec<f64> {
    let bias = Bias::new(scene, beta);
    let rows = assembly.rows.iter();
    let own = |row: &Row| bias.of(row.kind, row.bounds, row.spring, row.c, row.speed);
    rows.map(|row| own(row) + row.drift).collect()
}

/// The bias with e J u⁻ in the rows that bounce after the answer x; `None` if there are none.
pub(super) fn bouncing(problem: &Problem, scene: &Scene, x: &[f64]) -> Option<Vec<f64>> {
    debug_assert!(matches!(problem.stage, Stage::Velocity | Stage::Impact));
    let e = |row: &Row| scene.restitution(row.bodies);
    let least = match problem.stage {
        Stage::Impact => scene.resting().bounce,
        _ => 0.0,
    };
    let is_fast = |row: &Row| {
        let approach = -row.velocity;
        row.kind == Kind::Normal && scene.contact.bounces(approach) && e(row) * approach > least
    };
    let rows = problem.assembly.rows.iter().enumerate().filter(|(_, row)| is_fast(row));
    let hits = rows.filter(|(i, row)| has_closed(x[*i], problem.lcp.row_w(*i, x), row.velocity));
    let mut bias = problem.bias.clone();
    let mut any = false;
    for (i, row) in hits {
        bias[i] = e(row) * row.velocity + row.drift;
        any = true;
    }
    any.then_some(bias)
}

/// A closed contact has kept at most this fraction of its approach speed.
const CLOSED: f64 = 1e-6;

/// Whether a contact with the answer x and w has closed, after approaching with `velocity` = J u⁻
/// < 0. At a solution that means w = 0, which is unique even if x is not; x > 0 also indicates it
/// if sweeps stopped early.
pub(crate) fn has_closed(x: f64, w: f64, velocity: f64) -> bool {
    x > 0.0 || w <= CLOSED * -velocity
}
