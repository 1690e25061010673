//! E52: `empty()` tests, `clear()` clears, Code 11.

use super::common::equations;
use super::{Finding, Measure};
use crate::chapter::code::code11_map_matrix::{corrected, printed};
use crate::error::Result;
use crate::solver::{Pgs, Settings, Solver, Start};

/// Writes an entry, sets the matrix to zero, and does a sweep from there.
pub(super) fn example() -> Result<Finding> {
    let mut stale = printed::MapMatrix::new(2, 1, None)?;
    *stale.set(1, 0)? = 5.0;
    stale.set_to_zero();
    let mut clear = corrected::MapMatrix::zeros(2, 1);
    clear.set(1, 0, 5.0)?;
    clear.set_to_zero();

    let left = [stale.get(0, 0)?, stale.get(1, 0)?].map(f64::from);
    let none = [clear.get(0, 0), clear.get(1, 0)].map(f64::from);
    let entry = Measure::new("second entry", "", left[1], none[1]);
    let stored = Measure::new("entries stored", "", stale.stored() as f64, clear.stored() as f64);
    let sweeps = Measure::new("x after a sweep", "N s", swept(&left)?, swept(&none)?);
    Ok(Finding::new(
        "A matrix of 2 × 1 gets a 5 in its second row and is set to zero. Then Gauss-Seidel starts from it, \
         on 2 x₁ − x₂ = 1, −x₁ + 2 x₂ = 1 with the solution (1, 1), and is interrupted after one sweep.",
    )
    .measure(entry.truth(&[0.0], "its name", 0.0))
    .measure(stored.truth(&[0.0], "its name", 0.0))
    .measure(sweeps.truth(&[0.5, 0.75], "by hand from 0", 1e-12)))
}

/// x after one sweep from this start.
fn swept(start: &[f64]) -> Result<Vec<f64>> {
    let lcp = equations(&[2.0, -1.0, -1.0, 2.0], &[-1.0, -1.0])?;
    let settings = Settings { max_iterations: 1, ..Settings::default() };
    let pgs = Pgs { settings, ..Pgs::default() };
    Ok(pgs.solve(&lcp, &Start::at(start), &mut ()).x)
}
