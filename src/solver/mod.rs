//! Methods that solve an LCP, one a file, all behind one trait.
//!
//! A solver sees numbers only: no body, no contact. What it says of its own answer is its
//! [`Status`]; whether the answer is one is for [`certificate`](crate::certificate) to decide. Methods
//! for circular friction cones have a trait of their own, [`ConeSolver`].

mod active_set;
mod admm;
mod apgd;
mod block_pgs;
mod block_pivoting;
mod class;
mod code6;
mod cone;
mod dantzig;
mod dictionary;
mod elimination;
mod enumeration;
mod frozen;
mod interior_point;
mod iterate;
mod jacobi;
mod ldlt;
mod lemke;
mod metric;
mod mprgp;
mod murty;
mod newton;
mod nncg;
mod observer;
mod order;
mod pgs;
mod pivoting;
mod principal;
mod rational;
mod registry;
mod settings;
mod solution;
mod spectral;
mod standard_form;
pub mod theory;

pub use admm::Admm;
pub use apgd::Apgd;
pub use block_pgs::BlockPgs;
pub use block_pivoting::BlockPivoting;
pub use class::{Class, MatrixClass};
pub use code6::Code6;
pub use cone::{CONES, ConeEntry, ConePgs, ConeSolver, cone_by_name};
pub use dantzig::Dantzig;
pub use enumeration::{Enumeration, all_solutions};
pub use interior_point::InteriorPoint;
pub use jacobi::{Damping, Jacobi};
pub use lemke::Lemke;
pub use mprgp::Mprgp;
pub use murty::Murty;
pub use newton::{Equations, Newton};
pub use nncg::Nncg;
pub use observer::{Event, Iterate, Observer};
pub use order::Order;
pub use pgs::Pgs;
pub use registry::{ALL, Entry, Options, SPECIMENS, by_name, default_for, entry};
pub use settings::Settings;
pub use solution::{Solution, Status};
pub use spectral::Spectral;

use crate::lcp::{Complementarity, Lcp};

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
}

impl Start<'_> {
    /// The starting point: the guess or 0, moved into the bounds or cones.
    pub fn point(&self, problem: &impl Complementarity) -> Vec<f64> {
        let n = problem.lcp().len();
        let mut x = self.x.map_or_else(|| vec![0.0; n], <[f64]>::to_vec);
        assert_eq!(x.len(), n, "a start needs one entry a row");
        problem.project_all(&mut x);
        x
    }
}
