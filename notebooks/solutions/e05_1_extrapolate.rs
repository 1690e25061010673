//! Exercise 5.1: where the sweeps will end.
//!
//! After some sweeps the whole error shrinks by the same factor ρ a sweep, -1 < ρ < 1. You have the
//! x of three sweeps in a row, the newest last. Find ρ from the two changes of x, and from ρ where
//! infinitely many sweeps would end. ρ may be negative. It may be that some rows, or all, have not
//! changed. All rows are contacts: no x of the answer may be negative.

/// x after infinitely many sweeps.
pub fn answer(sweeps: [&[f64]; 3]) -> Vec<f64> {
    let [x, y, z] = sweeps;
    let rows = 0..x.len();
    let square: f64 = rows.clone().map(|i| (y[i] - x[i]).powi(2)).sum();
    if square == 0.0 {
        return z.to_vec();
    }
    // The changes are a multiple of each other; the product keeps the sign of ρ.
    let rho = rows.clone().map(|i| (z[i] - y[i]) * (y[i] - x[i])).sum::<f64>() / square;
    // The changes to come: ρ + ρ² + ρ³ + … times the last one.
    let still = rho / (1.0 - rho);
    rows.map(|i| f64::max(0.0, z[i] + still * (z[i] - y[i]))).collect()
}
