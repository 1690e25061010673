//! Methods that solve an LCP, one a file, all behind one trait.
//!
//! A solver sees numbers only: no body, no contact. What it says of its own answer is its
//! [`Status`]; whether the answer is one is for the judge, the crate `lcplab-judge`, to decide.
//! Methods for circular friction cones have a trait of their own, [`ConeSolver`].
//!
//! # Four groups, a page a method
//!
//! | group | its methods | an iteration |
//! | --- | --- | --- |
//! | [`sweep`] | PGS, SOR, SSOR, colours, Jacobi, blocks | each row in turn, clamped |
//! | [`gradient`] | APGD, spectral, MPRGP, NNCG, ADMM | products with A |
//! | [`newton`] | Newton on two kinds of equations, interior point | a linear system |
//! | [`pivot`] | Dantzig, Lemke, Murty, blocks, enumeration | a row changes its bound |
//!
//! They stand on factorisations in [`linalg`] and on [`kernel`]s, the same sweeps and pivots
//! arranged for speed. [`theory`] predicts how fast they converge, [`trace`] records what they do.
//!
//! The same methods as a student writes them are in [`textbook`].
//!
//! Where no solver is named, a [fallback sequence](solve_by_sequence) of methods answers.
//!
//! Friction rows whose bounds follow another row are solved in the sweep, or by [`frozen`] bounds.

mod class;
mod cone;
pub mod frozen;
pub mod gradient;
mod iterate;
pub mod kernel;
pub mod linalg;
mod method;
mod metric;
pub mod newton;
mod observer;
pub mod pivot;
mod registry;
mod sequence;
mod settings;
mod solution;
mod stop;
pub mod sweep;
pub mod textbook;
pub mod theory;
pub mod trace;
mod warm;

pub use class::{Class, MatrixClass};
pub use cone::{CONES, ConeBuild, ConeEntry, ConeSolver, add_cone, added_cones, cone_by_name};
pub use gradient::{Admm, AndersonPgs, Apgd, Mprgp, Nncg, Spectral};
pub use lcplab_problem::exact::all_solutions;
pub use method::{Method, methods, nameable, solve_polyhedral};
pub use newton::{Equations, InteriorPoint, Newton};
pub use observer::{Centring, Event, Iterate, Leaving, Move, Observer, Part, RowUpdate, Tableau};
pub use pivot::{BlockPivoting, Dantzig, Enumeration, Lemke, Murty, Side, Variable};
pub use registry::{
    ALL, Build, Choice, Entry, Group, Options, SPECIMENS, add, added, by_name, default_for, entry,
};
pub use sequence::{
    Answered, Attempt, solve as solve_by_sequence, solve_boxed as solve_boxed_by_sequence,
    solve_boxed_without,
};
pub use settings::Settings;
pub use solution::{Fallback, Solution, Status};
pub use stop::{Reason, Stop, Watched};
pub use sweep::{BlockPgs, Code6, ConePgs, Damping, Jacobi, Order, Pgs, PolygonPgs};
pub use trace::{Cost, Effort};
pub use warm::Warm;

use lcplab_problem::{Complementarity, Lcp};

/// A method that solves boxed LCPs.
pub trait Solver: Send + Sync {
    /// The name in the registry, on the command line and in every table.
    fn name(&self) -> &'static str;

    /// Solves the problem from a start, telling the observer of each iterate.
    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution;
}

/// Where a solver starts.
#[derive(Debug, Clone, Copy, Default)]
pub struct Start<'a> {
    /// A guess of x (n entries), for example the last step's impulses; 0 without one.
    pub x: Option<&'a [f64]>,
    /// What the last solve of a similar problem has left, for those who go on from an active set.
    pub warm: Option<&'a Warm>,
}

impl<'a> Start<'a> {
    /// From a guess.
    pub fn at(x: &'a [f64]) -> Self {
        Start { x: Some(x), warm: None }
    }

    /// Lends what the last solve has left to this one, and keeps what this one leaves.
    fn carry<T>(&self, solve: impl FnOnce(&mut warm::Left) -> T) -> T {
        match self.warm {
            Some(warm) => warm.lend(solve),
            None => solve(&mut warm::Left::default()),
        }
    }

    /// The starting point: the guess or 0, moved into the bounds or cones.
    pub fn point(&self, problem: &impl Complementarity) -> Vec<f64> {
        let n = problem.lcp().len();
        let mut x = self.x.map_or_else(|| vec![0.0; n], <[f64]>::to_vec);
        assert_eq!(x.len(), n, "a start needs one entry a row");
        problem.project_all(&mut x);
        x
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
