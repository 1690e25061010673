//! A simulation as its scene states it: which solver, with which settings.
//!
//! ```
//! use lcplab_mechanics::scene::{Scene, Scheme};
//! use lcplab_mechanics::simulation::{Simulation, Step, options, solver};
//! use lcplab_solver::Registry;
//!
//! let scene = Scene::load("fig7")?;
//! assert_eq!(options(&scene).settings.tolerance, scene.solver.tolerance);
//! assert_eq!(solver(&scene)?.name(), scene.solver.name);
//!
//! // The impulses of the first step, from the ground up (N s), by two solvers.
//! let mut simulation = Simulation::by(&scene, Registry::standard().method("lemke", None)?);
//! let by_lemke = simulation.step().expect("a step that can be taken");
//! assert_eq!(by_lemke.solves[0].solution.x, [4.0, 3.0, 1.0]);
//! assert_eq!(Step::of(&scene, 1)?.solves[0].solution.x, [4.0, 3.0, 1.0]);
//! // At acceleration level an impact LCP comes first: m v (1, 1, 0).
//! let level = scene.at_level(Scheme::Acceleration);
//! assert_eq!(Step::of(&level, 1)?.solves[0].solution.x, [1.0, 1.0, 0.0]);
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

use lcplab_lcp::error::{Error, Result};
use lcplab_solver::{Damping, Dantzig, Entry, Method, Options, Settings, Solver};

use super::{Simulation, Step};
use crate::formulation::Problem;
use crate::scene::{Scene, Scheme};

/// The options that a scene states for its solver.
pub fn options(scene: &Scene) -> Options {
    let settings = Settings::default()
        .with_tolerance(scene.solver.tolerance)
        .with_max_iterations(scene.solver.max_iterations)
        .with_memory(scene.memory);
    let order = scene.solver.order.seeded(scene.solver.seed);
    let damping = scene.solver.damping.map_or(Damping::Safe, Damping::Factor);
    Options::default()
        .with_settings(settings)
        .with_omega(scene.solver.omega)
        .with_order(order)
        .with_damping(damping)
}

/// The solver for LCPs that a scene states.
///
/// # Errors
/// If there is none of that name, or it solves only friction cones.
pub fn solver(scene: &Scene) -> Result<Box<dyn Solver>> {
    Ok(entry(scene)?.build(&options(scene)))
}

/// The entry of the solver for LCPs that a scene states, for which its options are valid.
fn entry(scene: &Scene) -> Result<&Entry> {
    let name = &scene.solver.name;
    let mut named = scene.solvers.all().filter(|method| method.name() == *name).peekable();
    if named.peek().is_some() && named.all(|method| method.boxed().is_none()) {
        let reason = format!("{name} supports only friction cones, not {}", scene.contact.model);
        return Err(Error::invalid(&*scene.name, "solver.name", reason));
    }
    let within = |error: Error| error.within(&scene.name);
    options(scene).validate().map_err(within)?;
    scene.solvers.entry(name).map_err(within)
}

impl Simulation {
    /// The scene at its start, to be stepped by the solver that it states: one for LCPs, or, if its
    /// friction is in cones, one for cones.
    ///
    /// ```
    /// use lcplab_mechanics::{scene::Scene, simulation::Simulation};
    ///
    /// let mut simulation = Simulation::of(&Scene::load("fig7")?)?;
    /// let step = simulation.step().expect("a step that can be taken");
    /// assert_eq!(step.solves[0].solution.x, [4.0, 3.0, 1.0]); // N s, from the ground up
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If there is none of that name.
    pub fn of(scene: &Scene) -> Result<Self> {
        let model = scene.contact.model;
        let is_stated =
            |method: &&Method| method.takes(Some(model)) && method.name() == scene.solver.name;
        match scene.solvers.all().find(is_stated) {
            Some(method @ Method::Cone(_)) => Ok(Simulation::by(scene, method)),
            _ => Ok(Simulation::by(scene, &Method::Boxed(entry(scene)?.clone()))),
        }
    }

    /// The scene at its start, to be stepped by a method; what a cone solver is not made for,
    /// problems without friction, is left to another one.
    pub fn by(scene: &Scene, method: &Method) -> Self {
        let options = options(scene);
        match method {
            Method::Boxed(entry) => Simulation {
                entry: Some(entry.clone()),
                ..Simulation::new(scene.clone(), entry.build(&options))
            },
            Method::Cone(entry) => {
                let boxed = Box::new(Dantzig { settings: options.settings.clone() });
                let cone_solver = entry.build(&options.settings);
                Simulation::new(scene.clone(), boxed).with_cone_solver(cone_solver)
            }
        }
    }
}

impl Step {
    /// The scene's step of this number, from 1, solved by Dantzig's method.
    ///
    /// # Errors
    /// If the simulation fails before.
    pub fn of(scene: &Scene, number: usize) -> Result<Self> {
        let stepper = Dantzig { settings: options(scene).settings };
        let mut simulation = Simulation::new(scene.clone(), Box::new(stepper));
        let refused =
            |reason: String| Error::invalid(&*scene.name, format!("step {number}"), reason);
        let mut last = None;
        for _ in 0..number {
            last = Some(simulation.step().map_err(|failure| refused(failure.to_string()))?);
        }
        last.ok_or_else(|| refused("steps are counted from 1".into()))
    }
}

/// The last LCP of the scene's step of this number, from 1.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::problem_of;
///
/// // Three balls in a stack, one above the other (K&M, Figure 7).
/// let problem = problem_of(&Scene::load("fig7")?, 1)?;
/// let a = problem.lcp.matrix();
/// assert_eq!([a.entry(1, 0), a.entry(1, 1), a.entry(1, 2)], [-1.0, 2.0, -1.0]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Errors
/// If the simulation fails before, or the step solves none.
pub fn problem_of(scene: &Scene, number: usize) -> Result<Problem> {
    let solve = Step::of(scene, number)?.solves.pop().ok_or_else(|| {
        Error::invalid(&*scene.name, format!("step {number}"), "it solves no problem")
    })?;
    Ok(solve.problem)
}

impl Scene {
    /// The scene stepped at another level.
    pub fn at_level(&self, scheme: Scheme) -> Scene {
        let mut scene = self.clone();
        scene.step.scheme = scheme;
        scene
    }
}
