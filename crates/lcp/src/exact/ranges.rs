//! The ranges of w for x within its bounds, with which pieces without a solution are passed over.

use super::Side;
use crate::Lcp;

/// The part of the sum of terms by which a range is widened: far more than the rounding of a sum of
/// a few thousand terms.
const ROUNDING: f64 = 1e-12;
/// And by this, far more than what a few thousand products lose when they underflow.
const UNDERFLOW: f64 = f64::MIN_POSITIVE;

/// The bounds of x.
pub(super) struct Ranges<'a> {
    lcp: &'a Lcp,
    lo: Vec<f64>,
    hi: Vec<f64>,
}

impl<'a> Ranges<'a> {
    /// A friction row has the widest range that its normal row allows.
    pub fn new(lcp: &'a Lcp) -> Self {
        let reach = |i: usize| match lcp.coupled_to(i) {
            Some((_, 0.0)) => (0.0, 0.0),
            Some((k, mu)) => {
                let most = mu * lcp.hi()[k] + UNDERFLOW;
                (-most, most)
            }
            None => (lcp.lo()[i], lcp.hi()[i]),
        };
        let (lo, hi) = (0..lcp.len()).map(reach).unzip();
        Ranges { lcp, lo, hi }
    }

    /// Whether the rows with these sides may have the signs of w that they ask for; the sides of
    /// the following rows are open. A row with one choice asks for none.
    pub fn are_possible(&self, sides: &[Side], choices: &[Vec<Side>]) -> bool {
        let asks = |&(i, _): &(usize, &Side)| choices[i].len() > 1;
        sides.iter().enumerate().filter(asks).all(|(i, side)| {
            let (least, most) = self.of_w(i, sides);
            match side {
                Side::Free => least <= 0.0 && most >= 0.0,
                Side::Lower => most >= 0.0,
                Side::Upper => least <= 0.0,
            }
        })
    }

    fn of_x(&self, j: usize, sides: &[Side]) -> (f64, f64) {
        let (lo, hi) = (self.lo[j], self.hi[j]);
        match sides.get(j) {
            _ if self.lcp.is_coupled(j) => (lo, hi),
            Some(Side::Lower) => (lo, lo),
            Some(Side::Upper) => (hi, hi),
            Some(Side::Free) | None => (lo, hi),
        }
    }

    /// The least and the largest w_i, widened by the rounding of their sums and products. Where a
    /// sum overflows, the range has no end.
    fn of_w(&self, i: usize, sides: &[Side]) -> (f64, f64) {
        let b = self.lcp.b()[i];
        let (mut least, mut most) = ((b, b.abs()), (b, b.abs()));
        let add = |(sum, size): &mut (f64, f64), term: f64| {
            *sum += term;
            *size += term.abs();
        };
        for (j, a) in self.lcp.matrix().row(i).iter().filter(|(_, a)| *a != 0.0) {
            let (lo, hi) = self.of_x(j, sides);
            let (from, to) = if a > 0.0 { (lo, hi) } else { (hi, lo) };
            add(&mut least, a * from);
            add(&mut most, a * to);
        }
        let slack = |size: f64| ROUNDING * size + UNDERFLOW;
        // −∞ is a bound of x; ∞ − ∞ is an overflow.
        let or = |end: f64, without: f64| if end.is_nan() { without } else { end };
        (or(least.0 - slack(least.1), f64::NEG_INFINITY), or(most.0 + slack(most.1), f64::INFINITY))
    }
}
