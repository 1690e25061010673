//! Methods that solve an LCP, one a file, all behind one trait.
//!
//! A solver sees numbers only: no body, no contact. What it says of its own answer is its
//! [`Status`]; whether the answer is one is for the judge, the crate `lcplab-judge`, to decide. Methods
//! for circular friction cones have a trait of their own, [`ConeSolver`].
//!
//! # Four families, a page a method
//!
//! **Splitting.** Solve row i for x_i while the others wait, clamp, go on; after enough sweeps nothing
//! moves any more. A sweep is cheap, can be stopped at any time, and starts from the last step's
//! answer; but news travels one row at a time, so tall stacks and large mass ratios need thousands of
//! sweeps ([`theory`] says how many). [`pgs`] (and SOR, symmetric SOR and colours, by [`order`]),
//! [`jacobi`], [`block_pgs`]; [`code6`] is the chapter's listing as printed, which is something else.
//! The same sweeps arranged for speed are [`kernel`]s.
//!
//! **Pivoting.** A solution is known once it is known which rows are at which bound. Pivoting methods
//! guess that set, look for a row that contradicts, and exchange it; they end after finitely many
//! exchanges with an answer that is exact but for rounding, or with a [ray](Status::Ray). [`dantzig`]
//! for symmetric semidefinite A, [`lemke`] for much more, [`murty`] and [`block_pivoting`] for
//! P-matrices, [`enumeration`] for all solutions of small problems of any kind. In the worst case
//! they need 2ⁿ exchanges; contacts are not the worst case.
//!
//! **Newton.** Complementarity is an equation that is not smooth, min(x, w) = 0 or Fischer-Burmeister's;
//! Newton's method solves it in a handful of steps, each a linear system of the size of the problem.
//! [`newton`]; and [`interior_point`], which smooths the corner and lets the smoothing go to zero.
//!
//! **First order.** For symmetric semidefinite A the problem is a minimisation over a box, and every
//! method for that serves: gradients with memory ([`apgd`], [`spectral`]), conjugate gradients that
//! know of bounds ([`mprgp`], [`nncg`]), operator splitting ([`admm`]). Products with A and nothing
//! else, and far fewer of them than sweeps.
//!
//! The same methods as a student writes them are in [`textbook`].
//!
//! Friction rows whose bounds follow another row are solved in the sweep, or by [`frozen`] bounds.

mod active_set;
pub mod admm;
pub mod apgd;
pub mod block_pgs;
pub mod block_pivoting;
pub mod cholesky;
mod class;
pub mod code6;
mod cone;
pub mod dantzig;
mod dictionary;
pub mod elimination;
pub mod enumeration;
pub mod envelope;
mod equations;
mod free_rows;
pub mod frozen;
pub mod interior_point;
mod iterate;
pub mod jacobi;
pub mod kernel;
pub mod ldlt;
pub mod lemke;
mod method;
mod metric;
pub mod mprgp;
pub mod murty;
pub mod newton;
pub mod nncg;
mod observer;
pub mod order;
pub mod pgs;
mod pivoting;
mod polygon_pgs;
mod principal;
mod proximal;
mod ratio_test;
mod registry;
mod settings;
mod solution;
pub mod sparse_factor;
pub mod spectral;
mod standard_form;
mod stop;
pub mod textbook;
pub mod theory;
pub mod trace;
mod variable;
mod warm;

pub use admm::Admm;
pub use apgd::Apgd;
pub use block_pgs::BlockPgs;
pub use block_pivoting::BlockPivoting;
pub use class::{Class, MatrixClass};
pub use code6::Code6;
pub use cone::{CONES, ConeEntry, ConePgs, ConeSolver, cone_by_name};
pub use dantzig::{Dantzig, Side};
pub use enumeration::Enumeration;
pub use equations::Equations;
pub use interior_point::InteriorPoint;
pub use jacobi::{Damping, Jacobi};
pub use lcplab_problem::exact::all_solutions;
pub use lemke::Lemke;
pub use method::{Method, methods, solve_polyhedral};
pub use mprgp::Mprgp;
pub use murty::Murty;
pub use newton::Newton;
pub use nncg::Nncg;
pub use observer::{Centring, Event, Iterate, Leaving, Move, Observer, Part, RowUpdate, Tableau};
pub use order::Order;
pub use pgs::Pgs;
pub use polygon_pgs::PolygonPgs;
pub use registry::{ALL, Choice, Entry, Options, SPECIMENS, by_name, default_for, entry};
pub use settings::Settings;
pub use solution::{Fallback, Solution, Status};
pub use spectral::Spectral;
pub use stop::{Reason, Stop, Watched};
pub use variable::Variable;
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
