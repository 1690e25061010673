//! What the steps of all schemes share: matrices of an instant, and solves that remember.

use std::collections::BTreeMap;

use super::fallback::Solvers;
use super::{Cause, Solve, StepEvent};
use crate::assembly::{Assembly, ConstraintFilter, Row, RowId};
use crate::body::State;
use crate::formulation::{Problem, Stage};
use crate::scene::{DetectedContact, Persistence, Scene};
use lcplab_solver::{Observer, Solution};

/// The x of each row at the end of a step, by what it decided.
pub(super) type Memory = BTreeMap<(Stage, RowId), f64>;

/// How a scheme answers a problem itself: from the problem, a start, and an observer.
type Method<'m> = &'m dyn Fn(&Problem, &[f64], &mut dyn Observer) -> Solution;

/// A step under way.
pub(super) struct Solving<'a> {
    /// The scene with the forces of this step.
    pub scene: &'a Scene,
    /// The time (s) at its beginning.
    pub from: f64,
    pub solvers: Solvers<'a>,
    /// The answers of the step before, which start the solves of this one.
    pub previous: &'a Memory,
    pub observer: &'a mut dyn Observer,
    /// What was solved so far.
    pub solves: Vec<Solve>,
    /// The answers so far.
    pub answers: Memory,
    /// What acted so far, if the scheme writes it down.
    pub events: Option<Vec<StepEvent>>,
    /// The impulse of each row, of a scheme that knows it and does not write down what acted.
    pub pushed: Vec<(Row, f64)>,
}

impl Solving<'_> {
    /// The matrices of the scene with these states.
    pub fn assemble(
        &self,
        states: &[State],
        found: &[DetectedContact],
        entering: ConstraintFilter,
    ) -> Result<Assembly, Cause> {
        assembled(self.scene, states, found, entering)
    }

    /// The x that rows of these names had at this stage a step before, 0 for new ones.
    pub fn start(&self, stage: Stage, assembly: &Assembly) -> Vec<f64> {
        let forgets = self.scene.contact.persistence == Persistence::None;
        let known = |id: RowId| self.previous.get(&(stage, id)).filter(|_| !forgets).copied();
        assembly.rows.iter().map(|row| known(row.id).unwrap_or(0.0)).collect()
    }

    /// Keeps an x as a start for the next step.
    pub fn remember(&mut self, stage: Stage, assembly: &Assembly, x: &[f64]) {
        let rows = assembly.rows.iter().zip(x);
        self.answers.extend(rows.map(|(row, &x)| ((stage, row.id), x)));
    }

    /// Poses a problem under the scene's friction model, solves it from the x that rows of the
    /// same name had at the same stage, and keeps it. Which contacts stick is decided with the
    /// answer.
    pub fn solve(&mut self, problem: Problem) -> Result<&Solve, Cause> {
        let mut solve = self.answered(problem.held(self.scene)?)?;
        while let Some(looser) = solve.problem.loosened(self.scene, &solve.solution.x)? {
            solve = self.answered(looser)?;
        }
        Ok(self.keep(solve))
    }

    /// The answer to a problem as it stands.
    fn answered(&mut self, problem: Problem) -> Result<Solve, Cause> {
        let x = self.start(problem.stage, &problem.assembly);
        let model = self.scene.contact.model;
        let posing = match (problem.stage, self.solves.last()) {
            (Stage::Restitution, Some(first)) => problem.pose(model, &first.solution.x)?,
            _ => problem.pose(model, &x)?,
        };
        let (solver, solution) = self.solvers.solve(&problem, posing.as_ref(), &x, self.observer);
        Ok(Solve { problem, posing, start: x, solver, solution, impulse_factor: 1.0 })
    }

    /// Solves a problem as it stands by a method of the scheme's own.
    pub fn solve_by(&mut self, problem: Problem, method: Method) -> Result<&Solve, Cause> {
        let mut problem = problem.held(self.scene)?;
        let x = self.start(problem.stage, &problem.assembly);
        let mut solution = method(&problem, &x, self.observer);
        while let Some(looser) = problem.loosened(self.scene, &solution.x)? {
            solution = method(&looser, &x, self.observer);
            problem = looser;
        }
        Ok(self.keep(Solve {
            problem,
            posing: None,
            start: x,
            solver: "none".into(),
            solution,
            impulse_factor: 1.0,
        }))
    }

    fn keep(&mut self, solve: Solve) -> &Solve {
        self.remember(solve.problem.stage, &solve.problem.assembly, &solve.solution.x);
        self.solves.push(solve);
        self.last()
    }

    /// Solves, and again with restitution if something bounces; the last answer counts. In a bounce
    /// a frozen box is frozen at the impulses of the first answer.
    pub(crate) fn solve_bouncing(&mut self, problem: Problem) -> Result<&Solve, Cause> {
        self.solve(problem)?;
        if let Some(second) = self.bounce()? {
            self.replace_last();
            self.solve(second)?;
        }
        Ok(self.last())
    }

    /// The last answer does not act: another one takes its place.
    pub(crate) fn replace_last(&mut self) {
        if let Some(last) = self.solves.last_mut() {
            last.impulse_factor = 0.0;
        }
    }

    /// The last problem again, with what bounces after its answer; `None` if nothing does.
    pub fn bounce(&self) -> Result<Option<Problem>, Cause> {
        let first = self.last();
        Ok(first.problem.restitution(self.scene, &first.solution.x)?)
    }

    /// Writes down what acted.
    pub fn note(&mut self, event: StepEvent) {
        self.events.get_or_insert_default().push(event);
    }

    /// Writes down that the last answer acted.
    pub(crate) fn note_answer(&mut self) {
        self.note(StepEvent::Answer(self.solves.len() - 1));
    }

    /// The last solve, of which there is one.
    pub fn last(&self) -> &Solve {
        &self.solves[self.solves.len() - 1]
    }
}

/// The matrices of a scene with these states.
pub(super) fn assembled(
    scene: &Scene,
    states: &[State],
    found: &[DetectedContact],
    entering: ConstraintFilter,
) -> Result<Assembly, Cause> {
    Assembly::new(scene, states, found, entering).map_err(Cause::Undefined)
}
