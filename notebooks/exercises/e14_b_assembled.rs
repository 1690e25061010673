//! Find the bug 14.b: A, put together body by body.
//!
//! Bodies move along one line. Row i lies between rows[i] = [first, second]: J has -1 at the first
//! and +1 at the second. The program should return the entries (row, column, value) of A = J M⁻¹
//! Jᵀ: it asks each body which rows touch it, so it never multiplies by a zero. A body with the
//! inverse mass 0 cannot move. Its users say: "Balls that fall on the ground are right. A ball that
//! falls on another ball is thrown back, though nothing here is elastic." There is exactly one
//! mistake.

use std::collections::BTreeMap;

/// The entries of A, row by row.
pub fn answer(rows: &[[usize; 2]], inverse_mass: &[f64]) -> Vec<(usize, usize, f64)> {
    // The rows that touch each body, with their entries in J.
    let mut touching = vec![Vec::new(); inverse_mass.len()];
    for (i, &[first, second]) in rows.iter().enumerate() {
        touching[first].push((i, -1.0));
        touching[second].push((i, 1.0));
    }
    let mut entries = BTreeMap::new();
    for (body, rows) in touching.iter().enumerate() {
        for &(i, j_i) in rows {
            for &(k, j_k) in rows {
                entries.insert((i, k), j_i * inverse_mass[body] * j_k);
            }
        }
    }
    entries.into_iter().map(|((i, k), value)| (i, k, value)).collect()
}
