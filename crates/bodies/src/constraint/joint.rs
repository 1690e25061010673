//! The constraints by their names in scene files, and their construction from the fields of a file.
//!
//! A new constraint is one file, with its derivation and a [`Joint`], and one line in [`ALL`].

use std::fmt;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};

use super::{
    Bodies, Verifiable, axis_lock, coincidence, cone_limit, cylindrical, distance, gear, hinge,
    limit, motor, orientation, pulley, rack, rope, slider, spring, squared_distance, universal,
    weld,
};
use crate::body::Pose;

/// Every constraint that a scene file can name; contacts are detected instead.
pub const ALL: &[&Joint] = &[
    &coincidence::BALL,
    &coincidence::NAIL,
    &weld::FIXED,
    &orientation::ORIENTATION,
    &axis_lock::TRANSLATION,
    &axis_lock::ROTATION,
    &hinge::HINGE,
    &slider::SLIDER,
    &cylindrical::CYLINDRICAL,
    &universal::UNIVERSAL,
    &distance::DISTANCE,
    &squared_distance::SQUARED_DISTANCE,
    &rope::ROPE,
    &pulley::PULLEY,
    &spring::SPRING,
    &spring::TORSION,
    &motor::TRANSLATION,
    &motor::ROTATION,
    &limit::TRANSLATION,
    &limit::ROTATION,
    &cone_limit::CONE,
    &gear::GEAR,
    &rack::RACK,
];

/// A constraint as scene files state it.
#[derive(Debug)]
pub struct Joint {
    /// The name in the file.
    pub name: &'static str,
    /// A one-line description for lists.
    pub title: &'static str,
    /// The smallest and the largest number of bodies it names; a single body is joined to the
    /// world.
    pub bodies: (usize, usize),
    /// The number of its bodies, counted from the first, that need an orientation; a point mass has
    /// none.
    pub turns: usize,
    /// The required fields.
    pub needs: &'static [Field],
    /// The optional fields.
    pub takes: &'static [Field],
    /// Constructs it.
    pub build: fn(&Placement) -> Result<Arc<dyn Verifiable>, Fault>,
}

/// A field of a constraint in a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// The position of the joint.
    Point,
    /// The two ends.
    Points,
    /// The axis.
    Axis,
    /// Two axes.
    Axes,
    /// The length.
    Length,
    /// The half angle of a cone.
    Angle,
    /// The lower and the upper limit.
    Limits,
    /// The speed of a motor.
    Speed,
    /// The initial speed.
    StartSpeed,
    /// The largest force or torque of a motor.
    Effort,
    /// The stiffness of a spring.
    Stiffness,
    /// The damping of a spring.
    Damping,
    /// The numbers of teeth.
    Teeth,
}

/// The placement of a constraint: the initial poses of its bodies and the given fields, each valid
/// by itself. Points and axes are in world coordinates at the start.
#[derive(Debug, Clone, Default)]
pub struct Placement {
    /// The bodies.
    pub bodies: Bodies,
    /// Their initial poses; that of the world is the identity.
    pub poses: [Pose; 2],
    /// The position of the joint (m).
    pub point: Option<Vector3<f64>>,
    /// The two ends (m), in the order of the bodies.
    pub points: Option<[Vector3<f64>; 2]>,
    /// The axis, a unit vector.
    pub axis: Option<Vector3<f64>>,
    /// The axes of body 0 and of body 1, unit vectors.
    pub axes: Option<[Vector3<f64>; 2]>,
    /// The length (m), positive.
    pub length: Option<f64>,
    /// The half angle of a cone (rad), positive.
    pub angle: Option<f64>,
    /// The lower and the upper limit (m or rad); ∓∞ for none.
    pub limits: Option<[f64; 2]>,
    /// The speed of a motor (m/s or rad/s).
    pub speed: Option<f64>,
    /// The largest force or torque of a motor (N or N m), positive.
    pub effort: Option<f64>,
    /// The stiffness of a spring (N/m or N m/rad), at least 0.
    pub stiffness: Option<f64>,
    /// The damping of a spring (N s/m or N m s/rad), at least 0.
    pub damping: Option<f64>,
    /// The numbers of teeth of the wheels of body 0 and of body 1, at least 1.
    pub teeth: Option<[u32; 2]>,
}

/// Why a constraint cannot be constructed from its fields.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The invalid field.
    pub field: Field,
    /// The reason.
    pub reason: String,
}

