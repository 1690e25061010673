//! Many steps: a scene, its formulation and a solver.
//!
//! A step finds the contacts, assembles, solves and moves. At velocity level that is one LCP, and a
//! second one if something bounces; at acceleration level impacts come first, as impulses, then the
//! forces. Each solve starts from the x that rows of the same name had before.

mod motion;
mod record;

pub use motion::Motion;
pub use record::{Cause, Failure, Recording, Solve, Step};

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use crate::assembly::{Assembly, Entering, Row, RowId};
use crate::body::State;
use crate::constraint::Kind;
use crate::formulation::{Formulation, Problem, Stage};
use crate::scene::{Found, Scene, contacts};
use crate::solver::{Observer, Solver, Start};

/// A speed (m/s or rad/s) beyond which a motion counts as diverged.
const DIVERGED: f64 = 1e8;

/// A scene on its way through time.
///
/// ```
/// use lcplab::{scene::Scene, simulation::Simulation, solver};
///
/// let solver = solver::by_name("dantzig", &solver::Options::default())?;
/// let mut simulation = Simulation::new(Scene::load("fig7")?, solver);
/// let step = simulation.step().expect("a step that can be taken");
/// assert_eq!(step.solves[0].solution.x, [4.0, 3.0, 1.0]); // N s, from the ground up
/// # Ok::<(), lcplab::error::Error>(())
/// ```
pub struct Simulation {
    scene: Scene,
    solver: Box<dyn Solver>,
    states: Vec<State>,
    steps: usize,
    previous: BTreeMap<(Stage, RowId), f64>,
}

impl Simulation {
    /// The scene at its start.
    pub fn new(scene: Scene, solver: Box<dyn Solver>) -> Self {
        let states = scene.states.clone();
        Simulation { scene, solver, states, steps: 0, previous: BTreeMap::new() }
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

    /// Takes one step; after a failure the states are those before it.
    ///
    /// # Errors
    /// A constraint without direction, or a state that is not finite.
    pub fn step(&mut self) -> Result<Step, Failure> {
        self.observed_step(&mut ())
    }

    /// Takes one step, telling the observer of the iterates of all its solves.
    ///
    /// # Errors
    /// As [`step`](Simulation::step).
    pub fn observed_step(&mut self, observer: &mut dyn Observer) -> Result<Step, Failure> {
        let failure = |cause| Failure { step: self.steps + 1, time: self.time(), cause };
        let found = contacts(&self.scene, &self.states, self.reach());
        let (solves, states) = self.moved(&found, observer).map_err(failure)?;
        if let Some(cause) = self.divergence(&states, &solves) {
            return Err(failure(cause));
        }
        self.remember(&solves);
        self.states.clone_from(&states);
        self.steps += 1;
        let motion = self.motion();
        Ok(Step { number: self.steps, solves, contacts: found, states, motion })
    }

    /// Takes up to `steps` steps, showing each to `watch`, which may end the run.
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

    /// How near (m) contacts must be to matter.
    fn reach(&self) -> f64 {
        match self.scene.step.formulation {
            Formulation::Velocity => self.scene.contact.margin,
            Formulation::Acceleration => self.scene.contact.resting_gap,
        }
    }

    /// The solves of a step and the states they lead to.
    fn moved(
        &self,
        found: &[Found],
        observer: &mut dyn Observer,
    ) -> Result<(Vec<Solve>, Vec<State>), Cause> {
        let dt = self.scene.step.dt;
        let mut solves = Vec::new();
        match self.scene.step.formulation {
            Formulation::Velocity => {
                let assembly = self.assembled(&self.states, found, Entering::Near)?;
                let problem = Problem::velocity(&self.scene, assembly)?;
                self.solve_bouncing(problem, &mut solves, observer)?;
                let states = after(&solves, &self.states, dt);
                Ok((solves, states))
            }
            Formulation::Acceleration => {
                let states = self.impacts(found, &mut solves, observer)?;
                let assembly = self.assembled(&states, found, Entering::Resting)?;
                let problem = Problem::acceleration(&self.scene, assembly)?;
                solves.push(self.solve(problem, observer));
                let states = after(&solves, &states, dt);
                Ok((solves, states))
            }
        }
    }

    /// The states after the impacts, where bodies touch and approach.
    fn impacts(
        &self,
        found: &[Found],
        solves: &mut Vec<Solve>,
        observer: &mut dyn Observer,
    ) -> Result<Vec<State>, Cause> {
        let assembly = self.assembled(&self.states, found, Entering::Touching)?;
        let limit = -self.scene.contact.resting_speed;
        let hits = |row: &Row| row.kind == Kind::Normal && row.velocity < limit;
        if !assembly.rows.iter().any(hits) {
            return Ok(self.states.clone());
        }
        self.solve_bouncing(Problem::impact(assembly)?, solves, observer)?;
        Ok(solves.last().map_or_else(
            || self.states.clone(),
            |Solve { problem, solution }| {
                let u = problem.next_velocity(&solution.x, 0.0);
                problem.assembly.with_velocities(&self.states, &u)
            },
        ))
    }

    fn assembled(
        &self,
        states: &[State],
        found: &[Found],
        entering: Entering,
    ) -> Result<Assembly, Cause> {
        Assembly::new(&self.scene, states, found, entering).map_err(Cause::Undefined)
    }

    /// Solves, and again with restitution if something bounces.
    fn solve_bouncing(
        &self,
        problem: Problem,
        solves: &mut Vec<Solve>,
        observer: &mut dyn Observer,
    ) -> Result<(), Cause> {
        let first = self.solve(problem, observer);
        let second = first.problem.restitution(&self.scene, &first.solution.x)?;
        solves.push(first);
        solves.extend(second.map(|problem| self.solve(problem, observer)));
        Ok(())
    }

    fn solve(&self, problem: Problem, observer: &mut dyn Observer) -> Solve {
        let before = |id: RowId| self.previous.get(&(problem.stage, id)).copied().unwrap_or(0.0);
        let x: Vec<f64> = problem.assembly.rows.iter().map(|row| before(row.id)).collect();
        let solution = self.solver.solve(&problem.lcp, &Start { x: Some(&x) }, observer);
        Solve { problem, solution }
    }

    fn remember(&mut self, solves: &[Solve]) {
        self.previous.clear();
        for Solve { problem, solution } in solves {
            let rows = problem.assembly.rows.iter().zip(&solution.x);
            self.previous.extend(rows.map(|(row, &x)| ((problem.stage, row.id), x)));
        }
    }

    fn divergence(&self, states: &[State], solves: &[Solve]) -> Option<Cause> {
        let sane = |state: &State| state.is_finite() && state.velocity().norm() < DIVERGED;
        let body = states.iter().position(|state| !sane(state))?;
        let last = solves.last()?;
        let rows = last.problem.assembly.rows.iter().zip(&last.solution.x);
        let acting = rows.filter(|(row, _)| row.bodies.contains(&Some(body)));
        let largest = acting.max_by(|(_, x), (_, y)| x.abs().total_cmp(&y.abs()));
        let row = largest.map(|(row, _)| row.label(&self.scene));
        Some(Cause::Diverged { body: self.scene.bodies[body].name.clone(), row })
    }
}

/// The states after a step whose last solve is the last of these.
fn after(solves: &[Solve], states: &[State], dt: f64) -> Vec<State> {
    solves.last().map_or_else(
        || states.to_vec(),
        |Solve { problem, solution }| problem.next_states(states, &solution.x, dt),
    )
}
