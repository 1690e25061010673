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
use crate::lcp::Lcp;

/// A vector d that proves that no solution exists.
#[derive(Debug, Clone, PartialEq)]
pub struct Farkas {
    /// d, exactly.
    pub vector: Vec<RBig>,
}

/// Tries to prove from a solver's ray that a problem with symmetric A and no coupling has no
/// solution.
///
/// `row` is the driven row. Rounding in the other entries is repaired first: as many as the equations
/// (A d)_j = 0 determine are solved anew, exactly.
pub fn refute(lcp: &Lcp, row: usize, direction: &[f64]) -> Option<Farkas> {
    let usable = direction.len() == lcp.len() && direction.iter().all(|d| d.is_finite());
    if !usable || lcp.coupling().is_some() || !lcp.matrix().is_symmetric() {
        return None;
    }
    let support: Vec<usize> = (0..lcp.len()).filter(|&j| j != row && direction[j] != 0.0).collect();
    let (rows, unknowns) = independent(lcp, &support);
    let d = Candidate::solve(&lcp.homogeneous(), &rows, unknowns, direction.to_vec())?;
    proves(lcp, &d).then(|| Farkas { vector: d.entries() })
}

/// Whether max (Aᵀd)ᵀx + bᵀd < 0, with every d_i on an allowed side. All terms carry d's positive
/// denominator.
fn proves(lcp: &Lcp, d: &Candidate) -> bool {
    let homogeneous = lcp.homogeneous();
    let mut bound = Dyadic::ZERO;
    for i in 0..lcp.len() {
        let (lo, hi) = (lcp.lo()[i], lcp.hi()[i]);
        let (d_i, product) = (d.scaled_x(i), d.scaled_w(&homogeneous, i));
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
