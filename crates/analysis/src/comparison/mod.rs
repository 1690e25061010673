//! One scene, stepped by every solver, at both levels or by any scheme, each answer judged.
//!
//! ```
//! use lcplab_analysis::comparison::{
//!     best, compare, compare_families, contenders, refusal, thinned,
//! };
//! use lcplab_lcp::friction::Model;
//! use lcplab_mechanics::scene::{Scene, Scheme};
//! use lcplab_solver::{Method, Registry, Stop};
//!
//! // Three balls in a stack, the middle one hit: three steps by two solvers.
//! let scene = Scene::load("fig7")?;
//! let (registry, stop) = (Registry::standard(), Stop::default());
//! let entries = [registry.entry("dantzig")?.clone(), registry.entry("pgs")?.clone()];
//! let (mut comparison, timings) = compare(&scene, &[Scheme::Velocity], &entries, 3, &|| ());
//! assert_eq!((comparison.runs.len(), timings.len()), (2, 2));
//! let dantzig = best(&comparison.runs).unwrap();
//! assert_eq!((dantzig.solver.as_str(), dantzig.steps), ("dantzig", 3));
//! assert!(dantzig.is_candidate() && dantzig.laws.keeps_energy());
//! assert_eq!(dantzig.failing_criterion(3, comparison.thinnest), None);
//! assert_eq!(comparison.best_run(Scheme::Velocity), Some(dantzig));
//! assert!(comparison.starts_within_tolerance());
//! assert_eq!(dantzig.failing_criterion(4, comparison.thinnest), Some("ended early"));
//! assert!((dantzig.energy_at_end() + 0.5).abs() < 1e-9); // ½ m v² of the middle ball, in J
//! assert!((dantzig.energy_change() + 0.5).abs() < 1e-9);
//! assert!(dantzig.worst(|sample| sample.penetration) < 1e-9);
//! assert_eq!(thinned(&dantzig.motion).len(), 4); // few samples are all kept
//!
//! // The same for methods, among them those for cones, which take part where they are made for it.
//! let methods: Vec<Method> = entries.iter().cloned().map(Method::Boxed).collect();
//! let levels = [Scheme::Velocity, Scheme::Acceleration];
//! assert_eq!(contenders(&scene, &levels, &methods).len(), 4);
//! let (again, _) = compare_families(&scene, &levels, &methods, 3, &|| (), &stop)?;
//! assert_eq!(again.runs.len(), 4);
//! comparison.add_levels(&scene, &methods, &stop); // this level, and the same with shorter steps
//! assert!(comparison.levels.is_some());
//! assert_eq!(refusal(&methods[0], Model::CoupledBox), None);
//! assert!(refusal(&methods[0], Model::CoulombCone).is_some());
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod laws;
mod levels;

pub use laws::{Energy, FRICTION_ANGLE, LAW_TOLERANCE, RunLaws};
pub use levels::{EXACT, LevelRefinement, Levels, Phase};

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::time::Instant;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::aside::GRACE;
use crate::tally::Tally;
use crate::tasks::Tasks;
use laws::LawMonitor;
use lcplab_lcp::error::Result;
use lcplab_lcp::friction::Model;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{Motion, Simulation, Step, carried};
use lcplab_solver::{Dantzig, Entry, Method, Registry, Stop};

/// A scene with all solvers at all levels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The scene's name.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// What it teaches.
    pub teaches: String,
    /// The steps that were to be taken.
    pub steps: usize,
    /// The length of a step (s).
    pub dt: f64,
    /// The largest scaled residual that passes.
    pub tolerance: f64,
    /// The size of its thinnest body (m), with which errors are compared; 1 where none has one.
    #[serde(default = "one")]
    pub thinnest: f64,
    /// One run a level and solver, levels first.
    pub runs: Vec<Run>,
    /// The levels compared with each other and with a divided step, where that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levels: Option<Levels>,
    /// Solvers that were named and did not take part.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<LeftOut>,
}

/// A solver that was named and is not made for the scene.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeftOut {
    /// The solver.
    pub solver: String,
    /// Why.
    pub reason: String,
}

