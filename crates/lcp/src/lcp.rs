//! The boxed LCP: A, b, the bounds and the coupling of friction rows.

use std::sync::Arc;

use crate::error::{Defects, Error, Result};
use crate::friction::Contact;
use crate::{Coupling, Matrix};

/// A boxed LCP, with its contacts if there is friction. The constructor checks that sizes agree,
/// all numbers of A and b are finite, no bound is NaN and lo ≤ hi, so solvers need no checks.
///
/// ```
/// use lcplab_lcp::{Coupling, Lcp, Matrix};
///
/// // A box of 1 kg reaches the ground with 2 m/s and slides along it with 3 m/s; μ = 0.5. Row 0 is
/// // the normal, row 1 the friction, and A = J M⁻¹ Jᵀ is the unit matrix.
/// let a = Matrix::from([[1.0, 0.0], [0.0, 1.0]]);
/// let (lo, hi) = (vec![0.0, -f64::INFINITY], vec![f64::INFINITY; 2]);
/// let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 0.5])?;
/// let lcp = Lcp::new(a, vec![-2.0, -3.0], lo, hi)?.with_coupling(coupling)?;
/// assert_eq!((lcp.len(), lcp.is_empty(), lcp.b()), (2, false, &[-2.0, -3.0][..]));
/// assert!(lcp.has_coupled_rows() && lcp.is_coupled(1) && !lcp.is_coupled(0));
/// assert_eq!(lcp.coupled_to(1), Some((0, 0.5))); // the normal row, and μ
///
/// // 2 N s stop the fall. Friction would need 3 N s to stop the slip, but μ · 2 N s is its limit.
/// let x = [2.0, lcp.project(1, 3.0, &[2.0, 0.0])];
/// assert_eq!(x, [2.0, 1.0]);
/// assert_eq!((lcp.row_w(0, &x), lcp.row_w(1, &x)), (0.0, -2.0)); // 2 m/s of slip remain
///
/// // A box of 2 kg needs twice the impulse.
/// let heavy = lcp.with_matrix(Matrix::from([[0.5, 0.0], [0.0, 0.5]]))?;
/// assert_eq!(heavy.row_w(0, &[4.0, 0.0]), 0.0);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Lcp {
    /// Shared, so that the same problem with other bounds does not copy A.
    pub(crate) matrix: Arc<Matrix>,
    pub(crate) b: Vec<f64>,
    pub(crate) lo: Vec<f64>,
    pub(crate) hi: Vec<f64>,
    pub(crate) coupling: Option<Coupling>,
    pub(crate) scale: f64,
}

impl Lcp {
    /// The problem with matrix A (n × n), offset b and bounds lo ≤ x ≤ hi (n each).
    ///
    /// b has the unit of w (a velocity or an acceleration), x that of an impulse or a force.
    ///
    /// # Errors
    /// One [`Error::Invalid`] that lists every defect.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// assert_eq!(lcp.w(&[0.5, 0.0]), [0.0, 1.5]); // row 0 is free, row 1 rests at its lower bound
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn new(matrix: Matrix, b: Vec<f64>, lo: Vec<f64>, hi: Vec<f64>) -> Result<Self> {
        if let Some(defect) = matrix.defect() {
            return Err(Error::invalid("problem", "A", defect));
        }
        let mut defects = Defects::default();
        let n = matrix.len();
        for (name, values) in [("b", &b), ("lo", &lo), ("hi", &hi)] {
            check_length(name, values, n, &mut defects);
        }
        for i in 0..n {
            for (j, a) in matrix.row(i).iter().filter(|(_, a)| !a.is_finite()) {
                defects.add(format!("A[{i}][{j}]"), format!("must be finite, is {a}"));
            }
        }
        check_finite("b", &b, &mut defects);
        for (i, (lo, hi)) in lo.iter().zip(&hi).enumerate() {
            check_bounds(i, *lo, *hi, &mut defects);
        }
        defects.into_result("problem")?;
        Ok(Lcp { matrix: Arc::new(matrix), b, lo, hi, coupling: None, scale: 0.0 })
    }

