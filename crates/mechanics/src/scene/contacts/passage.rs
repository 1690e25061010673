//! Detects bodies that passed through each other in a step.
//!
//! In a step a body translates in a straight line and rotates uniformly, by the angle that is
//! nearest to its angular velocity times dt: the orientations alone would hide whole turns. Along
//! this path two bodies approach by at most
//!
//! ```text
//! L = |Δp1 − Δp0| + angle0 r0 + angle1 r1
//! ```
//!
//! in total, where r is the distance of the farthest vertex from the center. From a distance d, no
//! overlap can begin before another d/L of the step (conservative advancement, Mirtich 1996), so no
//! pair is missed, however fast it is.

use std::f64::consts::{PI, TAU};

use nalgebra::{UnitQuaternion, Vector3};

use super::reach::Site;
use super::{Detector, point, touches};
use crate::body::{Pose, State};
use crate::scene::{Scene, resting};

/// Bodies whose relative motion is at most this fraction of the thinner one cannot pass through it.
const SHORT: f64 = 0.5;
/// Bodies that overlap on the path by at most this fraction of the thinner one only touch.
const TOUCHING: f64 = 1e-2;
/// Inside a body the path is sampled again after this fraction of the depth.
const INSIDE: f64 = 0.125;
/// The maximum cosine between the normals before and after if a body emerged on another side.
const OTHER_SIDE: f64 = 0.5;
/// A body that turns by more than π may emerge on any side: then an overlap of this fraction of
/// the thinner one is a passage.
const DEEP: f64 = 0.25;
/// After this many samples, for example along a surface, the path is sampled uniformly.
const MANY_LOOKS: usize = 10_000;

/// A body that passed through another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// The two bodies, the lower index first.
    pub bodies: [usize; 2],
    /// The deepest sampled overlap on the path (m).
    pub depth: f64,
    /// The distance (m) of their relative motion in the step, including rotation.
    pub travel: f64,
}

impl Detector {
    /// The pairs of bodies that passed through each other between the start and the end of a
    /// step: they overlap on the path, and their nearest surfaces are on other sides afterwards,
    /// or one of them turned by more than π. Half spaces have no other side.
    pub(crate) fn passages(
        &mut self,
        scene: &Scene,
        before: &[State],
        after: &[State],
    ) -> Vec<Passage> {
        let dt = scene.step.dt;
        let moves: Vec<Move> =
            (0..before.len()).map(|k| Move::of(&before[k], &after[k], dt, self.arms[k])).collect();
        let longest = moves.iter().map(Move::length).fold(0.0, f64::max);
        let is_short = |thickness: f64| 2.0 * longest <= SHORT * thickness;
        if scene.thinnest().is_none_or(is_short) {
            return Vec::new();
        }
        let middle: Vec<State> =
            before.iter().zip(&moves).map(|(start, path)| path.along(start, 0.5)).collect();
        let half = |site: Site| 0.5 * moves[site.body].length();
        self.near_pairs(scene, &middle, half, |_| f64::NEG_INFINITY);
        let mut states = middle;
        let mut passages: Vec<Passage> = Vec::new();
        for pair in self.broad.pairs().to_vec() {
            let bodies = pair.map(|solid| self.owners[solid].body);
            let sizes = bodies.map(|body| resting::size(&scene.bodies[body].shape));
            let Some(thickness) = sizes.into_iter().flatten().reduce(f64::min) else { continue };
            let path = Path::of(before, pair, bodies, bodies.map(|body| &moves[body]));
            let travel = path.travel;
            if travel <= SHORT * thickness {
                continue;
            }
            let Some(depth) = self.passes(scene, &path, &mut states, thickness) else { continue };
            match passages.iter_mut().find(|known| known.bodies == bodies) {
                Some(known) => known.depth = known.depth.max(depth),
                None => passages.push(Passage { bodies, depth, travel }),
            }
        }
        passages
    }

    /// The deepest overlap (m) on a path, if one part passes through the other.
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
        let deepest = deepest.max(-gap);
        let is_other_side = deepest > touching && first.dot(&last) < OTHER_SIDE;
        let is_turned_through = path.turns_over() && deepest > DEEP * thickness;
        (is_other_side || is_turned_through).then_some(deepest)
    }

    /// The gap (m) of a pair of parts at a fraction of its path, and the normal from the first to
    /// the second at the nearest points, in the axes of the larger body (a ball's own axes would be
    /// meaningless).
    pub(super) fn nearest(
        &mut self,
        scene: &Scene,
        path: &Path,
        states: &mut [State],
        theta: f64,
    ) -> Option<(f64, Vector3<f64>)> {
        let Path { pair, bodies, .. } = *path;
        for (k, (solid, body)) in pair.into_iter().zip(bodies).enumerate() {
            states[body] = path.moves[k].along(path.starts[k], theta);
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

/// The motion of two parts in a step.
pub(super) struct Path<'a> {
    /// Where their bodies start.
    starts: [&'a State; 2],
    moves: [&'a Move; 2],
    /// The indices of their solids.
    pair: [usize; 2],
    bodies: [usize; 2],
    /// The maximum distance (m) of their relative motion.
    pub travel: f64,
}

impl<'a> Path<'a> {
    /// The path of two parts whose bodies move so from these states.
    pub fn of(
        before: &'a [State],
        pair: [usize; 2],
        bodies: [usize; 2],
        moves: [&'a Move; 2],
    ) -> Self {
        let travel = Move::against(moves);
        Path { starts: bodies.map(|body| &before[body]), moves, pair, bodies, travel }
    }

    /// Whether a body turns by more than π.
    fn turns_over(&self) -> bool {
        self.moves.iter().any(|one| one.turn.norm() > PI)
    }
}

/// The motion of a body in a step.
pub(super) struct Move {
    /// The translation (m).
    shift: Vector3<f64>,
    /// The rotation vector (rad).
    turn: Vector3<f64>,
    /// The distance (m) that rotation moves its farthest vertex.
    turning: f64,
}

impl Move {
    /// The motion between two states that a step of dt (s) connects; `arm` is the distance (m) of
    /// the farthest vertex from the center.
    pub fn of(before: &State, after: &State, dt: f64, arm: f64) -> Self {
        let turn = turn(before, after, dt);
        Move { shift: after.pose.p - before.pose.p, turn, turning: turn.norm() * arm }
    }

    fn length(&self) -> f64 {
        self.shift.norm() + self.turning
    }

    /// The maximum distance (m) of the relative motion of two bodies.
    fn against([a, b]: [&Move; 2]) -> f64 {
        (b.shift - a.shift).norm() + a.turning + b.turning
    }

    /// The state at a fraction of the path, with straight translation and uniform rotation.
    fn along(&self, start: &State, theta: f64) -> State {
        let p = start.pose.p + theta * self.shift;
        let q = UnitQuaternion::from_scaled_axis(theta * self.turn) * start.pose.q;
        State { pose: Pose { p, q }, ..*start }
    }
}

/// The rotation vector (rad) between two orientations: of all that lead from one to the other,
/// which differ by whole turns, the nearest to the mean angular velocity times dt.
fn turn(before: &State, after: &State, dt: f64) -> Vector3<f64> {
    let expected = 0.5 * dt * (before.omega + after.omega);
    let least = (after.pose.q * before.pose.q.inverse()).scaled_axis();
    let axis = least.try_normalize(0.0).or_else(|| expected.try_normalize(0.0));
    let Some(axis) = axis else { return least };
    let whole_turns = ((expected - least).dot(&axis) / TAU).round();
    least + whole_turns * TAU * axis
}