/// A scene with one solver at one level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The level.
    pub scheme: String,
    /// The solver.
    pub solver: String,
    /// Steps taken.
    pub steps: usize,
    /// The LCPs solved in them, of which impacts and bounces are some, and the verdicts.
    #[serde(flatten)]
    pub tally: Tally,
    /// The average force with which contacts, joints and springs support the bodies, as a part of
    /// their weight, if there is a weight.
    #[serde(default)]
    pub carried: Option<f64>,
    /// What it measured of the laws.
    #[serde(default)]
    pub laws: RunLaws,
    /// The motion at the start and after each step.
    pub motion: Vec<Sample>,
}

fn one() -> f64 {
    1.0
}

/// Energy and errors at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Time (s).
    pub time: f64,
    /// Kinetic and potential energy (J).
    pub energy: f64,
    /// Largest |c| of an equality row that is a length (m).
    pub drift: f64,
    /// Deepest overlap (m).
    pub penetration: f64,
}

/// Gaps and joints are within tolerance if their errors are at most this part of the thinnest body.
pub const HELD: f64 = 0.01;

/// The approximate number of samples of a motion that are kept.
const SAMPLES: usize = 200;

/// Samples at equal distances, the last one, and those at which a measure is largest or smallest,
/// so that the extremes are still those of all samples.
pub fn thinned(samples: &[Sample]) -> Vec<Sample> {
    let measures: [fn(&Sample) -> f64; 3] = [|s| s.energy, |s| s.drift, |s| s.penetration];
    let length = samples.len().div_ceil(SAMPLES).max(1);
    let mut kept = vec![false; samples.len()];
    for first in (0..samples.len()).step_by(length) {
        kept[first] = true;
    }
    for measure in measures {
        let by_size =
            |a: &usize, b: &usize| measure(&samples[*a]).total_cmp(&measure(&samples[*b]));
        for extreme in [(0..samples.len()).min_by(by_size), (0..samples.len()).max_by(by_size)] {
            extreme.into_iter().for_each(|k| kept[k] = true);
        }
    }
    kept.last_mut().into_iter().for_each(|last| *last = true);
    samples.iter().zip(kept).filter_map(|(sample, kept)| kept.then_some(*sample)).collect()
}

impl From<&Motion> for Sample {
    fn from(motion: &Motion) -> Self {
        let Motion { time, drift, penetration, .. } = *motion;
        Sample { time, energy: motion.energy(), drift, penetration }
    }
}

/// Seconds that one run took; kept apart from the results, which do not depend on the speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// The scene.
    pub scene: String,
    /// The level.
    pub scheme: String,
    /// The solver.
    pub solver: String,
    /// Steps taken.
    pub steps: usize,
    /// Wall time of the whole run, judging left out (s).
    pub seconds: f64,
}

/// What stands for the solver where a scheme solves no LCP: it is never asked.
fn none() -> Method {
    Method::Boxed(Entry::new("none", |options| {
        Box::new(Dantzig { settings: options.settings.clone() })
    }))
}

/// Steps a scene with each of these solvers by each of these schemes; an entry need not be a
/// registered one.
///
/// Runs are spread over the threads of rayon's pool; none depends on another. `note` is called at
/// the end of each.
pub fn compare(
    scene: &Scene,
    schemes: &[Scheme],
    solvers: &[Entry],
    steps: usize,
    note: &(dyn Fn() + Sync),
) -> (Comparison, Vec<Timing>) {
    let cones = Registry::standard().cone_entries().cloned().map(Method::Cone);
    let methods: Vec<Method> = solvers.iter().cloned().map(Method::Boxed).chain(cones).collect();
    let pairs = contenders(scene, schemes, &methods);
    let runs = pairs.par_iter().map(|(scheme, solver)| {
        let ended = run(&scene.at_level(*scheme), solver, steps, &Stop::default());
        note();
        ended
    });
    of_runs(scene, steps, runs.collect())
}

