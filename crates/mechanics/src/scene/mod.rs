//! Scenes: bodies, constraints and gravity at the start, with the settings of a simulation.
//!
//! A [`Scene`] is always valid. It is read from TOML ([`Description`] lists every field) or built
//! from a description made by a program; [`contacts()`] finds its contact points.

mod anisotropy;
mod build;
pub mod catalogue;
mod change;
mod contacts;
pub mod description;
mod driven;
mod file;
mod friction;
pub mod generate;
mod infinite;
mod joints;
mod notes;
mod range;
pub(crate) mod resting;
mod saved;
mod scale;
mod scheme;
mod settings;
#[doc(hidden)] // for files of reports, which are read in the same way
pub mod source;
mod surface;
mod time_function;

pub use contacts::{
    ContactId, DetectedContact, Detector, Feature, Passage, Reach, contacts, step_contacts,
};
pub use description::Description;
pub use driven::Driven;
pub use file::schema;
pub use resting::Resting;
pub use saved::saved;
pub use scheme::{Feedback, Integrator, Penalty, Scheme, Soft, Xpbd};
pub use settings::{Contacts, Manifold, Persistence, RowOrder, Sliding, Solver, Step};
pub use surface::Surface;
pub use time_function::{Sine, TimeFunction};

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use nalgebra::Vector3;

use crate::body::{Body, State};
use crate::constraint::Constraint;
use lcplab_lcp::disk;
use lcplab_lcp::error::{Defects, Error, Result};
use lcplab_lcp::memory::Memory;
use lcplab_solver::Registry;

/// The path and the text of a scene file or a shipped scene.
///
/// # Errors
/// If the file cannot be read, or the name is neither a file nor a shipped scene.
pub fn text(path_or_name: &str) -> Result<(String, String)> {
    let path = Path::new(path_or_name);
    if disk::is_there(path) {
        let text = disk::read(path, disk::WRITTEN_BY_HAND)?;
        return Ok((path_or_name.into(), text));
    }
    match catalogue::text(path_or_name) {
        Some(text) => Ok((format!("{path_or_name}.toml"), text.into())),
        None => Err(Error::Unknown {
            kind: "scene file or shipped scene",
            name: path_or_name.into(),
            known: catalogue::SHIPPED.iter().map(|shipped| shipped.name.into()).collect(),
        }),
    }
}

/// A valid scene.
///
/// ```
/// use lcplab_mechanics::scene::{Scene, schema, text};
///
/// // Three balls of 1 kg and 1 m in a stack, g = 1 m/s².
/// let scene = Scene::load("fig7")?;
/// assert!(scene.validate().is_ok() && scene.notes().is_empty());
/// assert_eq!((scene.body("bottom"), scene.body("roof")), (Some(1), None));
/// assert_eq!(scene.thinnest(), Some(1.0)); // m
/// assert_eq!(scene.scale(), 1.0); // N, the weight of the lightest body
/// assert_eq!(scene.resting().speed, 1e-6); // m/s, as the file says
/// assert_eq!(scene.plastic_speed(), scene.contact.bounce_speed);
/// assert_eq!((scene.friction([0, 1]), scene.static_friction([0, 1])), (0.0, 0.0));
/// assert_eq!(scene.restitution([Some(0), Some(1)]), 0.0);
/// // No support is moved by a function of time.
/// assert_eq!(scene.supported(&scene.states, 0.0, 0.1).as_ref(), scene.states);
///
/// let (path, text) = text("fig7")?; // its file
/// assert!(path.ends_with("fig7.toml") && text.contains("gravity = [0, 0, -1]"));
/// assert!(schema()["properties"]["gravity"].is_object()); // the JSON schema of such files
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Scene {
    /// The file's name without its extension.
    pub name: String,
    /// A title for lists, one line.
    pub title: String,
    /// What the scene teaches, and what must hold in it.
    pub teaches: String,
    /// The acceleration of gravity (m/s²).
    pub gravity: Vector3<f64>,
    /// The time (s) at which the simulation begins.
    pub time: f64,
    /// The time-dependent forces and motions of bodies.
    pub driven: Vec<Driven>,
    /// The settings of a time step.
    pub step: Step,
    /// The settings of contacts.
    pub contact: Contacts,
    /// The solver and its settings.
    pub solver: Solver,
    /// The bodies.
    pub bodies: Vec<Body>,
    /// The bodies' states at the start.
    pub states: Vec<State>,
    /// Surface properties of pairs of bodies, the lower index first, that override those of the
    /// bodies.
    pub pairs: BTreeMap<[usize; 2], Surface>,
    /// The constraints other than contacts.
    pub constraints: Vec<Arc<dyn Constraint>>,
    /// The memory limit for the matrix of a step and for the solver's own data, each; not stored in
    /// files.
    pub memory: Memory,
    /// The solvers among which the name of [`Scene::solver`] selects one: those of the library,
    /// unless a program adds its own. Not stored in files.
    pub solvers: Registry,
}

