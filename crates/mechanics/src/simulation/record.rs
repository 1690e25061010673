//! What a simulation leaves behind: steps, solves, and why it could not go on.

use std::fmt;

use nalgebra::Vector3;

use super::events::Impulses;
use super::swept::Swept;
use super::{
    ImpactEnergy, Interpenetration, JointWork, LawErrors, Ledger, Motion, Slip, StepEvent, Touch,
    Unlocated,
};
use crate::assembly::{Row, Undefined};
use crate::body::State;
use crate::formulation::{Posing, Problem};
use crate::scene::{DetectedContact, Scene};
use lcplab_judge::ray::Farkas;
use lcplab_judge::{Demand, FrictionCertificate, judge, judge_friction};
use lcplab_lcp::error::Error;
use lcplab_lcp::number::readable;
use lcplab_solver::{Reason, Solution};

/// What happened in one step.
#[derive(Debug, Clone)]
pub struct Step {
    /// The number of the step, from 1.
    pub number: usize,
    /// The LCPs of the step and their answers, in the order of solving.
    pub solves: Vec<Solve>,
    /// The contacts at its beginning.
    pub contacts: Vec<DetectedContact>,
    /// Bodies that went through each other, and overlaps that became deep or last; each overlap is
    /// named once.
    pub interpenetrations: Vec<Interpenetration>,
    /// Energy that impacts changed against the coefficient of restitution; XPBD, the soft step and
    /// the penalty method report an impact in the step after the bodies have separated.
    pub impact_energy: Vec<ImpactEnergy>,
    /// The states at its end.
    pub states: Vec<State>,
    /// Energy, momentum and errors at its end.
    pub motion: Motion,
    /// What acted on the bodies, in its order; `None` where that is not written down: by XPBD,
    /// whose velocities are what positions did, and by integrators with stages.
    pub events: Option<Vec<StepEvent>>,
    /// The impulse of each row (N s, N m s) where the scheme poses no problem: all that its
    /// substeps gave it together, 0 for none.
    pub pushed: Vec<(Row, f64)>,
    /// The energy ledger; `None` if the scheme does not record what acted.
    pub ledger: Option<Ledger>,
    /// How well it kept the laws of contact and momentum.
    pub laws: LawErrors,
    /// The friction of each pair of bodies that rub, beside Coulomb's law.
    pub slips: Vec<Slip>,
    /// The pairs of bodies that push each other.
    pub touches: Vec<Touch>,
    /// Bounces across a gap that the step took at its beginning.
    pub unlocated: Vec<Unlocated>,
    /// The work of rigid joints of a body that turned fast in XPBD, the soft step or the penalty
    /// method, if it was notable.
    pub joint_work: Option<JointWork>,
    /// The start and the impulses of a step of a fixed number of sweeps, which has no solves of its
    /// own: [`posed`](Step::posed) makes them.
    pub swept: Option<Swept>,
}

impl Step {
    /// The mean force (N, world) that contacts and joints put on each body during the step, as the
    /// scheme has it; `None` where that is not written down: by integrators with stages.
    pub fn forces(&self, scene: &Scene) -> Option<Vec<Vector3<f64>>> {
        let world = scene.bodies.len();
        let mut sums = vec![Vector3::zeros(); world + 1];
        let mut add = |row: &Row, impulse: f64| {
            let pushes = row.pushes().map(|push| push * (impulse / scene.step.dt));
            for (body, push) in row.bodies.into_iter().zip(pushes) {
                sums[body.unwrap_or(world)] += push;
            }
        };
        match &self.events {
            None if self.swept.is_some() => {
                for Solve { problem, solution, impulse_factor, .. } in &*self.posed(scene).ok()? {
                    let rows = problem.assembly.rows.iter().zip(&solution.x);
                    rows.for_each(|(row, x)| add(row, impulse_factor * x));
                }
            }
            None if self.pushed.is_empty() && !self.solves.is_empty() => return None,
            None => self.pushed.iter().for_each(|(row, impulse)| add(row, *impulse)),
            Some(events) => {
                for impulses in
                    events.iter().filter_map(|event| Impulses::of(scene, event, &self.solves))
                {
                    let rows = impulses.assembly.rows.iter().zip(&impulses.x);
                    rows.for_each(|(row, impulse)| add(row, *impulse));
                }
            }
        }
        sums.truncate(world);
        Some(sums)
    }
}

/// Errors of forces from this part of the scene's scale on may hide that there is no solution.
const FAR: f64 = 0.01;