/// The same by these schemes and methods: those of the methods that take the scene's model of
/// friction, and one run each for schemes that solve no LCP. A scheme that does not know the model
/// is left out. When it is time to stop, runs end with the steps that they have taken, and no more
/// begin.
///
/// # Errors
/// If there are no threads to run on.
pub fn compare_families(
    scene: &Scene,
    schemes: &[Scheme],
    methods: &[Method],
    steps: usize,
    note: &(dyn Fn() + Sync),
    stop: &Stop,
) -> Result<(Comparison, Vec<Timing>)> {
    let pairs: Vec<_> = contenders(scene, schemes, methods).into_iter().enumerate().collect();
    let (own, asked) = (scene.clone(), stop.clone());
    let work = move |(_, (scheme, solver)): &(usize, (Scheme, Method))| {
        run(&own.at_level(*scheme), solver, steps, &asked)
    };
    let mut ended = BTreeMap::new();
    Tasks { together: pairs, alone: Vec::new(), grace: GRACE }.run(stop, work, |(k, _), run| {
        ended.insert(k, run);
        note();
        Ok(())
    })?;
    Ok(of_runs(scene, steps, ended.into_values().collect()))
}

impl Comparison {
    /// The best run of a scheme.
    pub fn best_run(&self, scheme: Scheme) -> Option<&Run> {
        let mut of_scheme = self.runs.chunk_by(|a, b| a.scheme == b.scheme);
        of_scheme.find(|runs| runs[0].scheme == scheme.name()).and_then(best)
    }

    /// Whether drift and penetration are within [`HELD`] of the thinnest body at the start.
    pub fn starts_within_tolerance(&self) -> bool {
        let first = self.runs.iter().find_map(|run| run.motion.first());
        first.is_some_and(|start| start.drift.max(start.penetration) <= HELD * self.thinnest)
    }

    /// Compares the levels with each other and with a divided step, each with its [`best`] solver;
    /// not where one of them ended early.
    pub fn add_levels(&mut self, scene: &Scene, methods: &[Method], stop: &Stop) {
        let chosen = |runs: &[Run]| -> Option<(Scene, Method)> {
            let run = best(runs).filter(|run| run.steps == self.steps)?;
            let scheme = Scheme::by_name(&run.scheme)?;
            let named = |method: &&Method| method.name() == run.solver;
            let method = methods.iter().find(named).cloned().unwrap_or_else(none);
            Some((scene.at_level(scheme), method))
        };
        let schemes = self.runs.chunk_by(|a, b| a.scheme == b.scheme);
        let chosen: Option<Vec<(Scene, Method)>> = schemes.map(chosen).collect();
        self.levels = chosen.and_then(|chosen| levels::levels(&chosen, self.steps, stop));
    }
}

/// The run that took the most steps with the fewest rejected answers, the first of several; none
/// where no solver supports the problems.
pub fn best(runs: &[Run]) -> Option<&Run> {
    let key = |run: &Run| (Reverse(run.steps), run.tally.rejected());
    runs.iter().filter(|run| run.is_candidate()).min_by_key(|run| key(run))
}

/// The comparison of these runs.
fn of_runs(scene: &Scene, steps: usize, ended: Vec<(Run, Timing)>) -> (Comparison, Vec<Timing>) {
    let (runs, timings) = ended.into_iter().unzip();
    let comparison = Comparison {
        scene: scene.name.clone(),
        title: scene.title.clone(),
        teaches: scene.teaches.clone(),
        steps,
        dt: scene.step.dt,
        tolerance: scene.solver.tolerance,
        thinnest: scene.thinnest().unwrap_or(1.0),
        runs,
        levels: None,
        left_out: Vec::new(),
    };
    (comparison, timings)
}

/// Why a method does not step a scene with this friction model; `None` if it does. The coupled box
/// is what every boxed solver gets.
pub fn refusal(method: &Method, model: Model) -> Option<String> {
    match method {
        Method::Boxed(_) if model == Model::CoupledBox => None,
        method => method.refusal(Some(model)),
    }
}

