//! Draws constraints: a rod if their two points are apart, a dot if they coincide.

use nalgebra::Vector3;

use super::Frame;
use super::layout::Lens;
use super::solid::Solid;
use crate::body::{Shape, State};
use crate::constraint::Constraint;
use crate::scene::Scene;

/// Half of a rod's width in px.
pub(super) const ROD: f64 = 0.8;
/// The minimum and maximum radius of a point mass in px.
const DOT: (f64, f64) = (1.5, 5.0);

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
    let constraints = scene.constraints.iter();
    constraints.filter_map(|constraint| rod(constraint.as_ref(), frame, radius)).collect()
}

/// The rod of one constraint, if its points are apart.
pub(super) fn rod(constraint: &dyn Constraint, frame: &Frame, radius: f64) -> Option<Solid> {
    let ends = ends(constraint, &frame.states)?;
    let apart = (ends[1] - ends[0]).norm() > radius;
    apart.then(|| Solid::rod(constraint.bodies(), ends, radius))
}

/// The radius of a point mass in px: a fraction of the shortest rod, within limits.
pub(super) fn dot(scene: &Scene, lens: &Lens) -> f64 {
    let shortest = shortest(scene).unwrap_or(f64::INFINITY);
    (0.25 * shortest * lens.scale).clamp(DOT.0, DOT.1)
}

/// The marks at the ends of constraints; a point mass is its own mark.
pub(super) fn marks(scene: &Scene, frame: &Frame) -> Vec<Mark> {
    let mut marks = Vec::new();
    for constraint in &scene.constraints {
        let Some(ends) = ends(constraint.as_ref(), &frame.states) else { continue };
        for (body, end) in constraint.bodies().into_iter().zip(ends) {
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
    scene.constraints.iter().filter_map(|constraint| {
        let side = constraint.bodies().iter().position(Option::is_none)?;
        Some(constraint.anchors()?[side])
    })
}

/// The least distance (m) between two points of a constraint that are apart at the start, if there
/// are any.
fn shortest(scene: &Scene) -> Option<f64> {
    let lengths = scene.constraints.iter().filter_map(|constraint| {
        let [start, end] = ends(constraint.as_ref(), &scene.states)?;
        Some((end - start).norm()).filter(|length| *length > 0.0)
    });
    lengths.min_by(f64::total_cmp)
}

/// The two points of a constraint (m, world).
fn ends(constraint: &dyn Constraint, states: &[State]) -> Option<[Vector3<f64>; 2]> {
    let (anchors, bodies) = (constraint.anchors()?, constraint.bodies());
    let state = |k: usize| bodies[k].map_or(&State::WORLD, |body| &states[body]);
    Some([0, 1].map(|k| state(k).pose.point(&anchors[k])))
}
