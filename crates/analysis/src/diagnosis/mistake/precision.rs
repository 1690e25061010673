//! Estimates the number of significant digits in an answer.
//!
//! An answer printed with three decimals agrees with everything that rounds to it. Therefore the
//! precision of an answer is estimated from its own numbers before it is compared: whether they all
//! have few decimal digits, are all 32-bit numbers, or neither.

/// Numbers with more decimal digits than this were not rounded to decimals.
const MOST_DIGITS: i32 = 14;

/// The precision of the numbers in an answer.
///
/// ```
/// use lcplab_analysis::diagnosis::Precision;
///
/// // Printed with three decimals: each number may be off by half of the last one.
/// let precision = Precision::of(&[0.333, 0.5]);
/// assert_eq!(precision, Precision::Decimal { digits: 3, decimals: 3 });
/// assert!((precision.half_unit(0.333) - 0.0005).abs() < 1e-18);
/// assert_eq!(Precision::of(&[1.0 / 3.0]), Precision::Double);
/// assert_eq!(Precision::of(&[f64::from(1.0_f32 / 3.0)]), Precision::Single);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// Full double precision.
    Double,
    /// All numbers are 32-bit numbers.
    Single,
    /// All numbers have few decimal digits.
    Decimal {
        /// The maximum number of significant digits.
        digits: i32,
        /// The maximum number of digits after the decimal point.
        decimals: i32,
    },
}

impl Precision {
    /// The precision of these numbers; zeros are ignored, because any rounding gives them.
    pub fn of(x: &[f64]) -> Precision {
        let numbers = || x.iter().filter(|x| x.is_finite() && **x != 0.0);
        let digits = numbers().map(|x| decimal(*x).0).max();
        let decimals =
            numbers().map(|x| decimal(*x)).map(|(digits, first)| digits - 1 - first).max();
        match (digits, decimals) {
            (Some(digits), Some(decimals)) if digits <= MOST_DIGITS => {
                Precision::Decimal { digits, decimals: decimals.max(0) }
            }
            (Some(_), _) if numbers().all(|&x| f64::from(x as f32) == x) => Precision::Single,
            _ => Precision::Double,
        }
    }

    /// The maximum distance of the unrounded number from the number x.
    pub fn half_unit(self, x: f64) -> f64 {
        let power = |exponent: i32| 0.5 * libm::exp10(f64::from(exponent));
        match self {
            Precision::Double => 0.5 * f64::EPSILON * x.abs(),
            Precision::Single => 0.5 * f64::from(f32::EPSILON) * x.abs(),
            // Either count may be that of the format; the coarser one is safe.
            Precision::Decimal { decimals, .. } if x == 0.0 => power(-decimals),
            Precision::Decimal { digits, decimals } => {
                power(-decimals).max(power(decimal(x).1 - digits + 1))
            }
        }
    }
}

/// The number of significant decimal digits, and the power of ten of the first.
fn decimal(x: f64) -> (i32, i32) {
    let shortest = format!("{:e}", x.abs());
    let (mantissa, exponent) = shortest.split_once('e').unwrap_or((&shortest, "0"));
    let digits = mantissa.chars().filter(char::is_ascii_digit).count();
    (digits as i32, exponent.parse().unwrap_or(0))
}
