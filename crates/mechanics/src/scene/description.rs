//! The scene file, field by field. SI units; angles are in radians unless the field's description
//! says degrees.
//!
//! ```toml
//! title = "A ball on the ground"
//! gravity = [0, 0, -9.81]
//!
//! [step]
//! dt = 0.01
//!
//! [[bodies]]
//! name = "ground"
//! fixed = true
//! shape = { plane = [0, 0, 1] }
//!
//! [[bodies]]
//! name = "ball"
//! shape = { sphere = 0.5 }
//! mass = 2
//! position = [0, 0, 0.5]
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::generate::Generator;
use super::infinite::{self, Number};
use super::settings::{Contacts, Solver, Step};
use super::time_function::TimeFunction;
use lcplab_lcp::error::Result;

/// A scene description. [`Scene::new`](super::Scene::new) builds a scene from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Description {
    /// A title for lists, one line.
    pub title: String,
    /// What the scene teaches, and what must hold in it.
    pub teaches: String,
    /// The acceleration of gravity (m/s²).
    pub gravity: [f64; 3],
    /// The inclination of the whole scene, in degrees: `{ y = 17 }` turns level ground and
    /// everything on it into a slope of 17 degrees, down along x. Coordinates stay along the slope;
    /// gravity is rotated.
    pub tilt: Option<Rotation>,
    /// The time (s) at which the simulation begins, for forces and supports that depend on it.
    pub time: f64,
    /// The settings of a time step.
    pub step: Step,
    /// The settings of contacts.
    pub contact: Contacts,
    /// The solver and its settings.
    pub solver: Solver,
    /// Regular structures, added to the bodies and constraints.
    #[schemars(schema_with = "one_or_several::<Generator>")]
    pub generate: Vec<Generator>,
    /// The bodies.
    #[schemars(schema_with = "one_or_several::<Body>")]
    pub bodies: Vec<Body>,
    /// The constraints; contacts are detected, not listed.
    #[schemars(schema_with = "one_or_several::<Constraint>")]
    pub constraints: Vec<Constraint>,
    /// The states of bodies at the start of the simulation, if they differ from those in which
    /// joints are defined; `simulate` saves these.
    pub start: Vec<Start>,
    /// Surface properties of pairs of bodies, overriding those of the bodies.
    #[schemars(schema_with = "one_or_several::<Pair>")]
    pub pairs: Vec<Pair>,
}

impl Description {
    /// Parses a description in the scene format; [`Scene::new`](super::Scene::new) checks whether
    /// it is a valid scene. `path` is used in messages.
    ///
    /// # Errors
    /// A single error that lists every defect with its line.
    pub fn from_toml(path: &str, text: &str) -> Result<Self> {
        super::file::description(path, text)
    }

    /// The description in a scene file, or of a shipped scene, with fields set as by
    /// [`Scene::load_with`](super::Scene::load_with).
    ///
    /// # Errors
    /// As for [`Scene::load_with`](super::Scene::load_with).
    pub fn load_with(path_or_name: &str, changes: &[(String, String)]) -> Result<Self> {
        let (path, text) = super::text(path_or_name)?;
        Description::changed(&path, &text, changes)
    }

    /// The description in a text, with fields set as by
    /// [`Scene::load_with`](super::Scene::load_with).
    ///
    /// ```
    /// use lcplab_mechanics::scene::{Description, text};
    ///
    /// let changes = [("bodies.bob.mass".into(), "2".into())];
    /// let heavy = Description::load_with("pendulum", &changes)?;
    /// assert_eq!(heavy.bodies[0].mass, Some(2.0));
    /// let (path, text) = text("pendulum")?; // the same from a text
    /// assert_eq!(Description::changed(&path, &text, &changes)?.bodies[0].mass, Some(2.0));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Scene::load_with`](super::Scene::load_with).
    pub fn changed(path: &str, text: &str, changes: &[(String, String)]) -> Result<Self> {
        super::change::changed(path, text, changes)
    }

    /// The same scene with all defaults written out, for other programs: structures as bodies, a
    /// tilt as gravity, and for each body mass, moments (unless its shape implies them),
    /// quaternion, coefficients and velocities. `name` is used in messages.
    ///
    /// # Errors
    /// As for [`Scene::new`](super::Scene::new).
    ///
    /// ```
    /// use lcplab_mechanics::scene::{Description, text};
    ///
    /// let (path, text) = text("stack")?;
    /// let plain = Description::from_toml(&path, &text)?.written_out("stack")?;
    /// assert_eq!(plain.bodies.len(), 6); // the ground, and five boxes that the file generates
    /// assert_eq!(plain.bodies[1].inertia, Some([1.0 / 6.0; 3]));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn written_out(&self, name: &str) -> Result<Description> {
        super::build::written_out(name, self)
    }
}

