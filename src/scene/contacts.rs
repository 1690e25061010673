//! Where bodies touch, or nearly: contact points with names that persist between steps.
//!
//! A plane, a ball or a point against anything is a formula and stands here; box against box is
//! left to a library ([`boxes`](super::boxes)). Bodies that a constraint joins do not collide, nor
//! do two fixed ones; a point mass touches planes only. The result depends on the states alone and
//! comes in the order of the bodies.

use std::collections::BTreeSet;

use nalgebra::Vector3;

use super::{Scene, boxes};
use crate::body::{Mass, Pose, Shape, State};
use crate::constraint::{Contact, Normal};

/// The name of a contact point: the same from step to step while the same features touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContactId {
    /// The two bodies, the lower index first.
    pub bodies: [usize; 2],
    /// Which corner, edge or face of the first and of the second body, and a count of points alike.
    pub feature: [u32; 3],
}

/// A contact point that was found.
#[derive(Debug, Clone)]
pub struct Found {
    /// Its name.
    pub id: ContactId,
    /// Its constraint.
    pub contact: Contact,
    /// The gap c (m), negative where the bodies overlap.
    pub gap: f64,
    /// The unit normal (world), from the constraint's body 0 to its body 1.
    pub normal: Vector3<f64>,
    /// The touching point on the constraint's body 1 (m, world).
    pub point: Vector3<f64>,
}

/// Two anchors and a normal between body 0 and body 1 of a pair that may be swapped.
pub(super) struct Touch {
    /// Distinguishes the points of a pair: see [`ContactId`].
    pub feature: [u32; 3],
    /// Whether body 0 of the contact is the second of the pair.
    pub swapped: bool,
    /// Anchors in the frames of the contact's body 0 and body 1 (m).
    pub anchors: [Vector3<f64>; 2],
    /// Radii around the anchors (m).
    pub radii: [f64; 2],
    /// What the normal depends on.
    pub normal: Normal,
}

/// All contact points with a gap up to `margin` (m). One entry of `states` a body.
pub fn contacts(scene: &Scene, states: &[State], margin: f64) -> Vec<Found> {
    let joined: BTreeSet<[usize; 2]> =
        scene.constraints.iter().filter_map(|c| pair(c.bodies())).collect();
    let mut found = Vec::new();
    for first in 0..scene.bodies.len() {
        for second in first + 1..scene.bodies.len() {
            if may_touch(scene, states, [first, second], margin)
                && !joined.contains(&[first, second])
            {
                touch(scene, states, [first, second], margin, &mut found);
            }
        }
    }
    found
}

fn pair(bodies: [Option<usize>; 2]) -> Option<[usize; 2]> {
    let (first, second) = (bodies[0]?, bodies[1]?);
    Some([first.min(second), first.max(second)])
}

/// Whether the balls around two bodies come within the margin, and one of the bodies can move.
fn may_touch(scene: &Scene, states: &[State], pair: [usize; 2], margin: f64) -> bool {
    let [a, b] = pair.map(|k| &scene.bodies[k]);
    let reach = reach(&a.shape) + reach(&b.shape) + margin;
    let points_only = a.shape == Shape::Point && b.shape == Shape::Point;
    let moves = a.mass != Mass::Fixed || b.mass != Mass::Fixed;
    let d = states[pair[1]].pose.p - states[pair[0]].pose.p;
    moves && !points_only && d.norm() <= reach
}

/// The radius (m) of the ball around a shape.
fn reach(shape: &Shape) -> f64 {
    match shape {
        Shape::Point => 0.0,
        Shape::Sphere { radius } => *radius,
        Shape::Box { half } => half.norm(),
        Shape::Plane { .. } => f64::INFINITY,
    }
}

