//! The linear equations of a step, reduced to the velocities.
//!
//! With A = Ĵ Ĵᵀ and the velocity change v = Ĵᵀ dx,
//!
//! ```text
//! (Ĵ Ĵᵀ + D) dx = r   ⇔   (1 + Ĵᵀ D⁻¹ Ĵ) v = Ĵᵀ D⁻¹ r,   dx = D⁻¹ (r − Ĵ v)
//! ```
//!
//! The matrix on the right, K, has six rows per body however many contacts it has, and a block for
//! each pair of bodies that share a row: a pile of 700 cubes has 4200 equations instead of one for
//! each of its 24,000 rows. K is positive definite, with no eigenvalue below 1. Its largest
//! eigenvalues grow with 1/D, and in rows without bounds D is only the added minimum; there 10⁻⁸
//! a_ii is added, and one or two iterations correct the effect on x.

use std::ops::Range;

use super::step::StepEquations;
use crate::Status;
use crate::kernel::impulses::{System, WIDTH};
use crate::linalg::sparse_factor::{Pattern, SparseFactor, minimum_degree, pattern};
use crate::tolerances::MIN_ADDED_WITHOUT_BOUNDS;

/// K, its factors, and the positions of its blocks.
pub(super) struct Velocities<'a> {
    system: &'a System,
    pairs: Vec<Pair>,
    /// The entries of K's blocks, column by column.
    values: Vec<f64>,
    /// The positions of K's diagonal in `values`.
    diagonal: Vec<usize>,
    factor: SparseFactor,
    /// D⁻¹, 0 where x is pinned.
    inverse: Vec<f64>,
}

/// Consecutive rows between the same two bodies, and the blocks of K that they contribute to.
struct Pair {
    rows: Range<usize>,
    blocks: Vec<Block>,
}

/// A block with the rows of one body of the pair and the columns of the other.
struct Block {
    /// Index of the body in the pair, 0 or 1.
    row: usize,
    column: usize,
    /// The offset of the block in `values`, and the stride between its columns.
    first: usize,
    stride: usize,
}

impl<'a> Velocities<'a> {
    /// Storage for the factors, if their entries fit.
    pub(super) fn of(
        system: &'a System,
        fit: impl Fn(usize) -> Result<(), Status>,
    ) -> Result<Self, Status> {
        let touching = touching(system);
        let order = minimum_degree(&pattern(touching.iter().map(|below| below.iter().copied())));
        let order: Vec<usize> = order.into_iter().flat_map(components).collect();
        let factor = SparseFactor::of(in_components(&touching), &order);
        fit(factor.entries())?;
        let values = vec![0.0; factor.pattern().compute_nnz()];
        let starts = factor.pattern().col_ptr();
        let diagonal = (0..order.len()).map(|c| starts[c] + c % WIDTH).collect();
        let pairs = system.pairs().map(|rows| Pair::of(system, rows, &touching, starts)).collect();
        let inverse = vec![0.0; system.rows().len()];
        Ok(Velocities { system, pairs, values, diagonal, factor, inverse })
    }

    /// K = 1 + Ĵᵀ D⁻¹ Ĵ.
    fn assemble(&mut self) {
        self.values.fill(0.0);
        self.diagonal.iter().for_each(|&place| self.values[place] = 1.0);
        for pair in &self.pairs {
            for block in &pair.blocks {
                // Stored by columns.
                let mut sum = [[0.0; WIDTH]; WIDTH];
                for i in pair.rows.clone() {
                    let [left, right] =
                        [block.row, block.column].map(|s| &self.system.rows()[i].jacobian[s]);
                    for (column, right) in sum.iter_mut().zip(right) {
                        let factor = self.inverse[i] * right;
                        column.iter_mut().zip(left).for_each(|(sum, left)| *sum += left * factor);
                    }
                }
                for (k, column) in sum.iter().enumerate() {
                    let values = &mut self.values[block.first + k * block.stride..];
                    values.iter_mut().zip(column).for_each(|(value, sum)| *value += sum);
                }
            }
        }
    }
}

impl StepEquations for Velocities<'_> {
    const UNBOUNDED: f64 = MIN_ADDED_WITHOUT_BOUNDS;

    fn diagonal(&self, i: usize) -> f64 {
        self.system.diagonal(i)
    }

    fn w(&self, x: &[f64]) -> Vec<f64> {
        self.system.w(x)
    }

    fn factor(&mut self, added: &[f64], pinned: &[bool]) -> bool {
        for (inverse, (added, pinned)) in self.inverse.iter_mut().zip(added.iter().zip(pinned)) {
            *inverse = if *pinned { 0.0 } else { added.recip() };
        }
        self.assemble();
        self.factor.factor(&self.values)
    }

    fn solve(&mut self, r: &mut [f64]) {
        let scaled: Vec<f64> =
            r.iter().zip(&self.inverse).map(|(r, inverse)| r * inverse).collect();
        // Ĵᵀ D⁻¹ r
        let mut v = self.system.transposed_product(&scaled);
        self.factor.solve(&mut v);
        // Ĵ v
        let back = self.system.product(&v);
        for (r, (back, inverse)) in r.iter_mut().zip(back.iter().zip(&self.inverse)) {
            *r = inverse * (*r - back);
        }
    }
}

impl Pair {
    fn of(system: &System, rows: Range<usize>, touching: &[Vec<usize>], starts: &[usize]) -> Self {
        let bodies = system.rows()[rows.start].bodies;
        let block = |row: usize, column: usize| {
            let below = &touching[bodies[column]];
            let place = below.partition_point(|&body| body < bodies[row]);
            let first = starts[WIDTH * bodies[column]] + WIDTH * place;
            Block { row, column, first, stride: WIDTH * below.len() }
        };
        let blocks = match bodies {
            [p, q] if p == q => vec![block(0, 0)],
            [p, q] if p < q => vec![block(0, 0), block(1, 1), block(1, 0)],
            _ => vec![block(0, 0), block(1, 1), block(0, 1)],
        };
        Pair { rows, blocks }
    }
}

/// For each body, itself and the later bodies with which it shares a row, ascending.
fn touching(system: &System) -> Vec<Vec<usize>> {
    let mut touching: Vec<Vec<usize>> = (0..system.bodies()).map(|body| vec![body]).collect();
    for rows in system.pairs() {
        let [p, q] = system.rows()[rows.start].bodies;
        touching[p.min(q)].push(p.max(q));
    }
    for below in &mut touching {
        below.sort_unstable();
        below.dedup();
    }
    touching
}

/// The pattern of K.
fn in_components(touching: &[Vec<usize>]) -> Pattern {
    let rows = |below: &Vec<usize>| below.iter().copied().flat_map(components).collect::<Vec<_>>();
    let columns = touching.iter().flat_map(|below| std::iter::repeat_n(rows(below), WIDTH));
    pattern(columns)
}

/// The rows of K that belong to a body.
fn components(body: usize) -> Range<usize> {
    WIDTH * body..WIDTH * (body + 1)
}
