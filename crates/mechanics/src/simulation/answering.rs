//! Who solves a problem of a step: the simulation's solver where it is made for it, else another
//! one, by name.
//!
//! | the problem | the solver | else |
//! | --- | --- | --- |
//! | boxed | the simulation's, if its class has such A | of a method that pivots: the fallback sequence of the solver crate |
//! | polygons of few contacts | the simulation's, if it takes them, or Lemke's method | sweeps by contact |
//! | polygons of many contacts | sweeps by contact | the simulation's, or Lemke's method |
//! | polygons, not solved | the same, on rows that yield a little | the answer it gave |
//! | cones | the simulation's cone solver | |

use crate::formulation::{Posing, Problem};
use crate::scene::Scene;
use lcplab_problem::Lcp;
use lcplab_problem::friction::{Model, Polyhedral, ProblemForm};
use lcplab_solver::{
    self, ConeSolver, Fallback, Lemke, MatrixClass, Method, Observer, Options, PolygonPgs,
    Settings, Solution, Solver, Start, Status, solve_boxed_without, solve_polyhedral,
};

/// The solvers of a simulation.
#[derive(Clone, Copy)]
pub(super) struct Solvers<'a> {
    /// For LCPs.
    pub boxed: &'a dyn Solver,
    /// For cones.
    pub cone: &'a dyn ConeSolver,
    /// The scene with its settings.
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
            Some((_, ProblemForm::Boxed(lcp))) => self.boxed(lcp, &start, observer),
            Some((model, ProblemForm::Polyhedral(polyhedral))) => {
                let settings = settings(self.scene);
                let lemke = Lemke { settings: settings.clone() };
                let solver = if takes(self.boxed, model) { self.boxed } else { &lemke };
                by_polygons(solver, polyhedral, &start, &settings, observer)
            }
            Some((_, ProblemForm::Cone(cones))) => {
                (self.cone.name(), self.cone.solve(cones, &start, observer))
            }
        }
    }

    /// The simulation's solver if it is made for A. Where that pivots and is led astray, by
    /// friction limits that change on the way say, or is not made for A, the methods of the
    /// fallback sequence.
    fn boxed(
        self,
        lcp: &Lcp,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> (&'static str, Solution) {
        let name = self.boxed.name();
        let first = suits(self.boxed, lcp).then(|| self.boxed.solve(lcp, start, observer));
        let is_lost = |first: &Solution| {
            PIVOTING.contains(&name) && !matches!(first.status, Status::Solved | Status::Stopped)
        };
        if let Some(first) = first.as_ref().filter(|first| !is_lost(first)) {
            return (name, first.clone());
        }
        let options = Options { settings: settings(self.scene), ..Options::default() };
        let tried = first.as_ref().map_or("", |_| name);
        let next = solve_boxed_without(tried, lcp, start, &options, observer);
        match (next.solution.status.clone(), first) {
            (Status::Solved | Status::Stopped | Status::NoSolution, _) | (_, None) => {
                (next.solver, next.solution)
            }
            (_, Some(first)) => (name, first),
        }
    }
}

/// Methods that end at a solution or nowhere. Others come nearer with every sweep, and where they
/// end early that is what a user wants to see.
const PIVOTING: [&str; 4] = ["dantzig", "block-pivoting", "murty", "lemke"];

/// With more contacts than these, pivoting a polygon's LCP takes longer than sweeps.
const FEW_CONTACTS: usize = 8;

/// By how much rows yield where a polygon is not solved otherwise, in parts of A's diagonal.
const SOFTENINGS: [f64; 3] = [1e-12, 1e-10, 1e-9];

/// An answer, and who gave it.
type NamedSolution = (&'static str, Solution);
/// A way to get one.
type Attempt<'a> = &'a dyn Fn(&mut dyn Observer) -> NamedSolution;

/// Sweeps and pivots, in the order that suits the number of contacts. Redundant contacts make the
/// polyhedral LCP so degenerate that rounding leads pivots astray. Rows that yield are not
/// redundant; an answer of theirs counts if it solves the rigid problem too.
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
    let ends =
        |(_, answer): &NamedSolution| matches!(answer.status, Status::Solved | Status::Stopped);
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

/// Whether a solver is made for a friction model; one that is not registered is thought to be.
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
