//! The square matrix A of an LCP: dense or sparse storage with one set of operations.
//!
//! Solvers access A by rows: the product of a row with x, the diagonal, and the entries of a row.
//! Rows are contiguous in both kinds of storage.

#[cfg(feature = "nalgebra")]
use nalgebra::DMatrix;

mod balance;
mod conversions;
mod sparse;

pub use sparse::Sparse;
use sparse::summed;

use std::ops::Range;
use std::sync::OnceLock;

/// The square matrix A.
///
/// ```
/// use lcplab_lcp::Matrix;
///
/// let dense = Matrix::from([[2.0, -1.0], [-1.0, 0.0]]);
/// let sparse = Matrix::sparse(2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0)]);
/// assert_eq!((dense.stored(), sparse.stored()), (4, 3)); // one zero is not stored
/// assert_eq!((sparse.len(), sparse.is_empty()), (2, false));
/// assert_eq!(dense.row_dot(0, &[3.0, 4.0]), sparse.row_dot(0, &[3.0, 4.0])); // 6 − 4
/// ```
#[derive(Debug, Clone)]
pub enum Matrix {
    /// All n² entries.
    Dense(Dense),
    /// The stored entries only.
    Sparse(Sparse),
}

/// All entries of an n × n matrix, row by row.
#[derive(Debug, Clone)]
pub struct Dense {
    n: usize,
    entries: Vec<f64>,
    is_symmetric: OnceLock<bool>,
    defect: Option<String>,
}

impl Dense {
    /// The n² entries.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let a = Matrix::from([[2.0, -1.0], [0.0, 3.0]]);
    /// let Matrix::Dense(dense) = &a else { panic!("made from all entries") };
    /// assert_eq!(dense.entries(), [2.0, -1.0, 0.0, 3.0]); // row by row
    /// ```
    pub fn entries(&self) -> &[f64] {
        &self.entries
    }
}

impl Matrix {
    /// A dense A from its n² entries, row by row. [`Lcp::new`](crate::Lcp::new) reports another
    /// number of entries; the matrix then has fewer rows.
    ///
    /// ```
    /// # use lcplab_lcp::{Lcp, Matrix};
    /// let a = Matrix::dense(2, &[2.0, -1.0, 0.0, 3.0]);
    /// assert_eq!(a.row_dot(0, &[1.0, 1.0]), 1.0);
    /// assert_eq!(a.diagonal(1), 3.0);
    ///
    /// let short = Matrix::dense(2, &[2.0, -1.0, 0.0]);
    /// assert_eq!(
    ///     Lcp::new(short, vec![1.0; 2], vec![0.0; 2], vec![9.0; 2]).unwrap_err().to_string(),
    ///     "problem: A: has 3 entries, needs 4 for 2 rows"
    /// );
    /// ```
    pub fn dense(n: usize, entries_by_rows: &[f64]) -> Self {
        let count = entries_by_rows.len();
        let is_square = n.checked_mul(n) == Some(count);
        let side = if is_square { n } else { count.isqrt().min(n) };
        let rows = if n == 1 { "row" } else { "rows" };
        let defect =
            || format!("has {count} entries, needs {} for {n} {rows}", n.saturating_mul(n));
        Matrix::Dense(Dense {
            n: side,
            entries: entries_by_rows[..side * side].to_vec(),
            is_symmetric: OnceLock::new(),
            defect: (!is_square).then(defect),
        })
    }

    /// Why the matrix cannot be that of a problem, if it cannot.
    pub(crate) fn defect(&self) -> Option<&str> {
        match self {
            Matrix::Dense(dense) => dense.defect.as_deref(),
            Matrix::Sparse(_) => None,
        }
    }

    /// A sparse A from entries (row, column, value); entries at the same place are summed exactly
    /// and rounded once.
    ///
    /// ```
    /// # use lcplab_lcp::Matrix;
    /// let a = Matrix::sparse(1, &[(0, 0, 1e16), (0, 0, 1.0), (0, 0, -1e16)]);
    /// assert_eq!(a.diagonal(0), 1.0);
    /// ```
    ///
    /// # Panics
    /// If an index is not below n.
    pub fn sparse(n: usize, entries: &[(usize, usize, f64)]) -> Self {
        Matrix::Sparse(Sparse::new(n, &summed(entries)))
    }

    /// The number of rows, n.
    #[inline]
    pub fn len(&self) -> usize {
        match self {
            Matrix::Dense(dense) => dense.n,
            Matrix::Sparse(sparse) => sparse.starts.len() - 1,
        }
    }

    /// Whether n = 0.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of stored entries: n² for a dense matrix.
    pub fn stored(&self) -> usize {
        match self {
            Matrix::Dense(dense) => dense.entries.len(),
            Matrix::Sparse(sparse) => sparse.values.len(),
        }
    }

