//! √(a² + b²), with the same bits on every machine.

/// Beyond it squares overflow.
const LARGE: f64 = f64::from_bits((1023 + 511) << 52);
/// Below it squares lose digits.
const SMALL: f64 = f64::from_bits((1023 - 459) << 52);
/// By so much numbers are brought near 1: 2⁻⁶⁰⁰.
const SCALE: f64 = f64::from_bits((1023 - 600) << 52);
/// Beside 1 the square of this is nothing: 2⁻⁵⁴.
const NOTHING: f64 = f64::from_bits((1023 - 54) << 52);

/// √(a² + b²) without overflow, corrected by one step of Newton's method on what rounding has left
/// (Borges 2019), so that it is nearly always the nearest number. The standard library's calls that
/// of the system.
///
/// ```
/// assert_eq!(lcplab_problem::hypot(3.0, -4.0), 5.0);
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

/// The same for a ≥ b > 0 whose squares are ordinary numbers.
fn corrected(a: f64, b: f64) -> f64 {
    let h = (a * a + b * b).sqrt();
    // h² − a² − b², so arranged that hardly anything is lost
    let excess = if h <= 2.0 * b {
        let d = h - b;
        a * (2.0 * d - a) + (d - 2.0 * (a - b)) * d
    } else {
        let d = h - a;
        2.0 * d * (a - 2.0 * b) + ((4.0 * d - b) * b + d * d)
    };
    h - excess / (2.0 * h)
}