impl Joint {
    /// The constraint with this name.
    ///
    /// ```
    /// use lcplab_bodies::constraint::Joint;
    ///
    /// let hinge = Joint::by_name("hinge").unwrap();
    /// assert_eq!(hinge.bodies, (1, 2)); // with a single body it hangs from the world
    /// assert!(Joint::by_name("henge").is_none());
    /// ```
    pub fn by_name(name: &str) -> Option<&'static Joint> {
        ALL.iter().find(|joint| joint.name == name).copied()
    }
}

/// One line for lists: name, title, fields; optional fields are in brackets.
impl fmt::Display for Joint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bodies = match self.bodies {
            (1, 1) => "1 body",
            (2, 2) => "2 bodies",
            _ => "1 or 2 bodies",
        };
        let needs = self.needs.iter().map(|field| format!(", {field}"));
        let takes = self.takes.iter().map(|field| format!(", [{field}]"));
        let fields: String = needs.chain(takes).collect();
        write!(f, "{:<18} {}\n{:18} {bodies}{fields}", self.name, self.title, "")
    }
}

impl Placement {
    /// The position of the joint in each body's frame (m): the given point, otherwise body 1's
    /// center.
    pub(crate) fn anchors(&self) -> [Vector3<f64>; 2] {
        self.local(&self.point.unwrap_or(self.poses[1].p))
    }

    /// The two ends, each in its body's frame (m), and their distance (m): the given points, or the
    /// centers of the two bodies.
    ///
    /// # Errors
    /// If only one body is named and no points are given.
    pub(crate) fn ends(&self) -> Result<([Vector3<f64>; 2], f64), Fault> {
        let ends = match (self.points, self.bodies[0]) {
            (Some(points), _) => points,
            (None, Some(_)) => [self.poses[0].p, self.poses[1].p],
            (None, None) => {
                return Err(Field::Points.fault("is missing: give the position in the world"));
            }
        };
        Ok(([0, 1].map(|k| self.poses[k].local(&ends[k])), (ends[1] - ends[0]).norm()))
    }

    /// The axis in body 0's frame.
    ///
    /// # Errors
    /// If it is missing.
    pub(crate) fn axis(&self) -> Result<Vector3<f64>, Fault> {
        Ok(self.axis_on_both()?[0])
    }

    /// The axis in each body's frame.
    ///
    /// # Errors
    /// If it is missing.
    pub(crate) fn axis_on_both(&self) -> Result<[Vector3<f64>; 2], Fault> {
        let axis = Field::Axis.given(self.axis)?;
        Ok(self.poses.map(|pose| pose.q.inverse() * axis))
    }

    /// The orientation of body 1 seen from body 0.
    pub(crate) fn relative(&self) -> UnitQuaternion<f64> {
        self.poses[0].q.inverse() * self.poses[1].q
    }

    /// A world point in each body's frame (m).
    fn local(&self, point: &Vector3<f64>) -> [Vector3<f64>; 2] {
        self.poses.map(|pose| pose.local(point))
    }
}

impl Field {
    /// All fields, in the order of the scene format.
    pub const ALL: [Field; 13] = [
        Field::Point,
        Field::Points,
        Field::Axis,
        Field::Axes,
        Field::Length,
        Field::Angle,
        Field::Limits,
        Field::Speed,
        Field::StartSpeed,
        Field::Effort,
        Field::Stiffness,
        Field::Damping,
        Field::Teeth,
    ];

    /// The name in the file.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Field::Point => "point",
            Field::Points => "points",
            Field::Axis => "axis",
            Field::Axes => "axes",
            Field::Length => "length",
            Field::Angle => "angle",
            Field::Limits => "limits",
            Field::Speed => "speed",
            Field::StartSpeed => "start_speed",
            Field::Effort => "effort",
            Field::Stiffness => "stiffness",
            Field::Damping => "damping",
            Field::Teeth => "teeth",
        }
    }

    /// The value given for this field.
    ///
    /// # Errors
    /// If it is missing.
    pub(crate) fn given<T>(self, value: Option<T>) -> Result<T, Fault> {
        value.ok_or_else(|| self.fault("is missing"))
    }

    /// An error in this field.
    pub(crate) fn fault(self, reason: impl Into<String>) -> Fault {
        Fault { field: self, reason: reason.into() }
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
