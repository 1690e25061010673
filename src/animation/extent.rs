//! What must be in the picture: everything that moves, and fixed bodies near it.

use nalgebra::Vector3;

use super::Frame;
use super::joint::{dot, pins};
use super::layout::Lens;
use super::solid::Solid;
use crate::body::{Body, Mass, State};
use crate::scene::Scene;

/// A motion this many times larger than the scene at its start is cut off.
const FARTHEST: f64 = 100.0;
/// How much of a fixed body is shown around the motion, relative to the motion's size.
const AROUND: f64 = 0.1;

/// The margin around the world's ends of joints, in the diagonals of the motion.
const PIN: f64 = 0.04;
/// How far around the smallest of several motions the others are shown, in its diagonals.
const NEAR: f64 = 0.4;
/// Fixed bodies up to this many times the motion's size are shown whole.
const WHOLE: f64 = 1.5;

/// A ball (m, world) that must be in the picture; usually with radius 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Landmark {
    pub point: Vector3<f64>,
    pub radius: f64,
}

/// An axis-aligned box (m).
#[derive(Debug, Clone, Copy)]
struct Extent {
    lo: Vector3<f64>,
    hi: Vector3<f64>,
}

/// The landmarks of a motion: the corners of moving bodies in every frame, the world's ends of
/// joints, and the nearby parts of fixed bodies.
pub(super) fn landmarks(scene: &Scene, frames: &[Frame]) -> Vec<Landmark> {
    let start = marks(&solids(scene, &scene.states, true));
    let limit = Extent::of(&start).grown(FARTHEST);
    let mut all = start;
    for frame in frames {
        let inside = |mark: &Landmark| limit.contains(&mark.point);
        all.extend(marks(&solids(scene, &frame.states, true)).into_iter().filter(inside));
    }
    let radius = PIN * size(&all);
    all.extend(pins(scene).map(|point| Landmark { point, radius }));
    let fixed = solids(scene, &scene.states, false);
    if all.is_empty() {
        return marks(&fixed);
    }
    let near = Extent::of(&all).grown(AROUND);
    for solid in fixed {
        let own = marks(&[solid]);
        let whole = Extent::of(&own);
        match whole.within(&near) {
            Some(_) if whole.diagonal() <= WHOLE * near.diagonal() => all.extend(own),
            part => all.extend(part.into_iter().flatten()),
        }
    }
    all
}

/// The landmarks of the smallest of several motions, and those of the others that are near: a
/// motion that explodes does not make the rest small.
pub(super) fn shared(scene: &Scene, motions: &[Vec<Frame>]) -> Vec<Landmark> {
    let mut all: Vec<_> = motions.iter().map(|frames| landmarks(scene, frames)).collect();
    all.sort_by(|a, b| size(a).total_cmp(&size(b)));
    let Some(calmest) = all.first() else { return landmarks(scene, &[]) };
    let near = Extent::of(calmest).grown(NEAR);
    let (first, others) = (calmest.clone(), all.into_iter().skip(1).flatten());
    first.into_iter().chain(others.filter(|mark| near.contains(&mark.point))).collect()
}

/// The diagonal of the box around the landmarks (m); 1 m if they are a single point.
pub(super) fn size(landmarks: &[Landmark]) -> f64 {
    Extent::of(landmarks).diagonal()
}

/// The moving bodies in a frame, and the left, right, top and bottom edge of each (px).
pub(super) fn boxes(scene: &Scene, frame: &Frame, lens: &Lens) -> Vec<(usize, [f64; 4])> {
    let bodies = scene.bodies.iter().zip(&frame.states).enumerate();
    let moving = bodies.filter(|(_, (body, _))| body.mass != Mass::Fixed);
    let dot = dot(scene, lens) / lens.scale;
    let edges = |(k, (body, state)): (usize, (&Body, &State))| {
        let marks = marks(&Solid::of(k, body, &state.pose, dot));
        let none = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        let grow = |[left, right, top, bottom]: [f64; 4], mark: Landmark| {
            let ((x, y), radius) = (lens.place(&mark.point), mark.radius * lens.scale);
            [
                left.min(x - radius),
                right.max(x + radius),
                top.min(y - radius),
                bottom.max(y + radius),
            ]
        };
        (k, marks.into_iter().fold(none, grow))
    };
    moving.map(edges).collect()
}

fn solids(scene: &Scene, states: &[State], moving: bool) -> Vec<Solid> {
    let bodies = scene.bodies.iter().zip(states).enumerate();
    let wanted = bodies.filter(|(_, (body, _))| (body.mass != Mass::Fixed) == moving);
    wanted.flat_map(|(k, (body, state))| Solid::of(k, body, &state.pose, 0.0)).collect()
}

fn marks(solids: &[Solid]) -> Vec<Landmark> {
    let marks = |solid: &Solid| {
        let radius = solid.radius;
        solid.corners.clone().into_iter().map(move |point| Landmark { point, radius })
    };
    solids.iter().flat_map(marks).collect()
}

impl Extent {
    fn of(marks: &[Landmark]) -> Self {
        let empty =
            Extent { lo: Vector3::repeat(f64::INFINITY), hi: Vector3::repeat(f64::NEG_INFINITY) };
        marks.iter().fold(empty, |extent, mark| Extent {
            lo: extent.lo.inf(&mark.point.add_scalar(-mark.radius)),
            hi: extent.hi.sup(&mark.point.add_scalar(mark.radius)),
        })
    }

    fn diagonal(&self) -> f64 {
        let diagonal = (self.hi - self.lo).norm();
        if diagonal > 0.0 && diagonal.is_finite() { diagonal } else { 1.0 }
    }

    /// The box enlarged on all sides by a fraction of its diagonal.
    fn grown(&self, share: f64) -> Self {
        let more = share * self.diagonal();
        Extent { lo: self.lo.add_scalar(-more), hi: self.hi.add_scalar(more) }
    }

    fn contains(&self, point: &Vector3<f64>) -> bool {
        (0..3).all(|i| self.lo[i] <= point[i] && point[i] <= self.hi[i])
    }

    /// The corners of the intersection with another box, if there is one.
    fn within(&self, other: &Extent) -> Option<impl Iterator<Item = Landmark> + use<>> {
        let (lo, hi) = (self.lo.sup(&other.lo), self.hi.inf(&other.hi));
        let corner = move |k: usize| {
            let side = |i: usize| if k >> i & 1 == 1 { hi[i] } else { lo[i] };
            Landmark { point: Vector3::new(side(0), side(1), side(2)), radius: 0.0 }
        };
        (0..3).all(|i| lo[i] <= hi[i]).then(|| (0..8).map(corner))
    }
}
