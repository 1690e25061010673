//! Gaussian elimination that knows when a number is zero.
//!
//! Whether a pivot vanishes must not depend on units. So zero is decided where it arises: a
//! difference a − b that cancels to a 1e-13th of its terms *is* zero, whatever the size of a and b.
//! Scaling a row or a column by a power of two changes no decision.

/// A difference below this part of its terms is zero.
const RELATIVE_ZERO: f64 = 1e-13;

/// a − b, exactly 0 where only rounding is left of it.
pub(super) fn difference(a: f64, b: f64) -> f64 {
    let difference = a - b;
    if difference.abs() <= RELATIVE_ZERO * (a.abs() + b.abs()) { 0.0 } else { difference }
}

/// P A = L U with rows exchanged for the largest pivot.
#[derive(Debug, Clone)]
pub(super) struct Lu {
    /// The rows in the order they were taken in.
    order: Vec<usize>,
    /// L below the diagonal, without its ones, and U.
    rows: Vec<Vec<f64>>,
}

impl Lu {
    /// The factors of the n × n matrix with these entries, or the column without a pivot.
    pub(super) fn of(n: usize, entry: impl Fn(usize, usize) -> f64) -> Result<Self, usize> {
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
                for j in k + 1..n {
                    row[j] = difference(row[j], row[k] * top[j]); // row ← row − l_k top
                }
            }
        }
        Ok(Lu { order, rows })
    }

    /// The solution z of A z = rhs, in place.
    pub(super) fn solve(&self, rhs: &mut [f64]) {
        let mut z: Vec<f64> = self.order.iter().map(|&r| rhs[r]).collect();
        for i in 0..z.len() {
            for j in 0..i {
                z[i] -= self.rows[i][j] * z[j]; // z = L \ P rhs
            }
        }
        for i in (0..z.len()).rev() {
            for j in i + 1..z.len() {
                z[i] -= self.rows[i][j] * z[j];
            }
            z[i] /= self.rows[i][i]; // z = U \ z
        }
        rhs.copy_from_slice(&z);
    }
}

#[cfg(test)]
mod tests {
    use super::Lu;

    #[test]
    fn a_dependent_row_is_found_whatever_its_unit() {
        // Row 2 is row 0 plus a third of row 1; rows and columns scaled over forty decades.
        let third = 1.0 / 3.0;
        let a =
            [[3.0, 1.0, 2.0], [1.0, 7.0, 5.0], [3.0 + third, 1.0 + 7.0 * third, 2.0 + 5.0 * third]];
        let scale = [1.0, 2f64.powi(70), 2f64.powi(-66)];
        assert_eq!(Lu::of(3, |r, c| a[r][c] * scale[r] * scale[c]).unwrap_err(), 2);
        let regular = Lu::of(2, |r, c| a[r][c]).unwrap();
        let mut z = [5.0, 9.0];
        regular.solve(&mut z);
        assert!((3.0 * z[0] + z[1] - 5.0).abs() < 1e-14 && (z[0] + 7.0 * z[1] - 9.0).abs() < 1e-14);
    }
}
