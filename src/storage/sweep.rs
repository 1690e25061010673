//! Projected Gauss-Seidel with any storage format: K&M (2), (3), Code 6 with the clamp inside the
//! sweep (E06).
//!
//! ```text
//! x_i ← Π_i( x_i − w_i / a_ii ),   w_i = Σ_j a_ij x_j + b_i with the newest x,   i = 1 … n
//! ```
//!
//! Sums run over ascending columns, as in [`Pgs`](crate::solver), so x is bitwise identical in
//! every format.

use super::{Error, Result, Storage, check_length};
use crate::lcp::Lcp;

/// One sweep over the rows of an LCP whose A is stored in `a`; the LCP's own matrix is not used.
///
/// ```
/// use lcplab::lcp::{Lcp, Matrix};
/// use lcplab::storage::{LinkedList, Storage, sweep};
///
/// let lcp = Lcp::new(
///     Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]),
///     vec![-1.0, 2.0],
///     vec![0.0; 2],
///     vec![f64::INFINITY; 2],
/// )?;
/// let mut a = LinkedList::new(2, 2);
/// a.load(&[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 2.0)])?;
/// let mut x = [0.0; 2];
/// sweep(&lcp, &a, &mut x)?;
/// assert_eq!(x, [0.5, 0.0]);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
///
/// # Errors
/// [`Error::Length`]; [`Error::Diagonal`] for a row that is not pinned and has no positive diagonal
/// entry.
pub fn sweep(lcp: &Lcp, a: &dyn Storage, x: &mut [f64]) -> Result<()> {
    check_length("x", x.len(), lcp.len())?;
    check_length("A's rows", a.rows(), lcp.len())?;
    check_length("A's columns", a.columns(), lcp.len())?;
    for i in 0..x.len() {
        let (mut sum, mut diagonal) = (0.0, 0.0);
        a.visit_row(i, &mut |j, value| {
            sum += value * x[j];
            if j == i {
                diagonal = value;
            }
        })?;
        x[i] = updated(lcp, x, i, sum + lcp.b()[i], diagonal)?;
    }
    Ok(())
}

/// Π_i(x_i − w_i / a_ii); a pinned row needs no diagonal entry.
fn updated(lcp: &Lcp, x: &[f64], i: usize, w: f64, diagonal: f64) -> Result<f64> {
    let diagonal = match diagonal {
        positive if positive > 0.0 => positive,
        _ if lcp.lo()[i] == lcp.hi()[i] => 1.0,
        _ => return Err(Error::Diagonal { row: i, diagonal }),
    };
    Ok(lcp.project(i, x[i] - w / diagonal, x))
}
