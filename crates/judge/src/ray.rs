//! Proves by one vector that a problem has no solution.
//!
//! A solution has w_i ≥ 0 if hi_i = ∞ and w_i ≤ 0 if lo_i = −∞. Let d be a vector with d_i > 0 only
//! if hi_i = ∞, d_i < 0 only if lo_i = −∞, and d_i = 0 if row i is coupled to another one: then dᵀw
//! ≥ 0 at every solution. But
//!
//! ```text
//! dᵀw = (Aᵀd)ᵀx + bᵀd ≤ max { (Aᵀd)ᵀx : lo ≤ x ≤ hi } + bᵀd
//! ```
//!
//! If the right side is negative, no solution exists (Farkas). The bounds of a coupled x_j are
//! unknown, so (Aᵀd)_j must be 0. Everything is decided in exact arithmetic, for every A.
//!
//! Rows that are equal but for rounding contradict each other exactly, too. If the problem states a
//! [scale](Lcp::scale), [`Farkas::significance`] compares the contradiction with it.

use dashu_int::IBig;
use dashu_ratio::RBig;

use crate::residual::row_scale;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, rational, rounded_up, whole};
use lcplab_lcp::exact::{Exact, Point};
use lcplab_lcp::{Lcp, Matrix};

/// (Aᵀd)_j below this fraction of its terms is intended to be 0.
const MEANT_TO_BE_ZERO: f64 = 1e-6;

/// A vector d that proves that no solution exists.
#[derive(Debug, Clone, PartialEq)]
pub struct Farkas {
    /// d, exactly.
    pub vector: Vec<RBig>,
    /// How far the maximum lies below 0, as a fraction of the sizes of its terms. It belongs to
    /// this d: another one may prove the same with a larger margin.
    pub margin: f64,
    /// How far the maximum lies below 0, as a fraction of Σ |d_i| s_i · scale; ∞ if the problem
    /// states no scale. If no b_i changes by more than this fraction of s_i · scale, d still proves
    /// that there is no solution; a larger fraction can make the maximum 0.
    pub significance: f64,
}

impl Farkas {
    /// Whether the contradiction is larger than what the tolerance ignores: an error of w_i up to
    /// tolerance · s_i · scale in each row.
    ///
    /// ```
    /// use lcplab_judge::refuted_by;
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // Two equations for x_0 + x_1, 2e-13 apart.
    /// let free = || (vec![f64::NEG_INFINITY; 2], vec![f64::INFINITY; 2]);
    /// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2e-13 - 1.0], free().0, free().1)?;
    /// let found = |scale: f64| {
    ///     let lcp = lcp.clone().with_scale(scale)?;
    ///     let farkas = refuted_by(&lcp, &[1.0, -1.0]).expect("a contradiction");
    ///     lcplab_lcp::error::Result::Ok(farkas.is_significant(1e-8))
    /// };
    /// assert!(found(0.0)?);
    /// assert!(!found(1.0)?);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn is_significant(&self, tolerance: f64) -> bool {
        self.significance > tolerance
    }
}

/// Tries to prove from a solver's ray, or from any other guess of d, that a problem has no
/// solution.
///
/// `row` is the driven row. If d itself is not a proof, rounding in its other entries is repaired:
/// a maximal independent set of the equations (Aᵀd)_j = 0 is solved exactly for some of them.
/// For symmetric A the ray of a method is such a d; for other A it need not be.
///
/// ```
/// use lcplab_judge::ray::{checked, refute};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = x₀ − x₁ − 1 and −x₀ + x₁ add up to −1, but both should be at least 0: d = (1, 1).
/// let a = Matrix::from([[1.0, -1.0], [-1.0, 1.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 0.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// assert!(checked(&lcp, &[1.0, 1.0]).is_some());
/// let rounded = [1.0, 1.0 + 1e-12]; // the other entries than that of row 0 may be rounded
/// assert!(checked(&lcp, &rounded).is_none());
/// let farkas = refute(&lcp, 0, &rounded).expect("a proof");
/// assert_eq!(farkas.vector, [1.into(), 1.into()]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn refute(lcp: &Lcp, row: usize, direction: &[f64]) -> Option<Farkas> {
    if direction.len() != lcp.len() || direction.iter().any(|d| !d.is_finite()) {
        return None;
    }
    let guess: Vec<f64> =
        (0..lcp.len()).map(|i| if lcp.is_coupled(i) { 0.0 } else { direction[i] }).collect();
    if let Some(checked) = checked(lcp, &guess) {
        return Some(checked);
    }
    let transposed = transposed(lcp)?;
    let zeros: Vec<usize> =
        (0..lcp.len()).filter(|&j| must_vanish(lcp, &transposed, j, &guess)).collect();
    let entries: Vec<usize> = (0..lcp.len()).filter(|&i| i != row && guess[i] != 0.0).collect();
    let dual = Exact::new(&transposed);
    proof(lcp, &dual, &dual.repaired(&guess, &zeros, &entries)?)
}

