//! A symmetric tableau: the matrix A after the pivots so far.
//!
//! With free rows C and other rows B it is the symmetric matrix
//!
//! ```text
//! S_CC = −A_CC⁻¹,   S_CB = A_CC⁻¹ A_CB,   S_BB = A_BB − A_BC A_CC⁻¹ A_CB
//! ```
//!
//! so that row i of B contains everything needed for a move of x_i: d_C = −S_iC, Δw_B = S_iB, and
//! s = S_ii. Row k enters or leaves C by a *sweep* (Beaton 1964; Goodnight 1979):
//!
//! ```text
//! s_ij ← s_ij − f_i s_kj,   s_ik ← ± f_i,   s_kk ← −1 / s_kk      f_i = s_ik / s_kk, + enters, − leaves
//! ```
//!
//! A sweep costs n²/2 products, but a single one is limited by memory bandwidth. f and row k are
//! therefore kept until several sweeps can be applied in one pass. A row that is needed meanwhile
//! is updated alone. Each entry sees the same operations in the same order as without deferral, so
//! the results are bitwise identical.

use super::lanes::{Lanes, Width, Work};
use super::rank_one::{Block, get, put, zeros};
use lcplab_lcp::Matrix;

/// Number of sweeps applied in one pass through the tableau.
const TOGETHER: usize = 16;

/// Number of rows updated together, so that the subtracted rows are loaded only once.
const ROWS: usize = 4;

/// S; each row is stored from its own block of eight on, earlier entries are read from the column.
pub(crate) struct Tableau {
    /// The last row and column; its last entry is 0.
    border: Vec<f64>,
    /// Blocks per full row, including zeros right of the last column; zeros also fill the rows
    /// below the last.
    blocks: usize,
    /// Rows in groups of eight; group g has the blocks from g on.
    entries: Vec<Block>,
    /// For each deferred sweep f, then row k; both are 0 where row and column are already updated.
    waiting: Vec<Block>,
    count: usize,
    width: Width,
}

impl Tableau {
    /// A with one more row and column, `border`, whose last entry is 0; no row is free.
    pub(crate) fn bordered(matrix: &Matrix, border: Vec<f64>) -> Self {
        let n = matrix.len() + 1;
        let blocks = n.div_ceil(8).max(1);
        let entries = zeros(4 * blocks * (blocks + 1));
        let waiting = Vec::with_capacity(2 * TOGETHER * blocks);
        let mut own =
            Tableau { border, blocks, entries, waiting, count: 0, width: Width::widest() };
        own.fill(matrix);
        own
    }

    /// Resets the tableau to A.
    pub(crate) fn reset(&mut self, matrix: &Matrix) {
        self.forget();
        self.entries.fill(Block([0.0; 8]));
        self.fill(matrix);
    }

    /// Writes the entries of A and of the border over zeros.
    fn fill(&mut self, matrix: &Matrix) {
        let n = matrix.len();
        for i in 0..n {
            let first = i / 8;
            let row = self.row_mut(i);
            match matrix {
                Matrix::Dense(dense) => {
                    let own = dense.entries()[i * n..(i + 1) * n].chunks(8).skip(first);
                    row.iter_mut().zip(own).for_each(|(to, a)| to.0[..a.len()].copy_from_slice(a));
                }
                Matrix::Sparse(_) => {
                    let own = matrix.row(i).iter().filter(|(j, _)| *j >= 8 * first);
                    own.for_each(|(j, a)| put(row, j - 8 * first, a));
                }
            }
        }
        for i in 0..self.border.len() {
            let entry = self.border[i];
            put(self.row_mut(i), n - i / 8 * 8, entry);
            if i / 8 == n / 8 {
                put(self.row_mut(n), i % 8, entry);
            }
        }
    }

    /// The offset of the rows of group g, and the number of blocks of each.
    #[inline(always)]
    fn group(&self, g: usize) -> (usize, usize) {
        (8 * g * self.blocks - 4 * g * g.saturating_sub(1), self.blocks - g)
    }

    /// Row i from its own block on.
    #[inline(always)]
    fn row(&self, i: usize) -> &[Block] {
        let (start, length) = self.group(i / 8);
        &self.entries[start + i % 8 * length..][..length]
    }

    #[inline(always)]
    fn row_mut(&mut self, i: usize) -> &mut [Block] {
        let (start, length) = self.group(i / 8);
        &mut self.entries[start + i % 8 * length..][..length]
    }

    /// Discards the deferred sweeps.
    fn forget(&mut self) {
        self.waiting.clear();
        self.count = 0;
    }

    /// Storage for a row.
    pub(crate) fn room(&self) -> Vec<Block> {
        zeros(self.blocks)
    }

    /// Reads row i; entries after the n-th are zero.
    pub(crate) fn read(&self, i: usize, row: &mut [Block]) {
        self.width.run(Read { tableau: self, i, row });
    }

    /// Row k, given here, enters C (sign = 1) or leaves it (sign = −1). `followed`, row i as read
    /// before, is updated.
    pub(crate) fn pivot(
        &mut self,
        k: usize,
        row: &[Block],
        sign: f64,
        followed: Option<(usize, &mut Vec<Block>)>,
    ) {
        let width = self.width;
        width.run(Pivot { tableau: self, k, row, sign, followed });
    }

    /// Computes row i; entries after the n-th are zero.
    #[inline(always)]
    fn bring<V: Lanes>(&self, i: usize, row: &mut [Block]) {
        let first = i / 8;
        let (before, own) = row.split_at_mut(first);
        let mut rows = &self.entries[..];
        for (g, to) in before.iter_mut().enumerate() {
            let length = self.blocks - g;
            for r in 0..8 {
                to.0[r] = rows[r * length + first - g].0[i % 8];
            }
            rows = &rows[8 * length..];
        }
        copy::<V>(self.row(i), own);
        self.subtract::<V>(0, i, row);
    }

