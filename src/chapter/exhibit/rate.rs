//! The rate of change of a position by dual numbers: the true values for the exhibits on Jacobians.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use num_dual::Dual2_64;

use crate::body::{Pose, State};

/// dc/dt of each entry of c(s) while the bodies move according to their states.
pub(super) fn rates(
    states: [&State; 2],
    c: impl Fn([&Pose<Dual2_64>; 2]) -> Vec<Dual2_64>,
) -> Vec<f64> {
    let poses = states.map(moving);
    c([&poses[0], &poses[1]]).iter().map(|c| c.v1).collect()
}

/// p + v t and q + q' t at t = 0, with their first derivatives.
fn moving(state: &State) -> Pose<Dual2_64> {
    let (p, q) = (state.pose.p, state.pose.q.coords);
    let (v, q_rate) = state.rate();
    let q = q.zip_map(&q_rate.coords, |q, rate| Dual2_64::new(q, rate, 0.0));
    Pose {
        p: Vector3::from_fn(|k, _| Dual2_64::new(p[k], v[k], 0.0)),
        q: UnitQuaternion::new_unchecked(Quaternion::from_vector(q)),
    }
}

/// A body at p without rotation, with this motion.
pub(super) fn body(p: Vector3<f64>, v: Vector3<f64>, omega: Vector3<f64>) -> State {
    State { pose: Pose { p, ..Pose::default() }, v, omega }
}
