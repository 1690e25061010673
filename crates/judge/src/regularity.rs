//! How far a matrix is from being singular, and in which rows.
//!
//! ```text
//! Ã = D A D,   D = diag(1/√s_i),   s_i = |a_ii|, or max_j |a_ij|, |a_ji| where a_ii = 0;   Ã = U Σ Vᵀ
//! ```
//!
//! A is first multiplied by powers of two, which loses no digit, so that numbers near the ends of
//! the range of doubles neither overflow nor lose digits on the way.
//!
//! The rank is the number of singular values above rounding, the condition number the quotient of
//! the largest and the least of those. A column u of U with σ = 0 makes d = D u a vector with dᵀA =
//! 0: the rows with d_i ≠ 0 depend on each other. D takes units and masses out of the decision. The
//! d come as a reduced echelon form, so that each has few entries: for a box on four equal feet (1,
//! −1, 1, −1). K&M ask for this in "Debugging"; they propose the determinant, which depends on
//! units and can be small or large for any matrix, E10.

#![allow(non_snake_case)]

use faer::Mat;

use lcplab_problem::{Lcp, Matrix};

/// A singular value below this part of the largest counts as zero.
const RELATIVE_ZERO: f64 = 1e-11;

/// An entry of d below this part of its largest counts as zero.
const NEGLIGIBLE: f64 = 1e-9;

/// Rank, condition and dependent rows of a square matrix A.
#[derive(Debug, Clone, PartialEq)]
pub struct Regularity {
    /// The number of independent rows.
    pub rank: usize,
    /// The condition number among them, after scaling to a unit diagonal; 1 without rows.
    pub condition: f64,
    /// Rows that have nothing but zeros: what they ask for, no x can give.
    pub zero_rows: Vec<usize>,
    /// Vectors d, n entries each and one of them 1, with dᵀA = 0; as many as rows are missing from
    /// the rank, those of zero rows included.
    pub dependencies: Vec<Vec<f64>>,
}

/// Rank, condition and dependent rows of A; `None` if its singular values cannot be found.
///
/// ```
/// use lcplab_judge::regularity::regularity;
/// use lcplab_problem::Matrix;
///
/// let twice = Matrix::dense(2, &[2.0, 2.0, 2.0, 2.0]); // one contact listed two times
/// let found = regularity(&twice).expect("a small matrix");
/// assert_eq!((found.rank, found.dependencies.len()), (1, 1));
/// let z = &found.dependencies[0]; // A z = 0
/// assert!((z[0] + z[1]).abs() < 1e-14);
/// ```
pub fn regularity(a: &Matrix) -> Option<Regularity> {
    let n = a.len();
    if n == 0 {
        return Some(Regularity {
            rank: 0,
            condition: 1.0,
            zero_rows: Vec::new(),
            dependencies: Vec::new(),
        });
    }
    let (unit, d) = unit_diagonal(a);
    let svd = unit.svd().ok()?;
    let (U, sigma) = (svd.U(), svd.S().column_vector());
    let rank = (0..n).filter(|&k| sigma[k] > RELATIVE_ZERO * sigma[0]).count();
    let null = (rank..n).map(|k| (0..n).map(|i| U[(i, k)]).collect()).collect();
    let mut dependencies = echelon(null);
    for vector in &mut dependencies {
        scale(vector, &d);
    }
    Some(Regularity {
        rank,
        condition: if rank == 0 { 1.0 } else { sigma[0] / sigma[rank - 1] },
        zero_rows: (0..n).filter(|&i| a.row(i).iter().all(|(_, a)| a == 0.0)).collect(),
        dependencies,
    })
}

/// The least eigenvalue of the scaled matrix: negative for no J M⁻¹ Jᵀ. `None` if A is not
/// symmetric but for rounding, or has no rows.
pub fn least_eigenvalue(lcp: &Lcp) -> Option<f64> {
    if lcp.is_empty() || !lcp.matrix().is_nearly_symmetric() {
        return None;
    }
    let (unit, _) = unit_diagonal(lcp.matrix());
    unit.self_adjoint_eigenvalues(faer::Side::Lower).ok()?.into_iter().reduce(f64::min)
}

/// Ã and the diagonal of D.
fn unit_diagonal(a: &Matrix) -> (Mat<f64>, Vec<f64>) {
    let (balanced, exponents) = a.balanced();
    let rest = |(size, &k): (f64, &i32)| 1.0 / libm::scalbn(size, -2 * k).sqrt();
    let rest: Vec<f64> = a.row_sizes().into_iter().zip(&exponents).map(rest).collect();
    let unit = Mat::from_fn(a.len(), a.len(), |i, j| rest[i] * balanced.entry(i, j) * rest[j]);
    let d = rest.iter().zip(&exponents).map(|(&rest, &k)| libm::scalbn(rest, -k)).collect();
    (unit, d)
}

/// Gauss-Jordan elimination with complete pivoting: the same space, each vector with a 1 where the
/// others have a 0, negligible entries removed.
fn echelon(mut vectors: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    for k in 0..vectors.len() {
        let entries = (k..vectors.len()).flat_map(|r| (0..vectors[r].len()).map(move |c| (r, c)));
        let Some((r, c)) = entries.max_by(|&(r, c), &(s, e)| {
            vectors[r][c].abs().total_cmp(&vectors[s][e].abs()).then((s, e).cmp(&(r, c)))
        }) else {
            break;
        };
        vectors.swap(k, r);
        let pivot = vectors[k][c];
        vectors[k].iter_mut().for_each(|entry| *entry /= pivot);
        let own = vectors[k].clone();
        for (_, other) in vectors.iter_mut().enumerate().filter(|(r, _)| *r != k) {
            let factor = other[c];
            other.iter_mut().zip(&own).for_each(|(entry, own)| *entry -= factor * own);
        }
    }
    for entry in vectors.iter_mut().flatten().filter(|entry| entry.abs() < NEGLIGIBLE) {
        *entry = 0.0;
    }
    vectors.sort_by_key(|vector| vector.iter().position(|&entry| entry != 0.0));
    vectors
}

/// d = D u, with its largest entry 1.
fn scale(vector: &mut [f64], factors: &[f64]) {
    vector.iter_mut().zip(factors).for_each(|(entry, factor)| *entry *= factor);
    let largest = vector
        .iter()
        .copied()
        .fold(0.0, |most: f64, entry| if entry.abs() > most.abs() { entry } else { most });
    vector.iter_mut().for_each(|entry| *entry /= largest);
}
