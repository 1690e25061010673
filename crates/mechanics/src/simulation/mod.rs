//! Many steps: a scene, its scheme and a solver.
//!
//! A step finds the contacts, assembles, solves and moves, each scheme in its own way
//! (`scheme/`). Each solve starts from the x that rows of the same name had before.
//!
//! A [`Simulation`] keeps everything that a step consists of, for inspection. A [`Stepper`] keeps
//! the
//! memory and nothing else: the velocity level by sweeps, the same motion, many times faster.

mod conflict;
mod correction;
mod departure;
mod events;
mod exported;
mod fallback;
mod impact_energy;
mod impacts;
mod integrator;
mod interpenetration;
mod joint_work;
mod laws;
mod ledger;
mod lost_bounces;
mod motion;
mod path;
mod record;
mod scheme;
mod slip;
mod solving;
mod stated;
pub mod stepper;
mod stiff;
mod sweep;
mod swept;
mod turned;
mod unlocated;
mod warnings;

pub use departure::Departure;
pub use events::{StepEvent, VelocityUpdate};
pub use impact_energy::{ImpactCause, ImpactEnergy};
pub use impacts::{Impact, Impacts, Touch};
pub use interpenetration::{Interpenetration, InterpenetrationKind, LASTING, NOTABLE};
pub use joint_work::JointWork;
pub use laws::LawErrors;
pub use ledger::Ledger;
pub use lost_bounces::LostBounces;
pub use motion::{Motion, carried, momentum_sizes};
pub use record::{Cause, Failure, Recording, Solve, Step};
pub use slip::{Creep, Slip, Slips};
pub use stated::{options, problem_of, solver};
pub use stepper::Stepper;
pub use stiff::{spring_growth, unstable_springs};
pub use swept::Swept;
pub use unlocated::Unlocated;
pub use warnings::{Amount, Warning, Warnings};

use std::ops::ControlFlow;

use crate::body::State;
use crate::scene::{DetectedContact, Detector, Passage, Scene};
use fallback::Solvers;
use impact_energy::SpreadImpacts;
use interpenetration::Overlaps;
use lcplab_solver::{Apgd, ConeSolver, Entry, Observer, Registry, Solver, Status, Stop};
use slip::Totals;
use solving::{Memory, Solving};
use turned::NormalShifts;

/// A speed (m/s or rad/s) beyond which a motion counts as diverged.
const DIVERGED: f64 = 1e8;

/// A scene on its way through time.
///
/// ```
/// use lcplab_mechanics::{scene::Scene, simulation::Simulation};
/// use lcplab_solver::Dantzig;
///
/// let solver = Dantzig::default();
/// let mut simulation = Simulation::new(Scene::load("fig7")?, Box::new(solver));
/// let step = simulation.step().expect("a step that can be taken");
/// assert_eq!(step.solves[0].solution.x, [4.0, 3.0, 1.0]); // N s, from the ground up
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::Simulation;
/// use lcplab_solver::trace::Path;
/// use lcplab_solver::{ConePgs, Dantzig, Pgs, Stop};
///
/// // Three balls of 1 kg in a stack, g = 1 m/s², dt = 1 s; the middle one is hit.
/// let scene = Scene::load("fig7")?;
/// let mut simulation = Simulation::new(scene, Box::new(Dantzig::default()))
///     .with_cone_solver(Box::new(ConePgs::default()));
/// assert_eq!(simulation.motion().energy(), 5.0); // ½ m v² + m g (0.5 + 1.5 + 2.5)
/// let step = simulation.step_before(&Stop::default()).expect("a step that can be taken");
/// assert_eq!(simulation.time(), 1.0); // s
/// assert!(simulation.unfinished().is_empty());
/// let forces = step.forces(simulation.scene()).unwrap();
/// assert_eq!(forces[1].z, 1.0); // N on the bottom ball: 4 from below, 3 from above
///
/// // Another solver for the next step, and its iterates.
/// simulation.solve_by(Box::new(Pgs::default()));
/// simulation.solve_cones_by(Box::new(ConePgs::default()));
/// let mut path = Path::default();
/// let step = simulation.observed_step(&mut path).expect("a step that can be taken");
/// assert_eq!(step.solves[0].solver, "pgs");
/// assert!(path.points.len() > 1);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub struct Simulation {
    scene: Scene,
    solver: Box<dyn Solver>,
    /// What the solver is made for; `None` if that is not known.
    entry: Option<Entry>,
    cone_solver: Box<dyn ConeSolver>,
    states: Vec<State>,
    steps: usize,
    previous: Memory,
    detector: Detector,
    overlaps: Overlaps,
    spread_impacts: SpreadImpacts,
    unfinished: Vec<Solve>,
    /// Takes the steps of a scene with a fixed number of sweeps.
    stepper: Option<Box<Stepper>>,
}

