//! Places for labels inside a plot, where they cover no curve, no marker and no other label.

use super::canvas::Frame;

/// The size in px of a cell of the map of what is drawn.
const CELL: f64 = 3.0;
/// The space in px around a label that should be free.
const CLEAR: f64 = 2.0;
/// The half height in px of what a marker covers.
const MARKER: f64 = 7.0;
/// The distances in px from a point of a curve to its label.
const DISTANCES: [f64; 7] = [6.0, 10.0, 16.0, 26.0, 40.0, 60.0, 90.0];
/// The directions from a point of a curve to its label, in halves of the label's size.
const SIDES: [f64; 5] = [0.0, 0.5, -0.5, 1.0, -1.0];
/// The costs of a covered cell and of a cell under the leader, relative to a px of distance from
/// the curve.
const COVERED: f64 = 40.0;
const CROSSED: f64 = 12.0;

/// A label that needs a place.
pub(super) struct Wanted {
    /// The width and height of its text (px).
    pub size: (f64, f64),
    /// The points of its curve next to which it can stand, those that are preferred first.
    pub points: Vec<(f64, f64)>,
    /// The cost of a px along these points.
    pub along: f64,
}

/// A label's place (px).
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// The point of the curve to which the leader goes.
    pub from: (f64, f64),
    /// The middle of the text.
    pub middle: (f64, f64),
    size: (f64, f64),
}

impl Place {
    /// The end of the leader: the point of the label next to the curve.
    pub fn to(&self) -> (f64, f64) {
        let near = |from: f64, middle: f64, size: f64| {
            from.clamp(middle - size / 2.0, middle + size / 2.0)
        };
        let (width, height) = self.size;
        (near(self.from.0, self.middle.0, width), near(self.from.1, self.middle.1, height - 4.0))
    }
}

/// A map of a plot: which cells are covered.
pub(super) struct Map {
    left: f64,
    top: f64,
    columns: usize,
    rows: usize,
    covered: Vec<u32>,
}

impl Map {
    /// The map of an empty plot.
    pub fn new(frame: &Frame) -> Self {
        let cells = |length: f64| (length / CELL).ceil().max(1.0) as usize;
        let (columns, rows) = (cells(frame.right - frame.left), cells(frame.bottom - frame.top));
        let covered = vec![0; columns * rows];
        Map { left: frame.left, top: frame.top, columns, rows, covered }
    }

