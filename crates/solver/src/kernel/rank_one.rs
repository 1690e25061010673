//! y ← y + f x for a number f: the basic step of elimination and pivots.
//!
//! As in [`difference`], an entry becomes exactly 0 if only rounding is left.

use super::lanes::{Lanes, Width, Work};
use crate::linalg::elimination::difference;
use crate::tolerances::RELATIVE_ZERO;

/// Eight numbers aligned to a cache line, so that none is loaded in two parts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct Block(pub(crate) [f64; 8]);

pub(super) fn zeros(blocks: usize) -> Vec<Block> {
    vec![Block([0.0; 8]); blocks]
}

#[inline(always)]
pub(crate) fn get(blocks: &[Block], k: usize) -> f64 {
    blocks[k / 8].0[k % 8]
}

#[inline(always)]
pub(crate) fn put(blocks: &mut [Block], k: usize, value: f64) {
    blocks[k / 8].0[k % 8] = value;
}

/// Number of blocks processed at once, to hide latency.
const TOGETHER: usize = 4;

/// y ← y + f x for each (f, x) in turn, in one pass through y; all have the same number of blocks
/// as y.
#[inline(always)]
pub(super) fn add_all<V: Lanes>(terms: &[(f64, &[Block])], y: &mut [Block]) {
    let done = y.len() - y.len() % TOGETHER;
    let (fours, rest) = y.as_chunks_mut::<TOGETHER>();
    for (k, four) in fours.iter_mut().enumerate() {
        add_at::<V, TOGETHER>(terms, TOGETHER * k, four);
    }
    for (k, block) in rest.iter_mut().enumerate() {
        add_at::<V, 1>(terms, done + k, std::array::from_mut(block));
    }
}

/// The same for the blocks of y starting at `place`.
#[inline(always)]
fn add_at<V: Lanes, const B: usize>(terms: &[(f64, &[Block])], place: usize, y: &mut [Block; B]) {
    let mut sums = [V::splat(0.0); B];
    for b in 0..B {
        sums[b] = V::load(&y[b].0);
    }
    for (factor, x) in terms {
        let (factor, x) = (V::splat(*factor), &x[place..place + B]);
        for b in 0..B {
            sums[b] = sum(sums[b], factor * V::load(&x[b].0));
        }
    }
    for b in 0..B {
        sums[b].store(&mut y[b].0);
    }
}

/// The sum, exactly 0 if only rounding is left.
#[inline(always)]
fn sum<V: Lanes>(before: V, change: V) -> V {
    let rounding = V::splat(RELATIVE_ZERO) * (before.abs() + change.abs());
    (before + change).zero_within(rounding)
}

/// y ← y + f x for slices of equal length.
pub(crate) fn add_multiple(factor: f64, x: &[f64], y: &mut [f64]) {
    Width::widest().run(Multiple { factor, x, y });
}

struct Multiple<'a> {
    factor: f64,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl Work for Multiple<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let (x_blocks, x_tail) = self.x.as_chunks::<8>();
        let (y_blocks, y_tail) = self.y.as_chunks_mut::<8>();
        let factor = V::splat(self.factor);
        for (y, x) in y_blocks.iter_mut().zip(x_blocks) {
            sum(V::load(y), factor * V::load(x)).store(y);
        }
        for (y, x) in y_tail.iter_mut().zip(x_tail) {
            *y = difference(*y, -self.factor * x);
        }
    }
}
