//! E17: the Jacobian as input over output, K&M (9).

use nalgebra::Vector3;
use num_dual::{Dual64, DualNum};

use super::common::jacobian;
use super::{Finding, Measure};
use crate::body::State;
use crate::constraint::Distance;
use crate::error::Result;

/// The distance of a point from the origin.
pub(super) fn example() -> Result<Finding> {
    let (place, velocity) = ([3.0, 4.0], [1.0, 2.0]);
    let c = |x: f64, y: f64| x.hypot(y);
    let h = 1e-6;
    let [x, y] = place;
    let printed = [h / (c(x + h, y) - c(x, y)), h / (c(x, y + h) - c(x, y))];
    let rod = Distance { bodies: [None, Some(0)], anchors: [Vector3::zeros(); 2], length: 5.0 };
    let mut bob = State::WORLD;
    bob.pose.p = Vector3::new(x, y, 0.0);
    let j = jacobian(&rod, &bob)?;
    let corrected = [j[0], j[1]];
    let exact = |x: Dual64, y: Dual64| (x * x + y * y).sqrt().eps;
    let (still, moved) = (|s| Dual64::new(s, 0.0), |s| Dual64::new(s, 1.0));
    let truth = [exact(moved(x), still(y)), exact(still(x), moved(y))];
    let rate = |j: [f64; 2]| j[0] * velocity[0] + j[1] * velocity[1];
    let along = exact(Dual64::new(x, velocity[0]), Dual64::new(y, velocity[1]));
    let entries = Measure::new("J", "", printed, corrected);
    let speed = Measure::new("ċ", "m/s", rate(printed), rate(corrected));
    Ok(Finding::new(
        "c = |p| at p = (3, 4) m, in the plane; the point moves at (1, 2) m/s. Printed: the change of an \
         input by 10⁻⁶ m over the change of c. Corrected: the row of this library's distance constraint.",
    )
    .measure(entries.truth(&truth, "dual numbers", 1e-12))
    .measure(speed.truth(&[along], "dual numbers", 1e-12)))
}
