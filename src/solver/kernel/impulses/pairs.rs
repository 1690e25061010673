//! One pair of bodies after the other: all rows between them with velocities read and written once.
//!
//! Within a pair the rows know each other by their Gram matrix G = Ĵ_P Ĵ_Pᵀ, so that one change of x
//! moves the w of all of them by one vector operation, and v is moved when all rows are done:
//!
//! ```text
//! w_P = Ĵ_P v + b_P;   for r in P:  x_r ← Π_r(x_r − w_r / a_rr),  w_P ← w_P + G_r δ_r;   v ← v + Ĵ_Pᵀ δ_P
//! ```
//!
//! The iterates are those of [`RowByRow`](super::RowByRow) but for rounding.

use std::ops::Range;

use super::colour::within;
use super::{System, Velocities, WIDTH};
use crate::solver::kernel::lanes::{Lanes, Width, Work, sum};

/// Rows are padded to this many lanes: four contacts with friction are 12 rows.
const MOST: usize = 16;
/// Vectors of eight in [`MOST`] rows.
const PARTS: usize = MOST / 8;

/// A number for each row of a pair.
type PerRow = [[f64; 8]; PARTS];

/// Projected Gauss-Seidel pair by pair, in the order they come.
#[derive(Debug, Clone)]
pub struct PairByPair {
    pairs: Vec<Pair>,
    v: Velocities,
    width: Width,
}

/// The rows between two bodies, at most [`MOST`] of them.
#[derive(Debug, Clone)]
#[repr(align(64))]
struct Pair {
    /// Column k of Ĵ_P.
    jacobian: [PerRow; 2 * WIDTH],
    /// Row r of G, which is its column too.
    gram: [PerRow; MOST],
    b: PerRow,
    x: PerRow,
    inverse: [f64; MOST],
    lo: [f64; MOST],
    /// μ where `follows` says which row of the pair bounds this one.
    hi: [f64; MOST],
    follows: [Option<usize>; MOST],
    bodies: [usize; 2],
    rows: Range<usize>,
}

impl PairByPair {
    /// The sweeps, from x = 0; `None` if a row's bounds follow one that is not between the same bodies,
    /// or not among the same sixteen rows of many.
    pub fn new(system: &System, width: Width) -> Option<Self> {
        let pairs = system.pairs().flat_map(|pair| split(system, pair));
        let pairs = pairs.map(|pair| Pair::of(system, pair)).collect::<Option<_>>()?;
        Some(PairByPair { pairs, v: vec![[0.0; 8]; system.bodies + 1], width })
    }

    /// One sweep over all rows.
    pub fn sweep(&mut self) {
        self.width.run(Sweep { pairs: &mut self.pairs, v: &mut self.v });
    }

    /// x, one entry a row.
    pub fn x(&self) -> Vec<f64> {
        self.pairs
            .iter()
            .flat_map(|pair| &pair.x.as_flattened()[..pair.rows.len()])
            .copied()
            .collect()
    }
}

