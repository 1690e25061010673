//! Sweeps over a dense A, by rows and by columns.
//!
//! ```text
//! by rows:      w_i = Σ_j a_ij x_j + b_i,   x_i ← Π_i(x_i − ω w_i / a_ii)
//! by columns:   x_i ← Π_i(x_i − ω w_i / a_ii),   w ← w + δ_i A_i,   δ_i the change of x_i
//! ```
//!
//! By rows, all n² entries are read in any case, so a sweep should take no longer than reading
//! them. A sum of n terms is a chain of n/8 dependent additions on the same eight lanes, which
//! takes longer than reading; four rows at a time give four independent chains. Their sums are
//! computed at the old x and corrected for the changes of the previous rows in the group of four:
//!
//! ```text
//! w_(i+r) = Σ_j a_(i+r)j x_j + b_(i+r) + Σ_(q<r) a_(i+r)(i+q) δ_(i+q)
//! ```
//!
//! By columns, a row that stays at its bound costs almost nothing. This works for symmetric A only,
//! because columns are read as rows. w accumulates rounding errors and is therefore recomputed
//! every [`RENEWED`] sweeps. For coupled rows use [`Pgs`](crate::Pgs).

use super::lanes::{Lanes, Width, Work, sum};
use crate::Status;
use crate::metric::Metric;
use lcplab_problem::{Lcp, Matrix, dot};

/// Number of sweeps by columns after which w is recomputed from x.
pub const RENEWED: usize = 64;

/// Number of rows whose sums are computed together.
const TOGETHER: usize = 4;

/// The data that both forms need.
#[derive(Debug, Clone)]
struct Dense<'a> {
    lcp: &'a Lcp,
    /// A, row by row.
    a: &'a [f64],
    diagonal: Vec<f64>,
    omega: f64,
    width: Width,
}

impl<'a> Dense<'a> {
    fn of(lcp: &'a Lcp, omega: f64, width: Width) -> Result<Self, Status> {
        let Matrix::Dense(dense) = lcp.matrix() else {
            return Err(Status::OutsideClass { reason: "A is not dense" });
        };
        if lcp.coupling().is_some() {
            return Err(Status::OutsideClass { reason: "rows are coupled" });
        }
        let diagonal = Metric::of(lcp)?.diagonal;
        Ok(Dense { lcp, a: dense.entries(), diagonal, omega, width })
    }

    fn row(&self, i: usize) -> &'a [f64] {
        let n = self.diagonal.len();
        &self.a[i * n..(i + 1) * n]
    }

    /// Π_i(x_i − ω w_i / a_ii)
    #[inline(always)]
    fn updated(&self, i: usize, x: f64, w: f64) -> f64 {
        (x - self.omega * w / self.diagonal[i]).max(self.lcp.lo()[i]).min(self.lcp.hi()[i])
    }
}

/// Projected SOR by rows.
///
/// ```
/// use lcplab_problem::{Lcp, Matrix};
/// use lcplab_solver::kernel::{Width, dense::Rows};
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let mut x = [0.0; 2];
/// Rows::of(&lcp, 1.0, Width::widest()).expect("a positive diagonal").sweep(&mut x);
/// assert_eq!(x, [0.5, 0.0]);
/// # Ok::<(), lcplab_problem::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Rows<'a>(Dense<'a>);

impl<'a> Rows<'a> {
    /// The sweeps for this problem with relaxation factor ω, 0 < ω < 2.
    ///
    /// # Errors
    /// [`Status::ZeroDiagonal`]; [`Status::OutsideClass`] if A is not dense or rows are coupled.
    pub fn of(lcp: &'a Lcp, omega: f64, width: Width) -> Result<Self, Status> {
        Ok(Rows(Dense::of(lcp, omega, width)?))
    }

    /// One sweep over all rows.
    ///
    /// # Panics
    /// If x does not have n entries.
    pub fn sweep(&self, x: &mut [f64]) {
        assert_eq!(x.len(), self.0.lcp.len(), "one x per row");
        self.0.width.run(RowSweep { dense: &self.0, x });
    }
}

struct RowSweep<'a> {
    dense: &'a Dense<'a>,
    x: &'a mut [f64],
}

impl Work for RowSweep<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let RowSweep { dense, x } = self;
        let n = x.len();
        let mut i = 0;
        while i + TOGETHER <= n {
            let mut rows = [&dense.a[..0]; TOGETHER];
            for r in 0..TOGETHER {
                rows[r] = dense.row(i + r);
            }
            let mut w = products::<V>(rows, x);
            let mut change = [0.0; TOGETHER];
            for r in 0..TOGETHER {
                for q in 0..r {
                    w[r] += rows[r][i + q] * change[q];
                }
                let updated = dense.updated(i + r, x[i + r], w[r] + dense.lcp.b()[i + r]);
                change[r] = updated - x[i + r];
                x[i + r] = updated;
            }
            i += TOGETHER;
        }
        for i in i..n {
            x[i] = dense.updated(i, x[i], dot(dense.row(i), x) + dense.lcp.b()[i]);
        }
    }
}

