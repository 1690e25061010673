//! Which friction models work with which schemes and settings.

use super::scheme::Scheme;
use super::settings::{Contacts, Persistence, Sliding, Step};
use lcplab_lcp::error::Defects;
use lcplab_lcp::friction::{Form, Model};

impl Scheme {
    /// Whether this scheme supports all friction models; otherwise it uses the coupled box, row by
    /// row.
    pub fn poses_friction(self) -> bool {
        self.solves_lcps()
    }
}

/// Checks that the friction model works with the scheme and settings.
pub(super) fn check(defects: &mut Defects, step: &Step, contact: &Contacts) {
    let (scheme, model) = (step.scheme, contact.model);
    let mut refuse = |reason: String| defects.add("contact.model", reason);
    if let Err(error) = model.to_string().parse::<Model>() {
        // No polygon has this number of corners.
        refuse(error.to_string());
    }
    if model != Model::CoupledBox && !scheme.poses_friction() {
        let scheme = scheme.name();
        refuse(format!(
            "the scheme {scheme} treats friction row by row and supports only \"coupled-box\""
        ));
    }
    let is_cone = matches!(model.form(), Form::Cone(_));
    if scheme == Scheme::Acceleration && model == Model::AssociatedCone {
        refuse(
            "the associated cone lifts sliding bodies, which would fly off at acceleration level"
                .into(),
        );
    } else if scheme == Scheme::Acceleration && is_cone && contact.sliding == Sliding::Substituted {
        refuse(
            "a cone needs a symmetric A, but sliding = \"substituted\" makes A unsymmetric".into(),
        );
    }
    if model == Model::FrozenBox && contact.persistence == Persistence::None {
        refuse(
            "a frozen box needs the impulses of the previous step: set persistence = \"features\""
                .into(),
        );
    }
}
