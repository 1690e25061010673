//! Whole scenes: cubes that should rest, in several engines.
//!
//! An engine that does less work per step is not faster if its bodies sink or creep. Therefore each
//! one uses the smallest number of iterations that keeps overlap and drift within the same bounds
//! after two seconds; then all are timed in turns.

pub mod foreign;
mod ours;
mod rapier;

use lcplab::body::{Pose, State};
use lcplab::error::Result;
use lcplab::scene::{Scene, contacts};
use lcplab_benches::recording::{Bounds, Engine as Recorded, Scene as RecordedScene};
use lcplab_benches::timing::{Contender, interleaved, timed};

/// Half of a cube's edge (m) and its mass (kg).
pub const HALF: f64 = 0.5;
pub const MASS: f64 = 1.0;

/// The length of a step (s).
const DT: f64 = 1.0 / 60.0;
/// Steps before the bodies are checked: two seconds.
const STEPS: usize = 120;
/// The number of earlier checks, to give up early.
const LOOKS: usize = 4;
/// Timed steps per engine.
const TIMED: usize = 40;
/// The coefficient of friction.
const FRICTION: f64 = 0.6;
/// The fraction of an overlap that lcplab corrects in a step. The correction becomes velocity,
/// which excites rocking of the cubes: with 0.2 the tower needs 32 sweeps row by row, with 0.02 it
/// needs 8.
const BAUMGARTE: f64 = 0.02;
/// The bounds for the cubes.
const BOUNDS: Bounds = Bounds { penetration: 0.01, drift: 0.05 };
/// Larger deviations are not recovered.
const HOPELESS: Bounds =
    Bounds { penetration: 4.0 * BOUNDS.penetration, drift: 2.0 * BOUNDS.drift };
/// The numbers of iterations that are tried, in order: four per doubling.
const ITERATIONS: [usize; 24] =
    [1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96, 112, 128];

/// A scene for every engine.
pub struct Setting {
    /// As a scene of lcplab.
    pub scene: Scene,
    /// The initial positions of the cubes.
    pub places: Vec<State>,
    pub friction: f64,
    pub dt: f64,
}

/// A world of cubes that can be stepped.
pub trait World {
    fn step(&mut self);
    /// The positions of the cubes.
    fn poses(&self) -> Vec<Pose>;
}

/// An engine.
pub struct Engine {
    pub name: &'static str,
    /// Whether it is lcplab.
    pub ours: bool,
    /// A world with this number of iterations per step.
    pub build: fn(&Setting, usize) -> Box<dyn World>,
}

/// All scenes, one after the other.
pub fn run() -> Result<Vec<RecordedScene>> {
    let stack =
        |count| format!("generate = {{ kind = \"stack\", count = {count}, size = 1, mass = 1 }}");
    let tower =
        "generate = { kind = \"circular_tower\", count = 700, ring = 35, size = 1, mass = 1 }";
    let scenes = [("stack of 10", stack(10)), ("tower of 700", tower.into())];
    scenes
        .into_iter()
        .map(|(name, generate)| Ok(measured(name, &Setting::of(&generate)?)))
        .collect()
}

impl Setting {
    fn of(generate: &str) -> Result<Setting> {
        let text = format!(
            "{generate}\n\
             [step]\ndt = {DT}\nbaumgarte = {BAUMGARTE}\n\
             [contact]\nfriction = {FRICTION}\nmargin = 0.01\n\
             [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n"
        );
        let scene = Scene::from_toml("peers.toml", &text)?;
        let cubes = scene.states.iter().zip(&scene.bodies).filter(|(_, body)| body.mass.dof() > 0);
        let places = cubes.map(|(state, _)| *state).collect();
        Ok(Setting { scene, places, friction: FRICTION, dt: DT })
    }

    /// Their overlap and displacement.
    fn look(&self, poses: &[Pose]) -> Option<Bounds> {
        let mut poses = poses.iter();
        let mut states = self.scene.states.clone();
        for (state, body) in states.iter_mut().zip(&self.scene.bodies) {
            if body.mass.dof() > 0 {
                state.pose = *poses.next()?;
            }
        }
        if !states.iter().all(State::is_finite) {
            return None;
        }
        let gaps = contacts(&self.scene, &states, 0.0).into_iter().map(|found| -found.gap);
        let ways = states
            .iter()
            .zip(&self.scene.states)
            .map(|(now, then)| (now.pose.p - then.pose.p).norm());
        Some(Bounds { penetration: gaps.fold(0.0, f64::max), drift: ways.fold(0.0, f64::max) })
    }
}

/// The result of an engine with this number of iterations, and its world afterwards.
struct Tuned {
    engine: Engine,
    iterations: usize,
    reached: Option<Bounds>,
    world: Option<Box<dyn World>>,
}

fn measured(name: &str, setting: &Setting) -> RecordedScene {
    eprintln!("{name}");
    let mut all: Vec<Tuned> = engines().into_iter().map(|engine| tuned(engine, setting)).collect();
    let worlds = all.iter_mut().filter_map(|tuned| tuned.world.as_mut());
    let mut contenders: Vec<Contender> =
        worlds.map(|world| Contender::new(|| timed(|| world.step()))).collect();
    let times = interleaved(TIMED, &mut contenders);
    drop(contenders);
    let mut times = times.into_iter();
    let recorded = |tuned: Tuned| Recorded {
        engine: tuned.engine.name.into(),
        ours: tuned.engine.ours,
        iterations: tuned.iterations,
        reached: tuned.reached,
        step: tuned.world.and_then(|_| times.next()),
    };
    let engines = all.into_iter().map(recorded).collect();
    let after = STEPS as f64 * setting.dt;
    let bodies = setting.places.len();
    RecordedScene { name: name.into(), bodies, dt: setting.dt, after, bounds: BOUNDS, engines }
}

fn engines() -> Vec<Engine> {
    vec![
        ours::ROW_BY_ROW,
        ours::EIGHT_PAIRS,
        rapier::ENGINE,
        #[cfg(has_ode)]
        crate::ode::ENGINE,
        #[cfg(has_bullet)]
        crate::bullet::ENGINE,
    ]
}

/// The smallest sufficient number of iterations.
fn tuned(engine: Engine, setting: &Setting) -> Tuned {
    let mut last = None;
    for iterations in ITERATIONS {
        let mut world = (engine.build)(setting, iterations);
        let reached = after(&mut *world, setting);
        eprintln!("  {}, {iterations}: {reached:?}", engine.name);
        if reached.is_some_and(|reached| reached.is_within(&BOUNDS)) {
            return Tuned { engine, iterations, reached, world: Some(world) };
        }
        last = reached;
    }
    let iterations = ITERATIONS[ITERATIONS.len() - 1];
    Tuned { engine, iterations, reached: last, world: None }
}

/// The deviations after the steps, or at the first check that rules out success.
fn after(world: &mut dyn World, setting: &Setting) -> Option<Bounds> {
    let mut reached = None;
    for _ in 0..LOOKS {
        (0..STEPS / LOOKS).for_each(|_| world.step());
        reached = setting.look(&world.poses());
        if !reached.is_some_and(|reached| reached.is_within(&HOPELESS)) {
            break;
        }
    }
    reached
}
