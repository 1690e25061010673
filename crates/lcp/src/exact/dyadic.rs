//! Exact binary fractions: every finite floating-point number is one, and so are sums and products.
//!
//! ```
//! use dashu_ratio::RBig;
//! use lcplab_lcp::exact::dyadic::{dyadic, integers, rational, whole};
//!
//! assert_eq!(rational(&dyadic(0.75)), RBig::from_parts(3.into(), 4u8.into()));
//! assert_eq!(whole(6.into()), dyadic(6.0));
//! assert_eq!(integers(&[dyadic(0.5), dyadic(0.75)]), [2.into(), 3.into()]); // both times 4
//! ```

use dashu_float::FBig;
use dashu_float::round::mode::Zero;
use dashu_int::IBig;
use dashu_int::ops::{BitTest, UnsignedAbs};
use dashu_ratio::RBig;

/// An exact binary fraction.
pub type Dyadic = FBig<Zero, 2>;

/// A finite number as an exact binary fraction.
pub fn dyadic(x: f64) -> Dyadic {
    // Adding 0 turns −0 into 0.
    exact_precision(Dyadic::try_from(x + 0.0).expect("a finite number"))
}

/// An integer as an exact binary fraction.
pub fn whole(x: IBig) -> Dyadic {
    exact_precision(Dyadic::from(x))
}

/// Sets precision 0, which means unlimited: all later sums and products are exact.
fn exact_precision(x: Dyadic) -> Dyadic {
    x.with_precision(0).value()
}

/// The same number as a rational.
pub fn rational(x: &Dyadic) -> RBig {
    let (significand, exponent) = x.repr().clone().into_parts();
    let power = IBig::ONE << exponent.unsigned_abs();
    if exponent >= 0 {
        RBig::from(significand * power)
    } else {
        RBig::from_parts(significand, power.unsigned_abs())
    }
}

/// The exponent e with 2^(e−1) ≤ |x| < 2^e; `None` for 0.
///
/// ```
/// use lcplab_lcp::exact::dyadic::{dyadic, exponent};
///
/// assert_eq!(exponent(&dyadic(-6.0)), Some(3));
/// assert_eq!(exponent(&dyadic(0.25)), Some(-1));
/// assert_eq!(exponent(&dyadic(0.0)), None);
/// ```
pub fn exponent(x: &Dyadic) -> Option<isize> {
    let repr = x.repr();
    (*x != Dyadic::ZERO).then(|| repr.exponent() + repr.significand().bit_len() as isize)
}

/// The largest multiple of 2^exponent that is at most x.
///
/// ```
/// use lcplab_lcp::exact::dyadic::{dyadic, floor};
///
/// assert_eq!(floor(&dyadic(5.75), -1), dyadic(5.5));
/// assert_eq!(floor(&dyadic(-5.75), 1), dyadic(-6.0));
/// ```
pub fn floor(x: &Dyadic, exponent: isize) -> Dyadic {
    let (significand, own) = x.repr().clone().into_parts();
    match usize::try_from(exponent - own) {
        Ok(shift) => whole(significand >> shift) << exponent,
        Err(_) => x.clone(),
    }
}

/// The numbers of an equation times a power of two that makes all of them integers.
pub fn integers(equation: &[Dyadic]) -> Vec<IBig> {
    let nonzero = || equation.iter().filter(|x| **x != Dyadic::ZERO);
    let least = nonzero().map(|x| x.repr().exponent()).min().unwrap_or(0);
    let integer = |x: &Dyadic| {
        let (significand, exponent) = x.repr().clone().into_parts();
        match usize::try_from(exponent - least) {
            Ok(shift) if *x != Dyadic::ZERO => significand << shift,
            _ => IBig::ZERO,
        }
    };
    equation.iter().map(integer).collect()
}

/// The smallest `f64` that is at least x.
///
/// ```
/// use lcplab_lcp::exact::rounded_up;
///
/// let third = dashu_ratio::RBig::from_parts(1.into(), 3u8.into());
/// assert_eq!(rounded_up(&third), (1.0_f64 / 3.0).next_up()); // 1/3 is rounded down
/// ```
pub fn rounded_up(x: &RBig) -> f64 {
    let mut bound = x.to_f64().value();
    while bound.is_finite() && rational(&dyadic(bound)) < *x {
        bound = bound.next_up();
    }
    bound
}
