//! The velocity level at speed: what a [`Simulation`](super::Simulation) with `pgs` does in the
//! scheme "velocity", without a matrix, without a record, in memory that is kept.
//!
//! ```text
//! pairs ─→ points ─→ rows Ĵ, b, bounds; x of the step before ─→ sweeps ─→ u⁺ = L v,  s⁺ = s + dt S u⁺
//! ```
//!
//! A = Ĵ Ĵᵀ is never formed: a sweep changes the scaled velocities v = L⁻¹ u, which start at L⁻¹
//! (u + dt M⁻¹F) + Ĵᵀ x (the kernel `impulses`). So x need not be turned
//! into velocities afterwards, and a step costs as much as its contacts, whatever they touch.
//!
//! Once warm, a step asks for no memory: while there are no more pairs, contacts and rows than ever
//! before, where joints are rods and balls (others make their rows in lists of their own). The
//! order of the pairs is kept as long as they are the same.
//!
//! It does not stop early and does not judge its answers: a simulation does.
//!
//! Stewart & Trinkle 1996; Catto, *Iterative Dynamics with Temporal Coherence*, 2005.

mod impulses;
mod masses;
mod rows;
mod scope;
mod sweeper;

use super::{Cause, DIVERGED, Failure};
use crate::assembly::{Assembly, ConstraintFilter};
use crate::body::State;
use crate::scene::{DetectedContact, Detector, Reach, Scene};
use impulses::Impulses;
use lcplab_lcp::error::{Error, Result};
use lcplab_solver::Status;
use masses::Masses;
use rows::Rows;
use sweeper::Sweeper;

/// What sweeps, and with it in which order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// One row after the other, constraints first, then contacts.
    RowByRow,
    /// Eight pairs of bodies at a time, color by color.
    SimdPairs {
        /// On how many threads; the bits are the same with any number.
        threads: usize,
    },
}

/// The parts of a step, in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Which bodies are near each other.
    Pairs,
    /// Where they touch.
    Points,
    /// Rows, and what they start from.
    Rows,
    /// Sweeps, and what puts the rows in their order.
    Sweeps,
    /// Velocities and positions.
    Motion,
}

impl Part {
    /// All of them.
    pub const ALL: [Part; 5] = [Part::Pairs, Part::Points, Part::Rows, Part::Sweeps, Part::Motion];

    /// A few words for tables.
    pub fn name(self) -> &'static str {
        match self {
            Part::Pairs => "pairs of bodies",
            Part::Points => "contact points",
            Part::Rows => "rows",
            Part::Sweeps => "sweeps",
            Part::Motion => "motion",
        }
    }
}

/// A scene on its way through time, as fast as it goes.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::stepper::{Kernel, Stepper};
///
/// let mut stepper = Stepper::new(Scene::load("stack")?, 50, Kernel::RowByRow)?;
/// for _ in 0..10 {
///     stepper.step().expect("a step that can be taken");
/// }
/// assert_eq!(stepper.found().len(), 20); // five boxes on four points each
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::Stepper;
/// use lcplab_mechanics::simulation::stepper::{Kernel, Part};
///
/// // Three balls in a stack, the middle one hit: many sweeps come to (4, 3, 1) N s.
/// let mut stepper = Stepper::new(Scene::load("fig7")?, 100, Kernel::RowByRow)?;
/// let mut parts = Vec::new();
/// stepper.watched_step(&mut |part| parts.push(part)).expect("a step that can be taken");
/// for (x, expected) in stepper.x().iter().zip([4.0, 3.0, 1.0]) {
///     assert!((x - expected).abs() < 1e-9);
/// }
/// assert_eq!((stepper.time(), stepper.order()), (1.0, vec![0, 1, 2]));
/// assert_eq!((parts.last(), Part::Motion.name()), (Some(&Part::Motion), "motion"));
/// stepper.restart();
/// assert_eq!((stepper.time(), stepper.states()), (0.0, &stepper.scene().states[..]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub struct Stepper {
    scene: Scene,
    sweeps: usize,
    states: Vec<State>,
    /// The states of the step under way.
    next: Vec<State>,
    steps: usize,
    detector: Detector,
    /// Whether the contacts of the states now are found.
    is_found: bool,
    masses: Masses,
    rows: Rows,
    sweeper: Sweeper,
    impulses: Impulses,
}

