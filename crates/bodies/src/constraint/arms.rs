//! The relative motion of two anchors, which all point constraints use.
//!
//! ```text
//! r = R r_body,   d = (p1 + r1) − (p0 + r0),   rel = v1 + ω1×r1 − v0 − ω0×r0,
//! cent = ω1×(ω1×r1) − ω0×(ω0×r0),   so d' = rel and d'' = (linear in u') + cent
//! ```

use nalgebra::{RealField, Vector3, Vector6};

use crate::body::{Pose, State, stack};

/// Two anchors at one instant; all vectors in world axes.
pub(super) struct Arms {
    /// From each center of mass to its anchor (m).
    pub r: [Vector3<f64>; 2],
    /// From anchor 0 to anchor 1 (m).
    pub d: Vector3<f64>,
    /// d' (m/s).
    pub rel: Vector3<f64>,
    /// The velocity product of d'' (m/s²).
    pub cent: Vector3<f64>,
}

impl Arms {
    #[inline]
    pub fn new(states: [&State; 2], anchors: &[Vector3<f64>; 2]) -> Self {
        let [r0, r1] = [0, 1].map(|k| states[k].pose.direction(&anchors[k]));
        let [s0, s1] = states;
        Arms {
            r: [r0, r1],
            d: (s1.pose.p + r1) - (s0.pose.p + r0),
            rel: s1.v + s1.omega.cross(&r1) - s0.v - s0.omega.cross(&r0),
            cent: s1.omega.cross(&s1.omega.cross(&r1)) - s0.omega.cross(&s0.omega.cross(&r0)),
        }
    }

    /// The row of n · d' for a constant direction n: [−n, −(r0×n), n, r1×n].
    #[inline]
    pub fn row(&self, n: &Vector3<f64>) -> [Vector6<f64>; 2] {
        let [r0, r1] = &self.r;
        [stack(-n, -r0.cross(n)), stack(*n, r1.cross(n))]
    }

    /// The row of (n · d)' for a direction n fixed to body 0, which rotates with it: [−n,
    /// −((r0+d)×n), n, r1×n].
    #[inline]
    pub(crate) fn row_with_normal_on_body_0(&self, n: &Vector3<f64>) -> [Vector6<f64>; 2] {
        let [r0, r1] = &self.r;
        [stack(-n, -(r0 + self.d).cross(n)), stack(*n, r1.cross(n))]
    }

    /// J'u of c = n · d with n fixed to body 0 (not necessarily a unit vector): n·cent + 2
    /// (ω0×n)·rel + (ω0×(ω0×n))·d.
    #[inline]
    pub(crate) fn product_with_normal_on_body_0(
        &self,
        n: &Vector3<f64>,
        omega0: &Vector3<f64>,
    ) -> f64 {
        let turn = omega0.cross(n);
        n.dot(&self.cent) + 2.0 * turn.dot(&self.rel) + omega0.cross(&turn).dot(&self.d)
    }

    /// J'u of c = |d| with n = d/|d|: n·cent + (|rel|² − (n·rel)²)/|d|.
    #[inline]
    pub(crate) fn product_of_distance(&self, n: &Vector3<f64>) -> f64 {
        let across = self.rel - n * n.dot(&self.rel);
        n.dot(&self.cent) + across.norm_squared() / self.d.norm()
    }
}

/// The row of m·(ω1 − ω0): [0, −m, 0, m].
pub(super) fn turning_row(m: &Vector3<f64>) -> [Vector6<f64>; 2] {
    [stack(Vector3::zeros(), -m), stack(Vector3::zeros(), *m)]
}

/// d for any real scalar type.
pub(super) fn separation<T: RealField + Copy>(
    poses: [&Pose<T>; 2],
    anchors: &[Vector3<f64>; 2],
) -> Vector3<T> {
    poses[1].point(&anchors[1]) - poses[0].point(&anchors[0])
}
