//! `explain`: derives a time step or a problem line by line.

use lcplab::simulation;
use std::path::Path;

use clap::{Args, ValueEnum};
use lcplab::animation::{Arrows, Force, Frame, Strip};
use lcplab::document::{Block, Document};
use lcplab::error::{Error, Result};
use lcplab::explain::{Method, problem, steps};
use lcplab::files;
use lcplab::lcp::Question;
use lcplab::lcp::friction::Model;
use lcplab::memory::Memory;
use lcplab::number::{capitalized, readable};
use lcplab::report::page::Picture;
use lcplab::scene::{Scene, Scheme};
use lcplab::simulation::Simulation;
use lcplab::solver::{Dantzig, Options, Pgs, default_for};

use super::form::Writing;
use super::loads;
use super::{Outcome, read_problem};

/// Derive a time step of a scene, or the solution of a problem file, line by line
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab explain fig7 --solver pgs
  lcplab explain fig7 --solver lemke --scheme acceleration --format html --out fig7.html
  lcplab explain bouncing_ball --from 80
  lcplab explain sphere_plane --model polygon-4
  lcplab export stack | lcplab explain - --solver dantzig --format markdown

The derivation lists, with units: states, masses and forces; c, J and the bias acceleration J'u of each row; the steps from Newton's \
law to A and b; and each sweep, pivot or tableau of the solver. Matrices and tables show at most 12 rows. A page \
begins with a picture. For a problem file the derivation starts at A and b. For friction cones it leaves out \
the iterations of the solver, and adds the derivation of the coupled box.

lcplab reads INPUT as a problem if it is - or has an extension that `convert --list` shows, and as a scene otherwise.

Exit codes:
  0  the judge accepts every answer
  1  the judge rejects an answer, or a step cannot be taken
  2  invalid input or usage")]
pub struct Explain {
    /// Scene file, name of a shipped scene, problem file, or - for a JSON problem from standard
    /// input
    input: String,
    /// pgs, sor, dantzig or lemke [default: the scene's, or dantzig; lemke if A is not symmetric]
    #[arg(long)]
    solver: Option<String>,
    /// Velocity or acceleration level [default: the scene's]
    #[arg(long, value_enum)]
    scheme: Option<Level>,
    #[command(flatten)]
    changes: super::scene::Changes,
    /// Friction model [default: that of the scene or the file]
    #[arg(long)]
    model: Option<Model>,
    /// First step of the scene to explain, counted from 1 [default: 1]
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    from: Option<u64>,
    /// Number of steps of the scene to explain [default: 1]
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=1000))]
    steps: Option<u64>,
    /// Largest scaled residual of an accepted answer [default: the scene's, or that of `solve`]
    #[arg(long, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Relaxation factor of sor, above 0 and below 2 [default: 1.3, unless the scene sets it]
    #[arg(long, allow_negative_numbers = true)]
    omega: Option<f64>,
    /// Also list the forces for each pair of bodies and for each contact, and mark the unique ones;
    /// of a scene those of the last step explained
    #[arg(long)]
    loads: bool,
    #[command(flatten)]
    writing: Writing,
}

/// The levels that are explained.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Level {
    /// Impulses over the step
    Velocity,
    /// Forces at an instant
    Acceleration,
}

/// Maximum number of instants in the picture of a motion.
const FRAMES: usize = 6;

/// Smaller forces, relative to the total weight, are rounding errors.
const DUST: f64 = 1e-9;

