//! Condition number and rank of a matrix, and the rows that depend on each other.
//!
//! ```text
//! Ã = D A D,   D = diag(1/√s_i),   s_i = |a_ii|, or max_j |a_ij|, |a_ji| where a_ii = 0;   Ã = U Σ Vᵀ
//! ```
//!
//! A is first multiplied by powers of two, which is exact, so that numbers near the ends of the
//! range of `f64` neither overflow nor lose digits.
//!
//! The rank is the number of singular values above rounding, the condition number the ratio of the
//! largest to the smallest of those. A column u of U with σ = 0 gives a vector d = D u with dᵀA =
//! 0: the rows with d_i ≠ 0 depend on each other. D removes units and masses from the decision. The
//! d are in reduced echelon form, so that each has few nonzero entries: (1, −1, 1, −1) for a box on
//! four equal feet. K&M recommend such a check in "Debugging", but with the determinant, which
//! depends on units and can be small or large for any matrix, E10.

#![allow(non_snake_case)]

use faer::Mat;

use lcplab_lcp::{Lcp, Matrix};

/// A singular value below this fraction of the largest counts as zero.
const RELATIVE_ZERO: f64 = 1e-11;

/// An entry of d below this fraction of its largest counts as zero.
const NEGLIGIBLE: f64 = 1e-9;

/// Rank, condition and dependent rows of a square matrix A.
#[derive(Debug, Clone, PartialEq)]
pub struct Regularity {
    /// The number of independent rows.
    pub rank: usize,
    /// The condition number of the independent part, after scaling to a unit diagonal; 1 without
    /// rows.
    pub condition: f64,
    /// Rows of zeros: x cannot change their w.
    pub zero_rows: Vec<usize>,
    /// Vectors d with dᵀA = 0, n entries each and one of them 1; there are n minus rank of them,
    /// including those of zero rows.
    pub dependencies: Vec<Vec<f64>>,
}

/// Rank, condition and dependent rows of A; `None` if its singular values cannot be computed.
///
/// ```
/// use lcplab_judge::regularity::regularity;
/// use lcplab_lcp::Matrix;
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

/// The smallest eigenvalue of the scaled matrix; it is not negative for J M⁻¹ Jᵀ. `None` if A is
/// not symmetric up to rounding, or has no rows.
///
/// ```
/// use lcplab_judge::regularity::least_eigenvalue;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // With a unit diagonal: [1 ½; ½ 1].
/// let a = Matrix::from([[2.0, 1.0], [1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![9.0; 2])?;
/// assert!((least_eigenvalue(&lcp).expect("symmetric") - 0.5).abs() < 1e-15);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
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

/// Gauss-Jordan elimination with complete pivoting: the same space, in a basis in which each vector
/// has a 1 where the others have a 0; negligible entries are set to 0.
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

/// d = D u, scaled so that its largest entry is 1.
fn scale(vector: &mut [f64], factors: &[f64]) {
    vector.iter_mut().zip(factors).for_each(|(entry, factor)| *entry *= factor);
    let largest = vector
        .iter()
        .copied()
        .fold(0.0, |most: f64, entry| if entry.abs() > most.abs() { entry } else { most });
    vector.iter_mut().for_each(|entry| *entry /= largest);
}
