//! y ← y + f x for a number f: the step of which elimination and pivots are made.
//!
//! It is done as [`difference`] does it: an entry of which only rounding is left becomes exactly 0.

use super::lanes::{Lanes, Width, Work};
use crate::solver::elimination::{RELATIVE_ZERO, difference};

/// Eight numbers that begin where a line of the cache does, so that none is loaded in two parts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Block(pub(super) [f64; 8]);

/// y ← y + f x for as many blocks as both have.
#[inline(always)]
pub(super) fn add<V: Lanes>(factor: f64, x: &[Block], y: &mut [Block]) {
    let factor = V::splat(factor);
    for (y, x) in y.iter_mut().zip(x) {
        add_eight(factor, &x.0, &mut y.0);
    }
}

#[inline(always)]
fn add_eight<V: Lanes>(factor: V, x: &[f64; 8], y: &mut [f64; 8]) {
    let (before, change) = (V::load(y), factor * V::load(x));
    let rounding = V::splat(RELATIVE_ZERO) * (before.abs() + change.abs());
    (before + change).zero_within(rounding).store(y);
}

/// y ← y + f x for slices of one length.
pub(in crate::solver) fn add_multiple(factor: f64, x: &[f64], y: &mut [f64]) {
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
            add_eight(factor, x, y);
        }
        for (y, x) in y_tail.iter_mut().zip(x_tail) {
            *y = difference(*y, -self.factor * x);
        }
    }
}
