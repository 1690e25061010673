//! Drops the points of a curve that no one can tell from the line without them (Ramer 1972; Douglas
//! and Peucker 1973).

/// The largest distance between a curve and its drawing in px.
const TOLERANCE: f64 = 0.1;

/// A point of the drawing in px.
type Place = (f64, f64);

/// The points of a curve from which no other one is farther away than [`TOLERANCE`] when they are
/// joined in order; the first and the last one among them.
pub(super) fn simplified(
    curve: &[(f64, f64)],
    place: impl Fn((f64, f64)) -> Place,
) -> Vec<(f64, f64)> {
    let at: Vec<Place> = curve.iter().map(|point| place(*point)).collect();
    let mut kept = vec![false; curve.len()];
    let mut open = vec![(0, curve.len().saturating_sub(1))];
    while let Some((first, last)) = open.pop() {
        let distance = |k: usize| distance(at[k], at[first], at[last]);
        for end in [first, last] {
            if let Some(kept) = kept.get_mut(end) {
                *kept = true;
            }
        }
        let farthest = (first + 1..last).max_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        if let Some(k) = farthest.filter(|k| distance(*k) > TOLERANCE) {
            open.extend([(first, k), (k, last)]);
        }
    }
    curve.iter().zip(kept).filter_map(|(point, kept)| kept.then_some(*point)).collect()
}

/// The distance of a point from the line between two others, ends included.
fn distance((x, y): Place, (x0, y0): Place, (x1, y1): Place) -> f64 {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let along = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
    let t = along.clamp(0.0, 1.0);
    (x - x0 - t * dx).hypot(y - y0 - t * dy)
}
