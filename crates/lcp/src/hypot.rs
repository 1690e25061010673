//! √(a² + b²), bitwise identical on every machine.

/// Squares of larger numbers overflow.
const LARGE: f64 = f64::from_bits((1023 + 511) << 52);
/// Squares of smaller numbers lose digits.
const SMALL: f64 = f64::from_bits((1023 - 459) << 52);
/// Factor that brings large numbers close to 1: 2⁻⁶⁰⁰.
const SCALE: f64 = f64::from_bits((1023 - 600) << 52);
/// The square of this number is negligible compared with 1: 2⁻⁵⁴.
const NOTHING: f64 = f64::from_bits((1023 - 54) << 52);

/// √(a² + b²) without overflow. One step of Newton's method corrects the rounding error (Borges
/// 2019), so that the result is nearly always the nearest `f64`. The standard library calls the
/// system's function, whose last digit varies.
///
/// ```
/// assert_eq!(lcplab_lcp::hypot(3.0, -4.0), 5.0);
/// ```
pub fn hypot(a: f64, b: f64) -> f64 {
    if a.is_infinite() || b.is_infinite() {
        return f64::INFINITY;
    }
    if a.is_nan() || b.is_nan() {
        return f64::NAN;
    }
    let (a, b) = (a.abs().max(b.abs()), a.abs().min(b.abs()));
    if b <= a * NOTHING {
        return a + b;
    }
    if a > LARGE {
        return corrected(a * SCALE, b * SCALE) / SCALE;
    }
    if b < SMALL {
        return corrected(a / SCALE, b / SCALE) * SCALE;
    }
    corrected(a, b)
}

/// `hypot` for a ≥ b > 0 whose squares neither overflow nor lose digits.
fn corrected(a: f64, b: f64) -> f64 {
    let h = (a * a + b * b).sqrt();
    // h² − a² − b², in an order that loses hardly any digits
    let excess = if h <= 2.0 * b {
        let d = h - b;
        a * (2.0 * d - a) + (d - 2.0 * (a - b)) * d
    } else {
        let d = h - a;
        2.0 * d * (a - 2.0 * b) + ((4.0 * d - b) * b + d * d)
    };
    h - excess / (2.0 * h)
}
