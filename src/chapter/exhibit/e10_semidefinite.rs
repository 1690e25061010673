//! E10: A called positive definite, K&M (14).

use nalgebra::{DMatrix, SMatrix, Vector3};

use super::common::{contacts, enumerated, equations, rank, spaced, sweeps};
use super::setting::{DT, G};
use super::{Finding, Measure};
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};
use crate::solver::Pgs;

const SWEEPS: usize = 4000;
/// A redistribution of forces that has no effect on the box.
const NULL: [f64; 4] = [1.0, -1.0, -1.0, 1.0];

/// A cube on its corners: its weight is supported, and one corner alone is lifted.
pub(super) fn example() -> Result<Finding> {
    let j = jacobian();
    let a = delassus(&j);
    let weight = contacts(a.as_slice(), &[-G * DT; 4])?;
    let solutions = enumerated(&weight).len() as f64;
    let (impulses, speeds) = run_off(&j)?;
    let growth = (impulses[SWEEPS] - impulses[SWEEPS / 2]) / (SWEEPS / 2) as f64;
    // zᵀb = α zᵀ(D + L) z with zᵀA z = 0: each sweep adds α z.
    let diagonal: f64 = (0..4).map(|i| NULL[i] * NULL[i] * a[(i, i)]).sum();
    let expected = NULL[0] / (0.5 * diagonal);
    Ok(Finding::new(
        "A cube of 1 m and 1 kg (moment of inertia 1/6 kg m²) on its four lower corners: A = [4 1 1 −2; 1 4 \
         −2 1; 1 −2 4 1; −2 1 1 4]. First its weight is held, w = A x + b ≥ 0, x ≥ 0 with b = −g/60 in each \
         row: we count the ways to support it on as few corners as possible. Then an equation that no force can \
         meet: one corner is to rise at 1 m/s and the others to stay, b = (−1, 0, 0, 0); the chapter has −b. \
         Printed is what a definite A would give: rank 4, one way, an x that settles.",
    )
    .measure(Measure::new("rank of A", "", 4.0, rank(&a)).truth(&[3.0], "height, two tilts", 0.0))
    .measure(Measure::new("ways to support it", "", 1.0, solutions).truth(&[2.0], "two diagonals", 0.0))
    .measure(
        Measure::new("growth of x₁ per sweep", "N s", 0.0, growth)
            .truth(&[expected], "zᵀb / ½ zᵀD z", 1e-9),
    )
    .plot(&unbounded_impulse(&impulses, &speeds)))
}

/// Four corners at (±½, ±½, −½), pushed upwards.
fn jacobian() -> SMatrix<f64, 4, 6> {
    SMatrix::from_fn(|i, k| {
        let arm = Vector3::new([-0.5, 0.5][i / 2], [-0.5, 0.5][i % 2], -0.5);
        let row = [Vector3::z(), arm.cross(&Vector3::z())];
        row[k / 3][k % 3]
    })
}

/// J M⁻¹ Jᵀ with M⁻¹ = diag(1, 1, 1, 6, 6, 6).
fn delassus(j: &SMatrix<f64, 4, 6>) -> DMatrix<f64> {
    let weighted = SMatrix::<f64, 6, 4>::from_fn(|k, i| j[(i, k)] * [1.0, 6.0][k / 3]);
    DMatrix::from_fn(4, 4, |i, k| (j.row(i) * weighted.column(k))[0])
}

/// x₁ and the cube's upward velocity after each sweep.
fn run_off(j: &SMatrix<f64, 4, 6>) -> Result<(Vec<f64>, Vec<f64>)> {
    let lcp = equations(delassus(j).as_slice(), &[-1.0, 0.0, 0.0, 0.0])?;
    let iterates = sweeps(Pgs::NAME, &lcp, &[0.0; 4], SWEEPS)?;
    Ok(iterates.iter().map(|x| (x[0], x.iter().sum::<f64>())).unzip())
}

fn unbounded_impulse(impulses: &[f64], speeds: &[f64]) -> Lines {
    Lines::new(
        "unbounded_impulse",
        "Forces without bound, a motion at rest",
        "The impulse of the first corner grows by ⅛ N s per sweep, without limit; the velocity that all four \
             together give the cube stays at ¼ m/s. A solver that watches x alone calls this divergence.",
        Axis::log("sweep", ""),
        Axis::log("impulse (N s) and velocity (m/s)", ""),
        vec![
            Series::measured("x₁ (N s)", powers(impulses)),
            Series::measured("velocity of the cube (m/s)", powers(speeds)),
        ],
    )
}

/// The values at sweeps 1, 2, 4, 8, ….
fn powers(values: &[f64]) -> Vec<(f64, f64)> {
    spaced(values, 1.0)
        .into_iter()
        .skip(1)
        .filter(|(k, _)| (*k as usize).is_power_of_two())
        .collect()
}
