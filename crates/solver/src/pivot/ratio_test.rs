//! The ratio test: which variable of a dictionary becomes zero first, with the lexicographic rule
//! for ties.
//!
//! With the constants perturbed by (ε, ε², …), associated with the initial basic variables, the
//! constant of a row is the vector (c_r, B⁻¹_r), and no two ratios are equal:
//!
//! ```text
//! B⁻¹_rv = −T_rv for a nonbasic v of the first basis,   1 for the basic one of row r,   else 0
//! ```
//!
//! Ratios are compared as vectors, entry by entry, until one row is left.

use super::dictionary::Dictionary;
use super::variable::Variable;
use crate::tolerances::RATIO_TIE;

/// The variable that becomes zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Blocking {
    /// The basic variable of this row.
    Row(usize),
    /// The distance of the basic variable of this row from the other end of its range.
    Mirrored(usize),
    /// The distance of the entering variable from the other end of its range.
    Entering,
}

/// A variable that becomes zero when the entering variable reaches value / weight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Candidate {
    pub(crate) blocking: Blocking,
    pub(crate) value: f64,
    /// Above 0.
    pub(crate) weight: f64,
}

/// The candidate with the lexicographically least ratio. The covering variable takes precedence in
/// a tie. `first` are the initial basic variables.
pub(crate) fn least(
    mut tied: Vec<Candidate>,
    d: &Dictionary,
    first: &[Variable],
) -> Option<Blocking> {
    keep_least(&mut tied, |candidate| candidate.value / candidate.weight);
    let is_cover = |candidate: &&Candidate| match candidate.blocking {
        Blocking::Row(r) => d.basic()[r] == Variable::Cover,
        Blocking::Mirrored(_) | Blocking::Entering => false,
    };
    if let Some(cover) = tied.iter().find(is_cover) {
        return Some(cover.blocking);
    }
    for &v in first {
        if tied.len() <= 1 {
            break;
        }
        let part = |candidate: &Candidate| match candidate.blocking {
            Blocking::Row(r) => inverse(d, r, v),
            Blocking::Mirrored(r) => -inverse(d, r, v),
            Blocking::Entering => 0.0,
        };
        keep_least(&mut tied, |candidate| part(candidate) / candidate.weight);
    }
    tied.first().map(|candidate| candidate.blocking)
}

/// B⁻¹_rv, for v or its mirror image.
fn inverse(d: &Dictionary, r: usize, v: Variable) -> f64 {
    let (name, sign) = if d.has(v) { (v, 1.0) } else { (v.mirrored(), -1.0) };
    match d.column_of(name) {
        Some(c) => -sign * d.entry(r, c),
        None if d.basic()[r] == name => sign,
        None => 0.0,
    }
}

/// Keeps those with the least ratio, ties included.
pub(crate) fn keep_least<T>(tied: &mut Vec<T>, ratio: impl Fn(&T) -> f64) {
    let ratios: Vec<f64> = tied.iter().map(ratio).collect();
    let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    let mut ratios = ratios.into_iter();
    tied.retain(|_| {
        ratios.next().is_some_and(|ratio| ratio - least <= RATIO_TIE * ratio.abs().max(least.abs()))
    });
}
