//! Which model of friction the contacts of a scene have, and which families can use it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::families::Formulation;
use super::settings::{Contacts, Persistence, Sliding, Step};
use lcplab_problem::error::Defects;

/// What the tangential impulse x_t of a contact may be, x_n being the normal one. `math §5`; the
/// words are those of `--model` and of problem files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FrictionModel {
    /// Model 1, a square of known size: |x_t1|, |x_t2| ≤ μ x̄_n with the x̄_n of the last step.
    FrozenBox,
    /// Model 2, a square that grows with the normal impulse: |x_t1|, |x_t2| ≤ μ x_n.
    #[default]
    CoupledBox,
    /// Model 3, a polygon with `directions` corners, |x_t| ≤ μ x_n at its corners.
    Polygon,
    /// Model 4 made convex, the disc |x_t| ≤ μ x_n: what slides floats at a height dt μ |v_t|.
    AssociatedCone,
    /// Model 4, the disc |x_t| ≤ μ x_n, opposite to the slip: Coulomb's law.
    CoulombCone,
}

/// The most corners of a polygon.
const MOST_DIRECTIONS: usize = 256;

impl Formulation {
    /// Whether its friction can be any model; else it is the coupled box, row by row.
    pub fn poses_friction(self) -> bool {
        self.solves_lcps()
    }
}

/// Whether the model of friction goes together with how the scene is stepped.
pub(super) fn check(defects: &mut Defects, step: &Step, contact: &Contacts) {
    let model = contact.model;
    let mut refuse = |reason: String| defects.add("contact.model", reason);
    let family = step.formulation;
    if model != FrictionModel::CoupledBox && !family.poses_friction() {
        refuse(format!(
            "the family {} rubs row by row and knows \"coupled-box\" only",
            family.name()
        ));
    }
    let cone = matches!(model, FrictionModel::AssociatedCone | FrictionModel::CoulombCone);
    if family == Formulation::Acceleration && model == FrictionModel::AssociatedCone {
        refuse("the associated cone lifts what slides: at acceleration level it would fly".into());
    } else if family == Formulation::Acceleration && cone && contact.sliding == Sliding::Substituted
    {
        refuse("a cone needs a symmetric A, which sliding = \"substituted\" does not leave".into());
    }
    if model == FrictionModel::FrozenBox && contact.persistence == Persistence::None {
        refuse("a frozen box needs the last step's impulses, persistence = \"features\"".into());
    }
    let k = contact.directions;
    if !(k.is_multiple_of(4) && (4..=MOST_DIRECTIONS).contains(&k)) {
        let reason = format!("must be a multiple of 4 from 4 to {MOST_DIRECTIONS}, is {k}");
        defects.add("contact.directions", reason);
    }
}