/// Appends the contact points of a pair with gap ≤ margin.
fn touch(scene: &Scene, states: &[State], pair: [usize; 2], margin: f64, found: &mut Vec<Found>) {
    let shapes = pair.map(|k| scene.bodies[k].shape);
    let poses = pair.map(|k| states[k].pose);
    let friction = pair.map(|k| scene.bodies[k].friction);
    for touch in touches(shapes, poses, margin) {
        let [k0, k1] = if touch.swapped { [pair[1], pair[0]] } else { pair };
        let contact = Contact {
            bodies: [Some(k0), Some(k1)],
            anchors: touch.anchors,
            radii: touch.radii,
            normal: touch.normal,
            friction: (friction[0] * friction[1]).sqrt(),
        };
        // Two balls with one centre have no normal, and nothing to be pushed apart along.
        let Ok((gap, normal)) = contact.gap([&states[k0], &states[k1]]) else { continue };
        if gap <= margin {
            let point = states[k1].pose.point(&touch.anchors[1]) - touch.radii[1] * normal;
            let id = ContactId { bodies: pair, feature: touch.feature };
            found.push(Found { id, contact, gap, normal, point });
        }
    }
}

fn touches(shapes: [Shape; 2], poses: [Pose; 2], margin: f64) -> Vec<Touch> {
    let swapped = |touches: Vec<Touch>| {
        touches.into_iter().map(|touch| Touch { swapped: true, ..touch }).collect()
    };
    match shapes {
        [Shape::Plane { normal }, other] => plane(normal, &other),
        [other, Shape::Plane { normal }] => swapped(plane(normal, &other)),
        [Shape::Sphere { radius: r0 }, Shape::Sphere { radius: r1 }] => vec![Touch {
            feature: [0; 3],
            swapped: false,
            anchors: [Vector3::zeros(); 2],
            radii: [r0, r1],
            normal: Normal::Centres,
        }],
        [Shape::Box { half }, Shape::Sphere { radius }] => {
            vec![box_sphere(&half, radius, &poses[0].local(&poses[1].p))]
        }
        [Shape::Sphere { radius }, Shape::Box { half }] => {
            swapped(vec![box_sphere(&half, radius, &poses[1].local(&poses[0].p))])
        }
        [Shape::Box { half: half0 }, Shape::Box { half: half1 }] => {
            boxes::touches([half0, half1], poses, margin)
        }
        _ => Vec::new(),
    }
}

/// A plane through body 0's origin: the point, the centre of the ball, or the corners of the box.
fn plane(normal: Vector3<f64>, other: &Shape) -> Vec<Touch> {
    let touch = |corner, anchor, radius| Touch {
        feature: [0, corner, 0],
        swapped: false,
        anchors: [Vector3::zeros(), anchor],
        radii: [0.0, radius],
        normal: Normal::Face(normal),
    };
    match other {
        Shape::Plane { .. } => Vec::new(),
        Shape::Point => vec![touch(0, Vector3::zeros(), 0.0)],
        Shape::Sphere { radius } => vec![touch(0, Vector3::zeros(), *radius)],
        Shape::Box { half } => (0..8).map(|k| touch(k, corner(half, k), 0.0)).collect(),
    }
}

/// Corner k of a box: bit i of k is set where the corner lies on the positive side of axis i.
fn corner(half: &Vector3<f64>, k: u32) -> Vector3<f64> {
    Vector3::from_fn(|i, _| if k >> i & 1 == 1 { half[i] } else { -half[i] })
}

/// The feature of a box (body 0) nearest to the centre of a ball, given in the box's frame: a face
/// where the centre is beyond one of the faces, an edge beyond two, a corner beyond three.
fn box_sphere(half: &Vector3<f64>, radius: f64, centre: &Vector3<f64>) -> Touch {
    let nearest = centre.zip_map(half, |x, h| x.clamp(-h, h));
    let beyond: Vec<usize> = (0..3).filter(|&i| centre[i].abs() > half[i]).collect();
    let side = |i: usize| Vector3::ith(i, 1.0f64.copysign(centre[i]));
    let (anchor, normal) = match beyond[..] {
        [] => {
            let depth = half - centre.abs();
            let i = depth.imin();
            (side(i) * half[i], Normal::Face(side(i)))
        }
        [i] => (nearest, Normal::Face(side(i))),
        [i, j] => (nearest, Normal::Edge(Vector3::ith(3 - i - j, 1.0))),
        _ => (nearest, Normal::Centres),
    };
    let sides = beyond.iter().map(|&i| if centre[i] > 0.0 { 1 << i } else { 8 << i });
    Touch {
        feature: [sides.sum(), 0, 0],
        swapped: false,
        anchors: [anchor, Vector3::zeros()],
        radii: [0.0, radius],
        normal,
    }
}
