//! What the stepper does not do.

use crate::body::{Mass, State};
use crate::scene::{Scene, Scheme};
use lcplab_lcp::error::{Defects, Result};
use lcplab_lcp::friction::Model;

/// Whether the stepper can take a scene's steps.
///
/// # Errors
/// One defect for each thing that it cannot do.
pub(super) fn check(scene: &Scene) -> Result<()> {
    let mut defects = Defects::default();
    let scheme = scene.step.scheme;
    if scheme != Scheme::Velocity {
        let reason = format!("the stepper supports only the velocity level, not {}", scheme.name());
        defects.add("step.scheme", reason);
    }
    if scene.contact.model != Model::CoupledBox {
        defects.add("contact.model", "the stepper supports only the coupled box");
    }
    if scene.has_static_friction() {
        defects.add(
            "contact.static_friction",
            "the stepper supports only one coefficient of friction",
        );
    }
    if let Some(driven) = scene.driven.first() {
        defects.add(
            format!("bodies[{}]", driven.body),
            "the stepper does not support functions of time",
        );
    }
    for (k, constraint) in scene.constraints.iter().enumerate() {
        let states =
            constraint.bodies().map(|body| body.map_or(&State::WORLD, |b| &scene.states[b]));
        let yields = |row: &crate::constraint::Row| row.spring.is_some();
        if constraint.rows(states).is_ok_and(|rows| rows.iter().any(yields)) {
            defects.add(format!("constraints[{k}]"), "the stepper does not support compliant rows");
        }
    }
    for (k, (body, state)) in scene.bodies.iter().zip(&scene.states).enumerate() {
        if body.mass == Mass::Fixed
            && (state.v, state.omega) != (State::WORLD.v, State::WORLD.omega)
        {
            defects.add(
                format!("bodies[{k}].velocity"),
                "the stepper does not support moving fixed bodies",
            );
        }
    }
    defects.into_result(scene.name.as_str())
}
