//! Where bodies touch, or nearly: contact points with names that persist between steps.
//!
//! Every shape but the half space is a convex polytope with a radius around it ([`solid`]): a point
//! for a ball, a segment for a capsule. So all pairs are one case. The data flow:
//!
//! ```text
//! broad: pairs of bodies ─→ separation: the axis ─→ overlap: face on anything │ crossing: edges │
//! nearest: edges and vertices ─→ reduce: at most four
//! ```
//!
//! The boxes around the bodies are searched by the library parry. Its contact manifolds are not
//! used: they cut faces to four corners and do not say which features touch, and both a contact's
//! name and how its normal moves depend on that.
//!
//! Bodies that a constraint joins do not collide, nor do two fixed ones, nor two points. The result
//! depends on the states alone and comes in the order of the bodies.

mod broad;
mod crossing;
mod nearest;
mod overlap;
mod pair;
mod plane;
mod reduce;
mod separation;
mod solid;

use std::collections::BTreeSet;

use nalgebra::Vector3;

use super::{Manifold, Scene};
use crate::body::{Mass, Shape, State};
use crate::constraint::{Contact, Normal};
use solid::Solid;

/// A feature of a body, by its index in the body's polytope.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// A corner, the centre of a ball, or an end of a capsule.
    Vertex(usize),
    /// An edge, or the axis of a capsule.
    Edge(usize),
    /// A face, or the surface of a half space.
    Face(usize),
}

/// The name of a contact point: the same from step to step while the same features touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContactId {
    /// The two bodies, the lower index first.
    pub bodies: [usize; 2],
    /// What touches of the first and of the second body.
    pub features: [Feature; 2],
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

/// Two features that touch, of a body 0 and a body 1.
#[derive(Debug, Clone)]
struct Touch {
    features: [Feature; 2],
    /// The anchors (m, world).
    anchors: [Vector3<f64>; 2],
    /// What the normal depends on.
    normal: Normal,
    /// n·d (m): the gap without the radii.
    separation: f64,
    /// Whether body 0 is the second of the pair.
    swapped: bool,
}

impl Touch {
    fn swap(self) -> Self {
        Touch { swapped: !self.swapped, ..self }
    }

    /// The features in the order of the pair.
    fn names(&self) -> [Feature; 2] {
        let [f0, f1] = self.features;
        if self.swapped { [f1, f0] } else { [f0, f1] }
    }
}

/// All contact points with a gap up to `margin` (m). One entry of `states` a body.
pub fn contacts(scene: &Scene, states: &[State], margin: f64) -> Vec<Found> {
    let joined: BTreeSet<[usize; 2]> =
        scene.constraints.iter().filter_map(|c| ordered(c.bodies())).collect();
    let solids: Vec<Option<Solid>> =
        scene.bodies.iter().zip(states).map(|(body, state)| Solid::new(body, state)).collect();
    let may_touch = |[first, second]: [usize; 2]| {
        let [a, b] = [first, second].map(|k| &scene.bodies[k]);
        let moves = a.mass != Mass::Fixed || b.mass != Mass::Fixed;
        let points_only = a.shape == Shape::Point && b.shape == Shape::Point;
        moves && !points_only && !joined.contains(&[first, second])
    };
    let mut found = Vec::new();
    for pair in broad::pairs(&solids, margin).into_iter().filter(|&pair| may_touch(pair)) {
        let touches = touches(scene, states, &solids, pair, margin);
        let mut points: Vec<Found> =
            touches.iter().filter_map(|touch| point(scene, states, pair, touch)).collect();
        points.retain(|found| found.gap <= margin);
        match scene.contact.manifold {
            Manifold::Full => found.extend(points),
            Manifold::Four => found.extend(reduce::to_four(points)),
        }
    }
    found
}

fn ordered(bodies: [Option<usize>; 2]) -> Option<[usize; 2]> {
    let (first, second) = (bodies[0]?, bodies[1]?);
    Some([first.min(second), first.max(second)])
}

/// Where two bodies may touch; a body without a solid is a half space.
fn touches(
    scene: &Scene,
    states: &[State],
    solids: &[Option<Solid>],
    pair: [usize; 2],
    margin: f64,
) -> Vec<Touch> {
    let plane = |k: usize, solid: &Solid| match &scene.bodies[k].shape {
        Shape::Plane { normal } => plane::touches(normal, &states[k].pose, solid),
        _ => Vec::new(),
    };
    match pair.map(|k| solids[k].as_ref()) {
        [Some(a), Some(b)] => pair::touches(a, b, margin),
        [None, Some(b)] => plane(pair[0], b),
        [Some(a), None] => plane(pair[1], a).into_iter().map(Touch::swap).collect(),
        [None, None] => Vec::new(),
    }
}

/// The contact of two features; none where it has no normal, as between balls with one centre:
/// there is nothing to be pushed apart along.
fn point(scene: &Scene, states: &[State], pair: [usize; 2], touch: &Touch) -> Option<Found> {
    let [k0, k1] = if touch.swapped { [pair[1], pair[0]] } else { pair };
    let local = |k: usize, anchor: &Vector3<f64>| states[k].pose.local(anchor);
    let contact = Contact {
        bodies: [Some(k0), Some(k1)],
        anchors: [local(k0, &touch.anchors[0]), local(k1, &touch.anchors[1])],
        radii: [k0, k1].map(|k| solid::radius(&scene.bodies[k].shape)),
        normal: touch.normal,
        friction: (scene.bodies[k0].friction * scene.bodies[k1].friction).sqrt(),
    };
    let (gap, normal) = contact.gap([&states[k0], &states[k1]]).ok()?;
    let point = states[k1].pose.point(&contact.anchors[1]) - contact.radii[1] * normal;
    let id = ContactId { bodies: pair, features: touch.names() };
    Some(Found { id, contact, gap, normal, point })
}
