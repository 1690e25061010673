//! Code 3: the work of each frame.
//!
//! First all forces are added up, then the constraints are solved. The step itself is left to the
//! latter, Code 7, which returns before the step if there is no constraint (E32). In print the call
//! passes dt to a function that takes no argument (E36).

use super::code05_rigid_body::RigidBody;
use super::code07_whole_step::{WholeStep, World};
use super::{Form, Listing};
use crate::error::Result;

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 3",
    title: "a frame: forces, then constraints and step",
    printed: "Add up the forces; leave constraints and integration to Code 7, which may return early.",
    corrected: "The same with a Code 7 that always takes the step.",
    errata: &["E32", "E36"],
};

/// A frame of dt (s) with either form of Code 7: `forces` adds to the forces on the bodies.
///
/// # Errors
/// As for [`WholeStep::take`].
pub fn update(
    form: Form,
    world: &mut World,
    forces: impl Fn(&mut [RigidBody]),
    dt: f64,
) -> Result<()> {
    forces(&mut world.bodies);
    match form {
        Form::Printed => WholeStep::PRINTED.take(world, dt),
        Form::Corrected => WholeStep::CORRECTED.take(world, dt),
    }
}

/// The listing.
///
/// # Errors
/// As for [`WholeStep::take`].
pub fn printed(world: &mut World, forces: impl Fn(&mut [RigidBody]), dt: f64) -> Result<()> {
    update(Form::Printed, world, forces, dt)
}

/// The frame that always moves the bodies.
///
/// # Errors
/// As for [`WholeStep::take`].
pub fn corrected(world: &mut World, forces: impl Fn(&mut [RigidBody]), dt: f64) -> Result<()> {
    update(Form::Corrected, world, forces, dt)
}
