//! Products of rows of A.
//!
//! Each row is stored from its first to its last entry, including the zeros between, in eights of
//! columns: all rows of a dense A, the rows of a stack as bands.

use std::ops::Range;

use super::lanes::{Lanes, Width, Work, sum};
use lcplab_lcp::Matrix;

/// Eight consecutive entries of a row.
pub(crate) type Lane8 = [f64; 8];

/// The rows of a square matrix.
#[derive(Debug, Clone)]
pub(crate) struct Rows {
    entries: Vec<Lane8>,
    /// For each row, the eight of its first column, and its range in `entries`.
    runs: Vec<(usize, Range<usize>)>,
    width: Width,
}

/// The eights of a row from its first to its last entry.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run<'a> {
    pub(crate) first: usize,
    pub(crate) entries: &'a [Lane8],
}

impl Run<'_> {
    /// The part of the row in the first eights.
    #[inline(always)]
    fn up_to(self, eights: usize) -> Self {
        let first = self.first.min(eights);
        Run { first, entries: &self.entries[..self.entries.len().min(eights - first)] }
    }

    /// The entry in this column.
    #[inline]
    pub(crate) fn entry(&self, column: usize) -> f64 {
        let place = column.wrapping_sub(8 * self.first);
        self.entries.as_flattened().get(place).copied().unwrap_or(0.0)
    }

    /// Σ |a_k x_k|, given |x|.
    pub(crate) fn magnitude(&self, sizes: &[f64]) -> f64 {
        let sizes = &sizes[8 * self.first..];
        self.entries.as_flattened().iter().zip(sizes).map(|(a, size)| a.abs() * size).sum()
    }
}

impl Rows {
    /// The rows of this matrix.
    pub(crate) fn of(matrix: &Matrix, width: Width) -> Self {
        let n = matrix.len();
        let (mut runs, mut end) = (Vec::with_capacity(n), 0);
        for i in 0..n {
            let span = matrix.row(i).span();
            let (first, count) = (span.start / 8, span.end.div_ceil(8) - span.start / 8);
            runs.push((first, end..end + count));
            end += count;
        }
        let mut entries = vec![[0.0; 8]; end];
        for (i, (first, range)) in runs.iter().enumerate() {
            let own = entries[range.clone()].as_flattened_mut();
            match matrix {
                Matrix::Dense(dense) => {
                    let row = &dense.entries()[i * n..(i + 1) * n][8 * first..];
                    let count = row.len().min(own.len());
                    own[..count].copy_from_slice(&row[..count]);
                }
                Matrix::Sparse(_) => {
                    let nonzero = matrix.row(i).iter().filter(|(_, a)| *a != 0.0);
                    nonzero.for_each(|(j, a)| own[j - 8 * first] = a);
                }
            }
        }
        Rows { entries, runs, width }
    }

    /// Row i.
    #[inline]
    pub(crate) fn row(&self, i: usize) -> Run<'_> {
        let (first, range) = &self.runs[i];
        Run { first: *first, entries: &self.entries[range.clone()] }
    }

    /// sum ← sum + Σ_j x_j A_j over these rows, for the length of `sum`, a multiple of eight.
    pub(crate) fn combine(&self, rows: &[usize], x: &[f64], sum: &mut [f64]) {
        self.width.run(Combine { a: self, rows, x, sum: sum.as_chunks_mut().0 });
    }

    /// products_j ← A_j x for these rows; the length of x is a multiple of eight, and all later
    /// entries are zero.
    pub(crate) fn products(&self, rows: &[usize], x: &[f64], products: &mut [f64]) {
        self.width.run(Products { a: self, rows, x: x.as_chunks().0, products });
    }
}

/// Number of products that are computed together, if their rows have the same columns.
const TOGETHER: usize = 4;

/// Number of rows that are added together, if they span the whole width of the matrix.
const ADDED: usize = 8;

/// See [`Rows::combine`].
struct Combine<'a> {
    a: &'a Rows,
    rows: &'a [usize],
    x: &'a [f64],
    sum: &'a mut [Lane8],
}

