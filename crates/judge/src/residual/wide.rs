//! Floating-point numbers with an unlimited exponent.
//!
//! Products and sums of a row in units of 1e-300 or 1e300 must not overflow or underflow before
//! their ratio is taken. Within the range of `f64` every operation gives bitwise the same result as
//! `f64`.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// mantissa · 2^exponent. The mantissa is 0, ±∞ or NaN, or its absolute value is in [½, 1).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wide {
    mantissa: f64,
    exponent: i64,
}

impl Wide {
    pub const ZERO: Wide = Wide { mantissa: 0.0, exponent: 0 };
    pub const INFINITY: Wide = Wide { mantissa: f64::INFINITY, exponent: 0 };

    /// value · 2^exponent.
    pub fn new(value: f64, exponent: i64) -> Self {
        if value == 0.0 || !value.is_finite() {
            return Wide { mantissa: value, exponent: 0 };
        }
        let (mantissa, own) = libm::frexp(value);
        Wide { mantissa, exponent: exponent + i64::from(own) }
    }

    /// The nearest `f64`, which may be 0 or ∞.
    pub fn value(self) -> f64 {
        // Larger than any exponent of an `f64`.
        let most = 10_000;
        libm::ldexp(self.mantissa, self.exponent.clamp(-most, most) as i32)
    }

    /// The mantissa and the exponent.
    pub fn parts(self) -> (f64, i64) {
        (self.mantissa, self.exponent)
    }

    pub fn is_zero(self) -> bool {
        self.mantissa == 0.0
    }

    pub fn is_finite(self) -> bool {
        self.mantissa.is_finite()
    }

    pub fn abs(self) -> Self {
        Wide { mantissa: self.mantissa.abs(), ..self }
    }

    pub fn sqrt(self) -> Self {
        if !self.is_finite() || self.is_zero() {
            return self;
        }
        let odd = self.exponent.rem_euclid(2);
        Wide::new(libm::ldexp(self.mantissa, odd as i32).sqrt(), (self.exponent - odd) / 2)
    }

    pub fn min(self, other: Self) -> Self {
        if other < self || self.mantissa.is_nan() { other } else { self }
    }

    pub fn max(self, other: Self) -> Self {
        if other > self || self.mantissa.is_nan() { other } else { self }
    }

    /// √(a² + b²) without computing the squares.
    pub fn hypot(self, other: Self) -> Self {
        let exponent = self.exponent.max(other.exponent);
        let at = |x: Wide| Wide { exponent: x.exponent - exponent, ..x }.value();
        match (self.is_zero(), other.is_zero()) {
            (true, _) => other.abs(),
            (_, true) => self.abs(),
            _ => Wide::new(lcplab_lcp::hypot(at(self), at(other)), exponent),
        }
    }

    /// self / other with 0/0 = 0; any other undefined ratio counts as ∞.
    pub(crate) fn relative_to(self, other: Self) -> f64 {
        match (self / other).value() {
            _ if self.is_zero() => 0.0,
            // x is not finite.
            _ if !other.is_finite() => f64::INFINITY,
            ratio if ratio.is_nan() => f64::INFINITY,
            ratio => ratio,
        }
    }
}

impl From<f64> for Wide {
    fn from(value: f64) -> Self {
        Wide::new(value, 0)
    }
}

impl Neg for Wide {
    type Output = Wide;

    fn neg(self) -> Wide {
        Wide { mantissa: -self.mantissa, ..self }
    }
}

impl Mul for Wide {
    type Output = Wide;

    fn mul(self, other: Wide) -> Wide {
        Wide::new(self.mantissa * other.mantissa, self.exponent + other.exponent)
    }
}

impl Div for Wide {
    type Output = Wide;

    fn div(self, other: Wide) -> Wide {
        Wide::new(self.mantissa / other.mantissa, self.exponent - other.exponent)
    }
}

impl Add for Wide {
    type Output = Wide;

    fn add(self, other: Wide) -> Wide {
        if self.is_zero() || other.is_zero() || !self.is_finite() || !other.is_finite() {
            let larger = if self.is_zero() || !other.is_finite() { other } else { self };
            let sum = self.mantissa + other.mantissa;
            return if sum.is_finite() { larger } else { Wide::from(sum) };
        }
        let (large, small) = match self.exponent >= other.exponent {
            true => (self, other),
            false => (other, self),
        };
        let below = (small.exponent - large.exponent).max(-2_000) as i32;
        Wide::new(large.mantissa + libm::ldexp(small.mantissa, below), large.exponent)
    }
}

impl Sub for Wide {
    type Output = Wide;

    fn sub(self, other: Wide) -> Wide {
        self + -other
    }
}

impl PartialEq for Wide {
    fn eq(&self, other: &Wide) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Wide {
    fn partial_cmp(&self, other: &Wide) -> Option<Ordering> {
        match (self.is_finite(), other.is_finite()) {
            (true, true) => (*self - *other).mantissa.partial_cmp(&0.0),
            (true, false) => 0.0.partial_cmp(&other.mantissa),
            (false, true) => self.mantissa.partial_cmp(&0.0),
            (false, false) => self.mantissa.partial_cmp(&other.mantissa),
        }
    }
}
