//! Projected Gauss-Seidel with any storage format: K&M (2), (3), Code 6 with the clamp inside the
//! sweep (E06).
//!
//! ```text
//! x_i ← Π_i( x_i − w_i / a_ii ),   w_i = Σ_j a_ij x_j + b_i with the newest x,   i = 1 … n
//! ```
//!
//! Sums run over ascending columns, as in [`Pgs`](crate::solver), so x is bitwise identical in
//! every format.

use super::Storage;
use crate::error::{Error, Result};
use crate::lcp::Lcp;

/// One sweep over the rows of an LCP whose A is stored in `a`; the LCP's own matrix is not used.
///
/// ```
/// use lcplab::lcp::{Lcp, Matrix};
/// use lcplab::storage::{LinkedList, sweep};
///
/// let lcp = Lcp::new(
///     Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]),
///     vec![-1.0, 2.0],
///     vec![0.0; 2],
///     vec![f64::INFINITY; 2],
/// )?;
/// let a = LinkedList::of(2, 2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 2.0)]);
/// let mut x = [0.0; 2];
/// sweep(&lcp, &a, &mut x)?;
/// assert_eq!(x, [0.5, 0.0]);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
///
/// # Errors
/// If a row that is not pinned has no positive diagonal entry.
///
/// # Panics
/// If the sizes differ.
pub fn sweep(lcp: &Lcp, a: &dyn Storage, x: &mut [f64]) -> Result<()> {
    assert_eq!([x.len(), a.rows()], [lcp.len(); 2], "sizes");
    for i in 0..x.len() {
        let (mut sum, mut diagonal) = (0.0, 0.0);
        a.visit_row(i, &mut |j, value| {
            sum += value * x[j];
            if j == i {
                diagonal = value;
            }
        });
        let divisor = match diagonal {
            positive if positive > 0.0 => positive,
            _ if lcp.lo()[i] == lcp.hi()[i] => 1.0,
            _ => {
                let reason = format!("must be positive, is {diagonal}");
                return Err(Error::invalid("matrix", format!("diagonal of row {i}"), reason));
            }
        };
        x[i] = lcp.project(i, x[i] - (sum + lcp.b()[i]) / divisor, x);
    }
    Ok(())
}
