//! E43: which body rotates the normal, K&M (43).

use nalgebra::Vector3;
use num_dual::Dual2_64;

use super::rate::{body, rates};
use super::{Finding, Measure};
use crate::body::{Pose, State};
use crate::error::Result;

/// The same normal with three owners, and a gap along it.
pub(super) fn example() -> Result<Finding> {
    let n = Vector3::y();
    let [r0, r1] = [Vector3::x(), -Vector3::y()];
    let states = |x: f64| {
        let resting = body(Vector3::zeros(), Vector3::zeros(), Vector3::z());
        [resting, body(Vector3::new(x, 2.0, 0.0), 2.0 * Vector3::y(), 2.0 * Vector3::z())]
    };
    let oblique = states(3.0);
    let along = states(1.0);
    let gap = |[s0, s1]: &[State; 2]| (s1.pose.p + r1) - (s0.pose.p + r0);
    let row = |[s0, s1]: &[State; 2], a0: Vector3<f64>, a1: Vector3<f64>| {
        n.dot(&(s1.v - s0.v)) - a0.cross(&n).dot(&s0.omega) + a1.cross(&n).dot(&s1.omega)
    };
    let truth =
        |states: &[State; 2],
         normal: fn([&Pose<Dual2_64>; 2], &Vector3<f64>) -> Vector3<Dual2_64>| {
            let c = |poses: [&Pose<Dual2_64>; 2]| {
                vec![normal(poses, &n).dot(&(poses[1].point(&r1) - poses[0].point(&r0)))]
            };
            rates([&states[0], &states[1]], c)
        };
    let d = gap(&oblique);
    let (dropped, of_body_0, of_body_1) =
        (row(&oblique, r0, r1), row(&oblique, r0 + d, r1), row(&oblique, r0, r1 - d));
    let on_body_0 = truth(&oblique, |poses, n| poses[0].direction(n));
    let on_body_1 = truth(&oblique, |poses, n| poses[1].direction(n));
    let on_world = truth(&oblique, |_, n| n.map(Dual2_64::from));
    let parallel = truth(&along, |poses, n| poses[1].direction(n));

    let measure = |quantity: &str, printed: f64, corrected: f64, truth: &[f64]| {
        Measure::new(quantity, "m/s", printed, corrected).truth(truth, "dual numbers", 1e-9)
    };
    Ok(Finding::new(
        "Body 0 rests at the origin and spins about z with 1 rad/s; body 1 has its center at (3, 2, 0) m, \
         rises with 2 m/s and spins with 2 rad/s. Anchors r₀ = (1, 0, 0) m and r₁ = (0, −1, 0) m, n = (0, 1, 0), \
         so d = (2, 1, 0) m. The rate of c = d·n by rows without the last term, with the ω of the other \
         body, and with that of the owner. In the last line body 1 is at (1, 2, 0) m, and d = (0, 1, 0) m \
         is parallel to n.",
    )
    .measure(measure("n on body 1, no term", dropped, of_body_1, &on_body_1))
    .measure(measure("n on body 1, other ω", of_body_0, of_body_1, &on_body_1))
    .measure(measure("n on body 0, no term", dropped, of_body_0, &on_body_0))
    .measure(measure("n of the world, no term", dropped, dropped, &on_world).agreeing())
    .measure(
        measure("d parallel to n, no term", row(&along, r0, r1), row(&along, r0, r1 - gap(&along)), &parallel)
            .agreeing(),
    ))
}
