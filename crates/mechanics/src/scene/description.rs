//! The scene file, field by field. SI units; angles in radians unless the name says degrees.
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

use super::course::Course;
use super::generate::Generator;
use super::settings::{Contacts, Solver, Step};
use lcplab_problem::error::Result;

/// A scene as it is written down. [`Scene::new`](super::Scene::new) makes a scene of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Description {
    /// One line for lists.
    pub title: String,
    /// What the scene teaches, and what must hold in it.
    pub teaches: String,
    /// The acceleration of gravity (m/s²).
    pub gravity: [f64; 3],
    /// How the whole scene leans, in degrees: `{ y = 17 }` makes a slope of 17 degrees, down along
    /// x, of a level ground and all that stands on it. Coordinates stay along the slope; gravity is
    /// turned.
    pub tilt: Option<Rotation>,
    /// The time (s) at which the simulation begins, for forces and supports that depend on it.
    pub time: f64,
    /// How a step is taken.
    pub step: Step,
    /// When contacts count, and what they do.
    pub contact: Contacts,
    /// Which solver to use.
    pub solver: Solver,
    /// Regular structures, added to the bodies and constraints.
    #[schemars(schema_with = "one_or_several::<Generator>")]
    pub generate: Vec<Generator>,
    /// The bodies.
    #[schemars(schema_with = "one_or_several::<Body>")]
    pub bodies: Vec<Body>,
    /// The constraints; contacts are found, not written.
    #[schemars(schema_with = "one_or_several::<Constraint>")]
    pub constraints: Vec<Constraint>,
    /// Where bodies are when the simulation begins, if not where joints were made: what `simulate`
    /// saves.
    pub start: Vec<Start>,
    /// What pairs of bodies do to each other, in place of what follows from their surfaces.
    #[schemars(schema_with = "one_or_several::<Pair>")]
    pub pairs: Vec<Pair>,
}

impl Description {
    /// The description in a text in the scene format, as it is written: whether it makes a scene is
    /// what [`Scene::new`](super::Scene::new) finds out. `path` stands in the messages.
    ///
    /// # Errors
    /// One error with every defect, each with its line.
    pub fn from_toml(path: &str, text: &str) -> Result<Self> {
        super::file::description(path, text)
    }

    /// The description in a scene file, or of a shipped scene, with fields set as by
    /// [`Scene::load_with`](super::Scene::load_with).
    ///
    /// # Errors
    /// As that one.
    pub fn load_with(path_or_name: &str, changes: &[(String, String)]) -> Result<Self> {
        let (path, text) = super::text(path_or_name)?;
        match changes {
            [] => Description::from_toml(&path, &text),
            _ => super::change::changed(&path, &text, changes),
        }
    }

    /// The same scene for a program that knows no defaults of this one: structures written out as
    /// bodies, a tilt as gravity, and of each body mass, moments (unless its shape implies them),
    /// quaternion, coefficients and velocities. `name` stands in the messages.
    ///
    /// # Errors
    /// As [`Scene::new`](super::Scene::new).
    ///
    /// ```
    /// use lcplab_mechanics::scene::{Description, text};
    ///
    /// let (path, text) = text("stack")?;
    /// let plain = Description::from_toml(&path, &text)?.written_out("stack")?;
    /// assert_eq!(plain.bodies.len(), 6); // the ground, and five boxes that the file generates
    /// assert_eq!(plain.bodies[1].inertia, Some([1.0 / 6.0; 3]));
    /// # Ok::<(), lcplab_problem::error::Error>(())
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
    /// What it looks like.
    pub shape: Shape,
    /// Whether nothing moves it: it keeps its velocities, which are 0 for the ground, and not for a
    /// belt, a turntable or a lift.
    #[serde(default)]
    pub fixed: bool,
    /// Mass (kg).
    #[serde(default)]
    pub mass: Option<f64>,
    /// Density (kg/m³), in place of the mass.
    #[serde(default)]
    pub density: Option<f64>,
    /// Principal moments of inertia (kg m²), in place of those of a homogeneous body.
    #[serde(default)]
    pub inertia: Option<[f64; 3]>,
    /// The centre of mass (m); of a plane, any point of it; of a hull, the origin of its points.
    #[serde(default)]
    pub position: [f64; 3],
    /// The orientation; by default the body's axes are the world's. Of a hull, the orientation of
    /// the axes in which its points are given.
    #[serde(default)]
    pub rotation: Option<Rotation>,
    /// Velocity (m/s).
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Angular velocity (rad/s), world axes.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
    /// Coefficient of friction; by default that of `[contact]`. A pair has the geometric mean.
    #[serde(default)]
    pub friction: Option<f64>,
    /// Coefficient of static friction, no less than `friction`; by default `friction` where the
    /// body states it, else that of `[contact]`. A pair has the geometric mean.
    #[serde(default)]
    pub static_friction: Option<f64>,
    /// Coefficient of restitution, 0 to 1; by default that of `[contact]`. A pair has the geometric
    /// mean.
    #[serde(default)]
    pub restitution: Option<f64>,
    /// A constant force (N, world), beside gravity.
    #[serde(default)]
    pub force: [f64; 3],
    /// The point of the body on which the force acts (m, from `position`, in the body's axes); by
    /// default the centre of mass.
    #[serde(default)]
    pub force_at: Option<[f64; 3]>,
    /// A force (N, world) that is added to `force`, at the same point, as a function of time:
    /// `{ sine = { amplitude = [5, 0, 0], angular_frequency = 3 } }`, or
    /// `{ table = [[0, 0, 0, 0], [1, 5, 0, 0]] }` with rows of time (s), x, y, z.
    #[serde(default)]
    pub force_over_time: Option<Course>,
    /// Where a fixed body is (m, world, from `position`) as a function of time, written likewise.
    #[serde(default)]
    pub displacement_over_time: Option<Course>,
    /// A constant torque (N m, world).
    #[serde(default)]
    pub torque: [f64; 3],
}

