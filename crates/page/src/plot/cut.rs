//! Clips a curve to a rectangle (Liang and Barsky 1984).

/// The parts of a curve with x and y in the given ranges, each as its points in order.
pub(super) fn cut(curve: &[(f64, f64)], x: (f64, f64), y: (f64, f64)) -> Vec<Vec<(f64, f64)>> {
    let mut parts: Vec<Vec<(f64, f64)>> = Vec::new();
    for ends in curve.windows(2) {
        let Some((start, end)) = inside(ends[0], ends[1], x, y) else { continue };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&start) => part.push(end),
            _ => parts.push(vec![start, end]),
        }
    }
    parts
}

/// The part of the line from a to b inside the rectangle; ends that lie inside stay exactly the
/// same.
fn inside(
    a: (f64, f64),
    b: (f64, f64),
    x: (f64, f64),
    y: (f64, f64),
) -> Option<((f64, f64), (f64, f64))> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (from, to, (low, high)) in [(a.0, b.0, x), (a.1, b.1, y)] {
        let length = to - from;
        if length == 0.0 {
            if from < low || from > high {
                return None;
            }
            continue;
        }
        let (first, second) = ((low - from) / length, (high - from) / length);
        enter = enter.max(first.min(second));
        leave = leave.min(first.max(second));
    }
    let at = |t: f64| match t {
        0.0 => a,
        1.0 => b,
        t => (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1)),
    };
    (enter <= leave).then(|| (at(enter), at(leave)))
}