/// The vector, if it proves without repair that no solution exists: checked exactly, at any size.
pub fn checked(lcp: &Lcp, vector: &[f64]) -> Option<Farkas> {
    if vector.len() != lcp.len() || vector.iter().any(|d| !d.is_finite()) {
        return None;
    }
    let dual = Exact::new(&transposed(lcp)?);
    proof(lcp, &dual, &dual.repaired(vector, &[], &[])?)
}

/// The proof by these integers with their rows, which exclude all cases at once; `None` if they do
/// so by the limits of friction, which this kind of proof does not use.
pub(crate) fn whole_vector(lcp: &Lcp, entries: &[(usize, IBig)]) -> Option<Farkas> {
    let mut d = vec![Dyadic::ZERO; lcp.len()];
    entries.iter().for_each(|(i, entry)| d[*i] = whole(entry.clone()));
    proof(lcp, &Exact::new(&transposed(lcp)?), &Point::new(d, Dyadic::ONE))
}

/// The equations with the matrix Aᵀ and b = 0.
fn transposed(lcp: &Lcp) -> Option<Lcp> {
    let n = lcp.len();
    let row = |i: usize| lcp.matrix().row(i).iter().map(move |(j, a)| (j, i, a));
    let entries: Vec<_> = (0..n).flat_map(row).collect();
    let (lo, hi) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
    Lcp::new(Matrix::sparse(n, &entries), vec![0.0; n], lo, hi).ok()
}

/// Whether (Aᵀd)_j must be 0: it nearly is, or its sign would need a bound at infinity.
fn must_vanish(lcp: &Lcp, transposed: &Lcp, j: usize, d: &[f64]) -> bool {
    let terms = || transposed.matrix().row(j).iter().map(|(i, a)| a * d[i]);
    let (product, size) = (terms().sum::<f64>(), terms().map(f64::abs).sum::<f64>());
    let bound = if product > 0.0 { lcp.hi()[j] } else { lcp.lo()[j] };
    lcp.is_coupled(j) || bound.is_infinite() || product.abs() <= MEANT_TO_BE_ZERO * size
}

/// The proof by d, if max (Aᵀd)ᵀx + bᵀd < 0 and every d_i is on an allowed side. All terms are
/// multiplied by d's positive denominator.
fn proof(lcp: &Lcp, dual: &Exact, d: &Point) -> Option<Farkas> {
    let (mut bound, mut size, mut at_rest) = (Dyadic::ZERO, Dyadic::ZERO, Dyadic::ZERO);
    let mut add = |term: Dyadic| {
        if term < Dyadic::ZERO {
            size -= &term;
        } else {
            size += &term;
        }
        bound += term;
    };
    for i in 0..lcp.len() {
        let (lo, hi) = match lcp.is_coupled(i) {
            true => (f64::NEG_INFINITY, f64::INFINITY),
            false => (lcp.lo()[i], lcp.hi()[i]),
        };
        let (d_i, product) = (d.scaled(i), dual.scaled_w(i, d));
        let is_forbidden = (*d_i > Dyadic::ZERO && hi.is_finite())
            || (*d_i < Dyadic::ZERO && lo.is_finite())
            || (*d_i != Dyadic::ZERO && lcp.is_coupled(i));
        let at = if product > Dyadic::ZERO { hi } else { lo };
        if is_forbidden || (product != Dyadic::ZERO && at.is_infinite()) {
            return None;
        }
        let rest = dyadic(row_scale(lcp, i)) * dyadic(lcp.scale());
        at_rest += if *d_i < Dyadic::ZERO { -(rest * d_i) } else { rest * d_i };
        add(dyadic(lcp.b()[i]) * d_i);
        if product != Dyadic::ZERO {
            add(product * dyadic(at));
        }
    }
    (bound < Dyadic::ZERO).then(|| {
        let bound = rational(&-bound);
        let fraction = |of: Dyadic| match of == Dyadic::ZERO {
            true => f64::INFINITY,
            false => rounded_up(&(&bound / rational(&of))),
        };
        let (margin, significance) = (fraction(size), fraction(at_rest));
        Farkas { vector: d.entries(), margin, significance }
    })
}