impl Default for Description {
    fn default() -> Self {
        Description {
            title: String::new(),
            teaches: String::new(),
            gravity: [0.0, 0.0, -9.81],
            tilt: None,
            time: 0.0,
            step: Step::default(),
            contact: Contacts::default(),
            solver: Solver::default(),
            generate: Vec::new(),
            bodies: Vec::new(),
            constraints: Vec::new(),
            start: Vec::new(),
            pairs: Vec::new(),
        }
    }
}

/// A body. It needs a name, a shape, and a mass or a density unless it is fixed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// The name that constraints use.
    pub name: String,
    /// The shape.
    pub shape: Shape,
    /// Whether the body is fixed: no force moves it and it keeps its velocities, which are 0 for
    /// the ground, but not for a belt, a turntable or a lift.
    #[serde(default)]
    pub fixed: bool,
    /// Mass (kg).
    #[serde(default)]
    pub mass: Option<f64>,
    /// Density (kg/m³), instead of the mass.
    #[serde(default)]
    pub density: Option<f64>,
    /// Principal moments of inertia (kg m²), instead of those of a homogeneous body. With them, the
    /// axes of a hull or a compound are its principal axes, and their origin its center of mass.
    #[serde(default)]
    pub inertia: Option<[f64; 3]>,
    /// The center of mass (m); for a plane, any point on it; for a hull, the origin of its points.
    #[serde(default)]
    pub position: [f64; 3],
    /// The orientation; by default the body's axes are the world's. For a hull, the orientation of
    /// the axes in which its points are given.
    #[serde(default)]
    pub rotation: Option<Rotation>,
    /// Velocity (m/s).
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Angular velocity (rad/s), world axes.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
    /// Coefficient of friction; by default that of `[contact]`. A pair uses the geometric mean.
    #[serde(default)]
    pub friction: Option<f64>,
    /// Coefficient of static friction, not below `friction`; by default the body's `friction` if
    /// given, otherwise that of `[contact]`. A pair uses the geometric mean.
    #[serde(default)]
    pub static_friction: Option<f64>,
    /// The direction (in the body's axes) along which the surface has its `friction`; across it, it
    /// has `friction_across`. On each face the projection of the direction counts.
    #[serde(default)]
    pub friction_direction: Option<[f64; 3]>,
    /// Coefficient of friction across `friction_direction`, above 0.
    #[serde(default)]
    pub friction_across: Option<f64>,
    /// Coefficient of restitution, 0 to 1; by default that of `[contact]`. A pair uses the
    /// geometric mean.
    #[serde(default)]
    pub restitution: Option<f64>,
    /// A constant force (N, world) in addition to gravity.
    #[serde(default)]
    pub force: [f64; 3],
    /// The point of the body on which the force acts (m, from `position`, in the body's axes); by
    /// default the center of mass.
    #[serde(default)]
    pub force_at: Option<[f64; 3]>,
    /// A time-dependent force (N, world) added to `force`, at the same point: `{ sine = {
    /// amplitude = [5, 0, 0], angular_frequency = 3 } }`, or `{ table = [[0, 0, 0, 0], [1, 5, 0,
    /// 0]] }` with rows of time (s), x, y, z.
    #[serde(default)]
    pub force_over_time: Option<TimeFunction>,
    /// The time-dependent displacement (m, world) of a fixed body from `position`, in the same
    /// format.
    #[serde(default)]
    pub displacement_over_time: Option<TimeFunction>,
    /// A constant torque (N m, world).
    #[serde(default)]
    pub torque: [f64; 3],
    /// Whether the body touches nothing; its shape is then only drawn.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub without_contact: bool,
}

/// Surface properties of two bodies, overriding those of the bodies. Fields that are not given
/// still follow from the bodies.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pair {
    /// The names of the two bodies.
    pub bodies: [String; 2],
    /// Coefficient of friction.
    #[serde(default)]
    pub friction: Option<f64>,
    /// Coefficient of static friction, not below `friction`; by default the pair's `friction` if
    /// given.
    #[serde(default)]
    pub static_friction: Option<f64>,
    /// The direction (in the first body's axes) along which `friction` holds; across it,
    /// `friction_across` holds.
    #[serde(default)]
    pub friction_direction: Option<[f64; 3]>,
    /// Coefficient of friction across `friction_direction`, above 0.
    #[serde(default)]
    pub friction_across: Option<f64>,
    /// Coefficient of restitution, 0 to 1.
    #[serde(default)]
    pub restitution: Option<f64>,
    /// Whether the two bodies never touch, even where they overlap.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub without_contact: bool,
}

/// The initial state of a body, as in a row of trajectory.csv.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// The body's name.
    pub body: String,
    /// Its center of mass (m).
    pub position: [f64; 3],
    /// The quaternion [w, x, y, z] that rotates its principal axes to the world's; a point has
    /// none.
    #[serde(default)]
    pub orientation: Option<[f64; 4]>,
    /// Velocity (m/s).
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Angular velocity (rad/s), world axes.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
}

