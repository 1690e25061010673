//! Small problems and what the library's solvers make of them.

use std::ops::ControlFlow;

use nalgebra::DMatrix;

use crate::error::Result;
use crate::lcp::{Lcp, Matrix};
use crate::solver::{Iterate, Observer, Options, Settings, Start, by_name};

/// w = A x + b ≥ 0, x ≥ 0, with A by rows.
pub(super) fn contacts(a: &[f64], b: &[f64]) -> Result<Lcp> {
    let n = b.len();
    Lcp::new(Matrix::dense(n, a), b.to_vec(), vec![0.0; n], vec![f64::INFINITY; n])
}

/// A x + b = 0, with A by rows.
pub(super) fn equations(a: &[f64], b: &[f64]) -> Result<Lcp> {
    let n = b.len();
    let (lo, hi) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
    Lcp::new(Matrix::dense(n, a), b.to_vec(), lo, hi)
}

/// J M⁻¹ Jᵀ by rows, for point masses that move along one line.
pub(super) fn delassus(j: &DMatrix<f64>, inverse_mass: &[f64]) -> Vec<f64> {
    let m_inv = DMatrix::from_fn(inverse_mass.len(), inverse_mass.len(), |r, c| {
        if r == c { inverse_mass[r] } else { 0.0 }
    });
    (j * m_inv * j.transpose()).as_slice().to_vec() // symmetric: by columns is by rows
}

/// x by the solver of this name, from 0.
pub(super) fn answer(solver: &str, lcp: &Lcp) -> Result<Vec<f64>> {
    Ok(by_name(solver, &Options::default())?.solve(lcp, &Start::default(), &mut ()).x)
}

/// The start, 0, and x after each sweep of projected Gauss-Seidel.
pub(super) fn sweeps(lcp: &Lcp, count: usize) -> Result<Vec<Vec<f64>>> {
    let settings = Settings { tolerance: 0.0, max_iterations: count, ..Settings::default() };
    let mut kept = Kept(Vec::new());
    by_name("pgs", &Options { settings, ..Options::default() })?.solve(
        lcp,
        &Start::default(),
        &mut kept,
    );
    Ok(kept.0)
}

struct Kept(Vec<Vec<f64>>);

impl Observer for Kept {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.0.push(iterate.x.to_vec());
        ControlFlow::Continue(())
    }
}

/// The entry that is largest in size.
pub(super) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}
