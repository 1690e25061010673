//! Balancing of A: rows and columns multiplied by powers of two.

use super::{Dense, Matrix, Sparse};
use std::sync::OnceLock;

impl Matrix {
    /// The size of each row in its own unit: |a_ii|, or the largest |a_ij| and |a_ji| if a_ii = 0;
    /// 1 if the row and the column are zero.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// // The diagonal; for row 1, whose diagonal is 0, the largest entry of row and column 1.
    /// let a = Matrix::from([[4.0, 3.0], [-5.0, 0.0]]);
    /// assert_eq!(a.row_sizes(), [4.0, 5.0]);
    /// ```
    pub fn row_sizes(&self) -> Vec<f64> {
        let n = self.len();
        let mut reach = vec![0.0_f64; n];
        for i in 0..n {
            for (j, a) in self.row(i).iter() {
                reach[i] = reach[i].max(a.abs());
                reach[j] = reach[j].max(a.abs());
            }
        }
        let size = |i: usize| match self.diagonal(i).abs() {
            0.0 if reach[i] == 0.0 => 1.0,
            0.0 => reach[i],
            diagonal => diagonal,
        };
        (0..n).map(size).collect()
    }

    /// S A S and the exponents k_i of S = diag(2^-k_i), which bring every row size into the range
    /// from 1 to 4.
    ///
    /// Powers of two do not round the entries: the eigenvalues of D⁻¹A and everything derived from
    /// them stay the same, while numbers like 1e-310, whose reciprocal overflows, come into the
    /// normal range.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let (balanced, exponents) = Matrix::dense(2, &[3e-310, 0.5, 0.5, 8.0]).balanced();
    /// assert_eq!(exponents, [-515, 1]); // 3e-310 is 3.45 × 4^-515, 8 is 2 × 4
    /// assert_eq!(balanced.diagonal(1), 2.0);
    /// assert!(balanced.diagonal(0) >= 1.0 && balanced.diagonal(0) < 4.0);
    /// ```
    pub fn balanced(&self) -> (Matrix, Vec<i32>) {
        let exponent = |size: &f64| (libm::frexp(*size).1 - 1).div_euclid(2);
        let exponents: Vec<i32> = self.row_sizes().iter().map(exponent).collect();
        let scaled = |i: usize, (j, a): (usize, f64)| libm::scalbn(a, -exponents[i] - exponents[j]);
        let entries = (0..self.len()).flat_map(|i| self.row(i).iter().map(move |a| scaled(i, a)));
        let entries: Vec<f64> = entries.collect();
        let balanced = match self {
            Matrix::Dense(dense) => Matrix::Dense(Dense {
                n: dense.n,
                entries,
                is_symmetric: OnceLock::new(),
                defect: None,
            }),
            Matrix::Sparse(sparse) => Matrix::Sparse(Sparse {
                values: entries,
                is_symmetric: OnceLock::new(),
                ..sparse.clone()
            }),
        };
        (balanced, exponents)
    }
}