/// The entry of a solver of the library.
fn built_in(solver: &dyn Solver) -> Option<Entry> {
    Registry::standard().entry(solver.name()).ok().cloned()
}

impl Simulation {
    /// The scene at its start. What a solver is not made for others solve: see
    /// [`Solve::solver`](Solve); cones are for accelerated projected gradients.
    ///
    /// ```
    /// use lcplab_mechanics::scene::Scene;
    /// use lcplab_mechanics::simulation::Simulation;
    /// use lcplab_solver::Dantzig;
    ///
    /// // Three balls in a stack; the middle one is hit (K&M, Figure 7).
    /// let mut simulation = Simulation::new(Scene::load("fig7")?, Box::new(Dantzig::default()));
    /// let step = simulation.step().expect("a step that does not diverge");
    /// assert_eq!(step.solves[0].solution.x, [4.0, 3.0, 1.0]); // N s, from the ground up
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn new(scene: Scene, solver: Box<dyn Solver>) -> Self {
        let states = scene.states.clone();
        let cone_solver = Box::new(Apgd { settings: fallback::settings(&scene) });
        let mut detector = Detector::new(&scene);
        let mut overlaps = Overlaps::default();
        overlaps.update(&scene, &states, detector.find(&scene, &states, 0.0));
        Simulation {
            scene,
            entry: built_in(&*solver),
            solver,
            cone_solver,
            states,
            steps: 0,
            previous: Memory::new(),
            detector,
            overlaps,
            spread_impacts: SpreadImpacts::default(),
            unfinished: Vec::new(),
            stepper: None,
        }
    }

    /// The same with another solver for friction in cones.
    pub fn with_cone_solver(self, cone_solver: Box<dyn ConeSolver>) -> Self {
        Simulation { cone_solver, ..self }
    }

    /// From now on its problems are solved by this one.
    pub fn solve_by(&mut self, solver: Box<dyn Solver>) {
        self.stepper = None;
        self.entry = built_in(&*solver);
        self.solver = solver;
    }

    /// From now on its problems with friction cones are solved by this one.
    pub fn solve_cones_by(&mut self, cone_solver: Box<dyn ConeSolver>) {
        self.cone_solver = cone_solver;
    }

    /// The scene; its states are those at the start.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The states now.
    pub fn states(&self) -> &[State] {
        &self.states
    }

