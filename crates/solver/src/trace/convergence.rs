//! Records the convergence measures of a solver's iterates.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::{Iterate, Observer};
use lcplab_lcp::{Lcp, merit};

/// An observer that records the convergence measures of every iterate.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Pgs, Solver, Start};
/// use lcplab_solver::trace::Convergence;
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, -1.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let mut trace = Convergence::of(&lcp);
/// Pgs::default().solve(&lcp, &Start::default(), &mut trace);
/// let objective: Vec<f64> = trace.records.iter().map(|record| record.objective).collect();
/// assert!(objective.windows(2).all(|pair| pair[1] <= pair[0]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Convergence<'a> {
    lcp: &'a Lcp,
    /// Asks the solver to stop after this many iterations.
    pub limit: usize,
    /// Asks the solver to stop once the natural residual is below this fraction of the first; later
    /// changes are rounding.
    pub floor: f64,
    /// One record per iterate, the start first.
    pub records: Vec<Record>,
}

/// The convergence measures of one iterate.
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
        Convergence { lcp, limit: usize::MAX, floor: 0.0, records: Vec::new() }
    }

    /// The factor by which the natural residual shrinks per iteration: a least-squares line through
    /// its logarithms, over the last half of the records above the floor; `None` with fewer than
    /// ten of them.
    ///
    /// A line is used because residuals may oscillate: for Jacobi's method, whose eigenvalues come
    /// in pairs ±ρ, or SOR above ω*, where they are complex.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_solver::trace::Convergence;
    /// use lcplab_solver::{Pgs, Settings, Solver, Start};
    ///
    /// // Gauss-Seidel's rate is a₀₁² / (a₀₀ a₁₁) = ¼.
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// let mut trace = Convergence::of(&lcp);
    /// trace.floor = 1e-10; // what comes later is rounding
    /// let pgs = Pgs { settings: Settings::default().with_tolerance(0.0), ..Pgs::default() };
    /// pgs.solve(&lcp, &Start::default(), &mut trace);
    /// assert!((trace.rate().unwrap() - 0.25).abs() < 1e-4);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn rate(&self) -> Option<f64> {
        let residuals = self.records.iter().map(|record| record.natural_residual);
        let above: Vec<f64> =
            residuals.take_while(|residual| !self.is_rounding(*residual)).collect();
        let logs: Vec<f64> =
            above[above.len() / 2..].iter().map(|residual| residual.ln()).collect();
        if above.len() < 10 {
            return None;
        }
        let n = logs.len() as f64;
        let middle = (n - 1.0) / 2.0;
        // Σ (k − middle)²
        let spread = n * (n * n - 1.0) / 12.0;
        let slope: f64 = logs.iter().enumerate().map(|(k, log)| (k as f64 - middle) * log).sum();
        Some((slope / spread).exp())
    }

    fn is_rounding(&self, residual: f64) -> bool {
        let first = self.records.first().map_or(0.0, |record| record.natural_residual);
        residual <= self.floor * first
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
        let residual = self.records.last().map_or(f64::INFINITY, |last| last.natural_residual);
        if (self.floor > 0.0 && self.is_rounding(residual)) || iterate.iteration >= self.limit {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}
