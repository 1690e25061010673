//! Settings shared by the exhibits: the numbers of a step, bodies on the z axis, and the stretched
//! rod.

use nalgebra::{DMatrix, DVector, Vector3};

use super::common::spaced;
use crate::chapter::code::code05_rigid_body::RigidBody;
use crate::chapter::code::code07_whole_step::{WholeStep, World};
use crate::chapter::code::constraint_class::Joint;
use crate::error::Result;

/// A step (s).
pub(super) const DT: f64 = 1.0 / 60.0;
/// Gravity (m/s²).
pub(super) const G: f64 = 9.81;

/// A matrix of one entry.
pub(super) fn one(entry: f64) -> DMatrix<f64> {
    DMatrix::from_element(1, 1, entry)
}

/// A vector of one entry.
pub(super) fn single(entry: f64) -> DVector<f64> {
    DVector::from_element(1, entry)
}

/// A point mass of 1 kg on the z axis.
pub(super) fn point(height: f64, speed: f64) -> RigidBody {
    RigidBody::point(1.0, Vector3::z() * height, Vector3::z() * speed)
}

/// A world with these bodies and joints.
pub(super) fn world(bodies: Vec<RigidBody>, joints: Vec<Joint>) -> World {
    let mut world = World { bodies, ..World::default() };
    world.constraints.extend(joints.into_iter().map(|joint| Box::new(joint) as _));
    world
}

/// Adds the weight of each body of 1 kg.
pub(super) fn weigh(bodies: &mut [RigidBody]) {
    for body in bodies {
        body.force.z -= G;
    }
}

/// The error (m) at the start and after each step of dt (s): a rod of 1 m, stretched by 0.1 m,
/// between two equal free masses at rest; `joint` is the constraint used by the step.
pub(super) fn stretched_rod(
    step: &WholeStep,
    joint: &Joint,
    dt: f64,
    steps: usize,
) -> Result<Vec<f64>> {
    let mut world = world(vec![point(0.0, 0.0), point(1.1, 0.0)], vec![joint.clone()]);
    let mut errors = Vec::new();
    for k in 0..=steps {
        errors.push(world.bodies[1].position.z - world.bodies[0].position.z - 1.0);
        if k < steps {
            step.take(&mut world, dt)?;
        }
    }
    Ok(errors)
}

/// Values of consecutive steps of [`DT`] as points over time (s).
pub(super) fn over_time(values: &[f64]) -> Vec<(f64, f64)> {
    spaced(values, DT)
}
