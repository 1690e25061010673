//! Shapes and blocks of the Jacobian and of what it multiplies.

use nalgebra::{DMatrix, DVector, Vector3};
use num_dual::{Dual64, DualNum};

use super::common::product;
use super::rate::{body, rates};
use super::{Finding, Measure, Outcome};
use crate::error::Result;

const BODIES: usize = 3;

/// E15: the Jacobian's shape.
///
/// Three bodies in a line and the gaps between them.
pub(super) fn shape_of_the_jacobian() -> Result<Finding> {
    let gap = |i: usize, k: usize| f64::from(k == 6 * (i + 1)) - f64::from(k == 6 * i);
    let j = DMatrix::from_fn(BODIES - 1, 6 * BODIES, gap);
    let (places, speeds) = ([0.0, 2.0, 5.0], [1.0, 3.0, 6.0]);
    let u = DVector::from_fn(6 * BODIES, |k, _| if k % 6 == 0 { speeds[k / 6] } else { 0.0 });
    let u = DMatrix::from_columns(&[u]);
    // The gaps before and after half a second.
    let after = |k: usize| places[k] + 0.5 * speeds[k];
    let rate = |i: usize| ((after(i + 1) - after(i)) - (places[i + 1] - places[i])) / 0.5;
    let rates =
        Measure::new("rates of the gaps", "m/s", product(&j.transpose(), &u), product(&j, &u));
    Ok(Finding::new(
        "Three bodies at 0, 2 and 5 m along x move along it at 1, 3 and 6 m/s: 6m = 18 velocities. Two \
         constraints, the gaps between neighbors: n = 2. We multiply J by the velocities u.",
    )
    .measure(rates.truth(&[rate(0), rate(1)], "gaps after ½ s", 1e-12)))
}

/// E16: the blocks of the Jacobian and what they multiply, K&M (7), (8).
///
/// The height of a point on a body that rises and rotates.
pub(super) fn blocks_of_the_jacobian() -> Result<Finding> {
    let (r, n) = (Vector3::new(0.0, 0.5, 0.2), Vector3::z());
    let (v, omega) = (Vector3::new(0.0, 0.0, 0.3), Vector3::new(2.0, 0.0, 0.0));
    let row = |v: Vector3<f64>| DMatrix::from_row_slice(1, 3, v.as_slice());
    let (j_v, j_omega) = (row(n), row(r.cross(&n)));
    let u = DMatrix::from_column_slice(6, 1, &[v.as_slice(), omega.as_slice()].concat());
    let corrected = (&j_v * v + &j_omega * omega)[0];
    // t = 0 + ε: the exact derivative of the height along the motion.
    let t = Dual64::new(0.0, 1.0);
    let angle = t * omega.x;
    let height = t * v.z + angle.sin() * r.y + angle.cos() * r.z;
    let rate = Measure::new("rate of the height", "m/s", product(&j_v, &u), corrected);
    Ok(Finding::new(
        "A body rises at v = (0, 0, 0.3) m/s and turns at ω = (2, 0, 0) rad/s; c is the height of its point \
         at r = (0, 0.5, 0.2) m. J_v = (0, 0, 1), J_ω = r × (0, 0, 1).",
    )
    .measure(rate.truth(&[height.eps], "dual numbers", 1e-15)))
}

/// E27: the velocities as a diagonal matrix, K&M Figure 5, Code 8.
///
/// The distance of one body from the ground, with each of the shapes.
pub(super) fn velocity_matrix() -> Result<Finding> {
    let j = DMatrix::from_row_slice(1, 6, &[0.0, 0.0, 1.0, 0.0, 0.5, 0.0]);
    let u = [0.0, 0.0, 2.0, 0.0, 3.0, 0.0];
    let column = DMatrix::from_column_slice(6, 1, &u);
    let row = DMatrix::from_row_slice(1, 6, &u);
    let diagonal = DMatrix::from_diagonal(&column.column(0).into_owned());
    // Seven rows: ω_x occurs twice.
    let as_scanned = diagonal.clone().insert_row(4, 0.0);
    let rate = product(&j, &column);
    let measure = |name: &str, shape: &DMatrix<f64>| {
        let rate = Measure::new(name, "m/s", product(&j, shape), rate.clone());
        rate.truth(&[2.0 + 0.5 * 3.0], "v_z + ½ ω_y", 1e-12)
    };
    Ok(Finding::new(
        "One row, J = (0, 0, 1, 0, ½, 0), the rate of the height of a point of a body that moves at \
         u = (0, 0, 2, 0, 3, 0). J u, with u in each printed shape; corrected is the column.",
    )
    .measure(measure("Figure 5, as read", &as_scanned))
    .measure(measure("diagonal, 6 × 6", &diagonal))
    .measure(measure("Code 8, a row a body", &row)))
}

/// E42: a row of three entries for six velocities, K&M (40).
///
/// Two points 5 m apart.
pub(super) fn distance_row() -> Result<Finding> {
    let still = Vector3::zeros();
    let left = body(still, Vector3::x(), still);
    let right = body(Vector3::new(3.0, 4.0, 0.0), 2.0 * Vector3::y(), still);
    let n = right.pose.p.normalize();
    let q_rate = DMatrix::from_iterator(6, 1, left.v.iter().chain(&right.v).copied());

    let short = DMatrix::from_row_slice(1, 3, n.as_slice());
    let full = DMatrix::from_iterator(1, 6, (-n).iter().chain(&n).copied());
    let difference = DMatrix::from_column_slice(3, 1, (right.v - left.v).as_slice());
    let truth = rates([&left, &right], |[one, other]| vec![(other.p - one.p).norm()]);
    let measure = |quantity: &str, printed: Outcome| {
        let measure = Measure::new(quantity, "m/s", printed, product(&full, &q_rate));
        measure.truth(&truth, "dual numbers", 1e-9)
    };
    Ok(Finding::new(
        "One point lies at the origin and moves with (1, 0, 0) m/s, the other at (3, 4, 0) m and moves with \
         (0, 2, 0) m/s; n = (0.6, 0.8, 0). How fast does their distance grow?",
    )
    .measure(measure("ċ with q' = [v₀; v₁]", product(&short, &q_rate)))
    .measure(measure("ċ with q' = v₁ − v₀", product(&short, &difference)).agreeing()))
}
