//! A step's problem under the model of friction that its scene asks for.
//!
//! As it is made, a problem's friction rows are the coupled box (model 2). Any other model is posed
//! from the same rows: [`FrictionProblem::of`] finds the contacts, [`Model::pose`] states the law.
//! At velocity level and in impacts w_t is the slip after the step; at acceleration level its
//! friction rows have w_t = slip⁺/dt, so the laws that look at the slip mean the same there.

use super::{Problem, Stage};
use lcplab_problem::error::Result;
use lcplab_problem::friction::{FrictionProblem, Model, Posed};

/// A problem as a model of friction other than the coupled box states it.
#[derive(Debug, Clone)]
pub struct Posing {
    /// The model.
    pub model: Model,
    /// The x at whose normal impulses a frozen box is frozen, an entry a row.
    pub frozen_at: Option<Vec<f64>>,
    /// The problem that x is to solve.
    pub posed: Posed,
}

impl Problem {
    /// The problem under this model, a frozen box frozen at the normal impulses of an x; `None`
    /// where the LCP stands as it is: under the coupled box, without friction rows, and where
    /// positions are corrected.
    ///
    /// # Errors
    /// If friction rows do not come in pairs, or a number of directions cannot be used.
    pub fn pose(&self, model: Model, frozen_at: &[f64]) -> Result<Option<Posing>> {
        let rubs = self.lcp.coupling().is_some();
        if model == Model::CoupledBox || !rubs || self.stage == Stage::Position {
            return Ok(None);
        }
        let frozen_at = (model == Model::FrozenBox).then(|| frozen_at.to_vec());
        let friction = FrictionProblem::of(&self.lcp)?;
        let posed = model.pose(&friction, frozen_at.as_deref())?;
        Ok(Some(Posing { model, frozen_at, posed }))
    }
}
