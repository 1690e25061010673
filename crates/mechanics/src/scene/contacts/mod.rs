//! Contact detection: contact points with identifiers that persist between steps.
//!
//! Every shape except the half space is a convex polytope with a radius around it ([`solid`]): a
//! point for a ball, a segment for a capsule; a compound is several of these. All pairs are
//! therefore one case. The data flow:
//!
//! ```text
//! broad: pairs of bodies ─→ separation: the axis ─→ overlap: face on anything │ crossing: edges │
//! nearest: edges and vertices ─→ reduce: at most four
//! ```
//!
//! The library parry searches the bounding boxes. Its contact manifolds are not used: they clip
//! faces to four corners and do not report which features touch, which both the contact's
//! identifier and the motion of its normal depend on.
//!
//! Bodies joined by a constraint do not collide, nor do two fixed bodies, two points, or pairs that
//! the scene says are without contact. The result depends only on the states and comes in the order
//! of the bodies. A [`Detector`] reuses its memory from step to step and allocates none once warm.

mod broad;
mod crossing;
mod meeting;
mod nearest;
mod overlap;
mod pair;
mod passage;
mod plane;
mod reach;
mod reduce;
mod rim;
mod separation;
mod solid;

use std::fmt;

use nalgebra::Vector3;

use super::{Manifold, Scene};
use crate::body::{Mass, Shape, State};
use crate::constraint::{Contact, Nearest, Normal};
use broad::{Broad, HalfSpace};
use meeting::FreeMotion;
pub use passage::Passage;
pub use reach::Reach;
use reach::Site;
use solid::Solid;

/// A feature of a body, by its index in the body's polytope.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// A corner, the center of a ball, or an end of a capsule.
    Vertex(usize),
    /// An edge, or the axis of a capsule.
    Edge(usize),
    /// A face, or the surface of a half space.
    Face(usize),
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Feature::Vertex(k) => write!(f, "vertex {k}"),
            Feature::Edge(k) => write!(f, "edge {k}"),
            Feature::Face(k) => write!(f, "face {k}"),
        }
    }
}

/// The identifier of a contact point: the same from step to step while the same features touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContactId {
    /// The two bodies, the lower index first.
    pub bodies: [usize; 2],
    /// The touching features of the first and the second body.
    pub features: [Feature; 2],
}

impl fmt::Display for ContactId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = self.features;
        write!(f, "{first} on {second}")
    }
}

/// A detected contact point.
#[derive(Debug, Clone)]
pub struct DetectedContact {
    /// Its identifier.
    pub id: ContactId,
    /// Its constraint.
    pub contact: Contact,
    /// The gap c (m), negative if the bodies overlap.
    pub gap: f64,
    /// The gap (m) up to which contacts of these bodies were searched.
    pub margin: f64,
    /// The unit normal (world), from the constraint's body 0 to its body 1.
    pub normal: Vector3<f64>,
    /// The contact point on the constraint's body 1 (m, world).
    pub point: Vector3<f64>,
}

/// Two touching features, of a body 0 and a body 1.
#[derive(Debug, Clone)]
struct Touch {
    features: [Feature; 2],
    /// The anchors (m, world).
    anchors: [Vector3<f64>; 2],
    /// The features that define the normal.
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

/// All contact points with a gap up to `margin` (m). `states` has one entry per body.
///
/// ```
/// use lcplab_mechanics::scene::{Scene, contacts};
///
/// // Three balls in a stack: the ground and the ball above each ball, no gaps.
/// let scene = Scene::load("fig7")?;
/// let found = contacts(&scene, &scene.states, 0.05);
/// assert_eq!(found.len(), 3);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn contacts(scene: &Scene, states: &[State], margin: f64) -> Vec<DetectedContact> {
    let mut detector = Detector::new(scene);
    detector.find(scene, states, margin);
    detector.found
}

/// The contact points for a step from these states: those with a gap up to the scene's margin or,
/// without one, up to the distance that the bodies can approach each other in the step; at
/// acceleration level those that touch. `states` has one entry per body.
///
/// ```
/// use lcplab_mechanics::scene::{Scene, step_contacts};
///
/// let mut scene = Scene::load("sphere_plane")?;
/// scene.states[1].pose.p.z += 0.3;
/// assert!(step_contacts(&scene, &scene.states).is_empty());
/// scene.states[1].v.z = -100.0; // it falls 1 m in a step of 10 ms
/// assert_eq!(step_contacts(&scene, &scene.states).len(), 1);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn step_contacts(scene: &Scene, states: &[State]) -> Vec<DetectedContact> {
    Detector::new(scene).step_contacts(scene, states)
}

/// The body of a solid.
#[derive(Debug, Clone, Copy)]
struct Owner {
    body: usize,
    /// The number of vertices, edges and faces of the body's earlier parts, the offset of feature
    /// indices.
    before: [usize; 3],
}