impl Work for Combine<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Combine { a, rows, x, sum } = self;
        let (eights, rest) = rows.as_chunks::<ADDED>();
        for rows in eights {
            let (mut factors, mut are_full) = ([0.0; ADDED], true);
            let mut entries = [&a.entries[..0]; ADDED];
            for r in 0..ADDED {
                let row = a.row(rows[r]);
                are_full &= row.first == 0 && row.entries.len() >= sum.len();
                (entries[r], factors[r]) = (row.entries, x[rows[r]]);
            }
            if are_full {
                add_multiples::<V, ADDED>(entries, factors, sum);
            } else {
                for &j in rows {
                    add_row::<V>(a.row(j), x[j], sum);
                }
            }
        }
        for &j in rest {
            add_row::<V>(a.row(j), x[j], sum);
        }
    }
}

#[inline(always)]
fn add_row<V: Lanes>(row: Run, factor: f64, sum: &mut [Lane8]) {
    let row = row.up_to(sum.len());
    let sum = &mut sum[row.first..][..row.entries.len()];
    add_multiples::<V, 1>([row.entries], [factor], sum);
}

/// sum ← sum + Σ factor · row, for the length of `sum`.
#[inline(always)]
pub(super) fn add_multiples<V: Lanes, const R: usize>(
    rows: [&[Lane8]; R],
    factors: [f64; R],
    sum: &mut [Lane8],
) {
    let (mut equal, mut lanes) = (rows, [V::splat(0.0); R]);
    for r in 0..R {
        (equal[r], lanes[r]) = (&rows[r][..sum.len()], V::splat(factors[r]));
    }
    for (k, total) in sum.iter_mut().enumerate() {
        // Two sums do not wait for each other.
        let mut sums = [V::load(total), V::splat(0.0)];
        for r in 0..R {
            sums[r % 2] = sums[r % 2] + lanes[r] * V::load(&equal[r][k]);
        }
        (sums[0] + sums[1]).store(total);
    }
}

/// See [`Rows::products`].
struct Products<'a> {
    a: &'a Rows,
    rows: &'a [usize],
    x: &'a [Lane8],
    products: &'a mut [f64],
}

impl Work for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Products { a, rows, x, products } = self;
        let (fours, rest) = rows.as_chunks::<TOGETHER>();
        for rows in fours {
            let first = a.row(rows[0]).up_to(x.len());
            let (mut entries, mut are_alike) = ([first.entries; TOGETHER], true);
            for r in 0..TOGETHER {
                let row = a.row(rows[r]).up_to(x.len());
                are_alike &= row.first == first.first && row.entries.len() == first.entries.len();
                entries[r] = row.entries;
            }
            if are_alike {
                let of_rows = dots::<V, TOGETHER>(entries, &x[first.first..]);
                for r in 0..TOGETHER {
                    products[rows[r]] = of_rows[r];
                }
            } else {
                for &j in rows {
                    products[j] = dot::<V>(a.row(j), x);
                }
            }
        }
        for &j in rest {
            products[j] = dot::<V>(a.row(j), x);
        }
    }
}

#[inline(always)]
fn dot<V: Lanes>(row: Run, x: &[Lane8]) -> f64 {
    let row = row.up_to(x.len());
    dots::<V, 1>([row.entries], &x[row.first..])[0]
}

/// The products of rows of equal length with x.
#[inline(always)]
pub(super) fn dots<V: Lanes, const R: usize>(rows: [&[Lane8]; R], x: &[Lane8]) -> [f64; R] {
    let count = rows[0].len();
    let (x, mut equal) = (&x[..count], rows);
    for r in 0..R {
        equal[r] = &rows[r][..count];
    }
    let mut sums = [V::splat(0.0); R];
    for k in 0..count {
        let x = V::load(&x[k]);
        for r in 0..R {
            sums[r] = sums[r] + V::load(&equal[r][k]) * x;
        }
    }
    let mut products = [0.0; R];
    for r in 0..R {
        products[r] = sum(sums[r].to_array());
    }
    products
}