/// Who steps the scene by which scheme.
pub fn contenders(scene: &Scene, schemes: &[Scheme], methods: &[Method]) -> Vec<(Scheme, Method)> {
    let takes = |method: &&Method| refusal(method, scene.contact.model).is_none();
    let of = |scheme: Scheme| -> Vec<Method> {
        match scheme.solves_lcps() {
            true => methods.iter().filter(takes).cloned().collect(),
            false => vec![none()],
        }
    };
    let able = schemes.iter().filter(|&&scheme| scene.at_level(scheme).validate().is_ok());
    able.flat_map(|&scheme| of(scheme).into_iter().map(move |method| (scheme, method))).collect()
}

fn run(scene: &Scene, solver: &Method, steps: usize, stop: &Stop) -> (Run, Timing) {
    let scheme = scene.step.scheme.name().to_string();
    let mut run = Run {
        scheme: scheme.clone(),
        solver: solver.name().to_string(),
        steps: 0,
        tally: Tally::default(),
        carried: None,
        laws: RunLaws::default(),
        motion: Vec::new(),
    };
    let simulation = Simulation::by(scene, solver);
    let seconds = step_through(simulation, steps, stop, &mut run);
    let (scene, solver) = (scene.name.clone(), solver.name().to_string());
    let timing = Timing { scene, scheme, solver, steps: run.steps, seconds };
    (run, timing)
}

/// Takes the steps; returns the seconds spent on them.
fn step_through(mut simulation: Simulation, steps: usize, stop: &Stop, run: &mut Run) -> f64 {
    let tolerance = simulation.scene().solver.tolerance;
    let first = simulation.motion();
    run.motion.push(Sample::from(&first));
    let mut monitor = LawMonitor::new(simulation.scene(), first.clone());
    let mut seconds = 0.0;
    for _ in 0..steps {
        let start = Instant::now();
        let step = simulation.step_before(stop);
        seconds += start.elapsed().as_secs_f64();
        match step {
            Ok(step) => {
                monitor.add(simulation.scene(), &step);
                run.record(&step, tolerance);
            }
            Err(failure) => {
                run.tally.trouble = Some(failure.to_string());
                break;
            }
        }
    }
    run.carried = carried(simulation.scene(), &first, &simulation.motion());
    run.laws = monitor.laws(simulation.scene());
    seconds
}

impl Run {
    fn record(&mut self, step: &Step, tolerance: f64) {
        self.steps += 1;
        self.motion.push(Sample::from(&step.motion));
        self.tally.add_step(step, tolerance, |_, _| ());
    }

    /// Whether the solver is made for a problem of the run: not if it refused all of them.
    pub fn is_candidate(&self) -> bool {
        self.tally.solves == 0 || self.tally.outside < self.tally.solves
    }

    /// The criterion that the run fails, if any: all steps taken, every answer accepted, and drift
    /// and penetration within [`HELD`] of the size of the thinnest body (m).
    pub fn failing_criterion(&self, steps: usize, thinnest: f64) -> Option<&'static str> {
        let error = self.worst(|sample| sample.drift.max(sample.penetration));
        match self {
            _ if self.steps < steps => Some("ended early"),
            _ if self.tally.rejected() > 0 => Some("answers rejected"),
            _ if self.laws.passages > 0 => Some("a body passed through another one"),
            _ if error > HELD * thinnest => Some("drift or penetration too large"),
            _ => None,
        }
    }

    /// The change of the energy from the start to the end (J).
    pub fn energy_at_end(&self) -> f64 {
        match (self.motion.first(), self.motion.last()) {
            (Some(first), Some(last)) => last.energy - first.energy,
            _ => 0.0,
        }
    }

    /// The largest departure of the energy from its value at the start (J).
    pub fn energy_change(&self) -> f64 {
        let Some(first) = self.motion.first() else { return 0.0 };
        let change = |sample: &Sample| sample.energy - first.energy;
        let larger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        self.motion.iter().map(change).fold(0.0, larger)
    }

    /// The largest value of a measure over the run.
    pub fn worst(&self, measure: impl Fn(&Sample) -> f64) -> f64 {
        self.motion.iter().map(measure).fold(0.0, f64::max)
    }
}
