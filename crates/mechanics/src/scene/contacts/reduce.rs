//! Reduces the contacts of a pair of bodies to at most four: four points can support the same loads
//! as many if they span the same area.
//!
//! The four are the deepest, the one farthest from it, the one that spans the largest triangle with
//! these two, and the one that adds most to it on another side. Ties go to the first, with a
//! tolerance for rounding, so that the same four are selected from step to step.

use nalgebra::Vector3;

use super::DetectedContact;

/// Measures that differ by less than this fraction of the points' extent are equal.
const EQUAL: f64 = 1e-6;

/// Keeps only the four selected contacts among those from `first` on, in their order.
pub(super) fn to_four(all: &mut Vec<DetectedContact>, first: usize) {
    let Some(kept) = four(&all[first..]) else { return };
    let mut end = first;
    for place in (first..all.len()).filter(|place| kept.contains(&(place - first))) {
        all.swap(end, place);
        end += 1;
    }
    all.truncate(end);
}

/// The indices of the four; `None` if there are no more than four.
fn four(found: &[DetectedContact]) -> Option<[usize; 4]> {
    if found.len() <= 4 {
        return None;
    }
    let point = |k: usize| found[k].point;
    // Either sign works: only the relative sides matter.
    let n = found[0].normal;
    let extent = found.iter().map(|f| (f.point - point(0)).norm()).fold(0.0, f64::max);
    let most = |measure: &dyn Fn(usize) -> f64, unit: f64| {
        let equal = EQUAL * unit;
        (0..found.len())
            .fold(0, |best, k| if measure(k) > measure(best) + equal { k } else { best })
    };
    let area = |i: usize, j: usize, k: usize| triangle(&n, [i, j, k].map(point));
    let first = most(&|k| -found[k].gap, extent);
    let second = most(&|k| (point(k) - point(first)).norm(), extent);
    let third = most(&|k| area(first, second, k).abs(), extent * extent);
    let turn = area(first, second, third).signum();
    let corners = [first, second, third];
    let outside = |k: usize| {
        let sides = (0..3).map(|c| -turn * area(corners[c], corners[(c + 1) % 3], k));
        sides.fold(f64::NEG_INFINITY, f64::max)
    };
    let fourth = most(&outside, extent * extent);
    Some([first, second, third, fourth])
}

/// Twice the area of a triangle projected along n, positive if counterclockwise.
fn triangle(n: &Vector3<f64>, [a, b, c]: [Vector3<f64>; 3]) -> f64 {
    n.dot(&(b - a).cross(&(c - a)))
}
