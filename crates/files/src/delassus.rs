//! From velocities to impulses: A = J M⁻¹ Jᵀ and J M⁻¹ f, where a file holds M, J and f.
//!
//! M is factored by sparse Cholesky, and each row of A is one solve, M y = J_iᵀ, and a product a row
//! of J. The lower triangle is computed and mirrored, so A is symmetric to the last bit.

use faer::Mat;
use faer::Side;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

use lcplab_problem::error::Result;
use lcplab_problem::file::Entries;
use lcplab_problem::memory::Memory;

/// Up to this many rows A is dense, whatever its fill.
const SMALL: usize = 32;
/// Beyond SMALL, A is dense where at least this part of its entries is stored.
const FULL: f64 = 0.25;

/// What an entry of A takes in a list of entries, and in the matrix made of that (bytes).
const ENTRY: usize = 48;

/// A motion M v = f + Jᵀx with its constraints J.
pub(super) struct Motion {
    /// The entries of M, k × k and symmetric; its lower triangle is used.
    pub mass: Vec<(usize, usize, f64)>,
    /// The rows of J, k columns.
    pub jacobian: Vec<Vec<(usize, f64)>>,
    /// f, k entries.
    pub force: Vec<f64>,
}

impl Motion {
    /// J M⁻¹ Jᵀ + diag(`compliance`), and J M⁻¹ f; `None` if M is not positive definite.
    ///
    /// # Errors
    /// If A, which a file need not be large to ask for, takes more memory than this.
    pub fn dual(
        &self,
        compliance: &[f64],
        input: &str,
        most: Memory,
    ) -> Result<Option<(Entries, Vec<f64>)>> {
        let k = self.force.len();
        let triplets: Vec<_> =
            self.mass.iter().map(|&(row, col, val)| Triplet { row, col, val }).collect();
        let mass = SparseColMat::<usize, f64>::try_new_from_triplets(k, k, &triplets).ok();
        let factor = mass.and_then(|mass| mass.sp_cholesky(Side::Lower).ok());
        let Some(factor) = factor else { return Ok(None) };
        let solve = |right: Mat<f64>| factor.solve(&right).col(0).iter().copied().collect();
        let free: Vec<f64> = solve(Mat::from_fn(k, 1, |i, _| self.force[i]));
        let mut triplets = Vec::new();
        for (i, row) in self.jacobian.iter().enumerate() {
            let needs = Memory::bytes(ENTRY as u64).times(triplets.len() + 2 * i + 1);
            most.check(format!("{input}: A of {} rows", self.jacobian.len()), needs)?;
            let mut right = Mat::zeros(k, 1);
            row.iter().for_each(|&(c, value)| right[(c, 0)] += value);
            let y: Vec<f64> = solve(right);
            for (j, other) in self.jacobian[..=i].iter().enumerate() {
                let a = dot(other, &y) + if i == j { compliance[i] } else { 0.0 };
                if a != 0.0 {
                    triplets.push((i, j, a));
                }
                if a != 0.0 && i != j {
                    triplets.push((j, i, a));
                }
            }
        }
        let b = self.jacobian.iter().map(|row| dot(row, &free)).collect();
        Ok(Some((entries(self.jacobian.len(), triplets), b)))
    }
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
