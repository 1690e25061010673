//! E49: Code 8 transposes before it fills, and omits dt.

use nalgebra::DMatrix;

use super::common::contacts;
use super::setting::{DT, G};
use super::{Finding, Measure};
use crate::chapter::code::code08_matrix_program::{corrected, printed};
use crate::error::Result;

/// A ball that falls onto the floor, in both programs.
pub(super) fn example() -> Result<Finding> {
    let (v, g, dt) = (-1.0, -G, DT);
    let one = DMatrix::from_element(1, 1, 1.0);
    let along_y = |y: f64| DMatrix::from_row_slice(1, 6, &[0.0, y, 0.0, 0.0, 0.0, 0.0]);
    let printed = printed::system(&one, &along_y(v), &along_y(g), &one);
    let mut inverse_mass = DMatrix::identity(6, 6);
    // A ball of inertia 0.1 kg m².
    inverse_mass.view_mut((3, 3), (3, 3)).fill_diagonal(10.0);
    let corrected = corrected::system(
        &inverse_mass,
        &along_y(v).transpose(),
        &along_y(g).transpose(),
        &along_y(1.0),
        dt,
    );

    let lcp = contacts(corrected.a.as_slice(), corrected.b.as_slice())?;
    let (closing, x) = (-printed.b[(0, 1)], -corrected.b[0]);
    let target = v + dt * g;
    let matrix = Measure::new("A", "1/kg", printed.a[0], corrected.a[0]);
    let columns =
        Measure::new("columns of b", "", printed.b.ncols() as f64, corrected.b.ncols() as f64);
    let after = Measure::new("velocity after the step", "m/s", target + closing, target + x);
    Ok(Finding::new(
        "A ball of 1 kg on the floor falls at 1 m/s, g = 9.81 m/s², a step of 1/60 s. Both programs are run as \
         they stand. For the velocity, the printed b is given the right A = 1 and its second column, along y: \
         x = −b/A. The judge sees both x on the problem w = A x + b of the corrected program.",
    )
    .measure(after.truth(&[0.0], "the floor stops it", 1e-12))
    .measure(matrix.truth(&[1.0], "1/m", 1e-12))
    .measure(columns.truth(&[1.0], "Code 6 reads one", 0.0))
    .judged("the ball on the floor", &lcp, &[closing], &[x]))
}