/// The products of four rows with x: in one pass if there are enough registers, otherwise one by
/// one with bitwise identical results.
#[inline(always)]
fn products<V: Lanes>(rows: [&[f64]; TOGETHER], x: &[f64]) -> [f64; TOGETHER] {
    if V::WIDE {
        return dots::<V, TOGETHER>(rows, x);
    }
    let mut products = [0.0; TOGETHER];
    for r in 0..TOGETHER {
        products[r] = dot(rows[r], x);
    }
    products
}

/// [`dot`](lcplab_problem::dot) of several rows with the same x, bitwise identical.
#[inline(always)]
fn dots<V: Lanes, const R: usize>(rows: [&[f64]; R], x: &[f64]) -> [f64; R] {
    let (x_blocks, x_tail) = x.as_chunks::<8>();
    let (count, start) = (x_blocks.len(), x.len() - x_tail.len());
    let mut blocks = [x_blocks; R];
    for r in 0..R {
        blocks[r] = &rows[r].as_chunks::<8>().0[..count];
    }
    let mut lanes = [V::splat(0.0); R];
    for k in 0..count {
        let x = V::load(&x_blocks[k]);
        for r in 0..R {
            lanes[r] = lanes[r] + V::load(&blocks[r][k]) * x;
        }
    }
    let mut dots = [0.0; R];
    for r in 0..R {
        let mut tail = 0.0;
        for j in start..x.len() {
            tail += rows[r][j] * x[j];
        }
        dots[r] = sum(lanes[r].to_array()) + tail;
    }
    dots
}

/// Projected SOR by columns.
#[derive(Debug, Clone)]
pub struct Columns<'a> {
    dense: Dense<'a>,
    /// A x + b, kept up to date.
    w: Vec<f64>,
    sweeps: usize,
}

impl<'a> Columns<'a> {
    /// The sweeps for this problem with relaxation factor ω, 0 < ω < 2.
    ///
    /// # Errors
    /// [`Status::ZeroDiagonal`]; [`Status::OutsideClass`] if A is not dense or not symmetric, or
    /// rows are coupled.
    pub fn of(lcp: &'a Lcp, omega: f64, width: Width) -> Result<Self, Status> {
        if !lcp.matrix().is_symmetric() {
            return Err(Status::OutsideClass { reason: "A is not symmetric" });
        }
        Ok(Columns { dense: Dense::of(lcp, omega, width)?, w: Vec::new(), sweeps: 0 })
    }

    /// One sweep over all rows; x must be unchanged since the last sweep. Returns how many x
    /// changed.
    ///
    /// # Panics
    /// If x does not have n entries.
    pub fn sweep(&mut self, x: &mut [f64]) -> usize {
        assert_eq!(x.len(), self.dense.lcp.len(), "one x per row");
        if self.sweeps.is_multiple_of(RENEWED) {
            self.w = self.dense.lcp.w(x);
        }
        self.sweeps += 1;
        self.dense.width.run(ColumnSweep { dense: &self.dense, x, w: &mut self.w })
    }
}

struct ColumnSweep<'a> {
    dense: &'a Dense<'a>,
    x: &'a mut [f64],
    w: &'a mut [f64],
}

impl Work for ColumnSweep<'_> {
    type Output = usize;

    #[inline(always)]
    fn run<V: Lanes>(self) -> usize {
        let ColumnSweep { dense, x, w } = self;
        let mut changed = 0;
        for i in 0..x.len() {
            let updated = dense.updated(i, x[i], w[i]);
            if updated != x[i] {
                add::<V>(updated - x[i], dense.row(i), w);
                x[i] = updated;
                changed += 1;
            }
        }
        changed
    }
}

/// y ← y + factor · x
#[inline(always)]
fn add<V: Lanes>(factor: f64, x: &[f64], y: &mut [f64]) {
    let (x_blocks, x_tail) = x.as_chunks::<8>();
    let (y_blocks, y_tail) = y.as_chunks_mut::<8>();
    let lanes = V::splat(factor);
    for (y, x) in y_blocks.iter_mut().zip(x_blocks) {
        (V::load(y) + lanes * V::load(x)).store(y);
    }
    for (y, x) in y_tail.iter_mut().zip(x_tail) {
        *y += factor * x;
    }
}
