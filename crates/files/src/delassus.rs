//! Computes A = J M⁻¹ Jᵀ and J M⁻¹ f, for files that store M, J and f.
//!
//! M is factored once, by sparse Cholesky if it is symmetric, otherwise by sparse LU. Each column
//! of A is one solve, M y = J_iᵀ, and one product per row of J. A step of iterative refinement, y +
//! M⁻¹ (J_iᵀ − M y), removes most of the rounding error of a solve and estimates it: an M so badly
//! conditioned that only a few digits of A would be correct is rejected. For symmetric M the lower
//! triangle of A is computed and mirrored, so A is exactly symmetric.

use faer::Mat;
use faer::Side;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::Entries;
use lcplab_lcp::memory::Memory;

/// Row, column and value.
pub(super) type Entry = (usize, usize, f64);

/// Up to this number of rows A is always stored densely.
const SMALL: usize = 32;
/// Above SMALL rows, A is stored densely if at least this fraction of its entries is nonzero.
const FULL: f64 = 0.25;

/// Limit on the relative change of a solution in the refinement step.
const INACCURATE: f64 = 1e-8;

/// Memory for an entry of A in a list of entries and in the resulting matrix (bytes).
const ENTRY: usize = 48;

/// A motion M v = f + Jᵀx with its constraints J.
pub(super) struct Motion {
    /// The entries of M, k × k.
    pub mass: Vec<Entry>,
    /// The rows of J, k columns.
    pub jacobian: Vec<Vec<(usize, f64)>>,
    /// f, k entries.
    pub force: Vec<f64>,
}

impl Motion {
    /// J M⁻¹ Jᵀ + diag(`compliance`), and J M⁻¹ f; messages refer to M as `name`.
    ///
    /// # Errors
    /// If M is symmetric but not positive definite, a single triangle of a matrix, or too badly
    /// conditioned, or if A exceeds the memory limit, which even a small file can cause.
    pub fn dual(
        &self,
        compliance: &[f64],
        name: &str,
        input: &str,
        most: Memory,
    ) -> Result<(Entries, Vec<f64>)> {
        let fault = |reason: &str| Error::invalid(input, name, reason);
        let is_symmetric = is_symmetric(&self.mass);
        let factor = self.factor(is_symmetric).map_err(fault)?;
        let solve = |right: &[f64]| self.solution(&factor, right).map_err(fault);
        let free = solve(&self.force)?;
        let mut triplets = Vec::new();
        for (i, row) in self.jacobian.iter().enumerate() {
            let others = if is_symmetric { &self.jacobian[..=i] } else { &self.jacobian[..] };
            let needs = Memory::bytes(ENTRY as u64).times(triplets.len() + 2 * others.len());
            most.check(format!("{input}: A of {} rows", self.jacobian.len()), needs)?;
            let mut right = vec![0.0; self.force.len()];
            row.iter().for_each(|&(c, value)| right[c] += value);
            let y = solve(&right)?;
            for (j, other) in others.iter().enumerate() {
                let a = dot(other, &y) + if i == j { compliance[i] } else { 0.0 };
                if a != 0.0 {
                    triplets.push((j, i, a));
                }
                if a != 0.0 && i != j && is_symmetric {
                    triplets.push((i, j, a));
                }
            }
        }
        let b = self.jacobian.iter().map(|row| dot(row, &free)).collect();
        Ok((entries(self.jacobian.len(), triplets), b))
    }

    /// Factors M.
    fn factor(&self, is_symmetric: bool) -> std::result::Result<Factor, &'static str> {
        let k = self.force.len();
        let triplets: Vec<_> =
            self.mass.iter().map(|&(row, col, val)| Triplet { row, col, val }).collect();
        let mass = SparseColMat::<usize, f64>::try_new_from_triplets(k, k, &triplets);
        let mass = mass.map_err(|_| "is too large")?;
        if is_symmetric {
            let factor = mass.sp_cholesky(Side::Lower).map_err(|_| "is not positive definite")?;
            return Ok(Box::new(move |right| factor.solve(right)));
        }
        let is_below = |&(i, j, value): &Entry| i > j && value != 0.0;
        let is_above = |&(i, j, value): &Entry| i < j && value != 0.0;
        if !self.mass.iter().any(is_below) || !self.mass.iter().any(is_above) {
            return Err(
                "has entries on one side of its diagonal only: all of M is required, not one triangle",
            );
        }
        let factor = mass.sp_lu().map_err(|_| "is singular")?;
        Ok(Box::new(move |right| factor.solve(right)))
    }

    /// M⁻¹ `right`, with one refinement step.
    fn solution(
        &self,
        factor: &Factor,
        right: &[f64],
    ) -> std::result::Result<Vec<f64>, &'static str> {
        let once = |right: &[f64]| -> Vec<f64> {
            factor(&Mat::from_fn(right.len(), 1, |i, _| right[i])).col(0).iter().copied().collect()
        };
        let size = |y: &[f64]| y.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
        let mut y = once(right);
        let mut rest = right.to_vec();
        self.mass.iter().for_each(|&(i, j, value)| rest[i] -= value * y[j]);
        let change = once(&rest);
        let is_finite = y.iter().chain(&change).all(|y| y.is_finite());
        if !is_finite || size(&change) > INACCURATE * size(&y) {
            return Err("is singular, or so ill-conditioned that A would have few correct digits");
        }
        y.iter_mut().zip(change).for_each(|(y, change)| *y += change);
        Ok(y)
    }
}

/// A factored matrix, as a function that solves with it.
type Factor = Box<dyn Fn(&Mat<f64>) -> Mat<f64>>;

/// Whether the entries, which may repeat positions, form a symmetric matrix.
pub(super) fn is_symmetric(entries: &[Entry]) -> bool {
    let sorted = |key: fn(&Entry) -> Entry| {
        let mut entries: Vec<Entry> = entries.iter().map(key).filter(|e| e.2 != 0.0).collect();
        entries.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        entries
    };
    sorted(|e| *e) == sorted(|&(i, j, value)| (j, i, value))
}

fn dot(row: &[(usize, f64)], y: &[f64]) -> f64 {
    row.iter().map(|&(c, value)| value * y[c]).sum()
}

fn entries(n: usize, triplets: Vec<(usize, usize, f64)>) -> Entries {
    if n > SMALL && (triplets.len() as f64) < FULL * (n * n) as f64 {
        return Entries::Sparse(triplets);
    }
    let mut dense = vec![0.0; n * n];
    for (i, j, a) in triplets {
        dense[i * n + j] += a;
    }
    Entries::Dense(dense)
}
