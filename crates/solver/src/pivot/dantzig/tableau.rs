//! The tableau: what the pivots so far have made of A, all of it.
//!
//! With C the free rows and B the others it is the symmetric matrix
//!
//! ```text
//! S_CC = −A_CC⁻¹,   S_CB = A_CC⁻¹ A_CB,   S_BB = A_BB − A_BC A_CC⁻¹ A_CB
//! ```
//!
//! so that row i of B has all that a move of x_i asks for: d_C = −S_iC, Δw_B = S_iB, and s = S_ii. Row k enters or
//! leaves C by a *sweep* (Beaton 1964; Goodnight 1979):
//!
//! ```text
//! s_ij ← s_ij − s_ik s_kj / s_kk,   s_ik ← ± s_ik / s_kk,   s_kk ← −1 / s_kk      + enters, − leaves
//! ```
//!
//! A sweep costs n² products. The factor of A_CC does a pivot with fewer, but in many short loops; up to some
//! hundred rows one long loop is faster. (To leave out the rows that have not been driven yet, and to make theirs from
//! A_iC S_CC when they are, halves the products, but then s is as wrong as a_ii ε times the condition of A_CC.)

use crate::kernel::Width;
use crate::kernel::tableau::Sweep;
use lcplab_problem::Matrix;

/// S, of which each row has the entries from its first block of eight on: what stands before is read from the column.
pub(super) struct Tableau {
    /// Rows of `stride` numbers from `start` on, each beginning where a line of the cache does; zeros behind the n-th.
    entries: Vec<f64>,
    start: usize,
    stride: usize,
    n: usize,
    /// Room for a sweep.
    factors: Vec<f64>,
    width: Width,
}

/// Numbers in a line of the cache.
const LINE: usize = 8;

impl Tableau {
    /// A itself: nothing is free.
    pub(super) fn of(matrix: &Matrix, width: Width) -> Self {
        let n = matrix.len();
        let stride = n.next_multiple_of(LINE);
        let entries = vec![0.0; n * stride + LINE];
        let start = entries.as_ptr().align_offset(8 * LINE).min(LINE);
        let mut own = Tableau { entries, start, stride, n, factors: vec![0.0; stride], width };
        own.reset(matrix);
        own
    }

    /// Becomes A again.
    pub(super) fn reset(&mut self, matrix: &Matrix) {
        for i in 0..self.n {
            let row = &mut self.entries[self.start + i * self.stride..][..self.n];
            row.fill(0.0);
            matrix.row(i).iter().for_each(|(j, a)| row[j] = a);
        }
    }

    /// Room for a row.
    pub(super) fn room(&self) -> Vec<f64> {
        vec![0.0; self.stride]
    }

    /// Row i, zeros behind the n-th entry.
    pub(super) fn read(&self, i: usize, row: &mut [f64]) {
        let table = &self.entries[self.start..];
        let first = i - i % LINE;
        for (s_ij, above) in row[..first].iter_mut().zip(table.chunks_exact(self.stride)) {
            *s_ij = above[i];
        }
        let own = &table[i * self.stride..][..self.stride];
        row[first..].copy_from_slice(&own[first..]);
    }

    /// Row k, which this is, enters C, sign = 1, or leaves it, sign = −1.
    pub(super) fn sweep(&mut self, k: usize, row: &[f64], sign: f64) {
        let table = &mut self.entries[self.start..][..self.n * self.stride];
        Sweep { table, k, row, sign, factors: &mut self.factors }.run(self.width);
    }
}