impl Stepper {
    /// The scene at its start, with this number of sweeps per step.
    ///
    /// # Errors
    /// Lists what of the scene it does not do: other schemes than "velocity", other models of
    /// friction than the coupled box, rows that yield.
    pub fn new(scene: Scene, sweeps: usize, kernel: Kernel) -> Result<Self> {
        scope::check(&scene)?;
        Ok(Stepper {
            states: scene.states.clone(),
            next: scene.states.clone(),
            steps: 0,
            detector: Detector::new(&scene),
            is_found: false,
            masses: Masses::new(&scene),
            rows: Rows::default(),
            sweeper: Sweeper::new(kernel),
            impulses: Impulses::default(),
            scene,
            sweeps,
        })
    }

    /// Back to the start; the memory stays.
    pub fn restart(&mut self) {
        self.states.clone_from(&self.scene.states);
        self.impulses.forget();
        self.steps = 0;
        self.is_found = false;
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

    /// The contacts at the beginning of the last step, or of the next one if they are known.
    pub fn found(&self) -> &[DetectedContact] {
        self.detector.found()
    }

    /// The contacts of the last step, which are then no longer kept here.
    pub(super) fn take_found(&mut self) -> Vec<DetectedContact> {
        self.detector.take_found()
    }

    /// The impulses of the last step (N s, N m s), one entry a row: constraints first, then
    /// contacts, as an [`Assembly`] has them.
    pub fn x(&self) -> &[f64] {
        self.impulses.x()
    }

    /// The x of the last step's solves, the one with bounces empty if nothing bounced: what each
    /// started from, and its answer.
    pub(super) fn solves(&self) -> [[&[f64]; 2]; 2] {
        self.impulses.solves()
    }

    /// How far friction reached out of the cone in the last step, as
    /// [`LawErrors`](super::LawErrors) measures it.
    pub(super) fn cone_excess(&self) -> f64 {
        self.rows.cone_excess(self.x())
    }

    /// The rows of the last step in the order in which they were swept.
    pub fn order(&self) -> Vec<usize> {
        self.sweeper.order(self.impulses.x().len())
    }

    /// Takes one step; after a failure the states are those before it.
    ///
    /// # Errors
    /// [`Cause`] lists them: a constraint without direction, a row that nothing moves, a state that
    /// is not finite.
    pub fn step(&mut self) -> std::result::Result<(), Failure> {
        self.watched_step(&mut |_| ())
    }

    /// Takes one step and says which part of it is done.
    ///
    /// # Errors
    /// As [`step`](Stepper::step).
    pub fn watched_step(&mut self, done: &mut dyn FnMut(Part)) -> std::result::Result<(), Failure> {
        let (step, time) = (self.steps + 1, self.time());
        self.advance(done).map_err(|cause| Failure { step, time, cause })
    }

    /// Finds the contacts of the next step, if they are not found yet.
    pub(super) fn find_contacts(&mut self, done: &mut dyn FnMut(Part)) {
        if self.is_found {
            return;
        }
        let Stepper { scene, states, detector, .. } = self;
        let reach = Reach::of_step(scene);
        detector.find_pairs(scene, states, reach);
        done(Part::Pairs);
        detector.find_points(scene, states, reach);
        done(Part::Points);
        self.is_found = true;
    }

    fn advance(&mut self, done: &mut dyn FnMut(Part)) -> std::result::Result<(), Cause> {
        self.find_contacts(done);
        let Stepper { scene, states, next, detector, masses, rows, sweeper, impulses, .. } = self;
        masses.turn(scene, states);
        rows.fill(scene, states, detector.found(), masses)?;
        done(Part::Rows);
        let refused = |status: Status| Error::invalid(&*scene.name, "rows", status.to_string());
        impulses.solve(scene, rows, masses, sweeper, self.sweeps).map_err(refused)?;
        done(Part::Sweeps);
        masses.advance(scene, &sweeper.v, states, next);
        if let Some(cause) = self.divergence() {
            return Err(cause);
        }
        std::mem::swap(&mut self.states, &mut self.next);
        self.is_found = false;
        self.steps += 1;
        done(Part::Motion);
        Ok(())
    }

    /// Why the states that follow cannot be.
    fn divergence(&self) -> Option<Cause> {
        let sane = |state: &State| state.is_finite() && state.velocity().norm() < DIVERGED;
        let body = self.next.iter().position(|state| !sane(state))?;
        // The same rows in the same order, with their names.
        let found = self.detector.found();
        let named = Assembly::new(&self.scene, &self.states, found, ConstraintFilter::Near).ok();
        let rows = named.iter().flat_map(|assembly| assembly.rows.iter().zip(self.impulses.x()));
        let acting = rows.filter(|(row, _)| row.bodies.contains(&Some(body)));
        let largest = acting.max_by(|(_, x), (_, y)| x.abs().total_cmp(&y.abs()));
        let row = largest.map(|(row, _)| row.label(&self.scene));
        Some(Cause::Diverged { body: self.scene.bodies[body].name.clone(), row })
    }
}