    /// The time now (s).
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.scene.step.dt
    }

    /// Energy, momentum and errors now.
    pub fn motion(&self) -> Motion {
        Motion::of(&self.scene, &self.states, self.steps)
    }

    /// What was solved in a step that then could not be taken; of a problem without solution, the
    /// last one, the answer is none.
    pub fn unfinished(&self) -> &[Solve] {
        &self.unfinished
    }

    /// Takes one step; after a failure the states are those before it.
    ///
    /// ```
    /// use lcplab_judge::Demand;
    /// use lcplab_mechanics::{scene::Scene, simulation::Simulation};
    /// use lcplab_solver::Dantzig;
    ///
    /// let mut simulation = Simulation::new(Scene::load("stack")?, Box::new(Dantzig::default()));
    /// let step = simulation.step().expect("a step that can be taken");
    /// let solve = &step.solves[0]; // the LCP of the step, and its solution
    /// assert_eq!(solve.solution.x.len(), 60); // impulses (N s)
    /// assert!(solve.judged(&Demand::default()).verdict.is_solution());
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Cause`] lists them: a constraint without direction, a problem that provably has no
    /// solution, a state that is not finite.
    pub fn step(&mut self) -> Result<Step, Failure> {
        self.observed_step(&mut ())
    }

    /// Takes one step, unless it is time to stop before it or in one of its solves.
    ///
    /// # Errors
    /// As [`step`](Simulation::step), or [`Cause::Stopped`].
    pub fn step_before(&mut self, stop: &Stop) -> Result<Step, Failure> {
        let stopped = |reason| Cause::Stopped(Some(reason));
        if let Some(reason) = stop.reason() {
            return Err(Failure {
                step: self.steps + 1,
                time: self.time(),
                cause: stopped(reason),
            });
        }
        self.observed_step(&mut stop.watch(&mut ())).map_err(|failure| match failure.cause {
            Cause::Stopped(_) => Failure { cause: Cause::Stopped(stop.reason()), ..failure },
            _ => failure,
        })
    }

    /// Takes one step, telling the observer of the iterates of all its solves.
    ///
    /// # Errors
    /// As [`step`](Simulation::step), or [`Cause::Stopped`] if the observer stops a solve.
    pub fn observed_step(&mut self, observer: &mut dyn Observer) -> Result<Step, Failure> {
        if let Some(mut stepper) = self.stepper.take() {
            let step = self.swept_step(&mut stepper);
            self.stepper = Some(stepper);
            return step;
        }
        let (number, time) = (self.steps + 1, self.time());
        let failure = |cause| Failure { step: number, time, cause };
        let (from, dt) = (self.scene.time + self.time(), self.scene.step.dt);
        let scene = self.scene.forced(from, dt);
        let scene = scene.as_ref();
        let before = scene.supported(&self.states, from, dt);
        let found = self.detector.step_contacts(scene, &before);
        let mut solving = Solving {
            scene,
            from,
            solvers: Solvers {
                boxed: self.solver.as_ref(),
                entry: self.entry.as_ref(),
                cone: self.cone_solver.as_ref(),
                scene,
            },
            previous: &self.previous,
            observer,
            solves: Vec::new(),
            answers: Memory::new(),
            events: None,
            pushed: Vec::new(),
        };
        let outcome = scheme::step(&mut solving, &before, &found);
        let Solving { solves, answers, events, mut pushed, .. } = solving;
        let is_stopped = |solve: &Solve| solve.solution.status == Status::Stopped;
        let totals = Totals::of(scene, events.as_deref(), &solves, &pushed);
        let sound = |states: Vec<State>| match self.divergence(&states, &totals) {
            _ if solves.iter().any(is_stopped) => Err(Cause::Stopped(None)),
            Some(cause) => Err(cause),
            None => Ok(states),
        };
        let states = match outcome.and_then(sound) {
            Ok(states) => states,
            Err(cause) => {
                let failure = failure(cause);
                self.unfinished = solves;
                return Err(failure);
            }
        };
        if pushed.is_empty() {
            pushed = events.as_deref().map(events::pushed).unwrap_or_default();
        }
        let account =
            |events: &Vec<StepEvent>| Ledger::of(scene, &before, &solves, events, &states);
        let ledger = events.as_ref().map(account);
        let slips = Slip::of(scene, &totals, &states);
        let shifts = match scene.step.scheme.spreads_impacts() {
            true => NormalShifts::of(scene, [&before, &states], &totals),
            false => NormalShifts::default(),
        };
        let touches = Touch::of(&totals, &shifts, &states);
        let unlocated = Unlocated::of(scene, &before, &totals);
        let joint_work = JointWork::of(scene, [&before, &states], &touches);
        let laws = LawErrors::of(scene, &before, &solves, ledger.as_ref());
        let laws = match scene.step.scheme.solves_lcps() {
            true => laws,
            false => laws.of_pushes(scene, [&before, &states], &totals, &slips),
        };
        let impact_energy = match scene.step.scheme.spreads_impacts() {
            true => self.spread_impacts.add(scene, number, &totals, &shifts, &states),
            false => ImpactEnergy::of(scene, &before, &solves, events.as_deref()),
        };
        let scene = self.scene.forced(from, dt);
        let passages = self.detector.passages(&scene, &before, &states);
        let overlapping = self.detector.find(&scene, &states, 0.0);
        let (interpenetrations, motion) =
            measured(&mut self.overlaps, &scene, &states, number, &passages, overlapping);
        self.previous = answers;
        self.states.clone_from(&states);
        self.steps += 1;
        Ok(Step {
            number: self.steps,
            solves,
            contacts: found,
            interpenetrations,
            impact_energy,
            states,
            motion,
            events,
            pushed,
            ledger,
            laws,
            swept: None,
            slips,
            touches,
            unlocated,
            joint_work,
        })
    }

    /// Takes up to `steps` steps, showing each to `watch`, which may end the run.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    ///
    /// use lcplab_mechanics::{scene::Scene, simulation::Simulation};
    /// use lcplab_solver::Dantzig;
    ///
    /// // A stone thrown upward at 3 m/s. 100 steps of 0.01 s later it falls at 9.81 − 3 m/s.
    /// let solver = Dantzig::default();
    /// let mut simulation = Simulation::new(Scene::load("free_fall")?, Box::new(solver));
    /// let recording = simulation.run(100, |_| ControlFlow::Continue(()));
    /// assert!(recording.failure.is_none());
    /// assert_eq!(recording.motion.len(), 101); // the start, and after each step
    /// assert!((simulation.states()[0].v.z + 6.81).abs() < 1e-12); // m/s
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn run(
        &mut self,
        steps: usize,
        mut watch: impl FnMut(&Step) -> ControlFlow<()>,
    ) -> Recording {
        let mut motion = vec![self.motion()];
        for _ in 0..steps {
            match self.step() {
                Ok(step) => {
                    motion.push(step.motion.clone());
                    if watch(&step).is_break() {
                        break;
                    }
                }
                Err(failure) => return Recording { motion, failure: Some(failure) },
            }
        }
        Recording { motion, failure: None }
    }

    fn divergence(&self, states: &[State], totals: &Totals) -> Option<Cause> {
        let sane = |state: &State| state.is_finite() && state.velocity().norm() < DIVERGED;
        let body = states.iter().position(|state| !sane(state))?;
        let acting = totals.rows().filter(|(row, _)| row.bodies.contains(&Some(body)));
        let acting = acting.filter(|(_, impulse)| *impulse != 0.0);
        let largest = acting.max_by(|(_, x), (_, y)| x.abs().total_cmp(&y.abs()));
        let row = largest.map(|(row, _)| row.label(&self.scene));
        Some(Cause::Diverged { body: self.scene.bodies[body].name.clone(), row })
    }
}

/// What bodies did to each other in a step, and energy, momentum and errors after it. `found` are
/// contacts after it, all that overlap among them.
fn measured(
    overlaps: &mut Overlaps,
    scene: &Scene,
    after: &[State],
    step: usize,
    passages: &[Passage],
    found: &[DetectedContact],
) -> (Vec<Interpenetration>, Motion) {
    let of_passage = |passage: &Passage| Interpenetration::passed(scene, after, passage);
    let mut interpenetrations: Vec<_> = passages.iter().map(of_passage).collect();
    interpenetrations.extend(overlaps.update(scene, after, found));
    (interpenetrations, Motion::overlapping(scene, after, step, found))
}