/// An LCP and a solver's answer to it.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::Step;
///
/// let scene = Scene::load("fig7")?;
/// let step = Step::of(&scene, 1)?;
/// let solve = &step.posed(&scene).expect("a problem")[0];
/// assert_eq!(solve.exported(&scene, 1).name, "fig7, step 1"); // as a problem file
/// assert!(solve.conflict(&scene).is_empty()); // the rows do not contradict each other
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Solve {
    /// The problem; its assembly names the rows.
    pub problem: Problem,
    /// The same under the scene's friction model, if that is not the coupled box that the
    /// problem's own LCP states.
    pub posing: Option<Posing>,
    /// The x that its solver started from.
    pub start: Vec<f64>,
    /// The name of the solver that gave the answer: another than the simulation's where that one is
    /// not made for the problem; "none" where no solver was asked.
    pub solver: String,
    /// The answer.
    pub solution: Solution,
    /// The factor from x to the impulse that acted in the step: 1 for impulses and corrections, the
    /// duration (s) for forces, 0 for an answer that another one replaced.
    pub impulse_factor: f64,
}

impl Solve {
    /// The judge's word on the answer, by the problem that was posed. If forces are so large that
    /// the tolerance allows errors of the size of the scene's own forces, a small residual does not
    /// show that a solution exists; then the judge also searches for a proof that there is none.
    pub fn judged(&self, demand: &Demand) -> FrictionCertificate {
        let (lcp, x) = (&self.problem.lcp, &self.solution.x);
        let largest = x.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        let is_far = lcp.scale() > 0.0 && demand.tolerance * largest > FAR * lcp.scale();
        let proves = if is_far { Demand::default().prove_up_to } else { 0 };
        let demand = Demand { prove_up_to: demand.prove_up_to.max(proves), ..*demand };
        match &self.posing {
            Some(posing) => judge_friction(&posing.posed, x, &demand),
            None => judge(lcp, x, &demand).into(),
        }
    }
}

/// The motion over many steps, as far as it got.
#[derive(Debug, Clone)]
pub struct Recording {
    /// The motion at the start and after each step.
    pub motion: Vec<Motion>,
    /// Why it ended early, if it did.
    pub failure: Option<Failure>,
}

/// Why a step could not be taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    /// The number of the step, from 1.
    pub step: usize,
    /// The time at its beginning (s).
    pub time: f64,
    /// What went wrong.
    pub cause: Cause,
}

/// What went wrong in a step.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// A constraint has no direction to push in.
    Undefined(Undefined),
    /// The LCP has numbers that are not finite.
    Problem(Error),
    /// It is proved that the problem of the step has no solution.
    NoSolution {
        /// A sliding contact's row that no forces can satisfy.
        row: String,
        /// The vector that proves it, checked in exact arithmetic; without one, all active sets
        /// were tried in exact arithmetic.
        proof: Option<Farkas>,
    },
    /// The equation of the implicit midpoint did not converge: the step is too long for it.
    Unsettled {
        /// How much the rates still changed, beside their size.
        change: f64,
    },
    /// Nothing: it was time to stop, for this reason, or the observer stopped a solve.
    Stopped(Option<Reason>),
    /// A body's state is not finite, or it moves faster than anything should.
    Diverged {
        /// The body's name.
        body: String,
        /// The row with the largest x among those that act on it, if any.
        row: Option<String>,
    },
}

impl Cause {
    /// Why the step was not taken, if nothing was wrong with it.
    ///
    /// ```
    /// use lcplab_mechanics::scene::Scene;
    /// use lcplab_mechanics::simulation::Simulation;
    /// use lcplab_solver::{Dantzig, Reason, Stop};
    ///
    /// let stop = Stop::default();
    /// stop.raise();
    /// let mut simulation = Simulation::new(Scene::load("fig7")?, Box::new(Dantzig::default()));
    /// let failure = simulation.step_before(&stop).unwrap_err();
    /// assert_eq!(failure.cause.stopped(), Some(Reason::Interrupted));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn stopped(&self) -> Option<Reason> {
        match self {
            Cause::Stopped(reason) => *reason,
            _ => None,
        }
    }
}

impl From<Error> for Cause {
    fn from(error: Error) -> Self {
        Cause::Problem(error)
    }
}

impl std::error::Error for Failure {}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "step {}, at {} s: {}", self.step, readable(self.time, 6), self.cause)
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::Undefined(undefined) => write!(f, "{undefined}"),
            Cause::Problem(error) => write!(f, "{error}"),
            Cause::NoSolution { row, .. } => {
                write!(f, "no forces satisfy the sliding contact {row:?}")
            }
            Cause::Unsettled { change } => {
                write!(
                    f,
                    "the implicit midpoint iteration does not converge; its rates change by {}",
                    readable(*change, 2)
                )
            }
            Cause::Stopped(Some(reason)) => write!(f, "{reason}"),
            Cause::Stopped(None) => write!(f, "stopped by the observer"),
            Cause::Diverged { body, row: Some(row) } => {
                write!(f, "{body:?} diverged; the row with the largest impulse on it is {row:?}")
            }
            Cause::Diverged { body, row: None } => {
                write!(f, "{body:?} diverged; no contact or joint impulse acts on it")
            }
        }
    }
}