    /// Updates row i, which was read before the last pivot, that of row k.
    #[inline(always)]
    fn follow<V: Lanes>(&self, i: usize, k: usize, row: &mut [Block]) {
        self.subtract::<V>(self.count - 1, i, row);
        put(row, k, self.stored(i, k));
    }

    /// s_ik as stored: up to date if row k is.
    #[inline(always)]
    fn stored(&self, i: usize, k: usize) -> f64 {
        let (i, k) = (i.min(k), i.max(k));
        get(self.row(i), k - i / 8 * 8)
    }

    /// Subtracts the contribution of the sweeps from `first` on from row i: s_ji − f_j s_ki before
    /// its block, s_ij − f_i s_kj from there on.
    #[inline(always)]
    fn subtract<V: Lanes>(&self, first: usize, i: usize, row: &mut [Block]) {
        let (before, own) = row.split_at_mut(i / 8);
        let waiting = self.waiting[2 * first * self.blocks..].chunks_exact(2 * self.blocks);
        for (factors, swept) in waiting.map(|sweep| sweep.split_at(self.blocks)) {
            let entry = get(swept, i);
            if entry != 0.0 {
                subtract_multiple::<V>(entry, factors, before);
                subtract_multiple::<V>(get(factors, i), &swept[i / 8..], own);
            }
        }
    }

    /// Row k enters or leaves C.
    #[inline(always)]
    fn sweep<V: Lanes>(&mut self, k: usize, row: &[Block], sign: f64) {
        if self.count == TOGETHER {
            self.flush::<V>();
        }
        let (first, blocks) = (k / 8, self.blocks);
        let pivot = get(row, k);
        for side in self.waiting.chunks_exact_mut(blocks) {
            put(side, k, 0.0);
        }
        let start = self.waiting.len();
        self.waiting.extend_from_slice(row);
        self.waiting.extend_from_slice(row);
        for factors in &mut self.waiting[start..][..blocks] {
            for lane in 0..8 {
                factors.0[lane] /= pivot;
            }
        }
        let mut rows = &mut self.entries[..];
        for (g, factors) in self.waiting[start..][..=first].iter().enumerate() {
            let length = blocks - g;
            for r in 0..8 {
                rows[r * length + first - g].0[k % 8] = sign * factors.0[r];
            }
            if g < first {
                rows = &mut rows[8 * length..];
            }
        }
        let length = blocks - first;
        let own = &mut rows[k % 8 * length..][..length];
        for (own, factors) in own.iter_mut().zip(&self.waiting[start + first..]) {
            for lane in 0..8 {
                own.0[lane] = sign * factors.0[lane];
            }
        }
        put(own, k % 8, -1.0 / pivot);
        let (factors, swept) = self.waiting[start..].split_at_mut(blocks);
        put(factors, k, 0.0);
        put(swept, k, 0.0);
        self.count += 1;
    }

    /// Applies the deferred sweeps.
    #[inline(always)]
    fn flush<V: Lanes>(&mut self) {
        let (blocks, waiting) = (self.blocks, &self.waiting);
        let mut rest = &mut self.entries[..];
        for i in (0..8 * blocks).step_by(ROWS) {
            let length = blocks - i / 8;
            let rows;
            (rows, rest) = rest.split_at_mut(ROWS * length);
            let (mut factors, mut swept, mut count) = ([[0.0; ROWS]; TOGETHER], [0; TOGETHER], 0);
            for start in (0..waiting.len()).step_by(2 * blocks) {
                factors[count] = waiting[start + i / 8].0.as_chunks::<ROWS>().0[i % 8 / ROWS];
                swept[count] = start + blocks;
                count += usize::from(factors[count] != [0.0; ROWS]);
            }
            if count == 0 {
                continue;
            }
            for b in 0..length {
                let mut own = [V::splat(0.0); ROWS];
                for r in 0..ROWS {
                    own[r] = V::load(&rows[r * length + b].0);
                }
                for (factors, start) in factors[..count].iter().zip(&swept) {
                    let swept = V::load(&waiting[start + i / 8 + b].0);
                    for r in 0..ROWS {
                        own[r] = own[r] - V::splat(factors[r]) * swept;
                    }
                }
                for r in 0..ROWS {
                    own[r].store(&mut rows[r * length + b].0);
                }
            }
        }
        self.forget();
    }
}

/// See [`Tableau::read`].
struct Read<'a> {
    tableau: &'a Tableau,
    i: usize,
    row: &'a mut [Block],
}

impl Work for Read<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        self.tableau.bring::<V>(self.i, self.row);
    }
}

/// See [`Tableau::pivot`].
struct Pivot<'a> {
    tableau: &'a mut Tableau,
    k: usize,
    row: &'a [Block],
    sign: f64,
    followed: Option<(usize, &'a mut Vec<Block>)>,
}

impl Work for Pivot<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        self.tableau.sweep::<V>(self.k, self.row, self.sign);
        if let Some((i, row)) = self.followed {
            self.tableau.follow::<V>(i, self.k, row);
        }
    }
}

/// to ← to − number · row.
#[inline(always)]
fn subtract_multiple<V: Lanes>(number: f64, row: &[Block], to: &mut [Block]) {
    let number = V::splat(number);
    for (to, row) in to.iter_mut().zip(row) {
        (V::load(&to.0) - number * V::load(&row.0)).store(&mut to.0);
    }
}

/// to ← from, up to the shorter length.
#[inline(always)]
fn copy<V: Lanes>(from: &[Block], to: &mut [Block]) {
    for (from, to) in from.iter().zip(to) {
        V::load(&from.0).store(&mut to.0);
    }
}
