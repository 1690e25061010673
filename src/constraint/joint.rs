//! The constraints by the names that scene files use, and how each is made of what a file states.
//!
//! A new constraint is one file, with its derivation and a [`Joint`], and one line in [`ALL`].

use std::fmt;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};

use super::{Bodies, Constraint, axis_lock, coincidence, distance, orientation, weld};
use crate::body::Pose;

/// Every constraint that a scene file can name; contacts are found, not named.
pub const ALL: &[&Joint] = &[
    &coincidence::BALL,
    &coincidence::NAIL,
    &weld::FIXED,
    &orientation::ORIENTATION,
    &axis_lock::TRANSLATION,
    &axis_lock::ROTATION,
    &distance::DISTANCE,
];

/// A constraint as scene files write it.
#[derive(Debug)]
pub struct Joint {
    /// The word in the file.
    pub name: &'static str,
    /// One line for lists.
    pub title: &'static str,
    /// The least and the greatest number of bodies it names; one is joined to the world.
    pub bodies: (usize, usize),
    /// Whether its bodies need an orientation, which a point mass has not.
    pub turns: bool,
    /// The fields it may have.
    pub fields: &'static [Field],
    /// Makes it.
    pub build: fn(&Placement) -> Result<Arc<dyn Constraint>, Fault>,
}

/// A field of a constraint in a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// The joint's place.
    Point,
    /// The two ends.
    Points,
    /// The axis.
    Axis,
    /// The length.
    Length,
}

/// Where a constraint is put: its bodies at the start, and the fields given, which are finite.
/// Points and axes are in world coordinates at the start.
#[derive(Debug, Clone)]
pub struct Placement {
    /// The bodies.
    pub bodies: Bodies,
    /// Their poses at the start; that of the world is the identity.
    pub poses: [Pose; 2],
    /// The joint's place (m).
    pub point: Option<Vector3<f64>>,
    /// The two ends (m), in the order of the bodies.
    pub points: Option<[Vector3<f64>; 2]>,
    /// The axis, a unit vector.
    pub axis: Option<Vector3<f64>>,
    /// The length (m), positive.
    pub length: Option<f64>,
}

/// Why a constraint cannot be made of its fields.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The field at fault.
    pub field: Field,
    /// What is wrong with it.
    pub reason: String,
}

impl Joint {
    /// The constraint with this name.
    pub fn by_name(name: &str) -> Option<&'static Joint> {
        ALL.iter().find(|joint| joint.name == name).copied()
    }
}

impl Placement {
    /// The joint's place in each body's frame (m): the point given, else the centre of body 1.
    pub fn anchors(&self) -> [Vector3<f64>; 2] {
        self.local(&self.point.unwrap_or(self.poses[1].p))
    }

    /// The two ends, each in its body's frame (m), and their distance (m): the points given, else
    /// the centres of two bodies.
    ///
    /// # Errors
    /// If only one body is named and no points are given.
    pub fn ends(&self) -> Result<([Vector3<f64>; 2], f64), Fault> {
        let ends = match (self.points, self.bodies[0]) {
            (Some(points), _) => points,
            (None, Some(_)) => [self.poses[0].p, self.poses[1].p],
            (None, None) => return Err(Field::Points.fault("is missing: where in the world?")),
        };
        Ok(([0, 1].map(|k| self.poses[k].local(&ends[k])), (ends[1] - ends[0]).norm()))
    }

    /// The axis in body 0's frame.
    ///
    /// # Errors
    /// If it is missing.
    pub fn axis(&self) -> Result<Vector3<f64>, Fault> {
        let axis = self.axis.ok_or_else(|| Field::Axis.fault("is missing"))?;
        Ok(self.poses[0].q.inverse() * axis)
    }

    /// The orientation of body 1 seen from body 0.
    pub fn relative(&self) -> UnitQuaternion<f64> {
        self.poses[0].q.inverse() * self.poses[1].q
    }

    /// A world point in each body's frame (m).
    fn local(&self, point: &Vector3<f64>) -> [Vector3<f64>; 2] {
        self.poses.map(|pose| pose.local(point))
    }
}

impl Field {
    /// All of them, in the order of the scene format.
    pub const ALL: [Field; 4] = [Field::Point, Field::Points, Field::Axis, Field::Length];

    /// The word in the file.
    pub fn name(self) -> &'static str {
        match self {
            Field::Point => "point",
            Field::Points => "points",
            Field::Axis => "axis",
            Field::Length => "length",
        }
    }

    /// Something wrong with this field.
    pub fn fault(self, reason: impl Into<String>) -> Fault {
        Fault { field: self, reason: reason.into() }
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
