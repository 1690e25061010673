//! Where the frames stand on the sheet, and where a point stands in a frame.

use nalgebra::Vector3;

use super::Camera;
use super::extent::Landmark;
use crate::plot::style::{EDGE, WIDTH};

/// Between two frames in px.
const GAP: f64 = 6.0;
/// Around the motion within a frame in px.
const PADDING: f64 = 9.0;
/// Above a frame, for its time, in px.
pub(super) const LABEL: f64 = 20.0;
/// The height of the sheet that is meant for a frame in px, and the least for all.
const HEIGHT: (f64, f64) = (70.0, 420.0);
/// Another row of frames must enlarge the picture by this factor.
const WORTH: f64 = 1.35;

/// A window is at least this high for its width, and this wide for its height.
const FLATTEST: f64 = 0.3;

/// The frames on the sheet: equal cells in rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    /// Cells in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Of a cell in px.
    pub width: f64,
    /// Of a cell in px.
    pub height: f64,
    /// px for a metre.
    pub scale: f64,
}

/// The picture's plane in px: y is down, and the origin is a cell's upper left corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lens {
    /// From where.
    pub camera: Camera,
    /// px for a metre.
    pub scale: f64,
    /// The cell in px.
    pub width: f64,
    /// The cell in px.
    pub height: f64,
    /// What appears in the cell's middle (m, to the right and up).
    middle: (f64, f64),
}

/// The rectangle that is seen (m).
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    x: (f64, f64),
    y: (f64, f64),
}

impl Window {
    /// The smallest that has all landmarks in it.
    pub fn around(camera: &Camera, landmarks: &[Landmark]) -> Self {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let grow =
            |(lo, hi): (f64, f64), at: f64, radius: f64| (lo.min(at - radius), hi.max(at + radius));
        let (x, y) = landmarks.iter().fold((none, none), |(x, y), mark| {
            let at = camera.project(&mark.point);
            (grow(x, at.x, mark.radius), grow(y, at.y, mark.radius))
        });
        let sane = |range: (f64, f64)| if range.0 <= range.1 { range } else { (-0.5, 0.5) };
        Window { x: sane(x), y: sane(y) }
    }

    fn size(&self) -> (f64, f64) {
        let (w, h) = (self.x.1 - self.x.0, self.y.1 - self.y.0);
        let least = FLATTEST * w.max(h).max(1e-9);
        (w.max(least), h.max(least))
    }

    fn middle(&self) -> (f64, f64) {
        (0.5 * (self.x.0 + self.x.1), 0.5 * (self.y.0 + self.y.1))
    }
}

impl Layout {
    /// As few rows as show the window nearly as large as any number of rows would, in cells at
    /// least as wide as a label.
    pub fn new(window: &Window, frames: usize, label: f64) -> Self {
        let mut best = Layout::in_rows(window, frames, 1);
        for rows in 2..=frames {
            let other = Layout::in_rows(window, frames, rows);
            if best.width < label || other.scale > WORTH * best.scale {
                best = other;
            }
        }
        best
    }

    /// One frame of this width, at most so high (px).
    pub fn single(window: &Window, width: f64, highest: f64) -> Self {
        let (w, h) = window.size();
        let scale = ((width - 2.0 * PADDING) / w).min((highest - 2.0 * PADDING) / h);
        Layout { columns: 1, rows: 1, width, height: h * scale + 2.0 * PADDING, scale }
    }

    fn in_rows(window: &Window, frames: usize, rows: usize) -> Self {
        let columns = frames.max(1).div_ceil(rows);
        let rows = frames.max(1).div_ceil(columns);
        let budget = (HEIGHT.0 * frames as f64).max(HEIGHT.1);
        let width = (WIDTH - 2.0 * EDGE - (columns - 1) as f64 * GAP) / columns as f64;
        let most = budget / rows as f64 - LABEL;
        let (w, h) = window.size();
        let scale = ((width - 2.0 * PADDING) / w).min((most - 2.0 * PADDING) / h);
        Layout { columns, rows, width, height: h * scale + 2.0 * PADDING, scale }
    }

    /// The upper left corner of a frame's cell in px, below the sheet's `top`.
    pub fn corner(&self, frame: usize, top: f64) -> (f64, f64) {
        let (row, column) = (frame / self.columns, frame % self.columns);
        let x = EDGE + column as f64 * (self.width + GAP);
        (x, top + LABEL + row as f64 * (self.height + LABEL))
    }

    /// The height of all rows in px.
    pub fn total(&self) -> f64 {
        self.rows as f64 * (self.height + LABEL)
    }

    /// How a cell shows the window.
    pub fn lens(&self, camera: Camera, window: &Window) -> Lens {
        let Layout { width, height, scale, .. } = *self;
        Lens { camera, scale, width, height, middle: window.middle() }
    }
}

impl Lens {
    /// The place in px of a point of the world.
    pub fn place(&self, point: &Vector3<f64>) -> (f64, f64) {
        let seen = self.camera.project(point);
        let x = 0.5 * self.width + (seen.x - self.middle.0) * self.scale;
        (x, 0.5 * self.height - (seen.y - self.middle.1) * self.scale)
    }

    /// The same in a cell that is higher at its foot by so many px.
    pub fn with_foot(self, foot: f64) -> Self {
        let height = (self.height + foot).round();
        let middle = (self.middle.0, self.middle.1 - 0.5 * (height - self.height) / self.scale);
        Lens { height, middle, ..self }
    }

    /// What appears in the middle (m, to the right and up).
    pub fn middle(&self) -> (f64, f64) {
        self.middle
    }

    /// Whether a place in px lies in the cell.
    pub fn holds(&self, (x, y): (f64, f64)) -> bool {
        (0.0..=self.width).contains(&x) && (0.0..=self.height).contains(&y)
    }
}
