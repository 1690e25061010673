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
        sum(V::load(&y.0), factor * V::load(&x.0)).store(&mut y.0);
    }
}

/// y ← y + f₀ x₀, y ← y + f₁ x₁ and so on, bit by bit, in a third of the time of as many calls.
///
/// Each sum is compared with its terms to see whether only rounding is left. Here that is done for
/// all sums of an entry at once: nothing has cancelled if the smallest is not tiny beside the largest.
#[inline(always)]
pub(super) fn add_all<V: Lanes, const N: usize>(
    factors: [f64; N],
    x: [&[Block]; N],
    y: &mut [Block],
) {
    let mut factor = [V::splat(0.0); N];
    for k in 0..N {
        factor[k] = V::splat(factors[k]);
    }
    for (b, y) in y.iter_mut().enumerate() {
        let before = V::load(&y.0);
        let (mut after, mut least, mut most) = (before, before.abs(), before.abs());
        for k in 0..N {
            after = after + factor[k] * V::load(&x[k][b].0);
            least = after.abs().min(least);
            most = after.abs().max(most);
        }
        if least.any_less(V::splat(3.0 * RELATIVE_ZERO) * most) {
            after = before;
            for k in 0..N {
                after = sum(after, factor[k] * V::load(&x[k][b].0));
            }
        }
        after.store(&mut y.0);
    }
}

/// a + b, exactly 0 where only rounding is left of it.
#[inline(always)]
fn sum<V: Lanes>(a: V, b: V) -> V {
    (a + b).zero_within(V::splat(RELATIVE_ZERO) * (a.abs() + b.abs()))
}

/// y ← y + f x for slices of one length.
pub(in crate::solver) fn add_multiple(factor: f64, x: &[f64], y: &mut [f64], width: Width) {
    width.run(Multiple { factor, x, y });
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