    /// The stored entries (j, a_ij) of row i, j ascending.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let a = Matrix::sparse(2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0)]);
    /// assert_eq!(a.row(0).iter().collect::<Vec<_>>(), [(0, 2.0), (1, -1.0)]);
    /// ```
    #[inline]
    pub fn row(&self, i: usize) -> Row<'_> {
        match self {
            Matrix::Dense(Dense { n, entries, .. }) => {
                Row { columns: None, values: &entries[i * n..(i + 1) * n] }
            }
            Matrix::Sparse(sparse) => {
                let range = sparse.row(i);
                Row { columns: Some(&sparse.columns[range.clone()]), values: &sparse.values[range] }
            }
        }
    }

    /// Row i times x.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let a = Matrix::sparse(2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0)]);
    /// assert_eq!(a.row_dot(0, &[3.0, 4.0]), 2.0);
    /// ```
    #[inline]
    pub fn row_dot(&self, i: usize, x: &[f64]) -> f64 {
        let row = self.row(i);
        match row.columns {
            None => dot(row.values, x),
            Some(columns) => columns.iter().zip(row.values).map(|(&j, a)| a * x[j]).sum(),
        }
    }

    /// The entry a_ii.
    #[inline]
    pub fn diagonal(&self, i: usize) -> f64 {
        match self {
            Matrix::Dense(Dense { n, entries, .. }) => entries[i * n + i],
            Matrix::Sparse(sparse) => sparse.diagonal[i].map_or(0.0, |k| sparse.values[k]),
        }
    }

    /// The entry a_ij, 0 where none is stored.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let a = Matrix::sparse(2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0)]);
    /// assert_eq!((a.entry(0, 1), a.entry(1, 1)), (-1.0, 0.0));
    /// ```
    #[inline]
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        let row = self.row(i);
        match row.columns {
            None => row.values[j],
            Some(columns) => columns.binary_search(&j).map_or(0.0, |k| row.values[k]),
        }
    }

    /// Whether a_ij = a_ji for all entries, exactly. The result is computed once and cached.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let a = Matrix::sparse(2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0)]);
    /// assert!(a.is_symmetric());
    /// assert!(!Matrix::from([[1.0, 2.0], [3.0, 1.0]]).is_symmetric());
    /// ```
    pub fn is_symmetric(&self) -> bool {
        match self {
            Matrix::Dense(Dense { n, entries, is_symmetric: known, .. }) => {
                *known.get_or_init(|| is_symmetric(entries, *n))
            }
            Matrix::Sparse(sparse) => {
                *sparse.is_symmetric.get_or_init(|| self.meets_its_transpose())
            }
        }
    }

    /// Whether a_ij and a_ji differ at most by rounding relative to √(a_ii a_jj), which bounds both
    /// if A is semidefinite. A computed J M⁻¹ Jᵀ is seldom symmetric to the last bit.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// assert!(Matrix::from([[1.0, 0.5], [0.5 + 1e-15, 1.0]]).is_nearly_symmetric());
    /// assert!(!Matrix::from([[1.0, 0.5], [0.5 + 1e-9, 1.0]]).is_nearly_symmetric());
    /// ```
    pub fn is_nearly_symmetric(&self) -> bool {
        const ROUNDING: f64 = 1e-12;
        if self.is_symmetric() {
            return true;
        }
        let diagonal: Vec<f64> = (0..self.len()).map(|i| self.diagonal(i).abs().sqrt()).collect();
        let is_close = |i: usize, j: usize, a: f64| {
            (a - self.entry(j, i)).abs() <= ROUNDING * diagonal[i] * diagonal[j]
        };
        let is_close_row = |i: usize| self.row(i).iter().all(|(j, a)| is_close(i, j, a));
        (0..self.len()).all(is_close_row)
    }

    /// [`Matrix::is_symmetric`] in one pass over the rows: entries right of the diagonal are kept
    /// until the row of their counterpart.
    fn meets_its_transpose(&self) -> bool {
        let nonzero = |i: usize| self.row(i).iter().filter(|&(_, a)| a != 0.0);
        let mut waiting: Vec<_> =
            (0..self.len()).map(|i| nonzero(i).skip_while(move |&(j, _)| j <= i)).collect();
        for i in 0..self.len() {
            for (j, a) in nonzero(i).take_while(|&(j, _)| j < i) {
                if waiting[j].next() != Some((i, a)) {
                    return false;
                }
            }
        }
        waiting.iter_mut().all(|row| row.next().is_none())
    }

    /// The same matrix with a_ii (1 + part) on the diagonal.
    pub fn softened(&self, part: f64) -> Self {
        let mut softened = self.clone();
        for i in 0..self.len() {
            let diagonal = match &mut softened {
                Matrix::Dense(Dense { n, entries, .. }) => Some(&mut entries[i * *n + i]),
                Matrix::Sparse(sparse) => sparse.diagonal[i].map(|k| &mut sparse.values[k]),
            };
            if let Some(diagonal) = diagonal {
                *diagonal *= 1.0 + part;
            }
        }
        softened
    }

    /// The matrix as a dense nalgebra matrix (allocates n² entries).
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    /// use nalgebra::dmatrix;
    ///
    /// let a = Matrix::sparse(2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0)]);
    /// assert_eq!(a.to_dense(), dmatrix![2.0, -1.0; -1.0, 0.0]);
    /// ```
    #[cfg(feature = "nalgebra")]
    pub fn to_dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.len(), self.len());
        for i in 0..self.len() {
            self.row(i).iter().for_each(|(j, a)| dense[(i, j)] = a);
        }
        dense
    }

    /// The positions (i, j) of the nonzero entries, row by row.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let a = Matrix::sparse(2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0)]);
    /// assert_eq!(a.pattern(), [(0, 0), (0, 1), (1, 0)]);
    /// ```
    pub fn pattern(&self) -> Vec<(usize, usize)> {
        let nonzero = |i| self.row(i).iter().filter(|&(_, a)| a != 0.0).map(move |(j, _)| (i, j));
        (0..self.len()).flat_map(|i| nonzero(i).collect::<Vec<_>>()).collect()
    }
}

