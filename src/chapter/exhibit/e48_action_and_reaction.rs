//! E48: two upward forces, text on Figure 6.

use nalgebra::DMatrix;

use super::common::{answer, delassus, equations};
use super::{Finding, Measure};
use crate::error::Result;
use crate::solver::Pgs;

/// The effect of a row on two bodies on a line.
struct Pushed {
    /// The constraint forces Jᵀ λ (N) on object and surface.
    forces: [f64; 2],
    /// The velocities after a step of 1 s.
    velocities: [f64; 2],
}

/// One step of 1 s with the row J u⁺ = 0.
fn pushed(j: [f64; 2], inverse_mass: [f64; 2], u: [f64; 2], force: [f64; 2]) -> Result<Pushed> {
    let row = DMatrix::from_row_slice(1, 2, &j);
    let target = [0, 1].map(|k| u[k] + inverse_mass[k] * force[k]);
    let b = j[0] * target[0] + j[1] * target[1];
    let x = answer(Pgs::NAME, &equations(&delassus(&row, &inverse_mass), &[b])?)?[0];
    Ok(Pushed {
        forces: j.map(|j| j * x),
        velocities: [0, 1].map(|k| target[k] + inverse_mass[k] * j[k] * x),
    })
}

pub(super) fn example() -> Result<Finding> {
    let (printed, corrected) = ([1.0, 1.0], [1.0, -1.0]);
    let on_surface = |j, weight| pushed(j, [1.0, 0.0], [-1.0, 0.0], [-1.0, weight]);
    let (up, apart) = (on_surface(printed, -1.0)?, on_surface(corrected, 0.0)?);
    let between = |j| pushed(j, [1.0, 1.0], [-1.0, 0.0], [0.0; 2]);
    let (both, opposite) = (between(printed)?, between(corrected)?);
    let sum = |[a, b]: [f64; 2]| a + b;

    let own =
        Measure::new("total force on the object", "N", up.forces[0] - 1.0, apart.forces[0] - 1.0);
    let forces = Measure::new("sum of both forces", "N", sum(up.forces), sum(apart.forces));
    let momentum = Measure::new(
        "momentum afterwards",
        "kg m/s",
        sum(both.velocities),
        sum(opposite.velocities),
    );
    let closing = |v: [f64; 2]| v[0] - v[1];
    let approach = Measure::new(
        "gap rate afterwards",
        "m/s",
        closing(both.velocities),
        closing(opposite.velocities),
    );
    Ok(Finding::new(
        "An object of 1 kg above a surface of inverse mass 0, g = 1 m/s², a step of 1 s; up is positive. The \
         total of 1 N stops the object within the step. Then the same row between two free bodies of 1 kg, \
         velocities (−1, 0) m/s, no gravity: the upper one runs into the lower one.",
    )
    .measure(own.truth(&[1.0], "m Δv / dt", 1e-9).agreeing())
    .measure(forces.truth(&[0.0], "Newton's third law", 1e-9))
    .measure(momentum.truth(&[-1.0], "it is conserved", 1e-9))
    .measure(approach.truth(&[0.0], "they must not enter", 1e-9)))
}
