//! The loops of a factor A_CC = L D Lᵀ of which L⁻¹ is stored (see [`crate::linalg::ldlt`]).
//!
//! ```text
//! panel p: rows 8p … 8p + 7, each with its columns 0 … 8p + 7
//! ```
//!
//! The products of different rows do not wait for each other, as those of a triangular solve do,
//! and both passes over a row are made while it is in the cache. Rows of zeros fill the last panel.

use std::ops::Range;

use super::lanes::{Lanes, Width, Work, sum};
use super::rows::{Lane8, add_multiples, dots};

/// Number of rows of a panel.
const TOGETHER: usize = 8;

/// Number of panels that are used twice in a row.
const CHUNK: usize = 4;

/// The rows m_r of L⁻¹, and D.
#[derive(Debug, Clone)]
pub(crate) struct InverseRows {
    /// Panel after panel, in each row after row.
    entries: Vec<Lane8>,
    /// s_r; 1 for rows of zeros.
    diagonal: Vec<f64>,
    /// Number of rows that are not zero.
    count: usize,
    width: Width,
}

/// The entries of the first panels, as many as this.
fn size(panels: usize) -> usize {
    TOGETHER * panels * (panels + 1) / 2
}

/// The entries of a row.
fn place(row: usize) -> Range<usize> {
    let panel = row / TOGETHER;
    let start = size(panel) + row % TOGETHER * (panel + 1);
    start..start + panel + 1
}

impl InverseRows {
    /// No rows, with storage for a few.
    pub(crate) fn new(width: Width) -> Self {
        let (entries, diagonal) = (Vec::with_capacity(size(3)), Vec::with_capacity(3 * TOGETHER));
        InverseRows { entries, diagonal, count: 0, width }
    }

    /// Appends a row with these entries left of its 1; entries past the last row are not read.
    pub(crate) fn push(&mut self, left: &[f64], s: f64) {
        let row = self.count;
        self.count += 1;
        self.resize();
        self.diagonal[row] = s;
        let own = self.entries[place(row)].as_flattened_mut();
        own[..row].copy_from_slice(&left[..row]);
        own[row] = 1.0;
    }

    /// Allocates the panels of all rows, and no more.
    fn resize(&mut self) {
        let panels = self.count.div_ceil(TOGETHER);
        self.entries.resize(size(panels), [0.0; 8]);
        self.diagonal.resize(TOGETHER * panels, 1.0);
    }

    /// x ← x − Σ_r (m_r·a / s_r) m_r; returns Σ_r (m_r·a)² / s_r. Both have an entry for each row,
    /// then zeros up to the next multiple of eight, at least.
    pub(crate) fn subtract_projections(&self, a: &[f64], x: &mut [f64]) -> f64 {
        self.width.run(Projections { m: self, a: a.as_chunks().0, x: x.as_chunks_mut().0 })
    }

    /// Removes row and column q; m_rᵀ A m_q is still zero for all other rows.
    pub(crate) fn remove(&mut self, q: usize) {
        let width = self.width;
        width.run(Removal { m: self, q });
        self.count -= 1;
        self.entries[place(self.count)].fill([0.0; 8]);
        self.diagonal[self.count] = 1.0;
        self.resize();
    }
}

/// See [`InverseRows::subtract_projections`].
struct Projections<'a> {
    m: &'a InverseRows,
    a: &'a [Lane8],
    x: &'a mut [Lane8],
}

impl Work for Projections<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<V: Lanes>(self) -> f64 {
        let Projections { m, a, x } = self;
        let (diagonal, _) = m.diagonal.as_chunks::<TOGETHER>();
        // All rows before it are zero where a is not.
        let mut begin = 0;
        while begin < diagonal.len() && a[begin] == [0.0; 8] {
            begin += 1;
        }
        let mut products = [0.0; TOGETHER];
        while begin < diagonal.len() {
            let end = diagonal.len().min(begin + CHUNK);
            let mut factors = [[0.0; TOGETHER]; CHUNK];
            for panel in begin..end {
                let along = m.products::<V>(panel, a);
                let factors = &mut factors[panel - begin];
                for r in 0..TOGETHER {
                    factors[r] = -along[r] / diagonal[panel][r];
                    products[r] -= along[r] * factors[r];
                }
            }
            for panel in begin..end {
                let (rows, factors) = (m.panel(panel), factors[panel - begin]);
                add_multiples::<V, TOGETHER>(rows, factors, &mut x[..panel + 1]);
            }
            begin = end;
        }
        sum(products)
    }
}

impl InverseRows {
    /// The rows of a panel.
    #[inline(always)]
    fn panel(&self, panel: usize) -> [&[Lane8]; TOGETHER] {
        let mut rows = [&self.entries[..0]; TOGETHER];
        for r in 0..TOGETHER {
            rows[r] = &self.entries[place(TOGETHER * panel + r)];
        }
        rows
    }

    /// m·a of the rows of a panel.
    #[inline(always)]
    fn products<V: Lanes>(&self, panel: usize, a: &[Lane8]) -> [f64; TOGETHER] {
        let [p, q, r, s, t, u, v, w] = self.panel(panel);
        let [p, q, r, s] = dots::<V, 4>([p, q, r, s], a);
        let [t, u, v, w] = dots::<V, 4>([t, u, v, w], a);
        [p, q, r, s, t, u, v, w]
    }
}

/// See [`InverseRows::remove`].
///
/// With p = m_q and σ = 1/s_q, for each row r below, where μ = m_rq:
///
/// ```text
/// σ' = σ + μ²/s_r,   s_r ← s_r σ'/σ,   m_r ← m_r − μ p,   p ← p + μ/(s_r σ') m_r,   σ ← σ'
/// ```
///
/// with the old s_r on the right, which keeps σ p pᵀ + Σ m_r m_rᵀ / s_r = A_CC⁻¹. At the end p is
/// the only one with an entry in column q, and is dropped.
struct Removal<'a> {
    m: &'a mut InverseRows,
    q: usize,
}

impl Work for Removal<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Removal { m: InverseRows { entries, diagonal, count, .. }, q } = self;
        let mut p = vec![0.0; *count];
        p[..=q].copy_from_slice(&entries[place(q)].as_flattened()[..=q]);
        let mut sigma = 1.0 / diagonal[q];
        for r in q + 1..*count {
            let (before, row) = entries.split_at_mut(place(r).start);
            let (row, to) = (row.as_flattened(), before[place(r - 1)].as_flattened_mut());
            let (s, mu) = (diagonal[r], row[q]);
            let updated = sigma + mu * mu / s;
            let gain = mu / (s * updated);
            diagonal[r - 1] = s * updated / sigma;
            sigma = updated;
            // Rows and columns after q move up by one.
            combine(mu, gain, &row[..q], &mut p[..q], &mut to[..q]);
            combine(mu, gain, &row[q + 1..=r], &mut p[q + 1..=r], &mut to[q..r]);
        }
    }
}

/// to ← row − μ p, p ← p + gain · to.
#[inline(always)]
fn combine(mu: f64, gain: f64, row: &[f64], p: &mut [f64], to: &mut [f64]) {
    for ((row, p), to) in row.iter().zip(p).zip(to) {
        *to = row - mu * *p;
        *p += gain * *to;
    }
}