    /// The same problem with some rows bounded by ±μ times another row's x.
    ///
    /// ```
    /// use lcplab_lcp::{Coupling, Lcp, Matrix};
    ///
    /// // Friction in row 1: |x_1| ≤ 0.5 x_0. A coupled row has no bounds of its own.
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0, -f64::INFINITY], vec![f64::INFINITY; 2])?;
    /// let lcp = lcp.with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 0.5])?)?;
    /// assert_eq!(lcp.bounds(1, &[4.0, 0.0]), (-2.0, 2.0));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// Lists every row whose coupling is impossible: see [`Coupling`].
    pub fn with_coupling(mut self, coupling: Coupling) -> Result<Self> {
        coupling.check(&self.lo, &self.hi)?;
        for (i, _) in coupling.rows() {
            (self.lo[i], self.hi[i]) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        self.coupling = (!coupling.is_empty()).then_some(coupling);
        Ok(self)
    }

    /// The contacts with friction: normal, two tangents, μ. Coupled rows that do not come in pairs
    /// with one μ belong to no contact.
    pub fn contacts(&self) -> &[Contact] {
        self.coupling.as_ref().map_or(&[], Coupling::contacts)
    }

    /// The same problem with the smallest significant size of x.
    ///
    /// If all terms of a row are rounding errors, say 1e-19 m/s while other rows have 1 m/s, its w
    /// is meaningless. Therefore a row whose terms are below s_i times `scale` is measured by s_i
    /// times `scale` ([`RowTerms`](crate::merit::RowTerms)), and rows that contradict each other by
    /// less than the tolerance times this size count as consistent. Scenes set `scale` to the
    /// impulse of their lightest body's weight in one step; the default 0 measures each row by its
    /// own terms.
    ///
    /// ```
    /// use lcplab_lcp::merit::scaled_residual;
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // At x = 0, w is −1e-19: as large as the row's terms, but nothing next to 0.1.
    /// let lcp = Lcp::new(Matrix::from([[1.0]]), vec![-1e-19], vec![0.0], vec![f64::INFINITY])?;
    /// assert_eq!(scaled_residual(&lcp, &[0.0]), 1.0);
    /// assert!(scaled_residual(&lcp.with_scale(0.1)?, &[0.0]) < 1e-17);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If `scale` is negative or not finite.
    pub fn with_scale(self, scale: f64) -> Result<Self> {
        if !(scale >= 0.0 && scale.is_finite()) {
            let reason = format!("must be finite and not negative, is {scale}");
            return Err(Error::invalid("problem", "scale", reason));
        }
        Ok(Lcp { scale, ..self })
    }

    /// The smallest significant size of x, 0 if the problem does not state one.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let lcp = Lcp::new(Matrix::from([[1.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
    /// assert_eq!(lcp.scale(), 0.0);
    /// assert_eq!(lcp.with_scale(0.1)?.scale(), 0.1);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The number of rows, n.
    pub fn len(&self) -> usize {
        self.b.len()
    }

    /// Whether n = 0.
    pub fn is_empty(&self) -> bool {
        self.b.is_empty()
    }

    /// The matrix A.
    pub fn matrix(&self) -> &Matrix {
        &self.matrix
    }

    /// The matrix as shared with the problems derived from this one.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let lcp = Lcp::new(Matrix::from([[1.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
    /// let other = lcp.with_b(vec![-2.0])?; // A is not copied
    /// assert!(Arc::ptr_eq(lcp.shared_matrix(), other.shared_matrix()));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn shared_matrix(&self) -> &Arc<Matrix> {
        &self.matrix
    }

    /// The offset b.
    pub fn b(&self) -> &[f64] {
        &self.b
    }

    /// The lower bounds; −∞ for a coupled row.
    pub fn lo(&self) -> &[f64] {
        &self.lo
    }

    /// The upper bounds; ∞ for a coupled row.
    pub fn hi(&self) -> &[f64] {
        &self.hi
    }

    /// Which rows are bounded by another row's x, if any.
    pub fn coupling(&self) -> Option<&Coupling> {
        self.coupling.as_ref()
    }

    /// Whether any row is bounded by another row's x.
    pub fn has_coupled_rows(&self) -> bool {
        self.coupling.as_ref().is_some_and(|coupling| !coupling.is_empty())
    }

    /// Whether row i is bounded by another row's x.
    #[inline]
    pub fn is_coupled(&self, i: usize) -> bool {
        self.coupling.as_ref().is_some_and(|coupling| coupling.index(i).is_some())
    }

    /// The row k that bounds row i by ±μ max(x_k, 0), and μ, if row i is coupled.
    #[inline]
    pub fn coupled_to(&self, i: usize) -> Option<(usize, f64)> {
        let coupling = self.coupling.as_ref()?;
        Some((coupling.index(i)?, coupling.mu(i)))
    }

    /// The bounds of row i at x: lo_i and hi_i, or ±μ max(x_k, 0) for a coupled row.
    ///
    /// ```
    /// use lcplab_lcp::{Coupling, Lcp, Matrix};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0, -f64::INFINITY], vec![f64::INFINITY; 2])?;
    /// let lcp = lcp.with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 0.5])?)?;
    /// assert_eq!(lcp.bounds(0, &[4.0, 0.0]), (0.0, f64::INFINITY));
    /// assert_eq!(lcp.bounds(1, &[-4.0, 0.0]), (0.0, 0.0)); // no pressing, no friction
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    #[inline]
    pub fn bounds(&self, i: usize, x: &[f64]) -> (f64, f64) {
        self.coupling
            .as_ref()
            .and_then(|coupling| coupling.bounds(i, x))
            .unwrap_or((self.lo[i], self.hi[i]))
    }

    /// Π_i(value): the nearest number within the bounds of row i at x. K&M (3).
    #[inline]
    pub fn project(&self, i: usize, value: f64, x: &[f64]) -> f64 {
        let (lo, hi) = self.bounds(i, x);
        value.max(lo).min(hi)
    }

    /// x ← Π(x). A friction row is clamped with the projected x of its normal row.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// let mut x = [-1.0, 5.0];
    /// lcp.project_all(&mut x);
    /// assert_eq!(x, [0.0, 5.0]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn project_all(&self, x: &mut [f64]) {
        for i in 0..x.len() {
            x[i] = x[i].max(self.lo[i]).min(self.hi[i]);
        }
        for (i, _) in self.coupling.iter().flat_map(Coupling::rows) {
            x[i] = self.project(i, x[i], x);
        }
    }

    /// w_i = (A x)_i + b_i.
    #[inline]
    pub fn row_w(&self, i: usize, x: &[f64]) -> f64 {
        self.matrix.row_dot(i, x) + self.b[i]
    }

    /// w = A x + b.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// assert_eq!(lcp.w(&[0.5, 0.0]), [0.0, 1.5]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn w(&self, x: &[f64]) -> Vec<f64> {
        (0..self.len()).map(|i| self.row_w(i, x)).collect()
    }

    /// The same A and bounds with another b.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// assert_eq!(lcp.with_b(vec![-3.0, 0.0])?.w(&[0.0; 2]), [-3.0, 0.0]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Lcp::new`].
    pub fn with_b(&self, b: Vec<f64>) -> Result<Lcp> {
        let mut defects = Defects::default();
        check_length("b", &b, self.len(), &mut defects);
        check_finite("b", &b, &mut defects);
        defects.into_result("problem")?;
        Ok(Lcp { b, ..self.clone() })
    }

    /// The same problem with another matrix.
    ///
    /// # Errors
    /// As [`Lcp::new`].
    pub fn with_matrix(&self, matrix: Matrix) -> Result<Lcp> {
        let plain = Lcp::new(matrix, self.b.clone(), self.lo.clone(), self.hi.clone())?;
        Ok(Lcp { coupling: self.coupling.clone(), scale: self.scale, ..plain })
    }

    /// The same problem with other bounds of the rows that are not coupled.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// let limited = lcp.with_bounds(vec![0.0; 2], vec![0.25, 1.0])?;
    /// assert_eq!(limited.bounds(0, &[0.0; 2]), (0.0, 0.25));
    /// assert_eq!(
    ///     lcp.with_bounds(vec![0.0; 2], vec![-1.0, 1.0]).unwrap_err().to_string(),
    ///     "problem: lo[0]: is 0, above hi[0] = -1"
    /// );
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Lcp::new`] and [`Lcp::with_coupling`].
    pub fn with_bounds(&self, lo: Vec<f64>, hi: Vec<f64>) -> Result<Lcp> {
        let mut defects = Defects::default();
        for (name, values) in [("lo", &lo), ("hi", &hi)] {
            check_length(name, values, self.len(), &mut defects);
        }
        for (i, (lo, hi)) in lo.iter().zip(&hi).enumerate() {
            check_bounds(i, *lo, *hi, &mut defects);
        }
        defects.into_result("problem")?;
        let plain = Lcp { lo, hi, coupling: None, ..self.clone() };
        match &self.coupling {
            Some(coupling) => plain.with_coupling(coupling.clone()),
            None => Ok(plain),
        }
    }

    /// The problem of these rows alone, in this order; all other x are 0. A friction row whose
    /// normal row is not one of them has no bounds.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 3.0]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// assert_eq!(lcp.part(&[1]).w(&[1.0]), [5.0]); // 3 · 1 + 2
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Panics
    /// If a row does not exist.
    pub fn part(&self, rows: &[usize]) -> Lcp {
        let of = |values: &[f64]| rows.iter().map(|&i| values[i]).collect::<Vec<f64>>();
        let mut places = vec![None; self.len()];
        rows.iter().enumerate().for_each(|(k, &i)| places[i] = Some(k));
        let entries = |(k, &i): (usize, &usize)| {
            let row = self.matrix.row(i);
            row.iter().filter_map(|(j, a)| Some((k, places[j]?, a))).collect::<Vec<_>>()
        };
        let entries: Vec<_> = rows.iter().enumerate().flat_map(entries).collect();
        Lcp {
            matrix: Arc::new(Matrix::sparse(rows.len(), &entries)),
            b: of(&self.b),
            lo: of(&self.lo),
            hi: of(&self.hi),
            coupling: self
                .coupling
                .as_ref()
                .map(|coupling| coupling.part(rows, &places))
                .filter(|coupling| !coupling.is_empty()),
            scale: self.scale,
        }
    }

    /// The same b and bounds with each diagonal entry of A increased by this fraction of itself:
    /// every row becomes slightly compliant.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// assert_eq!(lcp.softened(0.5)?.matrix().diagonal(0), 3.0);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If an increased entry is not finite.
    pub fn softened(&self, part: f64) -> Result<Lcp> {
        let matrix = self.matrix.softened(part);
        let mut defects = Defects::default();
        let diagonal: Vec<f64> = (0..self.len()).map(|i| matrix.diagonal(i)).collect();
        check_finite("diagonal", &diagonal, &mut defects);
        defects.into_result("problem")?;
        Ok(Lcp { matrix: Arc::new(matrix), ..self.clone() })
    }

    /// The same A and bounds with b = 0.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // Two supports share one load. Moving force from one to the other changes no w.
    /// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// assert_eq!(lcp.homogeneous().w(&[1.0, -1.0]), [0.0, 0.0]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn homogeneous(&self) -> Lcp {
        Lcp { b: vec![0.0; self.len()], scale: 0.0, ..self.clone() }
    }

    /// The uncoupled boxed problem with the bounds that this one has at x.
    ///
    /// ```
    /// use lcplab_lcp::{Coupling, Lcp, Matrix};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 3.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0, -f64::INFINITY], vec![f64::INFINITY; 2])?;
    /// let lcp = lcp.with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 0.5])?)?;
    /// let frozen = lcp.frozen_at(&[4.0, 0.0]);
    /// assert!(frozen.coupling().is_none());
    /// assert_eq!((frozen.lo()[1], frozen.hi()[1]), (-2.0, 2.0));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn frozen_at(&self, x: &[f64]) -> Lcp {
        let (lo, hi) = (0..self.len()).map(|i| self.bounds(i, x)).unzip();
        Lcp { lo, hi, coupling: None, ..self.clone() }
    }
}

fn check_length(name: &str, values: &[f64], n: usize, defects: &mut Defects) {
    if values.len() != n {
        defects.add(name, format!("has {} rows, A is {n} × {n}", values.len()));
    }
}

fn check_finite(name: &str, values: &[f64], defects: &mut Defects) {
    for (i, value) in values.iter().enumerate().filter(|(_, value)| !value.is_finite()) {
        defects.add(format!("{name}[{i}]"), format!("must be finite, is {value}"));
    }
}

fn check_bounds(i: usize, lo: f64, hi: f64, defects: &mut Defects) {
    for (name, value, impossible) in [("lo", lo, f64::INFINITY), ("hi", hi, f64::NEG_INFINITY)] {
        if value.is_nan() || value == impossible {
            defects.add(format!("{name}[{i}]"), format!("is {value}, no number can meet it"));
        }
    }
    if lo > hi {
        defects.add(format!("lo[{i}]"), format!("is {lo}, above hi[{i}] = {hi}"));
    }
}
