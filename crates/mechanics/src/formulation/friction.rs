//! A step's problem under the model of friction that its scene asks for.
//!
//! As it is made, a problem's friction rows are the coupled box (model 2). Any other model is posed
//! from the same rows: [`FrictionProblem::of`] finds the contacts, [`Model::pose`] states the law.
//! At velocity level and in impacts w_t is the slip after the step; at acceleration level its friction
//! rows have w_t = slip⁺/dt, so the laws that look at the slip mean the same there. `math §5`.

use super::{Problem, Stage};
use crate::scene::{Contacts, FrictionModel};
use lcplab_problem::Coupling;
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
        let rubs = self.lcp.coupling().is_some_and(|coupling: &Coupling| !coupling.is_empty());
        if model == Model::CoupledBox || !rubs || self.stage == Stage::Position {
            return Ok(None);
        }
        let frozen_at = (model == Model::FrozenBox).then(|| frozen_at.to_vec());
        let friction = FrictionProblem::of(&self.lcp)?;
        let posed = model.pose(&friction, frozen_at.as_deref())?;
        Ok(Some(Posing { model, frozen_at, posed }))
    }
}

/// The model of friction of a scene's contacts.
pub fn friction_model(contact: &Contacts) -> Model {
    match contact.model {
        FrictionModel::FrozenBox => Model::FrozenBox,
        FrictionModel::CoupledBox => Model::CoupledBox,
        FrictionModel::Polygon => Model::Polyhedral { directions: contact.directions },
        FrictionModel::AssociatedCone => Model::AssociatedCone,
        FrictionModel::CoulombCone => Model::CoulombCone,
    }
}

/// The contacts under another model of friction.
pub fn with_friction_model(contact: &Contacts, model: Model) -> Contacts {
    let (model, directions) = match model {
        Model::FrozenBox => (FrictionModel::FrozenBox, contact.directions),
        Model::CoupledBox => (FrictionModel::CoupledBox, contact.directions),
        Model::Polyhedral { directions } => (FrictionModel::Polygon, directions),
        Model::AssociatedCone => (FrictionModel::AssociatedCone, contact.directions),
        Model::CoulombCone => (FrictionModel::CoulombCone, contact.directions),
    };
    Contacts { model, directions, ..contact.clone() }
}
