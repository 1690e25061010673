//! What the steps of all families share: matrices of an instant, and solves that remember.

use std::collections::BTreeMap;

use super::{Cause, Solve};
use crate::assembly::{Assembly, Entering, RowId, Source};
use crate::body::State;
use crate::formulation::{Problem, Stage};
use crate::lcp::Lcp;
use crate::scene::{Found, Persistence, Scene};
use crate::solver::{
    self, Enumeration, Lemke, MatrixClass, Observer, Settings, Solution, Solver, Start, Status,
};

/// The x of each row at the end of a step, by what it decided.
pub(super) type Memory = BTreeMap<(Stage, RowId), f64>;

/// How a problem gets its answer: from the problem, a start, and someone who watches.
type Method<'m> = &'m dyn Fn(&Problem, &[f64], &mut dyn Observer) -> Solution;

/// A step under way.
pub(super) struct Solving<'a> {
    pub scene: &'a Scene,
    pub solver: &'a dyn Solver,
    /// The answers of the step before, which start the solves of this one.
    pub previous: &'a Memory,
    pub observer: &'a mut dyn Observer,
    /// What was solved so far.
    pub solves: Vec<Solve>,
    /// The answers so far.
    pub answers: Memory,
}

impl Solving<'_> {
    /// The matrices of the scene with these states.
    pub fn assemble(
        &self,
        states: &[State],
        found: &[Found],
        entering: Entering,
    ) -> Result<Assembly, Cause> {
        assembled(self.scene, states, found, entering)
    }

    /// The x that rows of these names had at this stage a step before, 0 for new ones.
    pub fn start(&self, stage: Stage, assembly: &Assembly) -> Vec<f64> {
        let forgets = self.scene.contact.persistence == Persistence::None;
        let before = |id: RowId| match id.source {
            Source::Contact(_) if forgets => 0.0,
            _ => self.previous.get(&(stage, id)).copied().unwrap_or(0.0),
        };
        assembly.rows.iter().map(|row| before(row.id)).collect()
    }

    /// Keeps an x as a start for the next step.
    pub fn remember(&mut self, stage: Stage, assembly: &Assembly, x: &[f64]) {
        let rows = assembly.rows.iter().zip(x);
        self.answers.extend(rows.map(|(row, &x)| ((stage, row.id), x)));
    }

    /// Solves a problem from the x that rows of the same name had at the same stage, and keeps it.
    pub fn solve(&mut self, problem: Problem) -> &Solve {
        let (chosen, settings) = (self.solver, settings(self.scene));
        self.solve_by(problem, &|problem, x, observer| {
            let (lcp, start) = (&problem.lcp, Start { x: Some(x) });
            if suits(chosen, problem) {
                chosen.solve(lcp, &start, observer)
            } else {
                unsymmetric(lcp, &start, settings.clone(), observer)
            }
        })
    }

    /// The same by another method than the solver.
    pub fn solve_by(&mut self, problem: Problem, method: Method) -> &Solve {
        let x = self.start(problem.stage, &problem.assembly);
        let solution = method(&problem, &x, self.observer);
        self.remember(problem.stage, &problem.assembly, &solution.x);
        self.solves.push(Solve { problem, solution });
        self.last()
    }

    /// Solves, and again with restitution if something bounces; the last answer counts.
    pub fn solve_bouncing(&mut self, problem: Problem) -> Result<&Solve, Cause> {
        self.solve(problem);
        if let Some(second) = self.bounce()? {
            self.solve(second);
        }
        Ok(self.last())
    }

    /// The last problem again, with what bounces after its answer; `None` if nothing does.
    pub fn bounce(&self) -> Result<Option<Problem>, Cause> {
        let first = self.last();
        Ok(first.problem.restitution(self.scene, &first.solution.x)?)
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
    found: &[Found],
    entering: Entering,
) -> Result<Assembly, Cause> {
    Assembly::new(scene, states, found, entering).map_err(Cause::Undefined)
}

/// Whether a solver is made for A, or A is symmetric, which all are.
fn suits(solver: &dyn Solver, problem: &Problem) -> bool {
    use MatrixClass::{CopositivePlus, General, P, P0};
    let class = solver::entry(solver.name()).ok().map(|entry| entry.class.matrix);
    problem.lcp.matrix().is_symmetric()
        || matches!(class, None | Some(General | CopositivePlus | P | P0))
}

/// Lemke's method, and where it ends without a solution the enumeration of all active sets, unless
/// there are too many.
fn unsymmetric(
    lcp: &Lcp,
    start: &Start<'_>,
    settings: Settings,
    observer: &mut dyn Observer,
) -> Solution {
    let first = Lemke { settings: settings.clone() }.solve(lcp, start, observer);
    if first.status == Status::Solved {
        return first;
    }
    let second = Enumeration { settings }.solve(lcp, start, observer);
    match second.status {
        Status::Solved | Status::NoSolution => second,
        _ => first,
    }
}

/// The scene's settings of solvers.
fn settings(scene: &Scene) -> Settings {
    Settings {
        tolerance: scene.solver.tolerance,
        max_iterations: scene.solver.max_iterations,
        ..Settings::default()
    }
}
