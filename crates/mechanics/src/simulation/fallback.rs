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
use lcplab_lcp::Lcp;
use lcplab_lcp::friction::{Model, Polyhedral, ProblemForm};
use lcplab_solver::{
    BlockPivoting, ConeSolver, Dantzig, Entry, Fallback, Lemke, MatrixClass, Method, Murty,
    Observer, Options, PolygonPgs, Settings, Solution, Solver, Start, Status, solve_boxed_without,
    solve_polyhedral,
};

/// The solvers of a simulation.
#[derive(Clone, Copy)]
pub(super) struct Solvers<'a> {
    /// For LCPs.
    pub boxed: &'a dyn Solver,
    /// What it is made for; `None` if that is not known.
    pub entry: Option<&'a Entry>,
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
    ) -> NamedSolution {
        let start = Start::at(x);
        match posing.map(|posing| (posing.model, &posing.posed)) {
            None => self.boxed(&problem.lcp, &start, observer),
            Some((_, ProblemForm::Boxed(lcp))) => self.boxed(lcp, &start, observer),
            Some((model, ProblemForm::Polyhedral(polyhedral))) => {
                let settings = settings(self.scene);
                let lemke = Lemke { settings: settings.clone() };
                let solver = if self.takes(model) { self.boxed } else { &lemke };
                by_polygons(solver, polyhedral, &start, &settings, observer)
            }
            Some((_, ProblemForm::Cone(cones))) => {
                (self.cone.name().into(), self.cone.solve(cones, &start, observer))
            }
        }
    }

    /// The simulation's solver if it is made for A. Where that pivots and is led astray, by
    /// friction limits that change on the way say, or is not made for A, the methods of the
    /// fallback sequence.
    fn boxed(self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> NamedSolution {
        let name = self.boxed.name();
        let first = self.suits(lcp).then(|| self.boxed.solve(lcp, start, observer));
        let is_lost = |first: &Solution| {
            PIVOTING.contains(&name) && !matches!(first.status, Status::Solved | Status::Stopped)
        };
        let first = match first {
            Some(first) if !is_lost(&first) => return (name.into(), first),
            lost => lost,
        };
        let options = Options::default().with_settings(settings(self.scene));
        let tried = first.as_ref().map_or("", |_| name);
        let next = solve_boxed_without(tried, lcp, start, &options, observer);
        match (next.solution.status.clone(), first) {
            (Status::Solved | Status::Stopped | Status::NoSolution, _) | (_, None) => {
                (next.solver, next.solution)
            }
            (_, Some(first)) => (name.into(), first),
        }
    }

    /// Whether the solver is made for a friction model; one of which nothing is known is thought to
    /// be.
    fn takes(&self, model: Model) -> bool {
        self.entry.is_none_or(|entry| Method::Boxed(entry.clone()).takes(Some(model)))
    }

    /// Whether the solver is made for A, or A is symmetric, which all are.
    fn suits(&self, lcp: &Lcp) -> bool {
        use MatrixClass::{Definite, Semidefinite};
        let class = self.entry.map(|entry| entry.class.matrix);
        lcp.matrix().is_nearly_symmetric() || !matches!(class, Some(Definite | Semidefinite))
    }
}

/// Methods that end at a solution or nowhere. Others come nearer with every sweep, and where they
/// end early that is what a user wants to see.
const PIVOTING: [&str; 4] = [Dantzig::NAME, BlockPivoting::NAME, Murty::NAME, Lemke::NAME];

/// With more contacts than these, pivoting a polygon's LCP takes longer than sweeps.
const FEW_CONTACTS: usize = 8;

/// By how much rows yield where a polygon is not solved otherwise, in parts of A's diagonal.
const SOFTENINGS: [f64; 3] = [1e-12, 1e-10, 1e-9];

/// An answer, and who gave it.
pub(super) type NamedSolution = (String, Solution);
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
) -> NamedSolution {
    let tolerance = settings.tolerance;
    let sweeps = PolygonPgs { settings: settings.clone() };
    let swept: Attempt<'_> =
        &|observer| (PolygonPgs::NAME.into(), sweeps.solve(polyhedral, start, observer));
    let pivoted: Attempt<'_> = &|observer| {
        (solver.name().into(), solve_polyhedral(solver, polyhedral, start, tolerance, observer))
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
    again.map_or(first, |answer| (solver.name().into(), answer))
}

/// The scene's settings of solvers.
pub(super) fn settings(scene: &Scene) -> Settings {
    Settings::default()
        .with_tolerance(scene.solver.tolerance)
        .with_max_iterations(scene.solver.max_iterations)
        .with_memory(scene.memory)
}
