//! The merits of a solver's iterates.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::{Iterate, Observer};
use lcplab_problem::{Lcp, merit};

/// An observer that records the merits of every iterate.
///
/// ```
/// use lcplab_problem::{Lcp, Matrix};
/// use lcplab_solver::{by_name, Options, Start};
/// use lcplab_solver::trace::Convergence;
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, -1.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let mut trace = Convergence::of(&lcp);
/// by_name("pgs", &Options::default())?.solve(&lcp, &Start::default(), &mut trace);
/// let objective: Vec<f64> = trace.records.iter().map(|record| record.objective).collect();
/// assert!(objective.windows(2).all(|pair| pair[1] <= pair[0]));
/// # Ok::<(), lcplab_problem::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Convergence<'a> {
    lcp: &'a Lcp,
    /// Ask the solver to stop after this many iterations.
    pub limit: usize,
    /// One record an iterate, the start first.
    pub records: Vec<Record>,
}

/// The merits of one iterate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// 0 for the start.
    pub iteration: usize,
    /// max_i r_i, dimensionless ([`merit::scaled_residual`]).
    pub scaled_residual: f64,
    /// max_i |x_i − Π(x_i − w_i)| ([`merit::natural_residual`]).
    pub natural_residual: f64,
    /// ½ xᵀAx + bᵀx.
    pub objective: f64,
    /// Rows strictly between their bounds.
    pub free_rows: usize,
}

impl<'a> Convergence<'a> {
    /// A trace of iterates for this problem.
    pub fn of(lcp: &'a Lcp) -> Self {
        Convergence { lcp, limit: usize::MAX, records: Vec::new() }
    }

    /// The factor by which the natural residual shrinks an iteration, measured over the last half
    /// of the records that lie between `floor` and the start; `None` with fewer than ten of them.
    pub fn rate(&self, floor: f64) -> Option<f64> {
        let above: Vec<&Record> =
            self.records.iter().take_while(|r| r.natural_residual > floor).collect();
        if above.len() < 10 {
            return None;
        }
        let (first, last) = (above[above.len() / 2], above[above.len() - 1]);
        let ratio = last.natural_residual / first.natural_residual;
        Some(ratio.powf(1.0 / (last.iteration - first.iteration) as f64))
    }
}

impl Observer for Convergence<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.records.push(Record {
            iteration: iterate.iteration,
            scaled_residual: merit::scaled_residual(self.lcp, iterate.x),
            natural_residual: merit::natural_residual(self.lcp, iterate.x),
            objective: merit::objective(self.lcp, iterate.x),
            free_rows: merit::free_rows(self.lcp, iterate.x),
        });
        if iterate.iteration >= self.limit {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}
