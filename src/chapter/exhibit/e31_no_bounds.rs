//! E31: bounds that are never set, K&M Code 7 and IsEquality.

use nalgebra::Vector3;

use super::common::contacts;
use super::setting::{DT, point, weigh, world};
use super::{Finding, Measure};
use crate::chapter::code::code07_whole_step::{Limits, WholeStep};
use crate::chapter::code::constraint_class::Joint;
use crate::error::Result;

/// A body that separates from the ground, and a nail that keeps the default.
pub(super) fn example() -> Result<Finding> {
    let corrected = WholeStep::CORRECTED;
    let parting = |step: &WholeStep| -> Result<(f64, f64)> {
        let joints = vec![Joint::contact([None, Some(0)], 0.0)];
        let mut world = world(vec![point(0.0, 1.0)], joints);
        step.take(&mut world, DT)?;
        Ok((world.bodies[0].linear_velocity.z, world.x[0]))
    };
    let drop = |step: &WholeStep| -> Result<f64> {
        let nail = Joint::ball([None, Some(0)], [Vector3::zeros(); 2]);
        let mut world = world(vec![point(0.0, 0.0)], vec![nail]);
        for _ in 0..60 {
            weigh(&mut world.bodies);
            step.take(&mut world, DT)?;
        }
        Ok(0.0 - world.bodies[0].position.z)
    };
    let (glued, taken) = parting(&WholeStep::PRINTED)?;
    let (free, added) = parting(&corrected)?;
    let by_default = WholeStep { limits: Limits::ByIsEquality, ..WholeStep::PRINTED };
    let speed = Measure::new("u⁺ of the parting body", "m/s", glued, free);
    let fallen =
        Measure::new("drop of the nailed point", "m", drop(&by_default)?, drop(&corrected)?);
    Ok(Finding::new(
        "A body of 1 kg on the ground leaves it at 1 m/s, without forces; dt = 1/60 s. And a body that is \
         nailed through its center hangs for a second, g = 9.81 m/s², with the default of IsEquality as \
         bound: as printed x ≥ 0 in Code 7's own sign, where a loaded nail has x < 0. The judge sees \
         the contact's x in the sign of w = A x + b.",
    )
    .measure(speed.truth(&[1.0], "nothing holds it", 1e-12))
    .measure(fallen.truth(&[0.0], "the nail holds", 1e-12))
    .judged("the parting body: A = 1, b = 1", &contacts(&[1.0], &[1.0])?, &[-taken], &[added]))
}
