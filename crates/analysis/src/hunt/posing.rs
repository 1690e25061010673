//! Formulates a problem of a search under its friction model.

use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::friction::{FrictionProblem, Model, ProblemForm};

/// The problem under a model; without one, the LCP itself with friction rows as coupled rows. The
/// frozen box is frozen at the normal impulses that each row alone would need.
///
/// # Errors
/// If there is a model and the problem has no friction rows, or they are not the two tangents of
/// contacts.
pub fn pose(lcp: &Lcp, model: Option<Model>) -> Result<ProblemForm> {
    let Some(model) = model else { return Ok(ProblemForm::Boxed(lcp.clone())) };
    if lcp.coupling().is_none_or(|coupling| coupling.is_empty()) {
        let reason = format!("is missing: {model} is a friction model");
        return Err(Error::invalid("problem", "friction_index", reason));
    }
    model.pose(&FrictionProblem::of(lcp)?, Some(&frozen_at(lcp)))
}

/// Normal impulses at which friction boxes can be frozen: those that each row alone would need,
/// x_i = max(−b_i / a_ii, 0).
pub(crate) fn frozen_at(lcp: &Lcp) -> Vec<f64> {
    let alone = |i: usize| {
        let x = -lcp.b()[i] / lcp.matrix().diagonal(i);
        if x.is_finite() { x.max(0.0) } else { 0.0 }
    };
    (0..lcp.len()).map(alone).collect()
}
