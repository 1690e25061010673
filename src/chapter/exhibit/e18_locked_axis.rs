//! E18: which plane is left when z is blocked.

use super::common::{answer, equations};
use super::{Evidence, Exhibit, Finding, Measure, Severity};
use crate::error::Result;

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E18",
    title: "the wrong plane",
    place: "K&M, section on the Jacobian",
    severity: Severity::Misprint,
    may_be_scan: false,
    printed: "Setting the z velocity to zero limits translation to the x–z plane.",
    holds: "To the x–y plane.",
    why: "J = (0, 0, 1) forbids motion along z; what it allows are the velocities with J v = 0, its null \
          space, and that is spanned by x and y.",
    evidence: Evidence::Example(example),
};

/// A velocity with z blocked.
fn example() -> Result<Finding> {
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