/// What two bodies do to each other where they touch, in place of what follows from their surfaces.
/// What is not stated still follows from them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pair {
    /// The names of the two bodies.
    pub bodies: [String; 2],
    /// Coefficient of friction.
    #[serde(default)]
    pub friction: Option<f64>,
    /// Coefficient of static friction, no less than `friction`; by default `friction` where the
    /// pair states it.
    #[serde(default)]
    pub static_friction: Option<f64>,
    /// Coefficient of restitution, 0 to 1.
    #[serde(default)]
    pub restitution: Option<f64>,
}

/// The state in which a body begins, as a row of trajectory.csv has it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// The body's name.
    pub body: String,
    /// Its centre of mass (m).
    pub position: [f64; 3],
    /// The quaternion [w, x, y, z] that turns its principal axes to the world's; a point has none.
    #[serde(default)]
    pub orientation: Option<[f64; 4]>,
    /// Velocity (m/s).
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Angular velocity (rad/s), world axes.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
}

/// The shape of a body, as `"point"` or `{ sphere = 0.5 }`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// A point mass: it has a place but no orientation, and touches all but other points.
    #[default]
    Point,
    /// A ball of this radius (m).
    Sphere(f64),
    /// A box with these edge lengths (m).
    Box([f64; 3]),
    /// A cylinder along z with half balls at its ends.
    Capsule(Capsule),
    /// A cylinder along z, disc and wheel too: round on planes and on the faces of boxes and hulls,
    /// to all else a prism with 32 sides.
    Cylinder(Capsule),
    /// The convex hull of these points (m), which must span a volume.
    Hull(Vec<[f64; 3]>),
    /// Several shapes that move as one, as `{ compound = [{ shape = { sphere = 0.2 }, position =
    /// [0, 0, 1] }] }`. Where two overlap, the matter counts twice.
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
    /// Where its origin is (m), in the axes in which the body is written.
    #[serde(default)]
    pub position: [f64; 3],
    /// How it is turned in these axes.
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
    /// Turned about the world's x axis by so many degrees.
    X(f64),
    /// Turned about the world's y axis by so many degrees.
    Y(f64),
    /// Turned about the world's z axis by so many degrees.
    Z(f64),
}

/// A constraint. It holds at the initial positions, except for a distance with its own length; what
/// has an angle or a displacement counts it from there.
/// [`constraint::ALL`](crate::constraint::ALL), and `lcplab scenes --joints`, list the kinds and
/// which fields each has.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Constraint {
    /// What is kept: the name of a joint, such as `ball`.
    #[schemars(schema_with = "kinds")]
    pub kind: String,
    /// The names of one body (joined to the world) or two.
    pub bodies: Vec<String>,
    /// The joint's place (m, world, at the start); by default the centre of the last body named.
    #[serde(default)]
    pub point: Option<[f64; 3]>,
    /// The two ends (m, world, at the start), in the order of the bodies, the world first; by
    /// default the centres of two bodies.
    #[serde(default)]
    pub points: Option<[[f64; 3]; 2]>,
    /// The length (m); by default the distance at the start. Of a rack the radius of its wheel.
    #[serde(default)]
    pub length: Option<f64>,
    /// The axis (any length), fixed to the first of two bodies or to the world; in world axes at
    /// the start.
    #[serde(default)]
    pub axis: Option<[f64; 3]>,
    /// Two axes (any length) in world axes at the start: of a universal joint the first on the
    /// first of two bodies or the world, the second on the other body; of a gear those of its
    /// wheels, of a rack that of its wheel and the direction of the other body.
    #[serde(default)]
    pub axes: Option<[[f64; 3]; 2]>,
    /// The half angle of a cone (rad).
    #[serde(default)]
    pub angle: Option<f64>,
    /// The lower and the upper stop (m or rad), 0 being the start; along an axis either may be
    /// infinite.
    #[serde(default)]
    pub limits: Option<[f64; 2]>,
    /// The speed of a motor (m/s or rad/s), that of the last body against the other.
    #[serde(default)]
    pub speed: Option<f64>,
    /// The speed at which the last body starts to turn on a hinge (rad/s) or to move on a slider
    /// (m/s), against the other body. Where that one has a `start_speed` too, its joint must come
    /// earlier in the file.
    #[serde(default)]
    pub start_speed: Option<f64>,
    /// The greatest force of a motor (N or N m).
    #[serde(default)]
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

/// The schema of a list that may also be its only item.
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
