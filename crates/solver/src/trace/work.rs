//! The cost of an answer, in a machine-independent measure.

use std::ops::ControlFlow;

use crate::{Entry, Event, Iterate, Observer};
use lcplab_lcp::{Lcp, merit};

/// An observer that adds up the multiplications of a solve according to the cost formula of the
/// method.
///
/// Each entry of the registry states its [`Cost`]: a product A x is s multiplications, s being the
/// stored entries of A, and a factorization of f free rows f³/3.
///
/// This is the leading term, not a count of instructions: stop tests (one product each), line
/// searches and additions are not included.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Pgs, Registry, Solver, Start};
/// use lcplab_solver::trace::Work;
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let mut work = Work::of(Registry::standard().entry(Pgs::NAME)?, &lcp);
/// Pgs::default().solve(&lcp, &Start::default(), &mut work);
/// assert_eq!(work.multiplications, 6.0); // one sweep: four entries, two divisions
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Work<'a> {
    cost: Cost,
    lcp: &'a Lcp,
    stored: f64,
    /// The multiplications so far.
    pub multiplications: f64,
}

impl<'a> Work<'a> {
    /// A counter at zero, for a solver on this problem.
    pub fn of(entry: &Entry, lcp: &'a Lcp) -> Self {
        let stored = lcp.matrix().stored() as f64;
        Work { cost: entry.cost, lcp, stored, multiplications: 0.0 }
    }
}

impl Observer for Work<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let (n, stored) = (self.lcp.len() as f64, self.stored);
        let effort = Effort { event: iterate.event, n, stored, lcp: self.lcp, x: iterate.x };
        let cost = match iterate.event {
            Event::Start => self.cost.start,
            _ => self.cost.iteration,
        };
        self.multiplications += cost(&effort);
        ControlFlow::Continue(())
    }
}

/// The cost of the iterations of a method, in multiplications.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::trace::{Cost, Work};
/// use lcplab_solver::{Pgs, Registry, Solver, Start};
///
/// // A method that costs a product A x and one multiplication for each free row.
/// let mut entry = Registry::standard().entry("pgs")?.clone();
/// entry.cost = Cost::each("s + f", |effort| effort.stored + effort.free());
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?; // x = (½, 0)
/// let mut work = Work::of(&entry, &lcp);
/// Pgs::default().solve(&lcp, &Start::default(), &mut work);
/// assert_eq!(work.multiplications, 5.0); // one sweep: four entries, one free row
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Cost {
    /// The formula as text: n rows, s stored entries of A, f free rows.
    pub formula: &'static str,
    /// The cost before the first iteration.
    pub start: fn(&Effort<'_>) -> f64,
    /// The cost of each iteration.
    pub iteration: fn(&Effort<'_>) -> f64,
}

impl Cost {
    /// The cost is unknown.
    pub const UNKNOWN: Cost =
        Cost { formula: "unknown", start: |_| f64::NAN, iteration: |_| f64::NAN };

    /// A fixed formula per iteration, and no start cost.
    pub const fn each(formula: &'static str, iteration: fn(&Effort<'_>) -> f64) -> Cost {
        Cost { formula, start: |_| 0.0, iteration }
    }
}

/// An iteration, as input of the cost formulas.
pub struct Effort<'a> {
    /// Its event.
    pub event: Event,
    /// The number of rows.
    pub n: f64,
    /// The number of stored entries of A.
    pub stored: f64,
    lcp: &'a Lcp,
    x: &'a [f64],
}

impl Effort<'_> {
    /// The number of free rows after the iteration.
    pub fn free(&self) -> f64 {
        merit::free_rows(self.lcp, self.x) as f64
    }

    /// Whether A is symmetric.
    pub(crate) fn is_symmetric(&self) -> bool {
        self.lcp.matrix().is_symmetric()
    }
}