impl Owner {
    /// Converts a feature of the part to one of the body.
    fn name(&self, feature: Feature) -> Feature {
        let [vertices, edges, faces] = self.before;
        match feature {
            Feature::Vertex(k) => Feature::Vertex(vertices + k),
            Feature::Edge(k) => Feature::Edge(edges + k),
            Feature::Face(k) => Feature::Face(faces + k),
        }
    }
}

/// Finds the contacts of a scene repeatedly, with reused memory.
pub struct Detector {
    /// The bodies' convex parts, body by body; `None` for a half space.
    solids: Vec<Option<Solid>>,
    /// The owner of each part.
    owners: Vec<Owner>,
    /// The distance (m) of each body's farthest vertex from its center.
    arms: Vec<f64>,
    half_spaces: Vec<HalfSpace>,
    /// The pairs that never touch, ascending: joined by a constraint, or without contact.
    apart: Vec<[usize; 2]>,
    broad: Broad,
    touches: Vec<Touch>,
    found: Vec<DetectedContact>,
}

impl Detector {
    /// A detector for this scene.
    pub(crate) fn new(scene: &Scene) -> Self {
        let joined = scene.constraints.iter().filter_map(|c| ordered(c.bodies()));
        let stated = scene.pairs.iter().filter(|(_, surface)| surface.without_contact);
        let mut apart: Vec<[usize; 2]> = joined.chain(stated.map(|(&pair, _)| pair)).collect();
        apart.sort_unstable();
        let mut solids: Vec<Option<Solid>> = Vec::with_capacity(scene.bodies.len());
        let mut owners = Vec::with_capacity(scene.bodies.len());
        let mut arms = Vec::with_capacity(scene.bodies.len());
        let mut parts = Vec::new();
        for (k, body) in scene.bodies.iter().enumerate() {
            if k == 0 || scene.bodies[k - 1].shape != body.shape {
                // Otherwise the parts of the previous body are shared.
                parts = solid::parts(&body.shape);
            }
            let of_parts = parts.iter().flatten().map(solid::Round::arm);
            arms.push(of_parts.fold(0.0, f64::max));
            let mut before = [0; 3];
            for part in &parts {
                let solid = part.clone().map(Solid::new);
                owners.push(Owner { body: k, before });
                let own = solid.as_ref().map_or([0; 3], Solid::features);
                (0..3).for_each(|kind| before[kind] += own[kind]);
                solids.push(solid);
            }
        }
        let (half_spaces, broad, touches, found) = Default::default();
        Detector { solids, owners, arms, half_spaces, apart, broad, touches, found }
    }

    /// All contact points with a gap up to `margin` (m) for the detector's scene. `states` has one
    /// entry per body.
    pub(crate) fn find(
        &mut self,
        scene: &Scene,
        states: &[State],
        margin: f64,
    ) -> &[DetectedContact] {
        self.find_pairs(scene, states, Reach::Gap(margin));
        self.find_points(scene, states, Reach::Gap(margin));
        &self.found
    }

    /// As [`step_contacts`] for the detector's scene.
    pub(crate) fn step_contacts(
        &mut self,
        scene: &Scene,
        states: &[State],
    ) -> Vec<DetectedContact> {
        let reach = Reach::of_step(scene);
        self.find_pairs(scene, states, reach);
        self.find_points(scene, states, reach);
        self.take_found()
    }

    /// The contacts found last.
    pub(crate) fn found(&self) -> &[DetectedContact] {
        &self.found
    }

    /// The contacts found last, which are then no longer kept here.
    pub(crate) fn take_found(&mut self) -> Vec<DetectedContact> {
        let room = Vec::with_capacity(self.found.len());
        std::mem::replace(&mut self.found, room)
    }

    /// The first phase of [`find`](Detector::find): pairs of bodies that are near each other.
    pub(crate) fn find_pairs(&mut self, scene: &Scene, states: &[State], reach: Reach) {
        let half = |site: Site| reach.of_body(scene, states, site);
        let margin = |pair: [Site; 2]| reach.of_pair(scene, states, pair);
        self.near_pairs(scene, states, half, margin);
    }

    /// The pairs of parts within the margins (m) of their bodies; `half` margins as for
    /// [`Broad::search`](broad::Broad::search).
    fn near_pairs(
        &mut self,
        scene: &Scene,
        states: &[State],
        half: impl Fn(Site) -> f64,
        margin: impl Fn([Site; 2]) -> f64,
    ) {
        self.half_spaces.clear();
        for (k, (solid, owner)) in self.solids.iter_mut().zip(&self.owners).enumerate() {
            let pose = &states[owner.body].pose;
            match (solid, &scene.bodies[owner.body].shape) {
                (Some(solid), _) => solid.place(pose),
                (None, Shape::Plane { normal }) => {
                    let normal = pose.direction(normal);
                    self.half_spaces.push(HalfSpace { solid: k, normal, point: pose.p });
                }
                (None, _) => {}
            }
        }
        let Detector { solids, owners, arms, half_spaces, apart, broad, .. } = self;
        let (owners, arms, apart) = (&*owners, &*arms, &*apart);
        let site = |solid: usize| Site { body: owners[solid].body, arm: arms[owners[solid].body] };
        let half = |solid: usize| half(site(solid));
        let margin = |pair: [usize; 2]| margin(pair.map(site));
        let may_touch = |solids: [usize; 2]| {
            let pair = solids.map(|k| owners[k].body);
            let [a, b] = pair.map(|k| &scene.bodies[k]);
            let moves = a.mass != Mass::Fixed || b.mass != Mass::Fixed;
            let points_only = a.shape == Shape::Point && b.shape == Shape::Point;
            pair[0] != pair[1] && moves && !points_only && apart.binary_search(&pair).is_err()
        };
        broad.search(solids, half_spaces, half, margin, may_touch);
    }