/// The stored entries of one row.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    columns: Option<&'a [usize]>,
    values: &'a [f64],
}

impl<'a> Row<'a> {
    /// Writes the entries of these columns, which must be ascending, into `entries`; 0 if not
    /// stored.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let a = Matrix::sparse(3, &[(0, 0, 2.0), (0, 2, -1.0)]);
    /// let mut entries = [f64::NAN; 2];
    /// a.row(0).gather(&[1, 2], &mut entries);
    /// assert_eq!(entries, [0.0, -1.0]);
    /// ```
    #[inline]
    pub fn gather(self, columns: &[usize], entries: &mut [f64]) {
        let Some(stored) = self.columns else {
            entries.iter_mut().zip(columns).for_each(|(entry, &j)| *entry = self.values[j]);
            return;
        };
        let mut k = 0;
        for (entry, &j) in entries.iter_mut().zip(columns) {
            k += stored[k..].iter().take_while(|&&column| column < j).count();
            *entry = if stored.get(k) == Some(&j) { self.values[k] } else { 0.0 };
        }
    }

    /// The columns from the first to the last entry that is not zero.
    ///
    /// ```
    /// use lcplab_lcp::Matrix;
    ///
    /// let a = Matrix::sparse(4, &[(0, 1, 2.0), (0, 2, -1.0)]);
    /// assert_eq!((a.row(0).span(), a.row(1).span()), (1..3, 0..0));
    /// ```
    #[inline]
    pub fn span(self) -> Range<usize> {
        let is_nonzero = |a: &f64| *a != 0.0;
        let column = |k: usize| self.columns.map_or(k, |columns| columns[k]);
        let first = self.values.iter().position(is_nonzero);
        let last = self.values.iter().rposition(is_nonzero);
        first.zip(last).map_or(0..0, |(first, last)| column(first)..column(last) + 1)
    }

    /// The entries (j, a_ij), j ascending.
    #[inline]
    pub fn iter(self) -> impl Iterator<Item = (usize, f64)> + 'a {
        let column = move |k| self.columns.map_or(k, |columns| columns[k]);
        self.values.iter().enumerate().map(move |(k, &a)| (column(k), a))
    }
}

/// Whether the n × n entries are symmetric; compared tile by tile, to keep both halves in the
/// cache.
fn is_symmetric(a: &[f64], n: usize) -> bool {
    const TILE: usize = 16;
    let tiles = (0..n).step_by(TILE).flat_map(|r| (0..=r).step_by(TILE).map(move |c| (r, c)));
    tiles.into_iter().all(|(r, c)| {
        let rows = r..(r + TILE).min(n);
        rows.into_iter().all(|i| {
            let (row, column) = (&a[i * n..(i + 1) * n], &a[i..]);
            (c..(c + TILE).min(i)).all(|j| row[j] == column[j * n])
        })
    })
}

/// xᵀy with eight partial sums in a fixed order: bitwise identical on every processor, and in a
/// form that compilers vectorize.
///
/// ```
/// use lcplab_lcp::dot;
///
/// assert_eq!(dot(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0]), 32.0); // 4 + 10 + 18
/// ```
#[inline]
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    let mut lanes = [0.0; 8];
    let (x_blocks, y_blocks) = (x.chunks_exact(8), y.chunks_exact(8));
    let tail: f64 = x_blocks.remainder().iter().zip(y_blocks.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in x_blocks.zip(y_blocks) {
        for lane in 0..8 {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    (((a + e) + (c + g)) + ((b + f) + (d + h))) + tail
}
