//! Range checks: numbers so large or small that computations would overflow or underflow.
//!
//! Squares and products of two numbers of a scene occur everywhere, and the inertia of a body grows
//! with the fifth power of its size. Therefore no number may exceed 1e150, divisors must be at
//! least 1e-150, and lengths of shapes must lie between 1e-60 and 1e60 m. Anything outside is
//! reported here as one clear defect instead of a list of NaN later.

use lcplab_lcp::error::Defects;

/// Maximum of all numbers: its square is still finite.
const LARGEST: f64 = 1e150;
/// Minimum of all divisors.
const SMALLEST: f64 = 1e-150;
/// Range of the lengths of shapes (m): their fifth powers are still finite.
const LENGTHS: [f64; 2] = [1e-60, 1e60];

/// A positive number that is used as a divisor; `what` and its unit appear in the message.
pub(super) fn divisor(
    defects: &mut Defects,
    place: impl Into<String>,
    [what, unit]: [&str; 2],
    value: f64,
) -> bool {
    within(defects, place, [what, unit], value, [SMALLEST, LARGEST])
}

/// A length (m) of a shape.
pub(super) fn length(defects: &mut Defects, place: impl Into<String>, value: f64) -> bool {
    within(defects, place, ["length", "m"], value, LENGTHS)
}

/// A coefficient that must be at least 0.
pub(super) fn coefficient(defects: &mut Defects, place: impl Into<String>, value: f64) {
    if !(value >= 0.0 && value.is_finite()) {
        defects.add(place, format!("must be at least 0, is {value}"));
    } else if value > LARGEST {
        defects.add(place, format!("{value:e} is too large, at most {LARGEST:e}"));
    }
}

/// Three numbers that must be finite.
pub(super) fn vector(defects: &mut Defects, place: &str, numbers: &[f64; 3]) {
    up_to(LARGEST, defects, place, numbers);
}

/// The offset (m) of a part within its body.
pub(super) fn offset(defects: &mut Defects, place: &str, numbers: &[f64; 3]) -> bool {
    up_to(LENGTHS[1], defects, place, numbers)
}

fn up_to(most: f64, defects: &mut Defects, place: &str, numbers: &[f64; 3]) -> bool {
    let reason = match numbers.iter().find(|x| !(x.abs() <= most)) {
        None => return true,
        Some(bad) if bad.is_finite() => format!("{bad:e} is too large, at most {most:e}"),
        Some(bad) => format!("must be finite, has {bad}"),
    };
    defects.add(place, reason);
    false
}

fn within(
    defects: &mut Defects,
    place: impl Into<String>,
    [what, unit]: [&str; 2],
    value: f64,
    [least, most]: [f64; 2],
) -> bool {
    let reason = match value {
        value if !(value > 0.0 && value.is_finite()) => format!("must be positive, is {value}"),
        value if value < least => {
            format!("{what} {value:e} {unit} is too small, at least {least:e} {unit}")
        }
        value if value > most => {
            format!("{what} {value:e} {unit} is too large, at most {most:e} {unit}")
        }
        _ => return true,
    };
    defects.add(place, reason);
    false
}
