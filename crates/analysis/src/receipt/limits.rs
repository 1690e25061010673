//! The largest accepted errors.
//!
//! The limits of motion errors, relative to the change that the constraints cause, were measured on
//! 1,560 good frames of MuJoCo 4.0.1 and 3.12 (stack, humanoid, gripper, trees; both cones; three
//! solvers) and of MuJoCo Warp; see `docs/ci.md`.

use super::step::Source;
use lcplab_lcp::error::{Error, Result};

/// By the kind of the solver, the limits for 64 and for 32 bits.
const LIMITS: [(&str, f64, f64); 4] =
    [("direct", 1e-6, 1e-3), ("newton", 2e-4, 1e-3), ("cg", 1e-3, 1e-2), ("pgs", 1e-3, 1e-2)];

/// An engine's own tolerance raises the limit at most this many times: it compares the last
/// improvement, and does not bound the error.
pub(crate) const MOST_LOOSENED: f64 = 10.0;

/// An error above this fraction of its limit is notable.
pub const NOTABLE: f64 = 0.1;

/// The largest difference between two ways to compute a number, relative to its terms, by the bits
/// of the engine's numbers.
pub fn rounding(bits: u32) -> f64 {
    if bits == 32 { 1e-3 } else { 1e-6 }
}

/// The limit for this kind of solver.
///
/// # Errors
/// If there is no such kind.
pub(crate) fn limit_of(source: &Source) -> Result<f64> {
    let Source { method, bits, .. } = source;
    let own = LIMITS.iter().find(|(name, ..)| name == method);
    match (own, bits) {
        (Some((_, limit, _)), 64) | (Some((_, _, limit)), 32) => Ok(*limit),
        _ => {
            let known: Vec<&str> = LIMITS.iter().map(|(name, ..)| *name).collect();
            let known = known.join(", ");
            let reason = format!(
                "unknown kind of solver {method:?} with {bits} bits; use one of {known}, with 32 \
                 or 64 bits"
            );
            Err(Error::invalid("step", "method", reason))
        }
    }
}
