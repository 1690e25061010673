//! The problem of a step under the friction model of its scene.
//!
//! A problem is built with friction rows of the coupled box (model 2). Any other model is derived
//! from the same rows: [`FrictionProblem::of`] finds the contacts, [`Model::pose`] formulates the
//! law. At velocity level and in impacts w_t is the slip after the step; at acceleration level
//! friction rows have w_t = slip⁺/dt, so laws in terms of slip have the same meaning.

use super::{Problem, Stage};
use lcplab_lcp::error::Result;
use lcplab_lcp::friction::{FrictionProblem, Model, ProblemForm};

/// A problem under a friction model other than the coupled box.
#[derive(Debug, Clone)]
pub struct Posing {
    /// The model.
    pub model: Model,
    /// The x whose normal impulses define the frozen box, one entry per row.
    pub frozen_at: Option<Vec<f64>>,
    /// The problem to solve.
    pub posed: ProblemForm,
}

impl Problem {
    /// The problem under this model; a frozen box is frozen at the normal impulses of `frozen_at`.
    /// `None` if the LCP needs no change: under the coupled box, without friction rows, and for
    /// position corrections.
    ///
    /// # Errors
    /// If friction rows do not come in pairs, or the number of directions is invalid.
    pub fn pose(&self, model: Model, frozen_at: &[f64]) -> Result<Option<Posing>> {
        let has_friction = self.lcp.coupling().is_some();
        if model == Model::CoupledBox || !has_friction || self.stage == Stage::Position {
            return Ok(None);
        }
        let frozen_at = (model == Model::FrozenBox).then(|| frozen_at.to_vec());
        let friction = FrictionProblem::of(&self.lcp)?;
        let posed = model.pose(&friction, frozen_at.as_deref())?;
        Ok(Some(Posing { model, frozen_at, posed }))
    }
}
