//! `scenes`, `simulate`, `compare` and `export`: commands on a scene.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use lcplab::constraint;
use lcplab::error::{Error, Result};
use lcplab::formulation::{friction_model, with_friction_model};
use lcplab::lcp::file::{Problem, number};
use lcplab::lcp::friction::Model;
use lcplab::plot::Figure;
use lcplab::plot::scene::{Film, Frame, Strip, Take, instants};
use lcplab::report::study::film::{self, Actor};
use lcplab::report::study::{comparison, scene_simulation};
use lcplab::report::{methods, recording, text, view, write};
use lcplab::scene::{self, Formulation, Scene, catalogue};
use lcplab::simulation::{Simulation, Step};
use lcplab::solver::{self, Method, entry};
use serde_json::json;

use super::options::{Choices, RowOrder};
use super::{Outcome, bar, print};

/// List the shipped scenes, or print one
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab scenes
  lcplab scenes pendulum > mine.toml   # a start for a scene of your own
  lcplab scenes --joints               # the constraints that it may have")]
pub struct Scenes {
    /// Print this scene's file
    name: Option<String>,
    /// Print the JSON schema of the scene format
    #[arg(long, conflicts_with = "name")]
    schema: bool,
    /// List the constraints that a scene can name, with their fields
    #[arg(long, conflicts_with_all = ["name", "schema"])]
    joints: bool,
}

impl Scenes {
    pub fn run(&self) -> Result<Outcome> {
        if self.schema {
            print(&format!("{}\n", lcplab::scene::schema()))?;
            return Ok(Outcome::Good);
        }
        if self.joints {
            constraint::ALL.iter().try_for_each(|joint| print(&format!("{joint}\n")))?;
            return Ok(Outcome::Good);
        }
        if let Some(name) = &self.name {
            let known = || catalogue::SHIPPED.iter().map(|shipped| shipped.name.into()).collect();
            let file = catalogue::text(name).ok_or_else(|| Error::Unknown {
                kind: "shipped scene",
                name: name.clone(),
                known: known(),
            })?;
            print(file)?;
            return Ok(Outcome::Good);
        }
        let mut list = String::new();
        for shipped in catalogue::SHIPPED {
            list += &format!("{:<16} {}\n", shipped.name, shipped.scene()?.title);
        }
        print(&list)?;
        Ok(Outcome::Good)
    }
}

/// A scene, and what to change in it.
#[derive(Debug, Args)]
struct SceneArgs {
    /// A scene file, or the name of a shipped scene
    scene: String,
    /// Family of methods that takes the steps; the scene's own without it
    #[arg(long, value_parser = families())]
    formulation: Option<Formulation>,
    /// Solver; the scene's own without it
    #[arg(long)]
    solver: Option<String>,
    /// Model of friction: frozen-box, coupled-box, polygon-4 (or 8, 12, …), associated-cone,
    /// coulomb-cone; the scene's own without it
    #[arg(long)]
    model: Option<Model>,
    /// Length of a step in seconds; the scene's own without it
    #[arg(long)]
    dt: Option<f64>,
    /// Largest scaled residual that counts as solved
    #[arg(long)]
    tolerance: Option<f64>,
    /// Most sweeps or pivots in a solve
    #[arg(long)]
    max_iterations: Option<usize>,
    #[command(flatten)]
    choices: Choices,
}

/// The names of the families, each of which is one.
fn families() -> impl TypedValueParser<Value = Formulation> {
    let names = Formulation::FAMILIES.map(Formulation::name);
    PossibleValuesParser::new(names).map(|name| Formulation::by_name(&name).unwrap_or_default())
}

impl SceneArgs {
    fn load(&self) -> Result<Scene> {
        let mut scene = Scene::load(&self.scene)?;
        scene.step.formulation = self.formulation.unwrap_or(scene.step.formulation);
        scene.step.dt = self.dt.unwrap_or(scene.step.dt);
        if let Some(model) = self.model {
            scene.contact = with_friction_model(&scene.contact, model);
        }
        let solver = &mut scene.solver;
        solver.name = self.solver.clone().unwrap_or_else(|| solver.name.clone());
        solver.tolerance = self.tolerance.unwrap_or(solver.tolerance);
        solver.max_iterations = self.max_iterations.unwrap_or(solver.max_iterations);
        solver.omega = self.choices.omega.unwrap_or(solver.omega);
        solver.order = self.choices.order.map_or(solver.order, scene::Order::from);
        solver.seed = self.choices.seed.unwrap_or(solver.seed);
        solver.damping = self.choices.damping.or(solver.damping);
        scene.validate()?;
        Ok(scene)
    }

