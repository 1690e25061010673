//! Whether redundant rows share the load so that all of them can press at the same time.
//!
//! A solution is often at a corner of the set of all solutions: of four feet on the floor two carry
//! the load, and the others have x = 0 = w. If a null vector d of A has d_i > 0 in these rows, x +
//! t d is a solution for which all of them are strictly between their bounds, and the motion, the
//! same for all solutions, has no kink. The perceptron finds such a d in the null space.

use dashu_ratio::RBig;
use faer::Mat;

use super::linear::{RELATIVE_ZERO, number, scales};

/// Steps of the perceptron.
const MOST_STEPS: usize = 10_000;
/// Entries of d below this fraction of the largest are rounding.
const NEGLIGIBLE: f64 = 1e-6;

/// Whether a null vector of K has these signs; 0 means any.
pub(super) fn has_null_vector(k: &[Vec<RBig>], signs: &[f64]) -> bool {
    let wanted: Vec<usize> = (0..signs.len()).filter(|&i| signs[i] != 0.0).collect();
    if wanted.is_empty() {
        return true;
    }
    let null = null_space(k);
    let rows: Vec<Vec<f64>> =
        wanted.iter().map(|&i| null.iter().map(|vector| signs[i] * vector[i]).collect()).collect();
    let product = |row: &[f64], c: &[f64]| row.iter().zip(c).map(|(a, c)| a * c).sum::<f64>();
    let length = |row: &[f64]| product(row, row).sqrt();
    let mut c = vec![0.0; null.len()];
    for _ in 0..MOST_STEPS {
        let values: Vec<f64> = rows.iter().map(|row| product(row, &c)).collect();
        let (worst, least) = values
            .iter()
            .copied()
            .enumerate()
            .fold((0, f64::INFINITY), |a, b| if b.1 < a.1 { b } else { a });
        if least > NEGLIGIBLE * length(&c) {
            return true;
        }
        let size = length(&rows[worst]);
        if size <= NEGLIGIBLE {
            return false;
        }
        c.iter_mut().zip(&rows[worst]).for_each(|(c, a)| *c += a / size);
    }
    false
}

/// An orthonormal basis of the null space of K, scaled to a unit diagonal.
fn null_space(k: &[Vec<RBig>]) -> Vec<Vec<f64>> {
    let (m, scale) = (k.len(), scales(k));
    let scaled = Mat::from_fn(m, m, |i, j| scale[i] * number(&k[i][j]) * scale[j]);
    let Ok(svd) = scaled.svd() else { return Vec::new() };
    let (sigma, v) = (svd.S().column_vector(), svd.V());
    let is_zero = |c: &usize| !(sigma[*c] > RELATIVE_ZERO * sigma[0]);
    let column = |c: usize| (0..m).map(|i| v[(i, c)]).collect();
    (0..m).filter(is_zero).map(column).collect()
}
