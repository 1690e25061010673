//! Recognizes the kind of problem in a file of Siconos. Files do not state it, but the numbers
//! before the first matrix determine it.

use super::matrix::{self, size_ahead};
use crate::words::Words;
use lcplab_lcp::error::{Error, Result};

/// The supported kinds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// An LCP or a relay problem: n, then the matrix.
    Boxes,
    /// A mixed LCP.
    Mixed,
    /// Contacts in the plane or in space, with or without their bodies.
    Contacts,
    /// A linear problem over second-order cones (SOCLCP).
    Cones,
    /// Blocks of complementary rows, equations and contacts (GMP).
    Generic,
}

/// The kind of a file.
///
/// # Errors
/// If it is not supported; the message names the kind that it appears to be.
pub(super) fn kind(words: &Words) -> Result<Kind> {
    let mut ahead = words.clone();
    let lead: Vec<usize> = std::iter::from_fn(|| ahead.next()?.parse().ok()).take(5).collect();
    let has_matrix = |after| size_ahead(words, after).is_some();
    let is_square = |after, n| size_ahead(words, after) == Some([n, n]);
    let refused = |kind: &str| Err(refusal(words, kind));
    match lead[..] {
        [n, ..] if is_square(1, n) => Ok(Kind::Boxes),
        [1, 0 | 1, _, _, 0] | [0, 1, _, _, ..] => Ok(Kind::Mixed),
        [3, 1, ..] if is_one_cone(words) => Ok(Kind::Cones),
        [2 | 3, _, ..] if has_matrix(2) => Ok(Kind::Contacts),
        [5, _, ..] if has_matrix(2) => refused("contacts with rolling friction (RFC3D or GRFC3D)"),
        [n, _, ..] if is_square(2, n) => Ok(Kind::Cones),
        [3, _, 1 | 2, ..] if has_matrix(3) => refused("a problem of plasticity"),
        [1, n, ..] if is_square(0, n) => Ok(Kind::Generic),
        _ if has_matrix(0) => refused("a matrix alone"),
        // Defective: its reader reports the details.
        [n, 0..=2, m, ..] if n == m => Ok(Kind::Boxes),
        _ => {
            let reason = "does not begin like a problem of Siconos: an LCP, a relay problem, a mixed LCP, or \
             contacts";
            Err(words.fault_ahead(reason))
        }
    }
}

/// Whether 3, 1 and a matrix begin a problem of one cone rather than of one contact: then q, 0, 3
/// and tau follow, and maybe a flag, not q and mu.
fn is_one_cone(words: &Words) -> bool {
    let mut ahead = words.clone();
    ahead.next();
    ahead.next();
    let is_read = matrix::read(&mut ahead, "M").is_ok_and(|m| [m.rows, m.cols] == [3, 3]);
    is_read && (6..=7).contains(&ahead.count())
}

/// The error for a file of this unsupported kind.
pub(super) fn refusal(words: &Words, kind: &str) -> Error {
    words.fault_ahead(format!(
        "this seems to be {kind}, which is not read: only LCPs, relay problems, mixed LCPs, \
         contacts (FC2D, FC3D, GFC2D, GFC3D), SOCLCPs and GMPs are"
    ))
}
