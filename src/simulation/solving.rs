//! What the steps of all families share: matrices of an instant, and solves that remember.

use std::collections::BTreeMap;

use super::{Cause, Solve};
use crate::assembly::{Assembly, Entering, RowId, Source};
use crate::body::State;
use crate::formulation::{Problem, Stage};
use crate::scene::{Found, Persistence, Scene};
use crate::solver::{Observer, Solver, Start};

/// The x of each row at the end of a step, by what it decided.
pub(super) type Memory = BTreeMap<(Stage, RowId), f64>;

/// A step under way.
pub(super) struct Solving<'a> {
    pub scene: &'a Scene,
    pub solver: &'a dyn Solver,
    /// The answers of the step before, which start the solves of this one.
    pub previous: &'a Memory,
    pub observer: &'a mut dyn Observer,
    /// What was solved so far.
    pub solves: Vec<Solve>,
}

impl Solving<'_> {
    /// The matrices of the scene with these states.
    pub fn assemble(
        &self,
        states: &[State],
        found: &[Found],
        entering: Entering,
    ) -> Result<Assembly, Cause> {
        Assembly::new(self.scene, states, found, entering).map_err(Cause::Undefined)
    }

    /// Solves a problem from the x that rows of the same name had at the same stage, and keeps it.
    pub fn solve(&mut self, problem: Problem) -> &Solve {
        let forgets = self.scene.contact.persistence == Persistence::None;
        let before = |id: RowId| match id.source {
            Source::Contact(_) if forgets => 0.0,
            _ => self.previous.get(&(problem.stage, id)).copied().unwrap_or(0.0),
        };
        let x: Vec<f64> = problem.assembly.rows.iter().map(|row| before(row.id)).collect();
        let solution = self.solver.solve(&problem.lcp, &Start { x: Some(&x) }, self.observer);
        self.solves.push(Solve { problem, solution });
        &self.solves[self.solves.len() - 1]
    }

    /// Solves, and again with restitution if something bounces; the last answer counts.
    pub fn solve_bouncing(&mut self, problem: Problem) -> Result<&Solve, Cause> {
        let scene = self.scene;
        let first = self.solve(problem);
        if let Some(second) = first.problem.restitution(scene, &first.solution.x)? {
            self.solve(second);
        }
        Ok(&self.solves[self.solves.len() - 1])
    }
}