/// The bodies before the first of the steps and after each, with velocities, impulses and forces;
/// `None` if no step can be taken.
fn motion(scene: &Scene, solver: &str, first: usize, last: usize) -> Result<Option<Picture>> {
    let mut scene = scene.clone();
    scene.solver.name = solver.into();
    let mut simulation = Simulation::of(&scene)?;
    let mut frames = Vec::new();
    for number in 1..=last {
        if number == first {
            frames.push(Frame::now(&simulation).with_velocities(&scene));
        }
        match simulation.step() {
            Ok(step) if number >= first => frames.extend(Frame::solved(&scene, &step)),
            Ok(_) => {}
            Err(_) => break,
        }
    }
    frames.truncate(FRAMES);
    let mass: f64 =
        scene.bodies.iter().map(|body| body.mass.mass()).filter(|m| m.is_finite()).sum();
    let is_seen = |force: &Force| force.force.norm() > DUST * mass * scene.gravity.norm();
    frames.iter_mut().for_each(|frame| frame.forces.retain(is_seen));
    if frames.len() < 2 {
        return Ok(None);
    }
    let is_impact = |frame: &Frame| frame.largest().is_some_and(|words| words.ends_with("N s"));
    let label = |frame: &Frame| match is_impact(frame) {
        true => "impact".into(),
        false => format!("{} s", readable(frame.time, 3)),
    };
    let labels = frames.iter().map(label).collect();
    let largest: Vec<String> = frames[1..].iter().filter_map(Frame::largest).collect();
    let title = match largest.is_empty() {
        true if scene.constraints.is_empty() => "No contact acts on the bodies".into(),
        true => "The bodies before and after the step".into(),
        false => {
            let actors = match scene.constraints.is_empty() {
                true => "the contacts carry",
                false => "the contacts and joints carry",
            };
            let (impulses, forces): (Vec<_>, Vec<_>) =
                largest.iter().cloned().partition(|own| own.ends_with("N s"));
            let clause = |who: &str, all: Vec<String>| {
                (!all.is_empty()).then(|| format!("{who} {}", all.join(", then ")))
            };
            let all = [clause("the impact takes", impulses), clause(actors, forces)];
            capitalized(&all.into_iter().flatten().collect::<Vec<_>>().join(", then "))
        }
    };
    let caption = match scene.step.scheme {
        _ if largest.is_empty() => "The velocities are those before the step. No forces are drawn.",
        Scheme::Acceleration if frames.iter().any(is_impact) => {
            "First the velocities before the step, then the impulses of the impact, then the forces at the end of the step."
        }
        Scheme::Acceleration => {
            "First the velocities before the step, then the forces at the end of the step."
        }
        _ => {
            "First the velocities before the step, then the forces: the impulses x of the step, divided by its length."
        }
    };
    let arrows = Arrows::Labeled;
    let strip = Strip { title, labels, arrows, ..Strip::new(&scene, frames) };
    Ok(Some(Picture::inline(&strip.with_caption(caption))))
}

impl Explain {
    pub fn run(&self) -> Result<Outcome> {
        let is_problem = files::is_problem(Path::new(&self.input));
        let document = if is_problem { self.of_problem()? } else { self.of_scene()? };
        self.writing.write(&document)
    }

    fn of_problem(&self) -> Result<Document> {
        for (option, given) in [
            ("--scheme", self.scheme.is_some()),
            ("--set", !self.changes.is_empty()),
            ("--from", self.from.is_some()),
            ("--steps", self.steps.is_some()),
        ] {
            if given {
                return Err(Error::invalid(
                    &self.input,
                    option,
                    "applies to scenes, but the input is a problem",
                ));
            }
        }
        let read = read_problem(Path::new(&self.input), Memory::default())?;
        let question = Question::new(&read, self.model, &self.input)?;
        let name = self.solver.as_deref().unwrap_or_else(|| default_for(&read.lcp));
        let mut document = problem(&question, &self.method(name, Options::default())?)?;
        if self.loads {
            document.add("", loads::section(&loads::of_problem(&question, &self.input)?));
        }
        Ok(document)
    }

    fn of_scene(&self) -> Result<Document> {
        let mut scene = self.changes.load(&self.input)?;
        scene.step.scheme = match self.scheme {
            Some(Level::Velocity) => Scheme::Velocity,
            Some(Level::Acceleration) => Scheme::Acceleration,
            None => scene.step.scheme,
        };
        let own = Method::NAMES.contains(&scene.solver.name.as_str());
        let name = match &self.solver {
            Some(name) => name.as_str(),
            None if own => scene.solver.name.as_str(),
            None => Dantzig::NAME,
        };
        let method = self.method(name, simulation::options(&scene))?;
        if let Some(model) = self.model {
            scene.contact.model = model;
        }
        let first = self.from.unwrap_or(1) as usize;
        let last = first.saturating_add(self.steps.unwrap_or(1) as usize - 1);
        let mut document = steps(&scene, &method, first..=last)?;
        if self.writing.has_pictures() {
            let figure = motion(&scene, method.name(), first, last)?.map(Block::Figure);
            document.sections.first_mut().map(|section| section.blocks.splice(0..0, figure));
        }
        if self.loads {
            scene.solver.name = method.name().into();
            document.add("", loads::section(&loads::of_scene(&scene, last)));
        }
        Ok(document)
    }

    fn method(&self, name: &str, mut options: Options) -> Result<Method> {
        options.omega = self.omega.unwrap_or(options.omega);
        options.settings.tolerance = self.tolerance.unwrap_or(options.settings.tolerance);
        let method = Method::with(name, options)?;
        if self.omega.is_some() && name != Pgs::RELAXED {
            return Err(Error::invalid(
                "options",
                "--omega",
                format!("{name} does not use it; sor does"),
            ));
        }
        Ok(method)
    }
}