    fn cell(&self, (x, y): (f64, f64)) -> Option<usize> {
        let (column, row) = ((x - self.left) / CELL, (y - self.top) / CELL);
        let inside =
            column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64;
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// Marks what a line covers.
    pub fn line(&mut self, points: &[(f64, f64)]) {
        for ends in points.windows(2) {
            for point in steps(ends[0], ends[1], CELL / 2.0) {
                if let Some(cell) = self.cell(point) {
                    self.covered[cell] = 1;
                }
            }
        }
    }

    /// Marks what a marker covers.
    pub fn marker(&mut self, (x, y): (f64, f64)) {
        self.change((x, y), (2.0 * MARKER, 2.0 * MARKER), |_| 1);
    }

    /// Changes the cells of a rectangle around this middle.
    fn change(&mut self, (x, y): (f64, f64), (width, height): (f64, f64), new: fn(u32) -> u32) {
        let steps = |length: f64| (length / CELL).ceil() as usize;
        for row in 0..=steps(height) {
            for column in 0..=steps(width) {
                let at =
                    (x - width / 2.0 + CELL * column as f64, y - height / 2.0 + CELL * row as f64);
                if let Some(cell) = self.cell(at) {
                    self.covered[cell] = new(self.covered[cell]);
                }
            }
        }
    }

    /// The places of labels. A second round moves labels that later ones have forced aside.
    pub fn labels(&mut self, labels: &[Wanted]) -> Vec<Option<Place>> {
        let mut places: Vec<Option<Place>> = vec![None; labels.len()];
        for _ in 0..2 {
            for (place, wanted) in places.iter_mut().zip(labels) {
                if let Some(place) = place {
                    self.change(place.middle, place.size, |covered| covered.saturating_sub(LABEL));
                }
                *place = self.best(wanted);
                if let Some(place) = place {
                    self.change(place.middle, place.size, |covered| covered + LABEL);
                }
            }
        }
        places
    }

    fn best(&self, wanted: &Wanted) -> Option<Place> {
        let Wanted { size, points, along: price } = wanted;
        let sums = self.sums();
        let mut best: Option<(f64, Place)> = None;
        let mut along = 0.0;
        let mut last = points.first().copied()?;
        for &from in points {
            along += (from.0 - last.0).hypot(from.1 - last.1);
            last = from;
            for distance in DISTANCES {
                let least = distance + price * along;
                if best.is_some_and(|(cost, _)| cost <= least) {
                    break;
                }
                for place in around(from, distance, *size) {
                    let Some(covered) = self.covered(&sums, &place) else { continue };
                    let leader = self.crossed(place.from, place.to());
                    let cost = least + COVERED * covered + CROSSED * leader;
                    if best.is_none_or(|(least, _)| cost < least) {
                        best = Some((cost, place));
                    }
                }
            }
        }
        best.map(|(_, place)| place)
    }

    /// The sums over all cells above and left of each corner.
    fn sums(&self) -> Vec<f64> {
        let wide = self.columns + 1;
        let mut sums = vec![0.0; wide * (self.rows + 1)];
        for row in 0..self.rows {
            for column in 0..self.columns {
                let corner = (row + 1) * wide + column + 1;
                sums[corner] = f64::from(self.covered[row * self.columns + column])
                    + sums[corner - 1]
                    + sums[corner - wide]
                    - sums[corner - wide - 1];
            }
        }
        sums
    }

    /// The sum over the cells that a label covers; `None` if it would not be inside the plot.
    fn covered(&self, sums: &[f64], place: &Place) -> Option<f64> {
        let ((x, y), (width, height)) = (place.middle, place.size);
        let (left, top) = (x - width / 2.0 - self.left, y - height / 2.0 - self.top);
        let (right, bottom) = (left + width, top + height);
        let (wide, high) = (CELL * self.columns as f64, CELL * self.rows as f64);
        if left < 0.0 || top < 0.0 || right > wide || bottom > high {
            return None;
        }
        let from = |px: f64| ((px - CLEAR) / CELL).floor().max(0.0) as usize;
        let to = |px: f64, most: usize| (((px + CLEAR) / CELL).ceil() as usize).min(most);
        let (left, right) = (from(left), to(right, self.columns));
        let (top, bottom) = (from(top), to(bottom, self.rows));
        let sum = |row: usize, column: usize| sums[row * (self.columns + 1) + column];
        Some(sum(bottom, right) - sum(top, right) - sum(bottom, left) + sum(top, left))
    }

    /// The number of covered cells under a leader, beyond the marker at its start.
    fn crossed(&self, from: (f64, f64), to: (f64, f64)) -> f64 {
        let under = steps(from, to, CELL).filter(|(x, y)| (x - from.0).hypot(y - from.1) > MARKER);
        under.filter(|point| self.cell(*point).is_some_and(|cell| self.covered[cell] > 0)).count()
            as f64
    }
}

/// What a label adds to the cells that it covers.
const LABEL: u32 = 8;

/// The places of a label of this size at this distance around a point.
fn around(from: (f64, f64), distance: f64, size: (f64, f64)) -> impl Iterator<Item = Place> {
    let sides = SIDES.into_iter().flat_map(|across| SIDES.map(|down| (across, down)));
    let outside = sides.filter(|(across, down)| f64::max(across.abs(), down.abs()) == 1.0);
    outside.map(move |(across, down)| {
        let middle = (
            from.0 + across * (size.0 / 2.0 + distance),
            from.1 + down * (size.1 / 2.0 + distance),
        );
        Place { from, middle, size }
    })
}

/// Points from one end of a line to the other, at most so far apart.
pub(super) fn steps(
    from: (f64, f64),
    to: (f64, f64),
    apart: f64,
) -> impl Iterator<Item = (f64, f64)> {
    let (across, down) = (to.0 - from.0, to.1 - from.1);
    let count = (across.hypot(down) / apart).ceil().max(1.0) as usize;
    (0..=count).map(move |k| {
        let part = k as f64 / count as f64;
        (from.0 + part * across, from.1 + part * down)
    })
}
