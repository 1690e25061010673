//! Exercise 10.2: the product of compressed rows with a vector.
//!
//! The entries of row i are values[k] in column columns[k], for all k with starts[i] ≤ k < starts[i + 1].

/// y = A x.
pub fn answer(starts: &[usize], columns: &[usize], values: &[f64], x: &[f64]) -> Vec<f64> {
    let row = |i: usize| (starts[i]..starts[i + 1]).map(|k| values[k] * x[columns[k]]).sum();
    (0..starts.len() - 1).map(row).collect()
}
