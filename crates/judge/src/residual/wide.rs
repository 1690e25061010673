//! Floating-point numbers whose exponent has no limits.
//!
//! A row in units of 1e-300 or 1e300 is a row like others: products and sums of its numbers must
//! not overflow or vanish on the way to a ratio. In the range of the doubles every operation gives
//! the same bits as that of `f64`.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// mantissa · 2^exponent. The mantissa is 0, ±∞, NaN, or its size is in [½, 1).
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

    /// The nearest double, which may be 0 or ∞.
    pub fn value(self) -> f64 {
        let most = 10_000; // beyond every exponent of a double
        libm::ldexp(self.mantissa, self.exponent.clamp(-most, most) as i32)
    }

    /// The mantissa, and the exponent of 2 beside it.
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

    /// √(a² + b²), without a detour through the squares.
    pub fn hypot(self, other: Self) -> Self {
        let exponent = self.exponent.max(other.exponent);
        let at = |x: Wide| Wide { exponent: x.exponent - exponent, ..x }.value();
        match (self.is_zero(), other.is_zero()) {
            (true, _) => other.abs(),
            (_, true) => self.abs(),
            _ => Wide::new(lcplab_problem::hypot(at(self), at(other)), exponent),
        }
    }

    /// self / other with 0/0 = 0; anything else that has no value counts as ∞.
    pub(crate) fn relative_to(self, other: Self) -> f64 {
        match (self / other).value() {
            _ if self.is_zero() => 0.0,
            _ if !other.is_finite() => f64::INFINITY, // x is not finite
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