    /// The scene at its start, with its solver; options that it does not look at are refused.
    fn simulation(&self, scene: &Scene) -> Result<Simulation> {
        let simulation = scene_simulation(scene)?;
        self.check(&[self.method(&scene.solver.name, scene)?], scene)?;
        Ok(simulation)
    }

    /// The solver of this name. One that is asked for must be made for the model of friction; the
    /// scene's own gives way to one that is.
    fn method(&self, name: &str, scene: &Scene) -> Result<Method> {
        match friction_model(&scene.contact) {
            Model::CoupledBox | Model::FrozenBox => Ok(Method::Boxed(*entry(name)?)),
            model if self.solver.is_some() => methods::by_name(name, model),
            model => methods::by_name(name, model)
                .or_else(|_| methods::by_name(methods::default_for(model), model)),
        }
    }

    fn check(&self, solvers: &[Method], scene: &Scene) -> Result<()> {
        let users: Vec<_> = solvers.iter().map(|solver| (solver.name(), solver.uses())).collect();
        self.choices.check(&users, Some(scene.solver.order.into()))
    }
}

impl From<RowOrder> for scene::Order {
    fn from(order: RowOrder) -> Self {
        match order {
            RowOrder::Natural => scene::Order::Natural,
            RowOrder::Reverse => scene::Order::Reverse,
            RowOrder::Shuffled => scene::Order::Shuffled,
        }
    }
}

impl From<scene::Order> for RowOrder {
    fn from(order: scene::Order) -> Self {
        match order {
            scene::Order::Natural => RowOrder::Natural,
            scene::Order::Reverse => RowOrder::Reverse,
            scene::Order::Shuffled => RowOrder::Shuffled,
        }
    }
}

/// Step a scene through time
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab simulate pendulum --steps 500 --out swing --frames 8 --forces

Writes index.html (a page that plays the motion), trajectory.csv (poses and velocities), ledger.csv
(energy and where it went, momentum, errors), forces.csv (x and w of every row), results.json and
frames.svg (a picture of some instants) to the folder. Exit code 0 if every step was solved, 1 if not
or if the motion diverged (what was recorded until then is written), 2 for bad input.")]
pub struct Simulate {
    #[command(flatten)]
    scene: SceneArgs,
    /// Number of steps; the scene's own without it
    #[arg(long)]
    steps: Option<usize>,
    /// Folder for the recorded motion
    #[arg(long)]
    out: Option<PathBuf>,
    /// Number of instants in frames.svg
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u64).range(2..=60))]
    frames: u64,
    /// Draw contacts, contact forces and constraint forces in frames.svg
    #[arg(long)]
    forces: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Simulate {
    pub fn run(&self) -> Result<Outcome> {
        let scene = self.scene.load()?;
        let mut simulation = self.scene.simulation(&scene)?;
        let steps = self.steps.unwrap_or(scene.step.count);
        let progress = bar(steps as u64, &scene.name);
        let mut record = recording::Record::start(&scene, &simulation);
        let (instants, mut frames) =
            (self.instants(steps, self.frames as usize), vec![Frame::start(&scene)]);
        let shots = self.instants(steps, Film::shots(1));
        let mut take = Take::start(scene.solver.name.clone(), &simulation);
        let recording = simulation.run(steps, |step: &Step| {
            record.add(step);
            if shots.binary_search(&step.number).is_ok() {
                take.add(&scene, step);
            }
            if instants.contains(&step.number) {
                frames.push(Frame::after(&scene, step));
            }
            progress.inc(1);
            ControlFlow::Continue(())
        });
        progress.finish_and_clear();
        record.end(recording.failure.as_ref());
        if recording.failure.is_some() {
            frames.push(Frame::now(&simulation));
        }
        if let Some(folder) = &self.out {
            take.end(recording.failure.as_ref());
            record.write(folder)?;
            let page = view::simulation_page(Film::new("film", &scene, vec![take]), &record);
            write::file(&folder.join("index.html"), &page.render()?)?;
            let strip = Strip::new(&scene, frames);
            let strip = if self.forces { strip.with_forces() } else { strip };
            write::file(&folder.join("frames.svg"), &strip.svg())?;
        }
        if self.json {
            print(&format!("{}\n", record.summary()))?;
        } else {
            print(&record.text())?;
        }
        Ok(if record.is_good() { Outcome::Good } else { Outcome::Refuted })
    }

    /// The steps after which to look; none if no picture is wanted.
    fn instants(&self, steps: usize, frames: usize) -> Vec<usize> {
        match self.out {
            Some(_) => instants(steps, frames),
            None => Vec::new(),
        }
    }
}

/// Step a scene with every solver, and judge every answer
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab compare stack --steps 20 --out stack-report

