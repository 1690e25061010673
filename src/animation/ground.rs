//! The drawn part of a half space: a patch of its plane under the motion, with a grid.

use nalgebra::Vector3;

use super::Camera;
use super::extent::{self, Landmark};
use super::layout::Window;
use crate::body::{Pose, Shape};
use crate::constraint::tangents;
use crate::plot::round_step;
use crate::scene::Scene;

/// The margin of a patch around what is above it, relative to the motion's size.
const MARGIN: f64 = 0.1;
/// Maximum number of grid lines, even under a body that is 1e155 m away.
const MOST_LINES: f64 = 1000.0;
/// The approximate distance of two grid lines, relative to the motion's size.
const MESH: f64 = 0.12;

/// A rectangle in a plane.
#[derive(Debug, Clone)]
pub(super) struct Patch {
    /// Its corners (m, world), counter-clockwise seen from outside.
    pub corners: [Vector3<f64>; 4],
    /// The outward unit normal.
    pub normal: Vector3<f64>,
    /// Grid lines at round distances (m, world).
    pub lines: Vec<[Vector3<f64>; 2]>,
}

/// The patches of a scene's half spaces near a motion.
pub(super) fn patches(scene: &Scene, landmarks: &[Landmark]) -> Vec<Patch> {
    let size = extent::size(landmarks);
    let bodies = scene.bodies.iter().zip(&scene.states);
    let patches = bodies.filter_map(|(body, state)| match &body.shape {
        Shape::Plane { normal } => Patch::new(&state.pose, normal, landmarks, size),
        _ => None,
    });
    patches.collect()
}

/// The window for the landmarks and the ground beneath them.
pub(super) fn window(camera: &Camera, mut landmarks: Vec<Landmark>, patches: &[Patch]) -> Window {
    let corners = patches.iter().flat_map(|patch| patch.corners);
    landmarks.extend(corners.map(|point| Landmark { point, radius: 0.0 }));
    Window::around(camera, &landmarks)
}

impl Patch {
    /// The patch of a plane under these landmarks; `None` if the nearest of them is farther away
    /// than the size of the motion.
    pub fn new(
        pose: &Pose,
        normal: &Vector3<f64>,
        landmarks: &[Landmark],
        size: f64,
    ) -> Option<Self> {
        let n = pose.direction(normal);
        let [t1, t2] = tangents(&n);
        let height = |mark: &Landmark| n.dot(&(mark.point - pose.p)) - mark.radius;
        let nearest = landmarks.iter().map(height).fold(f64::INFINITY, f64::min);
        if !(nearest < size) {
            return None;
        }
        let (x, y) = (range(landmarks, pose, &t1, size), range(landmarks, pose, &t2, size));
        let at = |x: f64, y: f64| pose.p + t1 * x + t2 * y;
        let step = round_step(MESH * size);
        let mut lines: Vec<_> = multiples(x, step).map(|x| [at(x, y.0), at(x, y.1)]).collect();
        lines.extend(multiples(y, step).map(|y| [at(x.0, y), at(x.1, y)]));
        let corners = [at(x.0, y.0), at(x.1, y.0), at(x.1, y.1), at(x.0, y.1)];
        Some(Patch { corners, normal: n, lines })
    }
}

/// The range of the landmarks along a direction, with a margin (m).
fn range(landmarks: &[Landmark], pose: &Pose, t: &Vector3<f64>, size: f64) -> (f64, f64) {
    let places = landmarks.iter().map(|mark| (t.dot(&(mark.point - pose.p)), mark.radius));
    let (lo, hi) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), (x, r)| {
        (lo.min(x - r), hi.max(x + r))
    });
    (lo - MARGIN * size, hi + MARGIN * size)
}

/// The multiples of `step` strictly inside a range.
fn multiples((lo, hi): (f64, f64), step: f64) -> impl Iterator<Item = f64> {
    let first = (lo / step).floor() + 1.0;
    let count = ((hi / step).ceil() - first).clamp(0.0, MOST_LINES) as usize;
    (0..count).map(move |k| (first + k as f64) * step)
}
