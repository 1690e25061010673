//! Helpers of the exhibits: small problems, iterates of sweeps, checked products, figures.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};

use super::Outcome;
use crate::body::State;
use crate::constraint::Constraint;
use crate::error::{Error, Result};
use crate::lcp::{Lcp, Matrix};
use crate::solver::{
    Damping, Iterate, Observer, Options, Registry, Settings, Start, all_solutions,
};

/// w = A x + b ≥ 0, x ≥ 0, with A by rows.
pub(super) fn contacts(a: &[f64], b: &[f64]) -> Result<Lcp> {
    bounded(Matrix::dense(b.len(), a), b, 0.0)
}

/// w = A x + b = 0 for any x, with A by rows.
pub(super) fn equations(a: &[f64], b: &[f64]) -> Result<Lcp> {
    bounded(Matrix::dense(b.len(), a), b, f64::NEG_INFINITY)
}

/// The problem with this lower bound in all rows, and no upper bound.
pub(super) fn bounded(a: Matrix, b: &[f64], lo: f64) -> Result<Lcp> {
    Lcp::new(a, b.to_vec(), vec![lo; b.len()], vec![f64::INFINITY; b.len()])
}

/// tridiag(−1, 2, −1) with this first diagonal entry: 2 for a chain, 1 for a column on the ground.
pub(super) fn tridiagonal(n: usize, first: f64) -> Matrix {
    let diagonal = (0..n).map(|i| (i, i, if i == 0 { first } else { 2.0 }));
    let beside = (1..n).flat_map(|i| [(i, i - 1, -1.0), (i - 1, i, -1.0)]);
    Matrix::sparse(n, &diagonal.chain(beside).collect::<Vec<_>>())
}

/// All isolated solutions, found in exact arithmetic by trying every active set, then rounded.
pub(super) fn enumerated(lcp: &Lcp) -> Vec<Vec<f64>> {
    let solutions = all_solutions(lcp).unwrap_or_default();
    solutions.iter().map(|x| x.iter().map(|x| x.to_f64().value()).collect()).collect()
}

/// A solver's answer, starting from 0.
pub(super) fn answer(solver: &str, lcp: &Lcp) -> Result<Vec<f64>> {
    let solver = Registry::standard().entry(solver)?.build(&Options::default());
    Ok(solver.solve(lcp, &Start::default(), &mut ()).x)
}

/// The iterates of this number of sweeps, the start first, without a stop test. Jacobi is undamped.
pub(super) fn sweeps(
    solver: &str,
    lcp: &Lcp,
    start: &[f64],
    count: usize,
) -> Result<Vec<Vec<f64>>> {
    let settings = Settings::default()
        .with_tolerance(0.0)
        .with_max_iterations(count)
        .with_check_every(count + 1);
    let options = Options::default().with_settings(settings).with_damping(Damping::Factor(1.0));
    let mut kept = Kept(Vec::new());
    Registry::standard().entry(solver)?.build(&options).solve(lcp, &Start::at(start), &mut kept);
    Ok(kept.0)
}

struct Kept(Vec<Vec<f64>>);

impl Observer for Kept {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.0.push(iterate.x.to_vec());
        ControlFlow::Continue(())
    }
}

/// The entry with the largest absolute value.
pub(super) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// The last of some iterates.
pub(super) fn last(iterates: Vec<Vec<f64>>) -> Vec<f64> {
    iterates.into_iter().next_back().unwrap_or_default()
}

/// A B by columns, or why the shapes do not match.
pub(super) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Outcome {
    let ((m, k), (l, n)) = (a.shape(), b.shape());
    if k != l {
        return Outcome::Impossible(format!("no product: {m} × {k} by {l} × {n}"));
    }
    Outcome::from((a * b).as_slice().to_vec())
}

/// J M⁻¹ Jᵀ by rows, for point masses that move along one line.
pub(super) fn delassus(j: &DMatrix<f64>, inverse_mass: &[f64]) -> Vec<f64> {
    let m_inv = DMatrix::from_diagonal(&DVector::from_row_slice(inverse_mass));
    // The matrix is symmetric, so the order by columns is that by rows.
    (j * m_inv * j.transpose()).as_slice().to_vec()
}

/// J of a constraint between the world and a body in this state: n × 6.
pub(super) fn jacobian(constraint: &dyn Constraint, body: &State) -> Result<DMatrix<f64>> {
    let rows = constraint
        .rows([&State::WORLD, body])
        .map_err(|cause| Error::invalid("exhibit", "constraint", cause.to_string()))?;
    Ok(DMatrix::from_fn(rows.len(), 6, |i, k| rows[i].jacobian[1][k]))
}

/// The rank, computed from singular values.
pub(super) fn rank(j: &DMatrix<f64>) -> f64 {
    j.rank(1e-9) as f64
}

/// Values as points with this spacing, the first at 0.
pub(super) fn spaced(values: &[f64], spacing: f64) -> Vec<(f64, f64)> {
    values.iter().enumerate().map(|(k, &value)| (k as f64 * spacing, value)).collect()
}
