//! A from the types of other libraries, and back. A matrix that is not square is reported by
//! [`Lcp::new`](crate::Lcp::new).

#[cfg(feature = "nalgebra")]
use nalgebra::{DMatrix, DMatrixView};

use super::Matrix;

/// The rows of a matrix, whose size is known when the program is compiled.
///
/// ```
/// use lcplab_lcp::Matrix;
///
/// let a = Matrix::from([[2.0, -1.0], [0.0, 3.0]]);
/// assert_eq!((a.len(), a.entry(0, 1)), (2, -1.0));
/// ```
impl<const N: usize> From<[[f64; N]; N]> for Matrix {
    fn from(rows: [[f64; N]; N]) -> Self {
        Matrix::dense(N, rows.as_flattened())
    }
}

/// The rows of a matrix.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let rows = [vec![2.0, -1.0], vec![0.0, 3.0]];
/// assert_eq!(Matrix::from(&rows[..]).entry(0, 1), -1.0);
/// let short = Matrix::from(&rows[..1]);
/// assert_eq!(
///     Lcp::new(short, vec![1.0], vec![0.0], vec![2.0]).unwrap_err().to_string(),
///     "problem: A: has 2 entries, needs 1 for 1 row"
/// );
/// ```
impl From<&[Vec<f64>]> for Matrix {
    fn from(rows: &[Vec<f64>]) -> Self {
        Matrix::dense(rows.len(), &rows.concat())
    }
}

/// ```
/// use lcplab_lcp::Matrix;
/// use nalgebra::dmatrix;
///
/// let a = dmatrix![2.0, -1.0; 0.0, 3.0];
/// assert_eq!(Matrix::from(a.as_view()).entry(0, 1), -1.0);
/// ```
#[cfg(feature = "nalgebra")]
impl From<DMatrixView<'_, f64>> for Matrix {
    fn from(dense: DMatrixView<'_, f64>) -> Self {
        Matrix::dense(dense.nrows(), dense.transpose().as_slice())
    }
}

/// ```
/// use lcplab_lcp::Matrix;
/// use nalgebra::dmatrix;
///
/// assert_eq!(Matrix::from(&dmatrix![2.0, -1.0; 0.0, 3.0]).entry(0, 1), -1.0);
/// ```
#[cfg(feature = "nalgebra")]
impl From<&DMatrix<f64>> for Matrix {
    fn from(dense: &DMatrix<f64>) -> Self {
        Matrix::from(dense.as_view())
    }
}

/// ```
/// use lcplab_lcp::Matrix;
/// use nalgebra::dmatrix;
///
/// assert_eq!(Matrix::from(dmatrix![2.0, -1.0; 0.0, 3.0]).entry(0, 1), -1.0);
/// ```
#[cfg(feature = "nalgebra")]
impl From<DMatrix<f64>> for Matrix {
    fn from(dense: DMatrix<f64>) -> Self {
        Matrix::from(&dense)
    }
}

/// ```
/// use lcplab_lcp::Matrix;
///
/// let a = faer::mat![[2.0, -1.0], [0.0, 3.0]];
/// assert_eq!(Matrix::from(a.as_ref()).entry(0, 1), -1.0);
/// ```
#[cfg(feature = "faer")]
impl From<faer::MatRef<'_, f64>> for Matrix {
    fn from(dense: faer::MatRef<'_, f64>) -> Self {
        let (rows, columns) = (dense.nrows(), dense.ncols());
        let entry = |k: usize| dense[(k / columns, k % columns)];
        Matrix::dense(rows, &(0..rows * columns).map(entry).collect::<Vec<f64>>())
    }
}

/// ```
/// use lcplab_lcp::Matrix;
///
/// let a = faer::mat![[2.0, -1.0], [0.0, 3.0]];
/// assert_eq!(Matrix::from(&a).entry(0, 1), -1.0);
/// ```
#[cfg(feature = "faer")]
impl From<&faer::Mat<f64>> for Matrix {
    fn from(dense: &faer::Mat<f64>) -> Self {
        Matrix::from(dense.as_ref())
    }
}

/// ```
/// use lcplab_lcp::Matrix;
/// use ndarray::array;
///
/// let a = array![[2.0, -1.0], [0.0, 3.0]];
/// assert_eq!(Matrix::from(a.view()).entry(0, 1), -1.0);
/// assert_eq!(Matrix::from(a.t()).entry(1, 0), -1.0);
/// ```
#[cfg(feature = "ndarray")]
impl From<ndarray::ArrayView2<'_, f64>> for Matrix {
    fn from(dense: ndarray::ArrayView2<'_, f64>) -> Self {
        Matrix::dense(dense.nrows(), &dense.iter().copied().collect::<Vec<f64>>())
    }
}
