//! E54: a sparse matrix that stores zeros, Code 11.

use super::{Finding, Measure};
use crate::chapter::code::code11_map_matrix::{corrected, printed};
use crate::error::Result;

/// Identities, written in three ways.
pub(super) fn example() -> Result<Finding> {
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
