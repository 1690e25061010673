//! Checks of lesson 1, complementarity by hand.

use super::Verdict;

/// Π onto [lo, hi]: held against the nearest of many points of the interval.
///
/// # Errors
/// Says which law an answer breaks, and where.
pub fn clamp(answer: fn(f64, f64, f64) -> f64) -> Verdict {
    for (x, lo, hi) in [(0.5, 0.0, 1.0), (-2.0, 0.0, 1.0), (3.0, 0.0, 1.0), (7.0, 2.0, 2.0)] {
        let got = answer(x, lo, hi);
        if !(lo..=hi).contains(&got) {
            return Err(format!(
                "for x = {x} on [{lo}, {hi}] the answer {got} lies outside the interval"
            ));
        }
        let points = (0..=1000).map(|k| lo + (hi - lo) * f64::from(k) / 1000.0);
        let nearest = points.map(|point| (point - x).abs()).fold(f64::INFINITY, f64::min);
        if (got - x).abs() > nearest + 1e-12 {
            return Err(format!(
                "for x = {x} on [{lo}, {hi}] another point is nearer to x than {got}"
            ));
        }
    }
    let got = answer(5.0, 0.0, f64::INFINITY);
    if got != 5.0 {
        return Err(format!(
            "a contact has hi = ∞: x = 5 is inside its bounds, the answer is {got}"
        ));
    }
    Ok(())
}

/// One row, w = a x + b with lo ≤ x ≤ hi: held against the three cases of the definition.
///
/// # Errors
/// Says which case an answer misses.
pub fn one_row(answer: fn(f64, f64, f64, f64) -> f64) -> Verdict {
    for (a, b, lo, hi) in [
        (2.0, -3.0, 0.0, f64::INFINITY),
        (0.5, 1.0, 0.0, f64::INFINITY),
        (4.0, -12.0, -1.0, 2.0),
        (3.0, 6.0, -1.0, 2.0),
    ] {
        let x = answer(a, b, lo, hi);
        let w = a * x + b;
        let at = format!("a = {a}, b = {b}, bounds [{lo}, {hi}]: x = {x} gives w = {w}");
        if !(lo..=hi).contains(&x) {
            return Err(format!("{at}; x lies outside its bounds"));
        }
        if w > 1e-12 && x > lo {
            return Err(format!("{at}; with w > 0 the impulse must not be above its lower bound"));
        }
        if w < -1e-12 && x < hi {
            return Err(format!("{at}; with w < 0 the impulse must not be below its upper bound"));
        }
    }
    Ok(())
}

/// Two rows, w = A x + b ≥ 0, x ≥ 0, x·w = 0: held against the definition, entry by entry.
///
/// # Errors
/// Says which condition an answer breaks.
pub fn two_rows(answer: fn([[f64; 2]; 2], [f64; 2]) -> [f64; 2]) -> Verdict {
    let a = [[2.0, -1.0], [-1.0, 2.0]];
    for (a, b) in [
        (a, [-1.0, 2.0]),
        (a, [2.0, -1.0]),
        (a, [-1.0, -1.0]),
        (a, [1.0, 3.0]),
        ([[2.0, 1.0], [1.0, 2.0]], [-4.0, -1.0]),
    ] {
        let x = answer(a, b);
        for i in 0..2 {
            let w = a[i][0] * x[0] + a[i][1] * x[1] + b[i];
            let at = format!("A = {a:?}, b = {b:?}: x = {x:?} gives w[{i}] = {w}");
            if !(x[i] >= 0.0) {
                return Err(format!("{at}; x[{i}] must not be negative"));
            }
            if !(w >= -1e-12) {
                return Err(format!("{at}; that contact goes on closing"));
            }
            if x[i] * w > 1e-12 {
                return Err(format!("{at}; a contact that opens must have no impulse"));
            }
        }
    }
    Ok(())
}
