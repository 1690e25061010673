//! Draws constraints: a rod if their two points are apart, a dot if they coincide.

use nalgebra::Vector3;

use super::Frame;
use super::layout::Lens;
use super::solid::Solid;
use crate::body::{Shape, State};
use crate::constraint::Bodies;
use crate::scene::Scene;

/// The minimum and maximum radius of a point mass in px.
const DOT: (f64, f64) = (1.5, 8.0);

/// A dot that marks a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Mark {
    /// The point that two bodies share.
    Ball(Vector3<f64>),
    /// An end that is fixed to the world.
    Pin(Vector3<f64>),
}

/// The rods between points farther apart than `radius` (m), which is also the radius of the rods.
pub(super) fn rods(scene: &Scene, frame: &Frame, radius: f64) -> Vec<Solid> {
    let apart = lines(scene, &frame.states).filter(|(_, ends)| (ends[1] - ends[0]).norm() > radius);
    apart.map(|(bodies, ends)| Solid::rod(bodies, ends, radius)).collect()
}

/// The radius of a point mass in px: a fraction of the shortest rod, within limits.
pub(super) fn dot(scene: &Scene, lens: &Lens) -> f64 {
    let shortest = shortest(scene).unwrap_or(f64::INFINITY);
    (0.25 * shortest * lens.scale).clamp(DOT.0, DOT.1)
}

/// Half of a rod's width in px.
pub(super) fn rod(scene: &Scene, lens: &Lens) -> f64 {
    (0.25 * dot(scene, lens)).max(0.8)
}

/// The marks at the ends of constraints; a point mass is its own mark.
pub(super) fn marks(scene: &Scene, frame: &Frame) -> Vec<Mark> {
    let mut marks = Vec::new();
    for (bodies, ends) in lines(scene, &frame.states) {
        for (body, end) in bodies.into_iter().zip(ends) {
            match body.map(|k| &scene.bodies[k].shape) {
                None => marks.push(Mark::Pin(end)),
                Some(Shape::Point) => {}
                Some(_) => marks.push(Mark::Ball(end)),
            }
        }
    }
    marks
}

/// The ends that are fixed to the world (m).
pub(super) fn pins(scene: &Scene) -> impl Iterator<Item = Vector3<f64>> {
    let lines = scene.constraints.iter().flat_map(|constraint| constraint.lines());
    lines.filter_map(|(bodies, ends)| Some(ends[bodies.iter().position(Option::is_none)?]))
}

/// The least distance (m) between two points of a constraint that are apart at the start, if there
/// are any.
fn shortest(scene: &Scene) -> Option<f64> {
    let lengths = lines(scene, &scene.states).map(|(_, [start, end])| (end - start).norm());
    lengths.filter(|length| *length > 0.0).min_by(f64::total_cmp)
}

/// The lines of the constraints (m, world).
fn lines(scene: &Scene, states: &[State]) -> impl Iterator<Item = (Bodies, [Vector3<f64>; 2])> {
    scene.constraints.iter().flat_map(|constraint| constraint.lines()).map(|(bodies, ends)| {
        let state = |k: usize| bodies[k].map_or(&State::WORLD, |body| &states[body]);
        (bodies, [0, 1].map(|k| state(k).pose.point(&ends[k])))
    })
}