impl Pair {
    fn of(system: &System, rows: Range<usize>) -> Option<Self> {
        let [p, q] = system.rows[rows.start].bodies;
        let second = if p == q { system.bodies } else { q };
        let mut pair = Pair {
            jacobian: [[[0.0; 8]; PARTS]; 2 * WIDTH],
            gram: [[[0.0; 8]; PARTS]; MOST],
            b: [[0.0; 8]; PARTS],
            x: [[0.0; 8]; PARTS],
            inverse: [0.0; MOST],
            lo: [0.0; MOST],
            hi: [0.0; MOST],
            follows: [None; MOST],
            bodies: [p, second],
            rows: rows.clone(),
        };
        pair.follows[..rows.len()].copy_from_slice(&within(system, &rows)?);
        let entries = |i: usize| {
            let [mut first, mut second] = system.rows[i].jacobian;
            if p == q {
                first.iter_mut().zip(&mut second).for_each(|(a, b)| *a += std::mem::take(b));
            }
            [first, second]
        };
        for (r, i) in rows.clone().enumerate() {
            let (part, lane) = (r / 8, r % 8);
            for (k, j) in entries(i).as_flattened().iter().enumerate() {
                pair.jacobian[k][part][lane] = *j;
            }
            for (s, other) in rows.clone().enumerate() {
                let (a, b) = (entries(i), entries(other));
                let terms = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b);
                pair.gram[r][s / 8][s % 8] = terms.sum();
            }
            pair.b[part][lane] = system.lcp.b()[i];
            pair.inverse[r] = system.inverse[i];
            pair.lo[r] = system.lcp.lo()[i];
            pair.hi[r] = system.follows(i).map_or(system.lcp.hi()[i], |(_, mu)| mu);
        }
        Some(pair)
    }

    /// The bounds of row r: its own, or ±μ max(x_k, 0).
    #[inline(always)]
    fn bounds(&self, r: usize) -> (f64, f64) {
        match self.follows[r] {
            None => (self.lo[r], self.hi[r]),
            Some(k) => {
                let hi = self.hi[r] * self.x[k / 8][k % 8].max(0.0);
                (-hi, hi)
            }
        }
    }
}

/// Parts of at most [`MOST`] rows, each ending where no row is bounded by one of the part.
fn split(system: &System, pair: Range<usize>) -> Vec<Range<usize>> {
    let (mut parts, mut start) = (Vec::new(), pair.start);
    while start < pair.end {
        let whole = pair.end.min(start + MOST);
        let is_apart = |&end: &usize| {
            end == pair.end || system.follows(end).is_none_or(|(normal, _)| normal < start)
        };
        let end = (start + 1..=whole).rev().find(is_apart).unwrap_or(whole);
        parts.push(start..end);
        start = end;
    }
    parts
}

struct Sweep<'a> {
    pairs: &'a mut [Pair],
    v: &'a mut [[f64; 8]],
}

impl Work for Sweep<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        for pair in self.pairs {
            let [p, q] = pair.bodies;
            let mut w = [V::splat(0.0); PARTS];
            for part in 0..PARTS {
                w[part] = V::load(&pair.b[part]);
                for k in 0..WIDTH {
                    w[part] = w[part]
                        + (V::load(&pair.jacobian[k][part]) * V::splat(self.v[p][k])
                            + V::load(&pair.jacobian[WIDTH + k][part]) * V::splat(self.v[q][k]));
                }
            }
            let change = sweep_rows(pair, w);
            for k in 0..WIDTH {
                self.v[p][k] += product::<V>(&pair.jacobian[k], &change);
                self.v[q][k] += product::<V>(&pair.jacobian[WIDTH + k], &change);
            }
        }
    }
}

/// One update of each row, w following by the Gram matrix; returns the changes of x.
#[inline(always)]
fn sweep_rows<V: Lanes>(pair: &mut Pair, mut w: [V; PARTS]) -> PerRow {
    let mut changes = [[0.0; 8]; PARTS];
    for part in 0..PARTS {
        let first = 8 * part;
        for lane in 0..pair.rows.len().saturating_sub(first).min(8) {
            let r = first + lane;
            let next = w[part].to_array()[lane];
            let (lo, hi) = pair.bounds(r);
            let before = pair.x[part][lane];
            let after = (before - next * pair.inverse[r]).max(lo).min(hi);
            pair.x[part][lane] = after;
            changes[part][lane] = after - before;
            let change = V::splat(after - before);
            for rest in part..PARTS {
                w[rest] = w[rest] + V::load(&pair.gram[r][rest]) * change;
            }
        }
    }
    changes
}

#[inline(always)]
fn product<V: Lanes>(a: &PerRow, b: &PerRow) -> f64 {
    let mut lanes = V::load(&a[0]) * V::load(&b[0]);
    for part in 1..PARTS {
        lanes = lanes + V::load(&a[part]) * V::load(&b[part]);
    }
    sum(lanes.to_array())
}
