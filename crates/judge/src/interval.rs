//! Interval arithmetic: each result contains the exact result of the operation.
//!
//! The rounding error of a sum or a product is itself a floating-point number (Knuth, Dekker); its
//! sign says on which side of the rounded value the exact value lies, and only that bound is moved
//! to the next number. The bounds are therefore those of directed rounding, and exact results, such
//! as sums of small integers, remain single points.

use std::ops::{Add, Mul, Neg, Sub};

/// Products below this may have lost part of their error to underflow.
const SMALL: f64 = 1e-250;

/// All numbers from `lo` to `hi`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Interval {
    pub(super) lo: f64,
    pub(super) hi: f64,
}

impl Interval {
    pub(super) const ZERO: Interval = Interval { lo: 0.0, hi: 0.0 };

    /// The interval from −radius to radius.
    pub(super) fn around_zero(radius: f64) -> Self {
        Interval { lo: -radius, hi: radius }
    }

    /// The midpoint, rounded.
    pub(super) fn middle(self) -> f64 {
        0.5 * self.lo + 0.5 * self.hi
    }

    /// The largest absolute value in the interval.
    pub(super) fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// Σ a b.
    pub(super) fn dot(terms: impl Iterator<Item = (Interval, Interval)>) -> Self {
        terms.fold(Interval::ZERO, |sum, (a, b)| sum + a * b)
    }
}

impl From<f64> for Interval {
    fn from(x: f64) -> Self {
        Interval { lo: x, hi: x }
    }
}

impl Add for Interval {
    type Output = Interval;

    fn add(self, other: Interval) -> Interval {
        Interval { lo: add(self.lo, other.lo).lo, hi: add(self.hi, other.hi).hi }
    }
}

impl Neg for Interval {
    type Output = Interval;

    fn neg(self) -> Interval {
        Interval { lo: -self.hi, hi: -self.lo }
    }
}

impl Sub for Interval {
    type Output = Interval;

    fn sub(self, other: Interval) -> Interval {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Interval;

    fn mul(self, other: Interval) -> Interval {
        let (a, b) = (self, other);
        let products = [mul(a.lo, b.lo), mul(a.lo, b.hi), mul(a.hi, b.lo), mul(a.hi, b.hi)];
        Interval {
            lo: products.iter().map(|p| p.lo).fold(f64::INFINITY, f64::min),
            hi: products.iter().map(|p| p.hi).fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

/// The sum of two upper bounds, rounded up.
pub(super) fn add_up(a: f64, b: f64) -> f64 {
    add(a, b).hi
}

/// The product of two upper bounds that are at least 0, rounded up; 0 · ∞ = 0.
pub(super) fn mul_up(a: f64, b: f64) -> f64 {
    mul(a, b).hi
}

/// √x, rounded up.
pub(super) fn sqrt_up(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.sqrt().next_up() }
}

/// a / b for a, b > 0, rounded up.
pub(super) fn div_up(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { (a / b).next_up() }
}

/// |v|₂ of numbers in these intervals, rounded up.
pub(super) fn norm_up(v: impl Iterator<Item = Interval>) -> f64 {
    sqrt_up(v.map(Interval::magnitude).fold(0.0, |sum, v| add_up(sum, mul_up(v, v))))
}

fn add(a: f64, b: f64) -> Interval {
    let sum = a + b;
    let part = sum - a;
    enclosing(sum, (a - (sum - part)) + (b - part))
}

fn mul(a: f64, b: f64) -> Interval {
    if a == 0.0 || b == 0.0 {
        return Interval::ZERO;
    }
    let product = a * b;
    enclosing(product, if product.abs() < SMALL { f64::NAN } else { a.mul_add(b, -product) })
}

/// The interval around value + error; only the sign of the error matters, and NaN means unknown.
fn enclosing(value: f64, error: f64) -> Interval {
    Interval {
        lo: if error >= 0.0 { value } else { value.next_down() },
        hi: if error <= 0.0 { value } else { value.next_up() },
    }
}
