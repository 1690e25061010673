//! What the sparse matrix of Code 11 stores, reads and clears.

use super::common::equations;
use super::{Finding, Measure};
use crate::chapter::code::code09_10_dense_matrix::printed::DenseMatrix;
use crate::chapter::code::code11_map_matrix::{corrected, printed};
use crate::error::Result;
use crate::solver::{Pgs, Settings, Solver, Start};

/// E52: `empty()` tests, `clear()` clears, Code 11.
///
/// Writes an entry, sets the matrix to zero, and does a sweep from there.
pub(super) fn empty_does_not_clear() -> Result<Finding> {
    let mut stale = printed::MapMatrix::new(2, 1, None)?;
    *stale.set(1, 0)? = 5.0;
    stale.set_to_zero();
    let mut clear = corrected::MapMatrix::zeros(2, 1);
    clear.set(1, 0, 5.0)?;
    clear.set_to_zero();

    let left = [stale.get(0, 0)?, stale.get(1, 0)?].map(f64::from);
    let none = [clear.get(0, 0), clear.get(1, 0)].map(f64::from);
    let entry = Measure::new("entry after SetToZero", "", left[1], none[1]);
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
    let settings = Settings::default().with_max_iterations(1);
    let pgs = Pgs { settings, ..Pgs::default() };
    Ok(pgs.solve(&lcp, &Start::at(start), &mut ()).x)
}

/// E53: two matrix classes read the same data in different orders, Codes 10 and 11.
///
/// Row 0 of two arrays, through all three classes.
pub(super) fn data_column_by_column() -> Result<Finding> {
    let measure = |quantity: &str, rows: usize, cols: usize, data: &[f32]| -> Result<Measure> {
        let sparse = printed::MapMatrix::new(rows, cols, Some(data))?;
        let corrected = corrected::MapMatrix::new(rows, cols, data)?;
        let dense = DenseMatrix::new(rows as i32, cols as i32, Some(data))?;
        let row = |entry: &dyn Fn(usize) -> Result<f32>| -> Result<Vec<f64>> {
            (0..cols).map(|k| Ok(f64::from(entry(k)?))).collect()
        };
        let truth = row(&|k| dense.get(0, k as i32))?;
        let measure = Measure::new(
            quantity,
            "",
            row(&|k| sparse.get(0, k))?,
            row(&|k| Ok(corrected.get(0, k)))?,
        );
        Ok(measure.truth(&truth, "Code 10", 0.0))
    };
    Ok(Finding::new(
        "The numbers 1 to 6 as a matrix of 2 × 3, and 2, −1, −1, 2 as one of 2 × 2: what is in the first row?",
    )
    .measure(measure("first row of 1 to 6", 2, 3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?)
    .measure(measure("first row, symmetric", 2, 2, &[2.0, -1.0, -1.0, 2.0])?.agreeing()))
}

/// E54: a sparse matrix that stores zeros, Code 11.
///
/// Identities, written in three ways.
pub(super) fn stored_zeros() -> Result<Finding> {
    let unit = |i: usize, k: usize| f32::from(u8::from(i == k));
    let data: Vec<f32> = (0..9).map(|at| unit(at / 3, at % 3)).collect();
    let small = Measure::new(
        "3 × 3 from data",
        "entries",
        printed::MapMatrix::new(3, 3, Some(&data))?.stored() as f64,
        corrected::MapMatrix::new(3, 3, &data)?.stored() as f64,
    );
    let n = 100;
    let places = || (0..n).flat_map(|i| (0..n).map(move |k| (i, k)));
    let (mut full, mut thin) =
        (printed::MapMatrix::new(n, n, None)?, corrected::MapMatrix::zeros(n, n));
    let mut read = printed::MapMatrix::new(n, n, None)?;
    let (empty, mut total) = (corrected::MapMatrix::zeros(n, n), 0.0);
    for (i, k) in places() {
        *full.set(i, k)? = unit(i, k);
        thin.set(i, k, unit(i, k))?;
        total += *read.set(i, k)? + empty.get(i, k);
    }
    let written =
        Measure::new("100 × 100 by Set", "entries", full.stored() as f64, thin.stored() as f64);
    let read =
        Measure::new("zeros, only read", "entries", read.stored() as f64, empty.stored() as f64);
    let nonzero = data.iter().filter(|&&value| value != 0.0).count();
    Ok(Finding::new(
        "The identity of 3 × 3 from an array of nine numbers, the identity of 100 × 100 written entry by \
         entry, and a matrix of 100 × 100 without entries that is summed up, entry by entry: how many \
         entries are stored afterwards?",
    )
    .measure(small.truth(&[nonzero as f64], "counted", 0.0))
    .measure(written.truth(&[n as f64], "counted", 0.0))
    .measure(read.truth(&[f64::from(total)], "counted", 0.0)))
}
