//! Which bodies went through each other between the beginning and the end of a step.
//!
//! In a step a body moves straight and turns evenly. Along this path two bodies approach by no more
//! than
//!
//! ```text
//! L = |Δp1 − Δp0| + angle0 r0 + angle1 r1
//! ```
//!
//! in all, r being the distance of the farthest vertex from the centre. So from a distance d no
//! overlap can begin before another d/L of the step (conservative advancement, Mirtich 1996), and
//! no pair is missed, however fast it is.

use nalgebra::{UnitQuaternion, Vector3};

use super::reach::Site;
use super::{Detector, point, touches};
use crate::body::{Pose, State};
use crate::scene::{Scene, resting};

/// Bodies that move against each other by up to this part of the thinner one cannot go through it.
const SHORT: f64 = 0.5;
/// Bodies that overlap on the path by no more than this part of the thinner one touch only.
const TOUCHING: f64 = 1e-2;
/// Inside a body the path is looked at again after this part of the depth.
const INSIDE: f64 = 0.125;
/// The normals before and after have at most this cosine where a body came out on another side.
const OTHER_SIDE: f64 = 0.5;
/// A path that was looked at more often than this, along a surface, say, is looked at in even
/// parts.
const MANY_LOOKS: usize = 10_000;

/// A body that went through another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// The two bodies, the lower index first.
    pub bodies: [usize; 2],
    /// The deepest overlap that was seen on the path (m).
    pub depth: f64,
    /// How far (m) they moved against each other in the step, turning included.
    pub travel: f64,
}

impl Detector {
    /// The pairs of bodies of which one went through the other between two instants: they overlap
    /// on the way, and their nearest surfaces lie on other sides of them afterwards. Half spaces
    /// have no other side.
    pub fn passages(&mut self, scene: &Scene, before: &[State], after: &[State]) -> Vec<Passage> {
        let moves: Vec<Move> =
            (0..before.len()).map(|k| Move::of(&before[k], &after[k], self.arms[k])).collect();
        let longest = moves.iter().map(Move::length).fold(0.0, f64::max);
        let is_short = |thickness: f64| 2.0 * longest <= SHORT * thickness;
        if scene.thinnest().is_none_or(is_short) {
            return Vec::new();
        }
        let middle: Vec<State> = before.iter().zip(after).map(|(a, b)| along(a, b, 0.5)).collect();
        let half = |site: Site| 0.5 * moves[site.body].length();
        self.near_pairs(scene, &middle, half, |_| f64::NEG_INFINITY);
        let mut states = middle;
        let mut passages: Vec<Passage> = Vec::new();
        for pair in self.broad.pairs().to_vec() {
            let bodies = pair.map(|solid| self.owners[solid].body);
            let sizes = bodies.map(|body| resting::size(&scene.bodies[body].shape));
            let Some(thickness) = sizes.into_iter().flatten().reduce(f64::min) else { continue };
            let travel = Move::against(bodies.map(|body| &moves[body]));
            if travel <= SHORT * thickness {
                continue;
            }
            let path = Path { before, after, pair, bodies, travel };
            let Some(depth) = self.passes(scene, &path, &mut states, thickness) else { continue };
            match passages.iter_mut().find(|known| known.bodies == bodies) {
                Some(known) => known.depth = known.depth.max(depth),
                None => passages.push(Passage { bodies, depth, travel }),
            }
        }
        passages
    }

