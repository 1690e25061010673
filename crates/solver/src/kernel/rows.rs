//! Sums of rows of A.
//!
//! Each row is stored contiguously from its first to its last entry, including the zeros between: a
//! dense A as it is in memory, the rows of a stack as bands.

use std::borrow::Cow;
use std::ops::Range;

use super::lanes::{Lanes, Width, Work};
use lcplab_lcp::Matrix;

/// The rows of a square matrix.
#[derive(Debug, Clone)]
pub(crate) struct Rows<'a> {
    values: Cow<'a, [f64]>,
    /// For each row, its first column and its range in `values`.
    runs: Vec<(usize, Range<usize>)>,
    width: Width,
}

/// The entries of a row from its first to its last.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run<'a> {
    pub(crate) first: usize,
    pub(crate) values: &'a [f64],
}

impl Run<'_> {
    /// The entry in this column.
    #[inline]
    pub(crate) fn entry(&self, column: usize) -> f64 {
        self.values.get(column.wrapping_sub(self.first)).copied().unwrap_or(0.0)
    }

    /// The product with x.
    pub(crate) fn dot(&self, x: &[f64]) -> f64 {
        lcplab_lcp::dot(self.values, &x[self.first..self.first + self.values.len()])
    }

    /// Σ |a_k x_k|, given |x|.
    pub(crate) fn magnitude(&self, sizes: &[f64]) -> f64 {
        self.values.iter().zip(&sizes[self.first..]).map(|(a, size)| a.abs() * size).sum()
    }
}

impl<'a> Rows<'a> {
    /// The rows of this matrix.
    pub(crate) fn of(matrix: &'a Matrix, width: Width) -> Self {
        let n = matrix.len();
        match matrix {
            Matrix::Dense(dense) => {
                let values = dense.entries();
                let run = |i: usize| {
                    let row = &values[i * n..(i + 1) * n];
                    let first = row.iter().position(|a| *a != 0.0).unwrap_or(0);
                    let end = row.iter().rposition(|a| *a != 0.0).map_or(first, |last| last + 1);
                    (first, i * n + first..i * n + end)
                };
                Rows { values: values.into(), runs: (0..n).map(run).collect(), width }
            }
            Matrix::Sparse(_) => {
                let (mut values, mut runs) = (Vec::new(), Vec::new());
                for i in 0..n {
                    let (start, mut first) = (values.len(), None);
                    for (j, a) in matrix.row(i).iter().filter(|(_, a)| *a != 0.0) {
                        let first = *first.get_or_insert(j);
                        values.resize(start + j - first, 0.0);
                        values.push(a);
                    }
                    runs.push((first.unwrap_or(0), start..values.len()));
                }
                Rows { values: values.into(), runs, width }
            }
        }
    }

    /// Row i.
    #[inline]
    pub(crate) fn row(&self, i: usize) -> Run<'_> {
        let (first, range) = &self.runs[i];
        Run { first: *first, values: &self.values[range.clone()] }
    }

    /// sum ← A_i + Σ_k factors_k A_rows_k, for the length of `sum`.
    pub(crate) fn combine(&self, i: usize, rows: &[usize], factors: &[f64], sum: &mut [f64]) {
        sum.fill(0.0);
        self.width.run(Combine { a: self, rows: &[i], factors: &[1.0], sum });
        self.width.run(Combine { a: self, rows, factors, sum });
    }
}

/// Number of rows whose sums are computed together, if they span the whole width of the matrix.
const TOGETHER: usize = 8;

struct Combine<'a> {
    a: &'a Rows<'a>,
    rows: &'a [usize],
    factors: &'a [f64],
    sum: &'a mut [f64],
}

impl Work for Combine<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Combine { a, rows, factors, sum } = self;
        let (rows, factors) = (rows.as_chunks::<TOGETHER>(), factors.as_chunks::<TOGETHER>());
        let width = sum.len();
        let is_full = |rows: &[usize; TOGETHER]| {
            rows.iter().all(|&j| a.row(j).first == 0 && a.row(j).values.len() >= width)
        };
        for (rows, factors) in rows.0.iter().zip(factors.0) {
            if is_full(rows) {
                let mut values = [&a.values[..0]; TOGETHER];
                for r in 0..TOGETHER {
                    values[r] = a.row(rows[r]).values;
                }
                add::<V, TOGETHER>(values, *factors, sum);
            } else {
                for (&j, &factor) in rows.iter().zip(factors) {
                    add_run::<V>(a.row(j), factor, sum);
                }
            }
        }
        for (&j, &factor) in rows.1.iter().zip(factors.1) {
            add_run::<V>(a.row(j), factor, sum);
        }
    }
}

#[inline(always)]
fn add_run<V: Lanes>(run: Run, factor: f64, sum: &mut [f64]) {
    let end = sum.len().min(run.first + run.values.len());
    if factor != 0.0 && run.first < end {
        add::<V, 1>([run.values], [factor], &mut sum[run.first..end]);
    }
}

/// sum ← sum + Σ factor · row
#[inline(always)]
fn add<V: Lanes, const R: usize>(rows: [&[f64]; R], factors: [f64; R], sum: &mut [f64]) {
    let (blocks, tail) = sum.as_chunks_mut::<8>();
    let (count, start) = (blocks.len(), 8 * blocks.len());
    let (mut row_blocks, mut lanes) =
        ([&rows[0].as_chunks::<8>().0[..count]; R], [V::splat(0.0); R]);
    for r in 0..R {
        row_blocks[r] = &rows[r].as_chunks::<8>().0[..count];
        lanes[r] = V::splat(factors[r]);
    }
    for k in 0..count {
        let mut total = V::load(&blocks[k]);
        for r in 0..R {
            total = total + V::load(&row_blocks[r][k]) * lanes[r];
        }
        total.store(&mut blocks[k]);
    }
    for (k, total) in tail.iter_mut().enumerate() {
        for r in 0..R {
            *total += rows[r][start + k] * factors[r];
        }
    }
}