    /// The second phase: the contact points of the pairs.
    pub(crate) fn find_points(&mut self, scene: &Scene, states: &[State], reach: Reach) {
        self.found.clear();
        let mut motion: Option<FreeMotion> = None;
        for k in 0..self.broad.pairs().len() {
            let pair = self.broad.pairs()[k];
            self.touches.clear();
            let owners = pair.map(|k| self.owners[k]);
            let sites = owners.map(|owner| Site { body: owner.body, arm: self.arms[owner.body] });
            let margin = reach.of_pair(scene, states, sites);
            touches(scene, states, &self.solids, owners, pair, margin, &mut self.touches);
            let first = self.found.len();
            let radii = pair.map(|k| self.solids[k].as_ref().map_or(0.0, |solid| solid.radius));
            for touch in &self.touches {
                self.found.extend(point(scene, states, owners, radii, margin, touch));
            }
            let is_far = self.found[first..].iter().all(|found| found.gap > reach::LEAST);
            if reach == Reach::Step && is_far && self.found.len() > first {
                let motion = motion.get_or_insert_with(|| FreeMotion::of(scene, states));
                if !self.may_meet(scene, states, pair, motion) {
                    self.found.truncate(first);
                }
            }
            if scene.contact.manifold == Manifold::Four {
                reduce::to_four(&mut self.found, first);
            }
        }
    }
}

fn ordered(bodies: [Option<usize>; 2]) -> Option<[usize; 2]> {
    let (first, second) = (bodies[0]?, bodies[1]?);
    Some([first.min(second), first.max(second)])
}

/// Computes where two parts may touch, into an empty list; a part without a solid is a half space.
fn touches(
    scene: &Scene,
    states: &[State],
    solids: &[Option<Solid>],
    owners: [Owner; 2],
    pair: [usize; 2],
    margin: f64,
    out: &mut Vec<Touch>,
) {
    let mut plane = |owner: Owner, solid: &Solid| {
        if let Shape::Plane { normal } = &scene.bodies[owner.body].shape {
            plane::touches(normal, &states[owner.body].pose, solid, out);
        }
    };
    match pair.map(|k| solids[k].as_ref()) {
        [Some(a), Some(b)] => pair::touches(a, b, margin, out),
        [None, Some(b)] => plane(owners[0], b),
        [Some(a), None] => {
            plane(owners[1], a);
            out.iter_mut().for_each(|touch| touch.swapped = true);
        }
        [None, None] => {}
    }
}

/// The contact of two features; `None` if its gap exceeds the margin (m), or if it has no normal.
/// Concentric balls are pushed apart along the world's z axis.
fn point(
    scene: &Scene,
    states: &[State],
    owners: [Owner; 2],
    radii: [f64; 2],
    margin: f64,
    touch: &Touch,
) -> Option<DetectedContact> {
    let pair = owners.map(|owner| owner.body);
    let in_order = |of: [f64; 2]| if touch.swapped { [of[1], of[0]] } else { of };
    let [k0, k1] = if touch.swapped { [pair[1], pair[0]] } else { pair };
    let local = |k: usize, anchor: &Vector3<f64>| states[k].pose.local(anchor);
    let contact = Contact {
        bodies: [Some(k0), Some(k1)],
        anchors: [local(k0, &touch.anchors[0]), local(k1, &touch.anchors[1])],
        radii: in_order(radii),
        normal: touch.normal,
        friction: scene.friction([k0, k1]),
        anisotropy: scene
            .anisotropy([k0, k1])
            .map(|(body, surface)| (usize::from(body == k1), surface)),
    };
    let pair_of = [&states[k0], &states[k1]];
    let (contact, nearest) = match (contact.nearest(pair_of), touch.normal) {
        (Ok(nearest), _) => (contact, nearest),
        (Err(_), Normal::Centers) => {
            let normal = Normal::Face(states[k0].pose.q.inverse() * Vector3::z());
            let contact = Contact { normal, ..contact };
            let nearest = contact.nearest(pair_of).ok()?;
            (contact, nearest)
        }
        (Err(_), _) => return None,
    };
    let Nearest { gap, normal, point } = nearest;
    (gap <= margin).then(|| {
        let [f0, f1] = touch.names();
        let id = ContactId { bodies: pair, features: [owners[0].name(f0), owners[1].name(f1)] };
        DetectedContact { id, contact, gap, margin, normal, point }
    })
}