    /// The deepest overlap (m) on a path, if one part goes through the other.
    fn passes(
        &mut self,
        scene: &Scene,
        path: &Path,
        states: &mut [State],
        thickness: f64,
    ) -> Option<f64> {
        let touching = TOUCHING * thickness;
        let (_, first) = self.nearest(scene, path, states, 0.0)?;
        let (mut theta, mut deepest, mut looks) = (0.0, 0.0f64, 0);
        while theta < 1.0 {
            let gap = self.nearest(scene, path, states, theta).map_or(0.0, |(gap, _)| gap);
            deepest = deepest.max(-gap);
            looks += 1;
            let least = match looks {
                ..MANY_LOOKS => touching.max(-INSIDE * gap),
                _ => path.travel / MANY_LOOKS as f64,
            };
            theta += gap.max(least) / path.travel;
        }
        let (gap, last) = self.nearest(scene, path, states, 1.0)?;
        let is_through = deepest.max(-gap) > touching && first.dot(&last) < OTHER_SIDE;
        is_through.then_some(deepest.max(-gap))
    }

    /// The gap (m) of a pair of parts at a part of its path, and the normal from the first to the
    /// second where they are nearest, in the axes of the larger body: a ball has none to speak of.
    pub(super) fn nearest(
        &mut self,
        scene: &Scene,
        path: &Path,
        states: &mut [State],
        theta: f64,
    ) -> Option<(f64, Vector3<f64>)> {
        let Path { before, after, pair, bodies, .. } = *path;
        for (solid, body) in pair.into_iter().zip(bodies) {
            states[body] = along(&before[body], &after[body], theta);
            self.solids[solid].as_mut()?.place(&states[body].pose);
        }
        self.touches.clear();
        let owners = pair.map(|solid| self.owners[solid]);
        let margin = f64::INFINITY;
        touches(scene, states, &self.solids, owners, pair, margin, &mut self.touches);
        let radii = pair.map(|k| self.solids[k].as_ref().map_or(0.0, |solid| solid.radius));
        let of = |touch| point(scene, states, owners, radii, margin, touch);
        let found = self.touches.iter().filter_map(of).min_by(|a, b| a.gap.total_cmp(&b.gap))?;
        let is_swapped = found.contact.bodies[0] != Some(bodies[0]);
        let normal = if is_swapped { -found.normal } else { found.normal };
        let larger = if self.arms[bodies[0]] >= self.arms[bodies[1]] { 0 } else { 1 };
        Some((found.gap, states[bodies[larger]].pose.q.inverse() * normal))
    }
}

/// Two parts on their way from one instant to another.
pub(super) struct Path<'a> {
    before: &'a [State],
    after: &'a [State],
    /// The parts, by their solids.
    pair: [usize; 2],
    bodies: [usize; 2],
    /// How far (m) they move against each other at most.
    pub travel: f64,
}

impl<'a> Path<'a> {
    /// The path of two parts between these states; `arms` are those of all bodies.
    pub fn of(
        before: &'a [State],
        after: &'a [State],
        pair: [usize; 2],
        bodies: [usize; 2],
        arms: &[f64],
    ) -> Self {
        let [a, b] = bodies.map(|k| Move::of(&before[k], &after[k], arms[k]));
        Path { before, after, pair, bodies, travel: Move::against([&a, &b]) }
    }
}

/// How a body moved.
struct Move {
    /// (m)
    shift: Vector3<f64>,
    /// How far (m) its farthest vertex moved by turning.
    turning: f64,
}

impl Move {
    fn of(before: &State, after: &State, arm: f64) -> Self {
        let angle = before.pose.q.angle_to(&after.pose.q);
        Move { shift: after.pose.p - before.pose.p, turning: angle * arm }
    }

    fn length(&self) -> f64 {
        self.shift.norm() + self.turning
    }

    /// How far (m) two bodies moved against each other at most.
    fn against([a, b]: [&Move; 2]) -> f64 {
        (b.shift - a.shift).norm() + a.turning + b.turning
    }
}

/// The state at a part of the way: straight, and turning evenly.
fn along(a: &State, b: &State, theta: f64) -> State {
    let turn = (b.pose.q * a.pose.q.inverse()).scaled_axis();
    let q = UnitQuaternion::from_scaled_axis(theta * turn) * a.pose.q;
    State { pose: Pose { p: a.pose.p.lerp(&b.pose.p, theta), q }, ..*a }
}
