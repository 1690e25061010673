//! `simulate`: a scene stepped through time and recorded.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::Result;
use lcplab::file;
use lcplab::plot::Figure;
use lcplab::plot::scene::{Film, Frame, Strip, Take, instants};
use lcplab::report::recording::Record;
use lcplab::report::view;
use lcplab::scene::Scene;
use lcplab::simulation::{Failure, Simulation, Step};

use super::SceneArgs;
use crate::cli::limits::Limits;
use crate::cli::{Outcome, bar, print};

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
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        let scene = self.scene.load()?;
        let mut simulation = self.scene.simulation(&scene)?;
        let steps = self.steps.unwrap_or(scene.step.count);
        let mut record = Record::start(&scene, &simulation);
        if self.out.is_some() {
            record = record.with_tables(&simulation);
        }
        let mut camera = Camera {
            shots: self.instants(steps, Film::shots(1)),
            instants: self.instants(steps, self.frames as usize),
            take: Take::start(scene.solver.name.clone(), &simulation),
            frames: vec![Frame::start(&scene)],
        };
        let progress = bar(steps as u64, &scene.name);
        let (stop, mut failure) = (limits.stop(), None);
        for _ in 0..steps {
            match simulation.step_before(stop) {
                Ok(step) => {
                    record.add(&step);
                    camera.look(&scene, &step);
                    progress.inc(1);
                }
                Err(why) => {
                    camera.end(&simulation, &why);
                    failure = Some(why);
                    break;
                }
            }
            if let Err(full) = scene.memory.check(recorded(record.steps()), record.memory()) {
                record.cut(&full.to_string());
                break;
            }
        }
        limits.over();
        progress.finish_and_clear();
        if let Some(failure) = &failure {
            record.end(failure);
        }
        if let Some(folder) = &self.out {
            record.write(folder)?;
            let Camera { take, frames, .. } = camera;
            let page = view::simulation_page(Film::new("film", &scene, vec![take]), &record);
            file::write(&folder.join("index.html"), &page.render()?)?;
            let strip = Strip::new(&scene, frames);
            let strip = if self.forces { strip.with_forces() } else { strip };
            file::write(&folder.join("frames.svg"), &strip.svg())?;
        }
        print(&if self.json { format!("{}\n", record.summary()) } else { record.text() })?;
        Ok(match failure.and_then(|failure| failure.cause.stopped()) {
            Some(reason) => Outcome::Stopped(reason),
            None if record.is_good() => Outcome::Good,
            None => Outcome::Refuted,
        })
    }

    /// The steps after which to look; none if no picture is wanted.
    fn instants(&self, steps: usize, frames: usize) -> Vec<usize> {
        match self.out {
            Some(_) => instants(steps, frames),
            None => Vec::new(),
        }
    }
}

/// What is kept for the film and for the strip of frames.
struct Camera {
    /// The steps after which the film is shot.
    shots: Vec<usize>,
    /// The steps after which a frame is drawn.
    instants: Vec<usize>,
    take: Take,
    frames: Vec<Frame>,
}

impl Camera {
    fn look(&mut self, scene: &Scene, step: &Step) {
        if self.shots.binary_search(&step.number).is_ok() {
            self.take.add(scene, step);
        }
        if self.instants.binary_search(&step.number).is_ok() {
            self.frames.push(Frame::after(scene, step));
        }
    }

    fn end(&mut self, simulation: &Simulation, why: &Failure) {
        self.take.end(Some(why));
        self.frames.push(Frame::now(simulation));
    }
}

fn recorded(steps: usize) -> String {
    format!("the record of {steps} steps")
}
