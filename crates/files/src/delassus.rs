//! From velocities to impulses: A = J M⁻¹ Jᵀ and J M⁻¹ f, where a file holds M, J and f.
//!
//! M is factored once, by sparse Cholesky where it is symmetric and by sparse LU where it is not,
//! and each column of A is one solve, M y = J_iᵀ, and a product a row of J. A step of iterative
//! refinement, y + M⁻¹ (J_iᵀ − M y), takes away most of the rounding of a solve and shows how much
//! there was: an M so badly conditioned that few digits of A would be right is refused. Of a
//! symmetric M the lower triangle of A is computed and mirrored, so A is symmetric to the last bit.

use faer::Mat;
use faer::Side;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

use lcplab_problem::error::{Error, Result};
use lcplab_problem::file::Entries;
use lcplab_problem::memory::Memory;

/// A row, a column and the number there.
pub(super) type Entry = (usize, usize, f64);

/// Up to this many rows A is dense, whatever its fill.
const SMALL: usize = 32;
/// Beyond SMALL, A is dense where at least this part of its entries is stored.
const FULL: f64 = 0.25;

/// The part of a solution by which a step of refinement may change it.
const INACCURATE: f64 = 1e-8;

/// What an entry of A takes in a list of entries, and in the matrix made of that (bytes).
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
    /// J M⁻¹ Jᵀ + diag(`compliance`), and J M⁻¹ f; messages call M `name`.
    ///
    /// # Errors
    /// If M is symmetric and not positive definite, one triangle of a matrix, or too badly
    /// conditioned, or if A, which a file need not be large to ask for, takes more memory than
    /// this.
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

    /// M⁻¹ times a vector.
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

    /// M⁻¹ times `right`, refined once.
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

/// A factored matrix: its inverse times a vector.
type Factor = Box<dyn Fn(&Mat<f64>) -> Mat<f64>>;

/// Whether entries, of which several may stand at one place, are those of their transpose.
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
