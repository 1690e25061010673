//! Block projected Gauss-Seidel: a contact with its friction, or a joint, at a time.
//!
//! ```text
//! for each block B:   x_B ← the solution y of   w_B = A_BB y + (b_B + Σ_{j∉B} a_Bj x_j)
//!                                               within the bounds of B
//! ```
//!
//! [`Pgs`](crate::Pgs) is the case of one row per block. The rows of a contact or joint act on the
//! same two bodies and are strongly coupled. Solving them together saves sweeps, and each friction
//! row is bounded by the normal impulse computed with it, not by the previous one. Each small
//! problem is solved exactly by [`Dantzig`]'s method, which also handles a singular A_BB. For
//! symmetric positive semidefinite A no block update raises the objective ½ xᵀAx + bᵀx; for a
//! definite A, x converges to the solution (block coordinate descent; Luo & Tseng 1992). While no
//! bound is active, the error shrinks by the spectral radius of the block Gauss-Seidel matrix,
//! which for Stieltjes matrices is never above that of the row method.
//!
//! If a block has no solution, the method ends with the status of that block. A sweep costs one
//! product A x and the small solves.

use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::theory::principal_submatrix;
use crate::tolerances::BLOCK_TOLERANCE;
use crate::{Dantzig, Event, Observer, Settings, Solution, Solver, Start, Status};
use lcplab_lcp::{Coupling, Lcp};

/// Block projected Gauss-Seidel.
#[derive(Debug, Clone)]
pub struct BlockPgs {
    /// A normal row and the friction rows that it bounds are one block; other rows form blocks of
    /// this many consecutive rows: 3 for ball joints.
    pub rows_per_block: usize,
    /// The common settings; an iteration is a sweep over all blocks.
    pub settings: Settings,
}

impl Default for BlockPgs {
    fn default() -> Self {
        BlockPgs { rows_per_block: 3, settings: Settings::default() }
    }
}

impl BlockPgs {
    /// Its name in the registry.
    pub const NAME: &'static str = "block-pgs";
}

impl Solver for BlockPgs {
    fn name(&self) -> &str {
        BlockPgs::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let blocks = blocks(lcp, self.rows_per_block);
        let blocks: Vec<Block> = blocks.into_iter().map(|rows| Block::of(lcp, rows)).collect();
        iterate(lcp, x, 0, &self.settings, observer, |x| {
            let before = x.to_vec();
            for block in &blocks {
                if let Err(status) = block.solve(lcp, x) {
                    x.copy_from_slice(&before);
                    return ControlFlow::Break(status);
                }
            }
            ControlFlow::Continue(Event::Sweep)
        })
    }
}

/// The blocks of rows, in the order of their first rows.
fn blocks(lcp: &Lcp, rows_per_block: usize) -> Vec<Vec<usize>> {
    let friction = lcp.coupling().map_or_else(Vec::new, Coupling::tangents);
    let contacts = friction.into_iter().enumerate().filter(|(_, tangents)| !tangents.is_empty());
    let mut blocks: Vec<Vec<usize>> =
        contacts.map(|(k, tangents)| [vec![k], tangents].concat()).collect();
    let mut is_single = vec![true; lcp.len()];
    blocks.iter().flatten().for_each(|&i| is_single[i] = false);
    let others: Vec<usize> = (0..lcp.len()).filter(|&i| is_single[i]).collect();
    let consecutive = others.chunk_by(|i, j| i + 1 == *j);
    blocks.extend(consecutive.flat_map(|run| run.chunks(rows_per_block.max(1))).map(<[_]>::to_vec));
    blocks.sort_by_key(|rows| rows.iter().min().copied());
    blocks
}

struct Block {
    rows: Vec<usize>,
    /// A, bounds and coupling of the block; its b changes with x.
    lcp: Lcp,
    solver: Dantzig,
}

impl Block {
    fn of(whole: &Lcp, rows: Vec<usize>) -> Block {
        let of_rows = |values: &[f64]| rows.iter().map(|&i| values[i]).collect::<Vec<_>>();
        let matrix = principal_submatrix(whole.matrix(), &rows);
        let (lo, hi) = (of_rows(whole.lo()), of_rows(whole.hi()));
        let mut lcp =
            Lcp::new(matrix, of_rows(whole.b()), lo, hi).expect("part of a valid problem");
        if let Some(coupling) = whole.coupling() {
            let place = |k: usize| rows.iter().position(|&row| row == k);
            let index = rows.iter().map(|&i| coupling.index(i).and_then(place)).collect();
            let mu = rows.iter().map(|&i| coupling.mu(i)).collect();
            let coupling = Coupling::new(index, mu).expect("part of a valid coupling");
            lcp = lcp.with_coupling(coupling).expect("part of a valid problem");
        }
        let settings = Settings { tolerance: BLOCK_TOLERANCE, ..Settings::default() };
        Block { rows, lcp, solver: Dantzig { settings } }
    }

    /// Replaces x_B by the solution of the block.
    fn solve(&self, whole: &Lcp, x: &mut [f64]) -> Result<(), Status> {
        let x_block: Vec<f64> = self.rows.iter().map(|&i| x[i]).collect();
        let own = self.lcp.matrix();
        let b = self.rows.iter().enumerate();
        let b = b.map(|(k, &i)| whole.row_w(i, x) - own.row_dot(k, &x_block)).collect();
        let lcp = self.lcp.with_b(b).map_err(|_| Status::Diverged)?;
        let solution = self.solver.solve(&lcp, &Start::at(&x_block), &mut ());
        match solution.status {
            Status::Ray { row, direction } => return Err(self.ray(row, &direction, x.len())),
            Status::Singular { row } => return Err(Status::Singular { row: self.rows[row] }),
            Status::OutsideClass { .. } => return Err(solution.status),
            _ => {}
        }
        for (&i, value) in self.rows.iter().zip(&solution.x) {
            x[i] = *value;
        }
        Ok(())
    }

    /// Extends a ray of the block to the whole problem: for semidefinite A, A_BB d = 0 implies A d
    /// = 0.
    fn ray(&self, row: usize, block_direction: &[f64], n: usize) -> Status {
        let mut direction = vec![0.0; n];
        for (&i, d) in self.rows.iter().zip(block_direction) {
            direction[i] = *d;
        }
        Status::Ray { row: self.rows[row], direction }
    }
}
