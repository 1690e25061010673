//! Checks case splits, which prove that no solution exists. The judge finds them:
//! [`lcplab_judge::cases`].

use dashu_int::IBig;

use lcplab_judge::cases::{Sides, Tree};
use lcplab_lcp::Lcp;
use lcplab_lcp::exact::Side;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, whole};

/// Checks a tree against the problem, by the rules of `docs/proofs.md`.
///
/// # Errors
/// Why the tree proves nothing.
pub fn check(lcp: &Lcp, tree: &Tree) -> Result<(), String> {
    walk(lcp, tree, &mut vec![None; lcp.len()])
}

fn walk(lcp: &Lcp, tree: &Tree, sides: &mut Sides) -> Result<(), String> {
    match tree {
        Tree::Leaf(d) => leaf(lcp, sides, d),
        Tree::Branch { row, lo, free, hi } => {
            let row = *row;
            if row >= lcp.len() || sides[row].is_some() {
                return Err(format!("the tree branches at row {row}"));
            }
            let [has_lo, has_hi] = finite(lcp, row);
            if lo.is_some() != has_lo || hi.is_some() != has_hi {
                return Err(format!("the tree does not have the sides of row {row}"));
            }
            let ways =
                [(Side::Lower, lo.as_ref()), (Side::Free, Some(free)), (Side::Upper, hi.as_ref())];
            for (side, tree) in ways {
                let Some(tree) = tree else { continue };
                sides[row] = Some(side);
                walk(lcp, tree, sides)?;
            }
            sides[row] = None;
            Ok(())
        }
    }
}

/// Whether a row has a lower and whether it has an upper side.
fn finite(lcp: &Lcp, row: usize) -> [bool; 2] {
    match lcp.is_coupled(row) {
        true => [true; 2],
        false => [lcp.lo()[row].is_finite(), lcp.hi()[row].is_finite()],
    }
}

/// The row that this row is coupled to, and μ.
fn coupled(lcp: &Lcp, row: usize) -> Option<(usize, Dyadic)> {
    lcp.coupled_to(row).map(|(k, mu)| (k, dyadic(mu)))
}

/// Whether d proves that no solution has these sides.
fn leaf(lcp: &Lcp, sides: &Sides, d: &[(usize, IBig)]) -> Result<(), String> {
    let mut c = vec![Dyadic::ZERO; lcp.len()];
    let mut sum = Dyadic::ZERO;
    for (i, d) in d {
        let i = *i;
        if i >= lcp.len() {
            return Err(format!("there is no row {i}"));
        }
        let (is_positive, is_negative) = (*d > IBig::ZERO, *d < IBig::ZERO);
        let [has_lo, has_hi] = finite(lcp, i);
        let is_forbidden = match sides[i] {
            Some(Side::Lower) => is_negative,
            Some(Side::Upper) => is_positive,
            Some(Side::Free) => false,
            None => is_negative && has_lo || is_positive && has_hi,
        };
        if is_forbidden {
            return Err(format!("d has the wrong sign in row {i}"));
        }
        let d = whole(d.clone());
        for (j, a) in lcp.matrix().row(i).iter() {
            c[j] += dyadic(a) * &d;
        }
        sum += dyadic(lcp.b()[i]) * d;
    }
    for j in 0..lcp.len() {
        let Some((k, mu)) = coupled(lcp, j) else { continue };
        let own = std::mem::take(&mut c[j]);
        c[k] += mu
            * match sides[j] {
                Some(Side::Lower) => -own,
                Some(Side::Upper) => own,
                _ if own < Dyadic::ZERO => -own,
                _ => own,
            };
    }
    for j in (0..lcp.len()).filter(|&j| !lcp.is_coupled(j)) {
        let bound = match sides[j] {
            Some(Side::Lower) => lcp.lo()[j],
            Some(Side::Upper) => lcp.hi()[j],
            _ if c[j] > Dyadic::ZERO => lcp.hi()[j],
            _ if c[j] < Dyadic::ZERO => lcp.lo()[j],
            _ => continue,
        };
        if !bound.is_finite() {
            return Err(format!("nothing bounds the product in row {j}"));
        }
        sum += std::mem::take(&mut c[j]) * dyadic(bound);
    }
    match sum < Dyadic::ZERO {
        true => Ok(()),
        false => Err("the vector of a case shows nothing".into()),
    }
}
