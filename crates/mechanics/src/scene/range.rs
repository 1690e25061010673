//! Numbers so large or small that what is computed from them is no number any more.
//!
//! Squares and products of two numbers of a scene are everywhere, and the inertia of a body grows
//! with the fifth power of its size: so no number is larger than 1e150, what is divided by is not
//! smaller than 1e-150, and lengths of shapes lie between 1e-60 and 1e60 m. What is beyond is one
//! clear defect here, and not a list of NaN later.

use lcplab_problem::error::Defects;

/// No number is larger: its square is still a double.
const LARGEST: f64 = 1e150;
/// No number that is divided by is smaller.
const SMALLEST: f64 = 1e-150;
/// Lengths of shapes (m): their fifth powers are still doubles.
const LENGTHS: [f64; 2] = [1e-60, 1e60];

/// A number that must be positive, and is divided by; `what` and its unit stand in the message.
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

/// The place (m) of a part in its body.
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