impl Scene {
    /// Builds a scene from a description.
    ///
    /// # Errors
    /// A single error that lists every defect with its field, such as `bodies[2].mass`.
    ///
    /// ```
    /// use lcplab_mechanics::scene::{Description, Scene};
    ///
    /// let mut description = Description::default();
    /// description.step.dt = -1.0;
    /// let error = Scene::new("empty", &description).unwrap_err();
    /// assert_eq!(error.to_string(), "empty: step.dt: must be positive, is -1");
    /// ```
    pub fn new(name: &str, description: &Description) -> Result<Scene> {
        build::scene(name, description)
    }

    /// Builds a scene from a text in the scene format; `path` is used in messages.
    ///
    /// # Errors
    /// A single error that lists every defect with its line and field, such as `arch.toml: line 12:
    /// bodies[2].mass: must be positive, is -1`.
    pub fn from_toml(path: &str, text: &str) -> Result<Scene> {
        file::parse(path, text)
    }

    /// The same with some fields overridden, such as `contact.friction` by `0.3` or
    /// `bodies.crate.mass` by `2`. Fields of a table and items of a list follow a dot; an item is
    /// given by its index from 0 or its name. `mu`, `dt` and `angle` stand for `contact.friction`,
    /// `step.dt` and `tilt.y`.
    ///
    /// # Errors
    /// As for [`load`](Scene::load), or if there is no such field or the value is invalid.
    ///
    /// ```
    /// use lcplab_mechanics::scene::Scene;
    ///
    /// let changes = [("mu".into(), "0.3".into()), ("bodies.bob.mass".into(), "2".into())];
    /// let scene = Scene::load_with("pendulum", &changes)?;
    /// assert_eq!((scene.contact.friction, scene.bodies[0].mass.mass()), (0.3, 2.0));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn load_with(path_or_name: &str, changes: &[(String, String)]) -> Result<Scene> {
        if changes.is_empty() {
            return Scene::load(path_or_name);
        }
        Scene::new(path_or_name, &Description::load_with(path_or_name, changes)?)
    }

    /// Reads a scene file, or a shipped scene by its name.
    ///
    /// # Errors
    /// If the file cannot be read or is not a scene, or the name is neither a file nor a shipped
    /// scene.
    ///
    /// ```
    /// let scene = lcplab_mechanics::scene::Scene::load("pendulum")?;
    /// assert_eq!(scene.bodies[0].name, "bob");
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn load(path_or_name: &str) -> Result<Scene> {
        let (path, text) = text(path_or_name)?;
        Scene::from_toml(&path, &text)
    }

    /// Checks the step, contact and solver settings, after a change to them.
    ///
    /// # Errors
    /// Lists each invalid setting.
    pub fn validate(&self) -> Result<()> {
        let mut defects = Defects::default();
        self.step.check(&mut defects);
        self.contact.check(&mut defects);
        friction::check(&mut defects, &self.step, &self.contact);
        surface::check_scheme(&mut defects, self);
        driven::check_scheme(&mut defects, self);
        self.solver.check(&mut defects);
        defects.into_result(self.name.as_str())
    }

    /// The thresholds for resting contacts at acceleration level.
    pub fn resting(&self) -> Resting {
        Resting::of(self)
    }

    /// The approach (m/s) below which an impact does not bounce, whatever e is.
    pub fn plastic_speed(&self) -> f64 {
        match self.step.scheme {
            Scheme::Acceleration => self.contact.bounce_speed.max(self.resting().bounce),
            _ => self.contact.bounce_speed,
        }
    }

    /// The thickness (m) of the thinnest body, if any has one.
    pub fn thinnest(&self) -> Option<f64> {
        self.bodies.iter().filter_map(|body| resting::size(&body.shape)).reduce(f64::min)
    }

    /// The index of the body with this name.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }
}
