//! Clips a convex polygon to a frame, one side of the frame after the other (Sutherland and Hodgman
//! 1974).

/// A position in px.
pub(super) type Place = (f64, f64);

/// The part of a convex polygon in the rectangle from (0, 0) to (width, height); empty if outside.
/// Two corners are a line segment.
pub(super) fn cut(polygon: Vec<Place>, width: f64, height: f64) -> Vec<Place> {
    let sides: [(f64, f64, f64); 4] =
        [(1.0, 0.0, 0.0), (-1.0, 0.0, width), (0.0, 1.0, 0.0), (0.0, -1.0, height)];
    sides.into_iter().fold(polygon, half)
}

/// The part where a x + b y + c ≥ 0.
fn half(polygon: Vec<Place>, (a, b, c): (f64, f64, f64)) -> Vec<Place> {
    let inside = |(x, y): Place| a * x + b * y + c;
    if polygon.iter().all(|place| inside(*place) >= 0.0) {
        return polygon;
    }
    let mut kept = Vec::new();
    for (k, &end) in polygon.iter().enumerate() {
        let start = polygon[(k + polygon.len() - 1) % polygon.len()];
        let (before, after) = (inside(start), inside(end));
        if (before >= 0.0) != (after >= 0.0) {
            let share = before / (before - after);
            kept.push((start.0 + share * (end.0 - start.0), start.1 + share * (end.1 - start.1)));
        }
        if after >= 0.0 {
            kept.push(end);
        }
    }
    if polygon.len() == 2 {
        kept.dedup();
        kept.truncate(2);
    }
    kept
}
