//! The layout of frames on the sheet, and of points in a frame.

use nalgebra::Vector3;

use super::Camera;
use super::extent::Landmark;
use crate::plot::style::EDGE;

/// The gap between two frames in px.
const GAP: f64 = 6.0;
/// The padding around the motion within a frame in px.
const PADDING: f64 = 9.0;
/// The space above a frame for its time in px.
pub(super) const LABEL: f64 = 20.0;
/// The maximum height of a cell in px: so high a row can be printed below others.
const HIGHEST: f64 = 175.0;
/// The minimum width of a cell in px, if there are enough rows.
const LEAST: f64 = 150.0;

/// Minimum ratio of a window's height to its width, and of its width to its height.
const FLATTEST: f64 = 0.3;

/// The frames on the sheet: equal cells in rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    /// The number of cells per row.
    pub columns: usize,
    /// The number of rows.
    pub rows: usize,
    /// The width of a cell in px.
    pub width: f64,
    /// The height of a cell in px.
    pub height: f64,
    /// px per meter.
    pub scale: f64,
}

/// The picture plane in px: y is down, and the origin is the upper left corner of a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lens {
    /// The camera.
    pub camera: Camera,
    /// px per meter.
    pub scale: f64,
    /// The width of the cell in px.
    pub width: f64,
    /// The height of the cell in px.
    pub height: f64,
    /// The point at the center of the cell (m, to the right and up).
    middle: (f64, f64),
}

/// The visible rectangle (m).
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    x: (f64, f64),
    y: (f64, f64),
}

impl Window {
    /// The smallest window that contains all landmarks.
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

    /// The same, enlarged so that it contains these points of the picture plane (m), too.
    pub fn containing(self, points: impl Iterator<Item = Vector3<f64>>) -> Self {
        points.fold(self, |Window { x, y }, at| Window {
            x: (x.0.min(at.x), x.1.max(at.x)),
            y: (y.0.min(at.y), y.1.max(at.y)),
        })
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
    /// The layout on a sheet of this width (px) with the fewest rows of cells that are as wide as
    /// a label, and wide enough for a picture.
    pub fn new(window: &Window, sheet: f64, frames: usize, label: f64) -> Self {
        let layouts = (1..=frames.max(1)).map(|rows| Layout::in_rows(window, sheet, frames, rows));
        let is_wide = |layout: &Layout| layout.width >= label.max(LEAST);
        let mut layouts: Vec<Layout> = layouts.collect();
        let first = layouts.iter().position(is_wide).unwrap_or(layouts.len() - 1);
        layouts.swap_remove(first)
    }

    /// One frame of this width and at most this height (px).
    pub fn single(window: &Window, width: f64, highest: f64) -> Self {
        let (w, h) = window.size();
        let scale = ((width - 2.0 * PADDING) / w).min((highest - 2.0 * PADDING) / h);
        Layout { columns: 1, rows: 1, width, height: h * scale + 2.0 * PADDING, scale }
    }

    fn in_rows(window: &Window, sheet: f64, frames: usize, rows: usize) -> Self {
        let columns = frames.max(1).div_ceil(rows);
        let rows = frames.max(1).div_ceil(columns);
        let width = (sheet - 2.0 * EDGE - (columns - 1) as f64 * GAP) / columns as f64;
        let (w, h) = window.size();
        let scale = ((width - 2.0 * PADDING) / w).min((HIGHEST - 2.0 * PADDING) / h);
        // A single cell is no wider than its picture.
        let width =
            if frames > 1 { width } else { width.min((w * scale).max(LEAST) + 2.0 * PADDING) };
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

    /// The mapping from the window to a cell.
    pub fn lens(&self, camera: Camera, window: &Window) -> Lens {
        let Layout { width, height, scale, .. } = *self;
        Lens { camera, scale, width, height, middle: window.middle() }
    }
}

impl Lens {
    /// The position in px of a point in the world.
    pub fn place(&self, point: &Vector3<f64>) -> (f64, f64) {
        let seen = self.camera.project(point);
        let x = 0.5 * self.width + (seen.x - self.middle.0) * self.scale;
        (x, 0.5 * self.height - (seen.y - self.middle.1) * self.scale)
    }

    /// The same for a cell that is extended at the bottom by `foot` (px).
    pub fn with_foot(self, foot: f64) -> Self {
        let height = (self.height + foot).round();
        let middle = (self.middle.0, self.middle.1 - 0.5 * (height - self.height) / self.scale);
        Lens { height, middle, ..self }
    }

    /// The point at the center (m, to the right and up).
    pub fn middle(&self) -> (f64, f64) {
        self.middle
    }

    /// Whether a position in px lies in the cell.
    pub fn holds(&self, (x, y): (f64, f64)) -> bool {
        (0.0..=self.width).contains(&x) && (0.0..=self.height).contains(&y)
    }
}
