//! Commands on a scene, one per file, and their common options: the scene and its changes.

mod export;
mod list;
mod simulate;

pub use export::Export;
pub use list::Scenes;
pub use simulate::Simulate;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use lcplab::body::State;
use lcplab::error::{Error, Result};
use lcplab::lcp::friction::{Form, Model};
use lcplab::report::methods::default_for;
use lcplab::scene::{self, Scene, Scheme};
use lcplab::simulation::Simulation;
use lcplab::solver::{Method, Registry};

use super::limits::MemoryLimit;
use super::options::{Choices, SolverArgs, iterations, model_names, with_default};
use super::plugin::Plugins;

/// A scene, and what to change in it.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// Scene file, or name of a shipped scene
    pub scene: String,
    /// Solver [default: the scene's]
    #[arg(long)]
    pub solver: Option<String>,
    #[arg(long, help = format!("Friction model: {} [default: the scene's]", model_names()))]
    pub model: Option<Model>,
    #[command(flatten)]
    pub step: StepArgs,
    #[command(flatten)]
    pub solve: SolveArgs,
    #[command(flatten)]
    pub plugins: Plugins,
}

/// How a scene is stepped.
#[derive(Debug, Args)]
pub struct StepArgs {
    /// Time-stepping scheme [default: the scene's]
    #[arg(long, value_parser = schemes())]
    pub scheme: Option<Scheme>,
    /// Time step in seconds [default: the scene's]
    #[arg(long, allow_negative_numbers = true)]
    dt: Option<f64>,
    #[command(flatten)]
    changes: Changes,
}

impl StepArgs {
    /// The first option that was given.
    pub fn given(&self) -> Option<&'static str> {
        let scheme = self.scheme.is_some().then_some("--scheme");
        let dt = self.dt.is_some().then_some("--dt");
        scheme.or(dt).or((!self.changes.is_empty()).then_some("--set"))
    }
}

/// How each problem is solved.
#[derive(Debug, Args)]
#[command(
    mut_arg("omega", |option| with_default(option, "the scene's")),
    mut_arg("order", |option| with_default(option, "the scene's")),
    mut_arg("seed", |option| with_default(option, "the scene's"))
)]
pub struct SolveArgs {
    /// Largest scaled residual of an accepted answer [default: the scene's]
    #[arg(long, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Maximum number of sweeps or pivots in a solve [default: the scene's]
    #[arg(long, visible_alias = "sweeps", allow_negative_numbers = true, value_parser = iterations)]
    max_iterations: Option<usize>,
    #[command(flatten)]
    memory: MemoryLimit,
    #[command(flatten)]
    choices: Choices,
}

impl SolveArgs {
    /// The same for problems, which have no settings of their own.
    pub fn with_defaults(&self) -> SolverArgs {
        let SolveArgs { tolerance, max_iterations, memory, choices } = *self;
        SolverArgs::new(tolerance, max_iterations, memory, choices)
    }
}

/// Fields of the scene file to set.
#[derive(Debug, Args)]
pub struct Changes {
    /// Set a field of the scene file, such as mu=0.3, angle=17, dt=0.001, contact.restitution=0.5
    /// or bodies.crate.velocity=[1,0,0] (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = key_and_value)]
    set: Vec<(String, String)>,
}

impl Changes {
    /// The scene of this file or name with these changes.
    pub fn load(&self, scene: &str) -> Result<Scene> {
        Scene::load_with(scene, &self.set)
    }

    /// The file of this scene with these changes, whose bodies start with these states, at this
    /// time (s) after its beginning.
    pub fn saved(&self, path: &str, scene: &Scene, states: &[State], time: f64) -> Result<String> {
        scene::saved(path, &self.set, scene, states, time)
    }

    /// Whether this field is among them.
    pub fn sets(&self, field: &str) -> bool {
        self.set.iter().any(|(key, _)| key == field)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.set.is_empty()
    }
}

fn key_and_value(text: &str) -> std::result::Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => {
            Ok((key.trim().into(), value.trim().into()))
        }
        _ => Err("needs a field and its value, such as contact.friction=0.3".into()),
    }
}

/// A parser for the names of the schemes.
fn schemes() -> impl TypedValueParser<Value = Scheme> {
    let value = |scheme: Scheme| PossibleValue::new(scheme.name()).help(meaning(scheme));
    PossibleValuesParser::new(Scheme::ALL.map(value))
        .map(|name| Scheme::by_name(&name).unwrap_or_default())
}

