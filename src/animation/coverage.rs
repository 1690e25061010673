//! Visibility: from front to back, each object claims the samples of the frame that are still free;
//! objects that get none are hidden.

use super::clip::Place;

/// Samples per px.
const FINE: f64 = 2.0;

/// The occupied samples of a frame.
pub(super) struct Coverage {
    columns: usize,
    rows: usize,
    taken: Vec<bool>,
}

impl Coverage {
    /// A frame of this size in px, all samples free.
    pub fn new(width: f64, height: f64) -> Self {
        let samples = |px: f64| (px * FINE).ceil().max(1.0) as usize;
        let (columns, rows) = (samples(width), samples(height));
        Coverage { columns, rows, taken: vec![false; columns * rows] }
    }

    /// Claims a convex polygon; returns whether any sample was free.
    pub fn claim_polygon(&mut self, corners: &[Place]) -> bool {
        let sign = area(corners).signum();
        let inside = |(x, y): Place| {
            corners.iter().enumerate().all(|(k, &(x1, y1))| {
                let (x0, y0) = corners[(k + corners.len() - 1) % corners.len()];
                sign * ((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) >= 0.0
            })
        };
        self.claim(corners, 0.0, inside)
    }

    /// Claims everything within a radius (px) of a line segment; returns whether any sample was
    /// free.
    pub fn claim_round(&mut self, ends: [Place; 2], radius: f64) -> bool {
        let [(x0, y0), (x1, y1)] = ends;
        let (dx, dy) = (x1 - x0, y1 - y0);
        let square = dx * dx + dy * dy;
        let inside = |(x, y): Place| {
            let along = (x - x0) * dx + (y - y0) * dy;
            let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
            let (ex, ey) = (x - x0 - share * dx, y - y0 - share * dy);
            ex * ex + ey * ey <= radius * radius
        };
        self.claim(&ends, radius, inside)
    }

    fn claim(&mut self, around: &[Place], radius: f64, inside: impl Fn(Place) -> bool) -> bool {
        let range = |pick: fn(&Place) -> f64, most: usize| {
            let values = around.iter().map(pick);
            let (lo, hi) = values
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
            let sample = |px: f64| (px * FINE).max(0.0) as usize;
            sample(lo - radius).min(most)..(sample(hi + radius) + 1).min(most)
        };
        let (columns, rows) = (range(|p| p.0, self.columns), range(|p| p.1, self.rows));
        let mut any = false;
        for row in rows {
            for column in columns.clone() {
                let taken = &mut self.taken[row * self.columns + column];
                let at = ((column as f64 + 0.5) / FINE, (row as f64 + 0.5) / FINE);
                if !*taken && inside(at) {
                    *taken = true;
                    any = true;
                }
            }
        }
        any
    }
}

/// Twice the signed area of a polygon.
fn area(corners: &[Place]) -> f64 {
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    pairs.map(|((x0, y0), (x1, y1))| x0 * y1 - x1 * y0).sum()
}
