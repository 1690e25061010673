//! What a whole step costs: finding what touches, making rows, sweeping, moving. Towers of cubes and nets
//! of rods, larger and larger, by the [`Stepper`] with a fixed number of sweeps.
//!
//! Sweeps of eight pairs at a time on one thread and on two must give the same bits, and no cube may have
//! sunk in, before any time counts.

use std::time::Instant;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::timing::Time;
use lcplab::body::State;
use lcplab::error::{Error, Result};
use lcplab::report::study::Study;
use lcplab::scene::Scene;
use lcplab::simulation::stepper::{Kernel, Part, Stepper};

/// How large, and how often.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Round towers of so many cubes, twenty rings each.
    pub towers: Vec<usize>,
    /// Nets of n × n points, for these n.
    pub nets: Vec<usize>,
    /// Sweeps a step.
    pub sweeps: usize,
    /// Steps that are timed, the first two apart.
    pub steps: usize,
    /// What is asked.
    pub goal: Asked,
}

/// What is asked of the times.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Asked {
    /// At most so many milliseconds for a step of the first tower on one thread.
    pub milliseconds: f64,
    /// A time that grows no faster than this power of the contacts or rods.
    pub power: f64,
    /// So many times as fast sweeps on two threads.
    pub threads: f64,
}

impl Default for Asked {
    fn default() -> Self {
        Asked { milliseconds: 16.7, power: 1.0, threads: 1.6 }
    }
}

impl Default for Plan {
    fn default() -> Self {
        Plan {
            towers: vec![700, 1400, 2800, 5600, 10_000, 20_000],
            nets: vec![20, 40, 80, 140, 200],
            sweeps: 50,
            steps: 12,
            goal: Asked::default(),
        }
    }
}

/// What stands in a scene after the steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The scene.
    pub scene: String,
    /// Which kind of scene.
    pub kind: Kind,
    /// Bodies that move.
    pub bodies: usize,
    /// Contacts of the last step, or rods where there are none.
    pub contacts: usize,
    /// Rows of the last step.
    pub rows: usize,
    /// Bytes that the step's arrays hold.
    pub bytes: usize,
    /// The deepest contact of the last step (m); 0 without contacts.
    pub deepest: f64,
    /// Whether one and two threads gave the same bits.
    pub same_bits: bool,
}

/// A kind of scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Cubes on cubes.
    Tower,
    /// Points and rods.
    Net,
}

/// The clock on a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The scene.
    pub scene: String,
    /// Which kind of scene.
    pub kind: Kind,
    /// Its contacts or rods.
    pub contacts: usize,
    /// Its rows.
    pub rows: usize,
    /// Bytes of a step's arrays.
    pub bytes: usize,
    /// A step, row by row.
    pub row_by_row: Time,
    /// A step of eight pairs at a time, on one thread and on two.
    pub eight_pairs: [Time; 2],
    /// The parts of the latter, in the order of [`Part::ALL`].
    pub parts: [[Time; 5]; 2],
}

impl Plan {
    fn scenes(&self) -> Vec<(Kind, usize)> {
        let towers = self.towers.iter().map(|&n| (Kind::Tower, n));
        towers.chain(self.nets.iter().map(|&n| (Kind::Net, n))).collect()
    }
}

fn name((kind, n): (Kind, usize)) -> String {
    match kind {
        Kind::Tower => format!("tower of {n} cubes"),
        Kind::Net => format!("net of {n} × {n}"),
    }
}

fn scene(which: (Kind, usize)) -> Result<Scene> {
    let text = match which {
        (Kind::Tower, n) => format!(
            "generate = {{ kind = \"circular_tower\", count = {n}, ring = {}, size = 1, mass = 1 }}\n\
             step = {{ dt = 0.005 }}\n\
             contact = {{ friction = 0.6, margin = 0.01 }}\n\
             bodies = [{{ name = \"ground\", fixed = true, shape = {{ plane = [0, 0, 1] }} }}]\n",
            n / 20
        ),
        (Kind::Net, n) => format!(
            "generate = {{ kind = \"net\", rows = {n}, columns = {n}, spacing = 0.1, hang = 1, mass = 0.01 }}\n\
             step = {{ dt = 0.005, baumgarte = 0.2 }}\n"
        ),
    };
    Scene::from_toml(&name(which), &text)
}

impl Study for Plan {
    const NAME: &'static str = "step-speed";
    type Finding = Finding;
    type Times = Times;

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        self.scenes().into_iter().map(name).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let which = self.scenes()[task];
        let (name, scene) = (name(which), scene(which)?);
        let run = |kernel| Run::of(&name, &scene, self, kernel);
        let row_by_row = run(Kernel::RowByRow)?;
        let [one, two] = [1, 2].map(|threads| run(Kernel::EightPairs { threads }));
        let (one, two) = (one?, two?);
        let stepper = &one.stepper;
        let found = stepper.found();
        let contacts = if found.is_empty() { stepper.x().len() } else { found.len() };
        let deepest = found.iter().map(|found| (-found.gap).max(0.0)).fold(0.0, f64::max);
        let finding = Finding {
            scene: name.clone(),
            kind: which.0,
            bodies: scene.bodies.iter().filter(|body| body.mass.mass() > 0.0).count(),
            contacts,
            rows: stepper.x().len(),
            bytes: stepper.bytes(),
            deepest,
            same_bits: same(stepper.states(), two.stepper.states()),
        };
        let times = Times {
            scene: name,
            kind: which.0,
            contacts,
            rows: finding.rows,
            bytes: finding.bytes,
            row_by_row: row_by_row.whole(),
            eight_pairs: [one.whole(), two.whole()],
            parts: [one.parts(), two.parts()],
        };
        Ok((finding, times))
    }
}

fn same(one: &[State], other: &[State]) -> bool {
    one == other
}

/// Steps of a scene with the seconds of each part.
struct Run {
    stepper: Stepper,
    seconds: Vec<[f64; 5]>,
}

impl Run {
    fn of(name: &str, scene: &Scene, plan: &Plan, kernel: Kernel) -> Result<Run> {
        const WARM: usize = 2;
        let mut stepper = Stepper::new(scene.clone(), plan.sweeps, kernel)?;
        let mut seconds = Vec::new();
        for step in 0..WARM + plan.steps {
            let (mut parts, mut last) = ([0.0; 5], Instant::now());
            let mut done = |part: Part| {
                let now = Instant::now();
                parts[part as usize] = (now - last).as_secs_f64();
                last = now;
            };
            let taken = stepper.watched_step(&mut done);
            taken.map_err(|failure| Error::invalid(name, "step", failure.to_string()))?;
            if step >= WARM {
                seconds.push(parts);
            }
        }
        Ok(Run { stepper, seconds })
    }

    fn whole(&self) -> Time {
        time(self.seconds.iter().map(|parts| parts.iter().sum()).collect())
    }

    fn parts(&self) -> [Time; 5] {
        std::array::from_fn(|part| time(self.seconds.iter().map(|parts| parts[part]).collect()))
    }
}

fn time(mut seconds: Vec<f64>) -> Time {
    seconds.sort_by(f64::total_cmp);
    Time { median: seconds[seconds.len() / 2], best: seconds[0] }
}