Without --formulation at both levels that are one LCP, velocity and acceleration; with it by that
family alone. Families that solve no LCP have one row. Only solvers that are made for the model of
friction run, and only levels that know it.
With --out the folder gets a page with a film of the solvers side by side, the table and the plots.
The film shows one solver of each group that moves alike, or those named by --show:
  lcplab compare stack --show pgs:5 --show dantzig --out stack-report   # five sweeps beside exact
Exit code 1 if the judge refutes a
solver's claim, 2 for bad input; a solver that admits failure is a row of the table.")]
pub struct Compare {
    #[command(flatten)]
    scene: SceneArgs,
    /// Number of steps; the scene's own without it
    #[arg(long)]
    steps: Option<usize>,
    /// Folder for a page with film, table and plots
    #[arg(long)]
    out: Option<PathBuf>,
    /// Solver in the film, with its most sweeps after a colon if they are not the scene's; repeatable
    #[arg(long, value_name = "SOLVER[:SWEEPS]", requires = "out")]
    show: Vec<String>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Compare {
    pub fn run(&self) -> Result<Outcome> {
        let scene = self.scene.load()?;
        let steps = self.steps.unwrap_or(scene.step.count);
        let solvers = match &self.scene.solver {
            Some(name) => vec![self.scene.method(name, &scene)?],
            None => solver::methods(),
        };
        let families = match self.scene.formulation {
            Some(family) => vec![family],
            None => Formulation::LEVELS.to_vec(),
        };
        let contenders = comparison::contenders(&scene, &families, &solvers);
        let running: Vec<Method> = contenders.iter().map(|(_, solver)| *solver).collect();
        self.scene.check(&running, &scene)?;
        let shown = self.show.iter().map(|name| Actor::named(name, &scene));
        let shown = shown.collect::<Result<Vec<Actor>>>()?;
        let progress = bar(contenders.len() as u64, &scene.name);
        let (comparison, timings) =
            comparison::compare_families(&scene, &families, &solvers, steps, &progress);
        progress.finish_and_clear();
        if self.json {
            print(&format!("{}\n", json!({ "comparison": comparison, "timings": timings })))?;
        } else {
            print(&text::table(&view::comparison_table(&comparison)))?;
        }
        if let Some(folder) = &self.out {
            let actors = match shown.is_empty() {
                true => film::alike(&contenders, &view::alike(&comparison.runs)),
                false => shown.into_iter().map(|actor| (actor.name(), actor)).collect(),
            };
            let film = film::film("film", &scene, &actors, steps);
            let page = write::document(&view::comparison_document(&comparison, film), folder)?;
            eprintln!("{}", page.display());
        }
        let refuted = comparison.runs.iter().any(|run| run.refuted_claims > 0);
        Ok(if refuted { Outcome::Refuted } else { Outcome::Good })
    }
}

/// Write the LCP of one step of a scene as a problem file
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab export stack --step 1 --out stack.json; lcplab solve stack.json

Rows come in the order of the scene's constraints, then contacts, each as normal, first and second
tangent. A step that solves several LCPs (an impact, a bounce) gives the last one.")]
pub struct Export {
    #[command(flatten)]
    scene: SceneArgs,
    /// The step, from 1
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    step: u64,
    /// The file; standard output without it
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Export {
    pub fn run(&self) -> Result<Outcome> {
        let scene = self.scene.load()?;
        let mut simulation = self.scene.simulation(&scene)?;
        let mut last = None;
        for _ in 0..self.step {
            match simulation.step() {
                Ok(step) => last = step.solves.into_iter().next_back(),
                Err(failure) => {
                    eprintln!("error: {}: {failure}", scene.name);
                    return Ok(Outcome::Refuted);
                }
            }
        }
        let Some(solve) = last else { return Ok(Outcome::Refuted) };
        let assembled = &solve.problem;
        let mut problem =
            Problem::new(format!("{}, step {}", scene.name, self.step), assembled.lcp.clone());
        if let Some(posing) = solve.posing {
            (problem.model, problem.frozen_at) = (Some(posing.model), posing.frozen_at);
        }
        let rows = assembled.assembly.rows.iter().map(|row| {
            let unit = assembled.stage.unit(row.kind.is_angular());
            json!({ "label": row.label(&scene), "kind": row.kind.name(), "unit": unit })
        });
        problem.extra.insert("rows".into(), rows.collect());
        problem.extra.insert("dt".into(), number(scene.step.dt));
        let source = format!("lcplab scene {}, {} level", scene.name, assembled.stage.name());
        problem.extra.insert("source".into(), source.into());
        let text = format!("{}\n", problem.to_json());
        match &self.out {
            Some(path) => write::file(Path::new(path), &text)?,
            None => print(&text)?,
        }
        Ok(Outcome::Good)
    }
}
