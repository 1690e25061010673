//! Who solves a problem of a step: the simulation's solver where it is made for it, else another
//! one, by name.
//!
//! | the problem | the solver | else |
//! | --- | --- | --- |
//! | boxed, A symmetric | the simulation's | |
//! | boxed, A not symmetric | the simulation's, if its class has such A | Lemke's method, then the enumeration of all active sets |
//! | polygons | the simulation's, if it takes them | Lemke's method |
//! | the same, not solved | the same, on rows that yield a little | the answer it gave |
//! | cones | the simulation's cone solver | |

use crate::formulation::{Posing, Problem};
use crate::lcp::friction::{Model, Polyhedral, Posed};
use crate::lcp::{Lcp, merit};
use crate::scene::Scene;
use crate::solver::{
    self, ConeSolver, Enumeration, Fallback, Lemke, MatrixClass, Method, Observer, Settings,
    Solution, Solver, Start, Status, solve_polyhedral,
};

/// The solvers of a simulation.
#[derive(Clone, Copy)]
pub(super) struct Solvers<'a> {
    /// For LCPs.
    pub boxed: &'a dyn Solver,
    /// For cones.
    pub cone: &'a dyn ConeSolver,
    /// What both were told.
    pub scene: &'a Scene,
}

impl Solvers<'_> {
    /// Solves a problem as it was posed, from an x; says who did.
    pub fn solve(
        self,
        problem: &Problem,
        posing: Option<&Posing>,
        x: &[f64],
        observer: &mut dyn Observer,
    ) -> (&'static str, Solution) {
        let start = Start::at(x);
        match posing.map(|posing| (posing.model, &posing.posed)) {
            None => self.boxed(&problem.lcp, &start, observer),
            Some((_, Posed::Boxed(lcp))) => self.boxed(lcp, &start, observer),
            Some((model, Posed::Polyhedral(polyhedral))) => {
                let settings = settings(self.scene);
                let tolerance = settings.tolerance;
                let lemke = Lemke { settings };
                let solver = if takes(self.boxed, model) { self.boxed } else { &lemke };
                (solver.name(), by_polygons(solver, polyhedral, &start, tolerance, observer))
            }
            Some((_, Posed::Cone(cones))) => {
                (self.cone.name(), self.cone.solve(cones, &start, observer))
            }
        }
    }

    fn boxed(
        self,
        lcp: &Lcp,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> (&'static str, Solution) {
        if suits(self.boxed, lcp) {
            return (self.boxed.name(), self.boxed.solve(lcp, start, observer));
        }
        let lemke = Lemke { settings: settings(self.scene) };
        let first = lemke.solve(lcp, start, observer);
        if first.status == Status::Solved {
            return (lemke.name(), first);
        }
        let enumeration = Enumeration { settings: settings(self.scene) };
        let second = enumeration.solve(lcp, start, observer);
        match second.status {
            Status::Solved | Status::NoSolution => (enumeration.name(), second),
            _ => (lemke.name(), first),
        }
    }
}

/// By how much rows yield where a polygon is not solved otherwise, in parts of A's diagonal.
const SOFTENINGS: [f64; 3] = [1e-12, 1e-10, 1e-9];

/// Redundant contacts make the polyhedral LCP so degenerate that rounding leads pivots astray. Rows
/// that yield are not redundant; an answer of theirs counts if it solves the rigid problem too.
fn by_polygons(
    solver: &dyn Solver,
    polyhedral: &Polyhedral,
    start: &Start<'_>,
    tolerance: f64,
    observer: &mut dyn Observer,
) -> Solution {
    let first = solve_polyhedral(solver, polyhedral, start, tolerance, observer);
    if matches!(first.status, Status::Solved | Status::Stopped) {
        return first;
    }
    let again = SOFTENINGS.iter().find_map(|&part| {
        let soft = polyhedral.softened(part).ok()?;
        let Solution { x, iterations, .. } =
            solve_polyhedral(solver, &soft, start, tolerance, observer);
        let solves = merit::is_solution(polyhedral.lcp(), &polyhedral.z(&x), tolerance);
        let lcp = polyhedral.friction().lcp();
        let solution = || Solution::new(lcp, x, Status::Solved, first.iterations + iterations);
        solves.then(|| solution().with_fallback(Some(Fallback::Softened)))
    });
    again.unwrap_or(first)
}

/// Whether a solver is made for a model of friction; one that is not registered is thought to be.
fn takes(solver: &dyn Solver, model: Model) -> bool {
    let entry = solver::entry(solver.name());
    entry.map_or(true, |entry| Method::Boxed(*entry).takes(Some(model)))
}

/// Whether a solver is made for A, or A is symmetric, which all are.
fn suits(solver: &dyn Solver, lcp: &Lcp) -> bool {
    use MatrixClass::{Definite, Semidefinite};
    let class = solver::entry(solver.name()).ok().map(|entry| entry.class.matrix);
    lcp.matrix().is_symmetric() || !matches!(class, Some(Definite | Semidefinite))
}

/// The scene's settings of solvers.
pub(super) fn settings(scene: &Scene) -> Settings {
    Settings {
        tolerance: scene.solver.tolerance,
        max_iterations: scene.solver.max_iterations,
        memory: scene.memory,
        ..Settings::default()
    }
}
