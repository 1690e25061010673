//! The sign of b, the sides of J, and the direction that is blocked.

use nalgebra::DMatrix;

use super::common::{answer, contacts, enumerated, equations, last, product};
use super::setting::{DT, G};
use super::{Finding, Measure};
use crate::error::Result;
use crate::solver::{Dantzig, Pgs};

/// E02: one letter b for three things, K&M (1), (2), (4), (13) to (15).
///
/// The b of (1) given to a solver of A x = b, unchanged and with the opposite sign.
pub(super) fn meanings_of_b() -> Result<Finding> {
    let (a, b) = ([2.0, -1.0, -1.0, 2.0], [-1.0, 2.0]);
    let negated = b.map(|b| -b);
    // The chapter's solver of A x = b finds the x with w = A x − b.
    let solve_ax_equals = |b: [f64; 2]| answer(Pgs::NAME, &contacts(&a, &b.map(|b| -b))?);
    let (printed, corrected) = (solve_ax_equals(b)?, solve_ax_equals(negated)?);
    let lcp = contacts(&a, &b)?;
    let truth = last(enumerated(&lcp));
    let x = Measure::new("x", "", printed.clone(), corrected.clone());
    Ok(Finding::new(
        "A = [2 −1; −1 2], w = A x + b ≥ 0, x ≥ 0 with b = (−1, 2), the sign of (1) and of this library. \
         Printed: the solver of A x = b is given this b. Corrected: it is given −b.",
    )
    .measure(x.truth(&truth, "enumeration", 1e-12))
    .judged("A = [2 −1; −1 2], b = (−1, 2)", &lcp, &printed, &corrected))
}

/// E18: which plane remains when z is blocked.
///
/// A velocity with z blocked.
pub(super) fn locked_axis() -> Result<Finding> {
    let (v, j) = ([1.0, 2.0, 3.0], [0.0, 0.0, 1.0]);
    let in_x_z_plane = [v[0], 0.0, v[2]];
    let push = answer(Dantzig::NAME, &equations(&[1.0], &[v[2]])?)?[0];
    let corrected: [f64; 3] = std::array::from_fn(|k| v[k] + j[k] * push);
    let velocity = Measure::new("velocity", "m/s", in_x_z_plane, corrected);
    Ok(Finding::new(
        "A free body of 1 kg moves at (1, 2, 3) m/s when z is blocked: one equation w = x + 3 = 0. Printed is \
         what is left of the velocity in the x–z plane. The truth is the velocity nearest to the old one \
         among those with v_z = 0.",
    )
    .measure(velocity.truth(&[v[0], v[1], 0.0], "Gauss's principle", 1e-12)))
}

/// E22: the derivation of the constraint equation, K&M Figure 4.
///
/// Two bodies that are pushed apart, and a ball on the floor.
pub(super) fn figure_4() -> Result<Finding> {
    let (j, lambda) =
        (DMatrix::from_row_slice(1, 2, &[-1.0, 1.0]), DMatrix::from_element(1, 1, 3.0));
    let forces =
        Measure::new("forces", "N", product(&j, &lambda), product(&j.transpose(), &lambda));
    let unconstrained = -1.0 - G * DT;
    // w = A x + b = 0 with A = 1; the printed equation is A x = J u*, so its b is −J u*.
    let next = |b: f64| -> Result<f64> {
        Ok(unconstrained + answer(Dantzig::NAME, &equations(&[1.0], &[b])?)?[0])
    };
    let velocity =
        Measure::new("v⁺ on the floor", "m/s", next(-unconstrained)?, next(unconstrained)?);
    Ok(Finding::new(
        "Two bodies in a line, J = (−1, 1), pushed apart with λ = 3 N: the forces on both. Then a ball of \
         1 kg that comes to the floor at 1 m/s, J = 1, dt = 1/60 s: v + dt F/m = −1.1635 m/s. In the sign of \
         w = A x + b, corrected has b = −1.1635, printed b = 1.1635.",
    )
    .measure(velocity.truth(&[0.0], "the floor is rigid", 1e-12))
    .measure(forces.truth(&[-3.0, 3.0], "Newton's third law", 1e-12)))
}