/// The shape of a body, such as `"point"` or `{ sphere = 0.5 }`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// A point mass: it has a position but no orientation, and touches everything except other
    /// points.
    #[default]
    Point,
    /// A ball of this radius (m).
    Sphere(f64),
    /// A box with these edge lengths (m).
    Box([f64; 3]),
    /// A capsule: a cylinder along z with half balls at its ends.
    Capsule(Capsule),
    /// A cylinder along z, also for disks and wheels: round on planes and on the faces of boxes and
    /// hulls, a prism with 32 sides for all other shapes.
    Cylinder(Capsule),
    /// The convex hull of these points (m), which must span a volume.
    Hull(Vec<[f64; 3]>),
    /// Several shapes that move as one body, such as `{ compound = [{ shape = { sphere = 0.2 },
    /// position = [0, 0, 1] }] }`. Mass in overlaps counts twice.
    Compound(Vec<Part>),
    /// The half space below a plane with this normal (any length); must be fixed.
    Plane([f64; 3]),
}

/// A part of a compound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// A sphere, a box, a capsule, a cylinder or a hull.
    pub shape: Shape,
    /// The position of its origin (m), in the axes of the body's description.
    #[serde(default)]
    pub position: [f64; 3],
    /// Its orientation in these axes.
    #[serde(default)]
    pub rotation: Option<Rotation>,
}

/// A segment along the body's z axis, and the radius around it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Capsule {
    /// The length of the segment (m); a whole capsule is longer by two radii.
    pub length: f64,
    /// Radius (m).
    pub radius: f64,
}

/// An orientation, body to world.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Rotation {
    /// A quaternion [w, x, y, z] (any length but 0).
    Quaternion([f64; 4]),
    /// Rotated about the world's x axis by this angle (degrees).
    X(f64),
    /// Rotated about the world's y axis by this angle (degrees).
    Y(f64),
    /// Rotated about the world's z axis by this angle (degrees).
    Z(f64),
}

/// A constraint. It is satisfied at the initial positions, except for a distance with its own
/// length; angles and displacements are measured from there.
/// [`constraint::ALL`](crate::constraint::ALL), and `lcplab scenes --joints`, list the kinds and
/// the fields of each.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Constraint {
    /// The kind of joint, such as `ball`.
    #[schemars(schema_with = "kinds")]
    pub kind: String,
    /// The names of one body (joined to the world) or two.
    pub bodies: Vec<String>,
    /// The joint's position (m, world, at the start); by default the center of the last body.
    #[serde(default)]
    pub point: Option<[f64; 3]>,
    /// The two ends (m, world, at the start), in the order of the bodies, the world first; by
    /// default the centers of the two bodies.
    #[serde(default)]
    pub points: Option<[[f64; 3]; 2]>,
    /// The length (m); by default the distance at the start. For a rack, the radius of its wheel.
    #[serde(default)]
    pub length: Option<f64>,
    /// The axis (any length), fixed to the first of two bodies or to the world; in world axes at
    /// the start.
    #[serde(default)]
    pub axis: Option<[f64; 3]>,
    /// Two axes (any length) in world axes at the start. For a universal joint, the first is fixed
    /// to the first of two bodies or the world, the second to the other body; for a gear, they are
    /// those of its wheels; for a rack, that of its wheel and the direction of the other body.
    #[serde(default)]
    pub axes: Option<[[f64; 3]; 2]>,
    /// The half angle of a cone (rad).
    #[serde(default)]
    pub angle: Option<f64>,
    /// The lower and the upper stop (m or rad), 0 being the start; along an axis either may be
    /// infinite.
    #[serde(default, with = "infinite::two")]
    #[schemars(with = "Option<[Number; 2]>")]
    pub limits: Option<[f64; 2]>,
    /// The speed of a motor (m/s or rad/s), that of the last body relative to the other.
    #[serde(default)]
    pub speed: Option<f64>,
    /// The initial speed of the last body on a hinge (rad/s) or a slider (m/s), relative to the
    /// other body. If that one has a `start_speed` too, its joint must come earlier in the file.
    #[serde(default)]
    pub start_speed: Option<f64>,
    /// The maximum force of a motor (N or N m); `inf` for a motor that always keeps its speed.
    #[serde(default, with = "infinite::one")]
    #[schemars(with = "Option<Number>")]
    pub effort: Option<f64>,
    /// The stiffness of a spring (N/m or N m/rad).
    #[serde(default)]
    pub stiffness: Option<f64>,
    /// The damping of a spring (N s/m or N m s/rad); by default 0.
    #[serde(default)]
    pub damping: Option<f64>,
    /// The numbers of teeth of a gear's wheels, in the order of the bodies.
    #[serde(default)]
    pub teeth: Option<[u32; 2]>,
}

/// The schema of a list that may also be written as its only item.
fn one_or_several<T: JsonSchema>(schemas: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let one = schemas.subschema_for::<T>();
    let several = schemas.subschema_for::<Vec<T>>();
    schemars::json_schema!({ "anyOf": [one, several] })
}

/// The schema of a constraint's kind: one of the names of the joints.
fn kinds(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let names: Vec<_> = crate::constraint::ALL.iter().map(|joint| joint.name).collect();
    schemars::json_schema!({ "type": "string", "enum": names })
}
