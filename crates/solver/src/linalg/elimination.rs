//! Gaussian elimination with a scale-invariant zero test.
//!
//! Whether a pivot vanishes must not depend on units. Zero is therefore decided in each
//! subtraction: a difference a − b below 1e-13 of its terms counts as zero, whatever the size of a
//! and b. Scaling a row or column by a power of two changes no decision.

use crate::kernel::rank_one::add_multiple;
use crate::tolerances::RELATIVE_ZERO;

/// a − b, or exactly 0 if only rounding is left.
#[inline(always)]
pub fn difference(a: f64, b: f64) -> f64 {
    let difference = a - b;
    if difference.abs() <= RELATIVE_ZERO * (a.abs() + b.abs()) { 0.0 } else { difference }
}

/// P A = L U with partial pivoting.
#[derive(Debug, Clone)]
pub struct Lu {
    /// The pivot order of the rows.
    order: Vec<usize>,
    /// L below the diagonal, without its ones, and U.
    rows: Vec<Vec<f64>>,
}

impl Lu {
    /// The factors of the n × n matrix with these entries, or the column that has no pivot.
    pub fn of(n: usize, entry: impl Fn(usize, usize) -> f64) -> Result<Self, usize> {
        let mut order: Vec<usize> = (0..n).collect();
        let mut rows: Vec<Vec<f64>> =
            order.iter().map(|&r| (0..n).map(|c| entry(r, c)).collect()).collect();
        for k in 0..n {
            let size = |&r: &usize| rows[r][k].abs();
            let pivot = (k..n).max_by(|a, b| size(a).total_cmp(&size(b))).ok_or(k)?;
            if rows[pivot][k] == 0.0 {
                return Err(k);
            }
            rows.swap(k, pivot);
            order.swap(k, pivot);
            let (top, below) = rows.split_at_mut(k + 1);
            let top = &top[k];
            for row in below.iter_mut().filter(|row| row[k] != 0.0) {
                row[k] /= top[k];
                // row ← row − l_k top
                add_multiple(-row[k], &top[k + 1..], &mut row[k + 1..]);
            }
        }
        Ok(Lu { order, rows })
    }

    /// Solves A z = rhs in place.
    pub fn solve(&self, rhs: &mut [f64]) {
        let mut z: Vec<f64> = self.order.iter().map(|&r| rhs[r]).collect();
        for i in 0..z.len() {
            for j in 0..i {
                // z = L \ P rhs
                z[i] -= self.rows[i][j] * z[j];
            }
        }
        for i in (0..z.len()).rev() {
            for j in i + 1..z.len() {
                z[i] -= self.rows[i][j] * z[j];
            }
            // z = U \ z
            z[i] /= self.rows[i][i];
        }
        rhs.copy_from_slice(&z);
    }
}
