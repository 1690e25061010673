//! Proof that a problem has no solution.
//!
//! A solution has w_i ≥ 0 where hi_i = ∞ and w_i ≤ 0 where lo_i = −∞. So let d be a vector with
//! d_i > 0 only where hi_i = ∞ and d_i < 0 only where lo_i = −∞: then dᵀw ≥ 0 at every solution. But
//!
//! ```text
//! dᵀw = (Aᵀd)ᵀx + bᵀd ≤ max { (Aᵀd)ᵀx : lo ≤ x ≤ hi } + bᵀd
//! ```
//!
//! If the right side is negative, no solution exists (Farkas). All of it is decided in exact
//! arithmetic.

use dashu_ratio::RBig;

use super::exact::{Candidate, Dyadic, dyadic, independent};
use crate::lcp::{Lcp, Matrix};

/// A vector d that proves that no solution exists.
#[derive(Debug, Clone, PartialEq)]
pub struct Farkas {
    /// d, exactly.
    pub vector: Vec<RBig>,
}

/// Tries to prove from a solver's ray, or any other guess of d, that a problem without coupling has no
/// solution.
///
/// `row` is the driven row. Rounding in the other entries is repaired first: as many as the equations
/// (Aᵀd)_j = 0 determine are solved anew, exactly. The ray of a method for symmetric A is a d; with
/// any other A it need not be.
pub fn refute(lcp: &Lcp, row: usize, direction: &[f64]) -> Option<Farkas> {
    let usable = direction.len() == lcp.len() && direction.iter().all(|d| d.is_finite());
    if !usable || lcp.coupling().is_some() {
        return None;
    }
    let dual = transposed(lcp)?;
    let support: Vec<usize> = (0..lcp.len()).filter(|&j| j != row && direction[j] != 0.0).collect();
    let (rows, unknowns) = independent(&dual, &support);
    let d = Candidate::solve(&dual, &rows, unknowns, direction.to_vec())?;
    proves(lcp, &dual, &d).then(|| Farkas { vector: d.entries() })
}

/// The problem with Aᵀ and b = 0.
fn transposed(lcp: &Lcp) -> Option<Lcp> {
    if lcp.matrix().is_symmetric() {
        return Some(lcp.homogeneous());
    }
    let row = |i: usize| lcp.matrix().row(i).iter().map(move |(j, a)| (j, i, a));
    let entries: Vec<_> = (0..lcp.len()).flat_map(row).collect();
    let matrix = Matrix::sparse(lcp.len(), &entries);
    Lcp::new(matrix, vec![0.0; lcp.len()], lcp.lo().to_vec(), lcp.hi().to_vec()).ok()
}

/// Whether max (Aᵀd)ᵀx + bᵀd < 0, with every d_i on an allowed side. All terms carry d's positive
/// denominator.
fn proves(lcp: &Lcp, dual: &Lcp, d: &Candidate) -> bool {
    let mut bound = Dyadic::ZERO;
    for i in 0..lcp.len() {
        let (lo, hi) = (lcp.lo()[i], lcp.hi()[i]);
        let (d_i, product) = (d.scaled_x(i), d.scaled_w(dual, i));
        let forbidden =
            (d_i > Dyadic::ZERO && hi.is_finite()) || (d_i < Dyadic::ZERO && lo.is_finite());
        let at = if product > Dyadic::ZERO { hi } else { lo };
        if forbidden || (product != Dyadic::ZERO && at.is_infinite()) {
            return false;
        }
        bound += dyadic(lcp.b()[i]) * d_i;
        if product != Dyadic::ZERO {
            bound += product * dyadic(at);
        }
    }
    bound < Dyadic::ZERO
}
