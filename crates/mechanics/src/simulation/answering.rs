//! Who solves a problem of a step: the simulation's solver where it is made for it, else another
//! one, by name.
//!
//! | the problem | the solver | else |
//! | --- | --- | --- |
//! | boxed, A symmetric | the simulation's | Newton's method, in place of pivoting that friction leads astray |
//! | boxed, A not symmetric | the simulation's, if its class has such A | Lemke's method, then the enumeration of all active sets |
//! | polygons of few contacts | the simulation's, if it takes them, or Lemke's method | sweeps by contact |
//! | polygons of many contacts | sweeps by contact | the simulation's, or Lemke's method |
//! | polygons, not solved | the same, on rows that yield a little | the answer it gave |
//! | cones | the simulation's cone solver | |

use crate::formulation::{Posing, Problem};
use crate::scene::Scene;
use lcplab_problem::Lcp;
use lcplab_problem::friction::{Model, Polyhedral, Posed};
use lcplab_solver::{
    self, ConeSolver, Enumeration, Fallback, Lemke, MatrixClass, Method, Newton, Observer,
    PolygonPgs, Settings, Solution, Solver, Start, Status, solve_polyhedral,
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
                let lemke = Lemke { settings: settings.clone() };
                let solver = if takes(self.boxed, model) { self.boxed } else { &lemke };
                by_polygons(solver, polyhedral, &start, &settings, observer)
            }
            Some((_, Posed::Cone(cones))) => {
                (self.cone.name(), self.cone.solve(cones, &start, observer))
            }
        }
    }

    /// The simulation's solver; where friction leads one that pivots astray, Newton's method has a try.
    fn symmetric(
        self,
        lcp: &Lcp,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> (&'static str, Solution) {
        let first = self.boxed.solve(lcp, start, observer);
        let is_lost = !matches!(first.status, Status::Solved | Status::Stopped)
            && lcp.coupling().is_some()
            && PIVOTING.contains(&self.boxed.name());
        if !is_lost {
            return (self.boxed.name(), first);
        }
        let settings = Settings { max_iterations: NEWTON_STEPS, ..settings(self.scene) };
        let newton = Newton { settings, ..Newton::default() };
        let second = newton.solve(lcp, start, observer);
        match second.status {
            Status::Solved | Status::Stopped => (newton.name(), second),
            _ => (self.boxed.name(), first),
        }
    }

    fn boxed(
        self,
        lcp: &Lcp,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> (&'static str, Solution) {
        if suits(self.boxed, lcp) {
            return self.symmetric(lcp, start, observer);
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

/// Methods that end at a solution or nowhere. Others come nearer with every sweep, and where they end early
/// that is what a user wants to see.
const PIVOTING: [&str; 4] = ["dantzig", "block-pivoting", "murty", "lemke"];

/// Newton's method is there in some ten steps, or not at all.
const NEWTON_STEPS: usize = 50;

/// With more contacts than these, pivoting a polygon's LCP takes longer than sweeps.
const FEW_CONTACTS: usize = 8;

/// By how much rows yield where a polygon is not solved otherwise, in parts of A's diagonal.
const SOFTENINGS: [f64; 3] = [1e-12, 1e-10, 1e-9];

/// An answer, and who gave it.
type Answered = (&'static str, Solution);
/// A way to get one.
type Attempt<'a> = &'a dyn Fn(&mut dyn Observer) -> Answered;

/// Sweeps and pivots, in the order that suits the number of contacts. Redundant contacts make the polyhedral
/// LCP so degenerate that rounding leads pivots astray. Rows that yield are not redundant; an answer of
/// theirs counts if it solves the rigid problem too.
fn by_polygons(
    solver: &dyn Solver,
    polyhedral: &Polyhedral,
    start: &Start<'_>,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> (&'static str, Solution) {
    let tolerance = settings.tolerance;
    let sweeps = PolygonPgs { settings: settings.clone() };
    let swept: Attempt<'_> =
        &|observer| (PolygonPgs::NAME, sweeps.solve(polyhedral, start, observer));
    let pivoted: Attempt<'_> = &|observer| {
        (solver.name(), solve_polyhedral(solver, polyhedral, start, tolerance, observer))
    };
    let has_few = polyhedral.friction().contacts().len() <= FEW_CONTACTS;
    let [one, other] = if has_few { [pivoted, swept] } else { [swept, pivoted] };
    let ends = |(_, answer): &Answered| matches!(answer.status, Status::Solved | Status::Stopped);
    let first = one(observer);
    if ends(&first) {
        return first;
    }
    let second = other(observer);
    if ends(&second) {
        return second;
    }
    let again = SOFTENINGS.iter().find_map(|&part| {
        let soft = polyhedral.softened(part).ok()?;
        let Solution { x, iterations, .. } =
            solve_polyhedral(solver, &soft, start, tolerance, observer);
        let solves = polyhedral.is_solution(&x, tolerance);
        let lcp = polyhedral.friction().lcp();
        let solution = || Solution::new(lcp, x, Status::Solved, iterations);
        solves.then(|| solution().with_fallback(Some(Fallback::Softened)))
    });
    again.map_or(first, |answer| (solver.name(), answer))
}

/// Whether a solver is made for a model of friction; one that is not registered is thought to be.
fn takes(solver: &dyn Solver, model: Model) -> bool {
    let entry = lcplab_solver::entry(solver.name());
    entry.map_or(true, |entry| Method::Boxed(*entry).takes(Some(model)))
}

/// Whether a solver is made for A, or A is symmetric, which all are.
fn suits(solver: &dyn Solver, lcp: &Lcp) -> bool {
    use MatrixClass::{Definite, Semidefinite};
    let class = lcplab_solver::entry(solver.name()).ok().map(|entry| entry.class.matrix);
    lcp.matrix().is_nearly_symmetric() || !matches!(class, Some(Definite | Semidefinite))
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
