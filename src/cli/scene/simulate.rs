//! `simulate`: steps a scene through time and records it.

use std::path::PathBuf;

use clap::Args;
use lcplab::animation::{Animation, Frame, Recording, instants};
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::report::aside::{Aside, GRACE};
use lcplab::report::recording::Record;
use lcplab::report::view;
use lcplab::scene::Scene;
use lcplab::simulation::{Cause, Failure, Simulation, Step};
use lcplab::solver::Stop;

use super::SceneArgs;
use crate::cli::limits::Limits;
use crate::cli::loads::{self, Summed};
use crate::cli::plugin::Plugins;
use crate::cli::{Outcome, bar, print};

/// The files that are written into the folder.
const FILES: [&str; 6] =
    ["trajectory.csv", "ledger.csv", "forces.csv", "results.json", "final.toml", "index.html"];
/// Maximum number of steps that a duration may give.
const MOST_STEPS: f64 = 1e9;

/// Simulate a scene and record its motion
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab simulate pendulum --steps 500 --out swing
  lcplab simulate sliding --set mu=0.3 --set angle=17   # on a slope of 17 degrees

--out writes these files to a folder:
  index.html      a page with the animation
  trajectory.csv  poses and velocities
  ledger.csv      energy and its changes, momentum, errors
  forces.csv      x and w of each row; for contacts also the bodies and the point
  results.json    the summary
  final.toml      the scene in its final state, including the changes of --set; load it to continue

Exit codes:
  0  every step was solved
  1  a step was not solved (the simulation continues), or the motion diverged (only the steps before that are written)
  2  invalid input or usage")]
pub struct Simulate {
    #[command(flatten)]
    scene: SceneArgs,
    /// Number of steps [default: the scene's]
    #[arg(long, conflicts_with = "duration")]
    steps: Option<usize>,
    /// Time to simulate, instead of a number of steps
    #[arg(long, value_name = "SECONDS")]
    duration: Option<f64>,
    /// Folder for the results [default: print a summary only]
    #[arg(long)]
    out: Option<PathBuf>,
    /// Write every Nth step to the tables
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,
    /// Print the forces of the last step for each pair of bodies and for each contact, and mark
    /// the unique ones
    #[arg(long)]
    loads: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Simulate {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        let (plugins, solvers) = self.scene.plugins.start()?;
        let named = Plugins::sole(self.scene.solver.as_deref(), &plugins)?;
        let scene = self.scene.load(named, solvers)?;
        let simulation = self.scene.simulation(&scene)?;
        if let Some(folder) = &self.out {
            file::prepare(folder, &FILES)?;
        }
        let steps = self.count(&scene)?;
        let mut record = Record::start(&scene, &simulation);
        if self.out.is_some() {
            record = record.with_tables(&simulation, self.every as usize);
        }
        let mut camera = Camera {
            samples: match self.out {
                Some(_) => instants(steps, Animation::samples_each(1)),
                None => Vec::new(),
            },
            recording: Recording::start(scene.solver.name.clone(), &simulation),
            last: Frame::start(&scene),
            step: None,
        };
        let failure = self.record(steps, simulation, limits.stop(), &mut record, &mut camera);
        limits.over();
        if let Some(failure) = &failure {
            record.end(failure);
            camera.recording.end(Some(failure));
        }
        let loads = self.loads.then(|| loads::of_step(&scene, camera.step.take().as_ref()));
        let written = self.write(&scene, &record, camera, loads.as_ref());
        print(&match (self.json, loads) {
            (true, None) => format!("{}\n", record.summary()),
            (true, Some(loads)) => {
                let mut summary = record.summary();
                summary["loads"] = loads::to_json(&loads);
                format!("{summary}\n")
            }
            (false, None) => record.text(),
            (false, Some(Ok(loads))) => record.text() + &loads.text(),
            (false, Some(Err(why))) => record.text() + &format!("forces       not summed: {why}\n"),
        })?;
        written?;
        Ok(match failure.and_then(|failure| failure.cause.stopped()) {
            Some(reason) => Outcome::Stopped(reason),
            None if record.is_good() => Outcome::Good,
            None => Outcome::Rejected,
        })
    }

    /// The requested number of steps.
    fn count(&self, scene: &Scene) -> Result<usize> {
        match self.duration {
            None => Ok(self.steps.unwrap_or(scene.step.count)),
            Some(time) if time >= 0.0 && time / scene.step.dt <= MOST_STEPS => {
                Ok((time / scene.step.dt).round() as usize)
            }
            Some(time) => {
                let reason =
                    format!("must be at least 0 s and at most {MOST_STEPS} steps, is {time}");
                Err(Error::invalid(&scene.name, "--duration", reason))
            }
        }
    }

    /// Records the steps; returns why they ended early. They are computed on a separate thread: a
    /// step that cannot be interrupted in time is abandoned, and the steps before it are not lost.
    fn record(
        &self,
        steps: usize,
        mut simulation: Simulation,
        stop: &Stop,
        record: &mut Record,
        camera: &mut Camera,
    ) -> Option<Failure> {
        let scene = simulation.scene().clone();
        let (progress, asked) = (bar(steps as u64, &scene.name), stop.clone());
        let taken = Aside::begin(stop, GRACE, move |send| {
            for _ in 0..steps {
                let step = simulation.step_before(&asked);
                let is_last = step.is_err();
                if !send(step) || is_last {
                    break;
                }
            }
        });
        for step in taken {
            match step {
                Ok(step) => {
                    record.add(&step);
                    camera.look(&scene, &step);
                    camera.step = self.loads.then_some(step);
                    progress.inc(1);
                }
                Err(failure) => return Some(failure),
            }
            let what = || format!("the record of {} steps", record.steps());
            if let Err(full) = scene.memory.check(what(), record.memory()) {
                record.cut(&full.to_string());
                return None;
            }
        }
        let (step, time) = (record.steps() + 1, camera.last.time);
        let is_left_behind = record.steps() < steps;
        is_left_behind.then(|| Failure { step, time, cause: Cause::Stopped(stop.reason()) })
    }

    /// Writes the folder, if requested.
    fn write(
        &self,
        scene: &Scene,
        record: &Record,
        camera: Camera,
        loads: Option<&Summed>,
    ) -> Result<()> {
        let Some(folder) = &self.out else { return Ok(()) };
        record.write(folder)?;
        let (states, time) = (&camera.last.states, camera.last.time);
        let saved = self.scene.step.changes.saved(&self.scene.scene, scene, states, time)?;
        file::write_in(folder, "final.toml", &saved)?;
        let mut page = view::simulation_page(
            Animation::new("animation", scene, vec![camera.recording]),
            record,
        );
        page.sections.extend(loads.map(loads::page_section));
        file::write_in(folder, "index.html", &page.render()?)
    }
}

/// The instants for the animation.
struct Camera {
    /// The steps that it shows; empty if no page is requested.
    samples: Vec<usize>,
    recording: Recording,
    /// The last instant, without forces.
    last: Frame,
    /// The last step, if its forces are printed.
    step: Option<Step>,
}

impl Camera {
    fn look(&mut self, scene: &Scene, step: &Step) {
        if self.samples.binary_search(&step.number).is_ok() {
            self.recording.add(scene, step);
        }
        self.last.time = step.motion.time;
        self.last.states.clone_from(&step.states);
    }
}
