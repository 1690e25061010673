//! E18: which plane remains when z is blocked.

use super::common::{answer, equations};
use super::{Finding, Measure};
use crate::error::Result;

/// A velocity with z blocked.
pub(super) fn example() -> Result<Finding> {
    let (v, j) = ([1.0, 2.0, 3.0], [0.0, 0.0, 1.0]);
    let in_x_z_plane = [v[0], 0.0, v[2]];
    let push = answer("dantzig", &equations(&[1.0], &[v[2]])?)?[0];
    let corrected: [f64; 3] = std::array::from_fn(|k| v[k] + j[k] * push);
    let velocity = Measure::new("velocity", "m/s", in_x_z_plane, corrected);
    Ok(Finding::new(
        "A free body of 1 kg moves at (1, 2, 3) m/s when z is blocked: one equation w = x + 3 = 0. Printed is \
         what is left of the velocity in the x–z plane. The truth is the velocity nearest to the old one \
         among those with v_z = 0.",
    )
    .measure(velocity.truth(&[v[0], v[1], 0.0], "Gauss's principle", 1e-12)))
}
