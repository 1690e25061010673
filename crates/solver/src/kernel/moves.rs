//! A move along a line of all x and w at once: how far it may go, and the move itself.
//!
//! The loops are plain, without a branch that depends on a number, so that the compiler
//! vectorizes them.

use super::lanes::{Lanes, Width, Work, sum};
use crate::linalg::elimination::difference;

/// How far x can move at this velocity until it reaches a bound; ∞ if it does not move.
#[inline(always)]
pub(crate) fn length_to_bound(x: f64, [lo, hi]: [f64; 2], velocity: f64) -> f64 {
    length(room(x, [lo, hi], velocity), velocity.abs())
}

/// The distance of x from the bound to which it moves.
#[inline(always)]
fn room(x: f64, [lo, hi]: [f64; 2], velocity: f64) -> f64 {
    let room = if velocity > 0.0 { hi - x } else { x - lo };
    if room > 0.0 { room } else { 0.0 }
}

#[inline(always)]
fn length(distance: f64, speed: f64) -> f64 {
    let length = distance / speed;
    if speed > 0.0 { length } else { f64::INFINITY }
}

#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// Rows in a move along ±d.
pub(crate) struct Rows<'a> {
    pub(crate) x: &'a [f64],
    pub(crate) w: &'a [f64],
    pub(crate) lo: &'a [f64],
    pub(crate) hi: &'a [f64],
    /// For rows at a bound the direction in which w may always move, 1 or −1; 0 for others.
    pub(crate) away: &'a [f64],
    /// The change of x; 0 for rows at a bound.
    pub(crate) d: &'a [f64],
    /// The change of w.
    pub(crate) delta_w: &'a [f64],
    /// 1 or −1.
    pub(crate) sign: f64,
}

impl Rows<'_> {
    /// How far the move may go until x of each row reaches a bound, or w of a row at a bound is
    /// zero; returns the least of these lengths.
    pub(crate) fn lengths(&self, width: Width, lengths: &mut [f64]) -> f64 {
        width.run(Lengths { rows: self, lengths })
    }
}

struct Lengths<'a> {
    rows: &'a Rows<'a>,
    lengths: &'a mut [f64],
}

impl Work for Lengths<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<V: Lanes>(self) -> f64 {
        let Rows { x, w, lo, hi, away, d, delta_w, sign } = *self.rows;
        let n = x.len();
        let (w, lo, hi, away, d, delta_w) =
            (&w[..n], &lo[..n], &hi[..n], &away[..n], &d[..n], &delta_w[..n]);
        let lengths = &mut self.lengths[..n];
        for j in 0..n {
            // w of a row at a bound approaches zero at this speed.
            let speed = -away[j] * (sign * delta_w[j]);
            let of_x = (room(x[j], [lo[j], hi[j]], sign * d[j]), d[j].abs());
            let (distance, speed) = if speed > 0.0 { (away[j] * w[j], speed) } else { of_x };
            lengths[j] = length(distance, speed);
        }
        let mut least = [f64::INFINITY; 8];
        let (eights, rest) = lengths.as_chunks::<8>();
        for eight in eights {
            for lane in 0..8 {
                least[lane] = smaller(least[lane], eight[lane]);
            }
        }
        for length in rest {
            least[0] = smaller(least[0], *length);
        }
        let [a, b, c, d, e, f, g, h] = least;
        smaller(smaller(smaller(a, e), smaller(c, g)), smaller(smaller(b, f), smaller(d, h)))
    }
}

/// x ← x + t d, w ← w + t Δw; exactly 0 where only rounding is left.
pub(crate) fn advance(width: Width, t: f64, x: [&mut [f64]; 2], d: [&[f64]; 2]) {
    width.run(Advance { t, x, d });
}

struct Advance<'a> {
    t: f64,
    x: [&'a mut [f64]; 2],
    d: [&'a [f64]; 2],
}

impl Work for Advance<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        for (x, d) in self.x.into_iter().zip(self.d) {
            for (x, d) in x.iter_mut().zip(d) {
                *x = difference(*x, -self.t * d);
            }
        }
    }
}

/// Σ √a_jj |d_j|.
pub(crate) fn size(width: Width, root: &[f64], d: &[f64]) -> f64 {
    width.run(Size { root, d })
}

struct Size<'a> {
    root: &'a [f64],
    d: &'a [f64],
}

impl Work for Size<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<V: Lanes>(self) -> f64 {
        let (roots, root) = self.root.as_chunks::<8>();
        let (eights, d) = self.d[..self.root.len()].as_chunks::<8>();
        let mut sums = V::splat(0.0);
        for (root, d) in roots.iter().zip(eights) {
            sums = sums + V::load(root) * V::load(d).abs();
        }
        let mut size = sum(sums.to_array());
        for (root, d) in root.iter().zip(d) {
            size += root * d.abs();
        }
        size
    }
}
