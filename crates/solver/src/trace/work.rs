//! What an answer costs, in a measure that is the same on every machine.

use std::ops::ControlFlow;

use crate::{Event, Iterate, Observer};
use lcplab_problem::{Lcp, merit};

/// An observer that adds up the multiplications of a solve, as the formula of each method has them.
///
/// With n rows, s stored entries of A and f free rows:
///
/// ```text
/// a product A x                                    s
/// pgs, sor, red-black, jacobi       a sweep        s + n
/// ssor                              a sweep        2 (s + n)
/// block-pgs                         a sweep        s + 10 n     blocks of three rows
/// nncg                              a sweep        s + 5 n
/// apgd, spectral, mprgp             a step         2 s + 5 n
/// admm                              a step         n²           and n³/6 once
/// interior-point                    a step         n³/6 + 2 n² + s
/// newton, fischer-newton            a step         5/3 n³       a sweep where it takes one: s + n
/// dantzig                           a pivot        f n
/// lemke                             a pivot        n (n + 2)
/// murty, block-pivoting             an exchange    f³/3 + f² + s   and once for the first active set;
///                                                                  the most, where A is symmetric
/// enumeration                       a set          n³/3         of fractions
/// ```
///
/// That is the leading term of the method, not a count of instructions: stop tests, of which each is
/// another product, line searches and additions are left out.
///
/// ```
/// use lcplab_problem::{Lcp, Matrix};
/// use lcplab_solver::{by_name, Options, Start};
/// use lcplab_solver::trace::Work;
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let mut work = Work::of("pgs", &lcp);
/// by_name("pgs", &Options::default())?.solve(&lcp, &Start::default(), &mut work);
/// assert_eq!(work.multiplications, 6.0); // one sweep: four entries, two divisions
/// # Ok::<(), lcplab_problem::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Work<'a> {
    solver: &'static str,
    lcp: &'a Lcp,
    stored: f64,
    /// So far.
    pub multiplications: f64,
}

impl<'a> Work<'a> {
    /// None so far, of the solver of this name on this problem.
    pub fn of(solver: &'static str, lcp: &'a Lcp) -> Self {
        let n = lcp.len() as f64;
        let multiplications = if solver == "admm" { n.powi(3) / 6.0 } else { 0.0 };
        Work { solver, lcp, stored: lcp.matrix().stored() as f64, multiplications }
    }

    /// The multiplications of an iteration that led to x.
    fn iteration(&self, event: Event, x: &[f64]) -> f64 {
        let (n, s) = (self.lcp.len() as f64, self.stored);
        let free = || merit::free_rows(self.lcp, x) as f64;
        match (self.solver, event) {
            ("murty" | "block-pivoting", _) => {
                let f = free();
                f.powi(3) / 3.0 + f * f + s
            }
            (_, Event::Start) => 0.0,
            ("ssor", _) => 2.0 * (s + n),
            ("block-pgs", _) => s + 10.0 * n,
            ("nncg", _) => s + 5.0 * n,
            ("apgd" | "spectral" | "mprgp", _) => 2.0 * s + 5.0 * n,
            ("admm", _) => n * n,
            ("interior-point", _) => n.powi(3) / 6.0 + 2.0 * n * n + s,
            ("newton" | "fischer-newton", Event::Step) => 5.0 / 3.0 * n.powi(3),
            ("dantzig", _) => free() * n,
            ("lemke", _) => n * (n + 2.0),
            ("enumeration", _) => n.powi(3) / 3.0,
            _ => s + n,
        }
    }
}

impl Observer for Work<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.multiplications += self.iteration(iterate.event, iterate.x);
        ControlFlow::Continue(())
    }
}
