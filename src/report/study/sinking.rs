//! Why a stack with a heavy top sinks: sweeps that end early leave part of the weight uncarried, and
//! what is not carried falls.
//!
//! For two bodies, the upper one r times as heavy, k sweeps from 0 leave the part (r/(1 + r))^k of both
//! impulses out ([`Theory`](crate::report::grid::Theory)).

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::{Table, toml};

use super::footage::{Footage, shots};
use super::history::{self, History};
use super::variation::Variation;
use super::{Study, force_path};
use crate::error::Result;
use crate::film::Take;
use crate::scene::Scene;

/// A stack of cubes whose top one is heavier, by several mass ratios and solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// How many cubes.
    pub boxes: usize,
    /// The mass of the top one, in masses of the others.
    pub ratios: Vec<f64>,
    /// Simulated time (s).
    pub duration: f64,
    /// Who solves.
    pub solvers: Vec<Contender>,
    /// The mass ratio that is shown in a film.
    #[serde(default)]
    pub film: Option<f64>,
    /// Instants of the film.
    #[serde(default = "shots")]
    pub shots: usize,
}

/// A solver and how it is used.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Contender {
    /// Its name.
    pub solver: String,
    /// Sweeps in a step; the scene's most without.
    #[serde(default)]
    pub sweeps: Option<usize>,
    /// Whether a step starts from the impulses of the one before.
    #[serde(default = "warm")]
    pub warm: bool,
}

fn warm() -> bool {
    true
}

/// One mass ratio.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The mass of the top cube, in masses of the others.
    pub ratio: f64,
    /// A run a contender.
    pub runs: Vec<Run>,
    /// The film, if it is wanted of this ratio.
    pub footage: Option<Footage>,
}

/// One contender.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Its name, with sweeps and start.
    pub name: String,
    /// How it went.
    pub history: History,
    /// How much of the weight the ground carries in the first step, and in the last, as parts.
    pub carried: [f64; 2],
    /// How far the top cube has come down (m) and aside (m) at the end.
    pub top: [f64; 2],
}

impl Contender {
    /// Its name, with sweeps and start.
    pub fn name(&self) -> String {
        match (self.sweeps, self.warm) {
            (None, true) => self.solver.clone(),
            (None, false) => format!("{}, from 0", self.solver),
            (Some(n), true) => format!("{}, {n} sweeps", self.solver),
            (Some(n), false) => format!("{}, {n} sweeps from 0", self.solver),
        }
    }

    fn change(&self) -> Table {
        let mut solver = Table::from_iter([("name".into(), self.solver.clone().into())]);
        if let Some(sweeps) = self.sweeps {
            solver.insert("max_iterations".into(), (sweeps as i64).into());
        }
        let persistence = if self.warm { "features" } else { "none" };
        let contact = Table::from_iter([("persistence".into(), persistence.into())]);
        Table::from_iter([("solver".into(), solver.into()), ("contact".into(), contact.into())])
    }
}

/// Unit cubes of 1 kg on the ground, on top of them one r times as heavy; errors are fed back.
pub fn tower(boxes: usize, ratio: f64) -> Variation {
    let (others, height) = (boxes.saturating_sub(1) as i64, boxes as f64 - 0.5);
    let title = format!("{boxes} boxes, the top one {ratio} times as heavy");
    let change = toml! {
        title = title
        generate = { kind = "stack", count = others, size = 1, mass = 1 }
        step = { baumgarte = 0.2 }
        bodies = [
            { name = "ground", fixed = true, shape = { plane = [0, 0, 1] } },
            { name = "top", shape = { box = [1, 1, 1] }, mass = ratio, position = [0, 0, height] },
        ]
    };
    Variation::of("stack", &change)
}

impl Plan {
    fn run_one(&self, ratio: f64, contender: &Contender) -> Result<(Run, Option<Take>)> {
        let scene = tower(self.boxes, ratio).and(&contender.change()).scene()?;
        let name = contender.name();
        let (mut first, mut last, mut top) = (0.0, 0.0, [0.0; 2]);
        let heavy = scene.body("top").unwrap_or(0);
        let start = scene.states[heavy].pose.p;
        let total = weight(&scene);
        let watch = |step: &crate::simulation::Step| {
            last = force_path::ground_force(&scene, step) / total;
            if step.number == 1 {
                first = last;
            }
            let way = step.states[heavy].pose.p - start;
            top = [-way.z, way.x.hypot(way.y)];
        };
        let (history, take) = match self.film == Some(ratio) {
            true => {
                let (h, t) = history::filmed(&scene, self.duration, (&name, self.shots), watch)?;
                (h, Some(t))
            }
            false => (history::run(&scene, self.duration, watch)?, None),
        };
        Ok((Run { name, history, carried: [first, last], top }, take))
    }
}

/// The weight (N) of all that moves.
fn weight(scene: &Scene) -> f64 {
    scene.gravity.norm() * scene.bodies.iter().map(|body| body.mass.mass()).sum::<f64>()
}

impl Study for Plan {
    const NAME: &'static str = "sinking";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.ratios.iter().map(|ratio| format!("ratio {ratio}")).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, ())> {
        let ratio = self.ratios[task];
        let one = |contender: &Contender| self.run_one(ratio, contender);
        let outcomes: Vec<_> = self.solvers.par_iter().map(one).collect::<Result<_>>()?;
        let takes: Vec<Take> = outcomes.iter().filter_map(|(_, take)| take.clone()).collect();
        let footage = (!takes.is_empty())
            .then(|| Footage::of("film_sinking", tower(self.boxes, ratio), &takes));
        let runs = outcomes.into_iter().map(|(run, _)| run).collect();
        Ok((Finding { ratio, runs, footage }, ()))
    }
}
