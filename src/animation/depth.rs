//! The painter's order: from back to front.
//!
//! Two convex solids that do not overlap are separated by a plane, and the one on the viewer's side
//! is in front, wherever their centers are: a long floor under a small box is behind it. Candidate
//! planes are the faces of both, the cross products of their edges, the plane normal to the line of
//! their centers and the picture plane; for solids that overlap slightly, the plane with the least
//! overlap decides. Ties and cycles are resolved by the depth of the centers, then by the order of
//! the bodies.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use nalgebra::Vector3;

use super::Camera;
use super::solid::{Part, Solid};

/// A direction closer than this (as a sine) to the picture plane gives no depth order.
const EDGE_ON: f64 = 1e-9;
/// Overlap (m) relative to the size of the pair that counts as touching.
const TOUCH: f64 = 1e-9;

/// The indices of the solids in the order of painting.
pub(super) fn order(camera: &Camera, solids: &[Solid]) -> Vec<usize> {
    let n = solids.len();
    let boxes: Vec<Seen> = solids.iter().map(|solid| Seen::new(camera, solid)).collect();
    let (mut over, mut below) = (vec![Vec::new(); n], vec![0; n]);
    for j in 0..n {
        for i in 0..j {
            if !boxes[i].meets(&boxes[j]) {
                continue;
            }
            let (back, front) = match relation(camera, &solids[i], &solids[j]) {
                Ordering::Less => (i, j),
                Ordering::Greater => (j, i),
                Ordering::Equal => continue,
            };
            over[back].push(front);
            below[front] += 1;
        }
    }
    let depths: Vec<f64> = boxes.iter().map(|seen| seen.depth).collect();
    sorted(&depths, &over, below)
}

/// The area a solid covers in the picture (m), and the depth of its center.
struct Seen {
    x: (f64, f64),
    y: (f64, f64),
    depth: f64,
}

impl Seen {
    fn new(camera: &Camera, solid: &Solid) -> Self {
        let corners: Vec<_> = solid.corners.iter().map(|corner| camera.project(corner)).collect();
        let range = |k: usize| {
            let values = corners.iter().map(|corner| corner[k]);
            let (lo, hi) = values
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
            (lo - solid.radius, hi + solid.radius)
        };
        Seen { x: range(0), y: range(1), depth: camera.project(&solid.center()).z }
    }

    fn meets(&self, other: &Seen) -> bool {
        let meet = |a: (f64, f64), b: (f64, f64)| a.0 < b.1 && b.0 < a.1;
        meet(self.x, other.x) && meet(self.y, other.y)
    }
}

/// Less if a is behind b, equal if neither hides the other.
fn relation(camera: &Camera, a: &Solid, b: &Solid) -> Ordering {
    if let Some(order) = joined(a, b).or_else(|| joined(b, a).map(Ordering::reverse)) {
        return order;
    }
    let mut best: Option<(f64, Ordering)> = None;
    for n in candidates(camera, a, b) {
        let ((a_lo, a_hi), (b_lo, b_hi)) = (a.interval(&n), b.interval(&n));
        let gap = (b_lo - a_hi).max(a_lo - b_hi);
        let towards = camera.project(&n).z;
        let touch = TOUCH * (a_hi - a_lo + b_hi - b_lo);
        if towards.abs() <= EDGE_ON {
            if gap >= -touch {
                // They are next to each other in the picture.
                return Ordering::Equal;
            }
            continue;
        }
        let b_is_beyond = b_lo - a_hi >= a_lo - b_hi;
        let order = if b_is_beyond == (towards > 0.0) { Ordering::Less } else { Ordering::Greater };
        if best.is_none_or(|(widest, _)| gap > widest) {
            best = Some((gap, order));
        }
    }
    best.map_or(Ordering::Equal, |(_, order)| order)
}

/// A rod is behind the balls and points at its ends, which it would otherwise cross.
fn joined(rod: &Solid, body: &Solid) -> Option<Ordering> {
    match (rod.part, body.part) {
        (Part::Rod(bodies), Part::Body(k)) if bodies.contains(&Some(k)) && body.radius > 0.0 => {
            Some(Ordering::Less)
        }
        _ => None,
    }
}

/// Unit normals of planes that may separate the two solids.
fn candidates(camera: &Camera, a: &Solid, b: &Solid) -> Vec<Vector3<f64>> {
    let normals = |solid: &Solid| -> Vec<_> {
        solid.faces.iter().filter_map(|face| solid.normal(face)).collect()
    };
    let mut all = normals(a);
    all.extend(normals(b));
    for e in &a.edges {
        all.extend(b.edges.iter().filter_map(|f| e.cross(f).try_normalize(1e-9)));
    }
    all.extend((b.center() - a.center()).try_normalize(0.0));
    all.push(camera.toward());
    all
}

/// Topological order by Kahn's algorithm: each node after those below it, the deepest of the
/// available ones first.
fn sorted(depths: &[f64], over: &[Vec<usize>], mut below: Vec<usize>) -> Vec<usize> {
    let n = depths.len();
    let mut by_depth: Vec<usize> = (0..n).collect();
    by_depth.sort_by(|&i, &j| depths[i].total_cmp(&depths[j]));
    let mut rank = vec![0; n];
    for (place, &node) in by_depth.iter().enumerate() {
        rank[node] = place;
    }
    let free = (0..n).filter(|&node| below[node] == 0);
    let mut heap: BinaryHeap<_> = free.map(|node| Reverse(rank[node])).collect();
    let (mut done, mut order, mut deepest) = (vec![false; n], Vec::new(), 0);
    while order.len() < n {
        // In a cycle no node is available: the deepest goes first.
        while deepest < n && done[by_depth[deepest]] {
            deepest += 1;
        }
        let node = by_depth[heap.pop().map_or(deepest, |Reverse(place)| place)];
        if done[node] {
            continue;
        }
        done[node] = true;
        order.push(node);
        for &front in &over[node] {
            below[front] -= 1;
            if below[front] == 0 && !done[front] {
                heap.push(Reverse(rank[front]));
            }
        }
    }
    order
}