/// A scheme in the help.
fn meaning(scheme: Scheme) -> &'static str {
    match scheme {
        Scheme::Velocity => "Solve an LCP for impulses; constraints hold for velocities",
        Scheme::Acceleration => "Solve an LCP for forces; constraints hold for accelerations",
        Scheme::SplitImpulse => "As velocity, then correct positions by a second LCP",
        Scheme::GaussSeidel => "As velocity, then correct positions row by row (NGS)",
        Scheme::Xpbd => "Correct positions row by row in substeps; --solver is not used",
        Scheme::Soft => "Treat rows as springs of a given frequency; --solver is not used",
        Scheme::Penalty => "Replace constraints by springs and dampers; --solver is not used",
        Scheme::SequentialImpulses => "Apply impulses row by row; --solver is not used",
    }
}

impl SceneArgs {
    /// The scene, stepped by this solver of the registry instead of its own if given.
    pub fn load(&self, named: Option<&str>, solvers: Registry) -> Result<Scene> {
        let mut scene = self.step.changes.load(&self.scene)?;
        scene.solvers = solvers;
        let method = |scene: &Scene| {
            let Scene { step, contact, solver, .. } = scene;
            (step.scheme, contact.model, solver.name.clone(), solver.order)
        };
        let own_method = method(&scene);
        scene.step.scheme = self.step.scheme.unwrap_or(scene.step.scheme);
        scene.step.dt = self.step.dt.unwrap_or(scene.step.dt);
        if let Some(model) = self.model {
            scene.contact.model = model;
        }
        let solver = &mut scene.solver;
        solver.name = named.unwrap_or(&solver.name).to_string();
        solver.tolerance = self.solve.tolerance.unwrap_or(solver.tolerance);
        solver.max_iterations = self.solve.max_iterations.unwrap_or(solver.max_iterations);
        solver.omega = self.solve.choices.omega.unwrap_or(solver.omega);
        solver.order = self.solve.choices.order.unwrap_or(solver.order);
        solver.seed = self.solve.choices.seed.unwrap_or(solver.seed);
        solver.damping = self.solve.choices.damping.or(solver.damping);
        // A number of sweeps without a test is the scene's choice for its own method only.
        let is_tested = self.solve.tolerance.is_some() || method(&scene) != own_method;
        if is_tested && !self.step.changes.sets("solver.fixed_sweeps") {
            scene.solver.fixed_sweeps = false;
        }
        if self.solve.tolerance.is_some() && scene.solver.fixed_sweeps {
            let reason = "has no effect with solver.fixed_sweeps=true";
            return Err(Error::invalid(&scene.name, "--tolerance", reason));
        }
        scene.validate()?;
        scene.memory = self.solve.memory.max_memory;
        Ok(scene)
    }

    /// A simulation of the scene at its start, with its solver; options that the solver does not
    /// use are rejected.
    fn simulation(&self, scene: &Scene) -> Result<Simulation> {
        let simulation = Simulation::unjudged(scene).map_err(|error| self.blamed(error))?;
        self.check(&[self.method(&scene.solver.name, scene)?], scene)?;
        Ok(simulation)
    }

    /// Attributes an unknown solver to the scene file, unless it was given here.
    fn blamed(&self, error: Error) -> Error {
        match (&self.solver, &error) {
            (None, Error::Unknown { .. }) => {
                Error::invalid(&*self.scene, "solver.name", error.to_string())
            }
            _ => error,
        }
    }

    /// The solver with this name. A requested solver must be made for the friction model; if the
    /// scene's own is not, another one is used and the output names it.
    fn method(&self, name: &str, scene: &Scene) -> Result<Method> {
        let (solvers, model) = (&scene.solvers, scene.contact.model);
        let method = match model.form() {
            Form::Box => solvers.method(name, None),
            _ if self.is_named() => solvers.method(name, Some(model)),
            _ => solvers
                .method(name, Some(model))
                .or_else(|_| solvers.method(default_for(model), Some(model))),
        };
        method.cloned()
    }

    /// Whether a solver was given.
    fn is_named(&self) -> bool {
        self.solver.is_some() || !self.plugins.is_empty()
    }

    pub fn check<'m>(
        &self,
        solvers: impl IntoIterator<Item = &'m Method>,
        scene: &Scene,
    ) -> Result<()> {
        let users: Vec<_> =
            solvers.into_iter().map(|solver| (solver.name(), solver.uses())).collect();
        self.solve.choices.check(&users, Some(scene.solver.order))
    }
}
