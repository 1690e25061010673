//! The rounded neighbor of x: what x would be without the rounding error of its own digits.
//!
//! A row whose true terms are all 0, such as a joint without load, has nothing that its rounding
//! error could be compared with: x_i = 2e-17 instead of 0 misses by all of its terms, although no
//! solver can do better beside an x_j of 1. So an entry that lies within 16 · 2⁻⁵² of a bound or of
//! 0, in parts of the largest entry that it is connected with, is moved there, and that point is
//! judged.

use super::{Verdict, distance};
use lcplab_problem::Lcp;
use lcplab_problem::friction::Contact;

/// An entry is moved by at most this part of the largest one in its component.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// A solution this close to x, in the same measure, is x but for rounding.
const SAME: f64 = 64.0 * f64::EPSILON;

/// How large x is where a row is, row by row: the largest |x_j| of all rows that row i is connected
/// with through A or friction; of all rows for a row that is connected with none.
pub(crate) fn sizes(lcp: &Lcp, contacts: &[Contact], x: &[f64]) -> Vec<f64> {
    let mut parent: Vec<usize> = (0..x.len()).collect();
    let mut is_connected = vec![false; x.len()];
    let mut connect = |i: usize, j: usize| {
        (is_connected[i], is_connected[j]) = (true, true);
        let (a, b) = (root(&mut parent, i), root(&mut parent, j));
        parent[a.max(b)] = a.min(b);
    };
    for i in 0..x.len() {
        let entries = lcp.matrix().row(i).iter();
        entries.filter(|&(j, a)| a != 0.0 && j != i).for_each(|(j, _)| connect(i, j));
        lcp.coupled_to(i).into_iter().for_each(|(k, _)| connect(i, k));
    }
    for contact in contacts {
        let [n, t1, t2] = contact.rows;
        connect(n, t1);
        connect(n, t2);
    }
    let mut largest = vec![0.0f64; x.len()];
    for i in 0..x.len() {
        let root = root(&mut parent, i);
        largest[root] = largest[root].max(x[i].abs());
    }
    let all = x.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    let size = |i: usize| match is_connected[i] {
        true => largest[root(&mut parent, i)],
        false => all,
    };
    (0..x.len()).map(size).collect()
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

/// The rounded neighbor of x where it differs from x. `contacts` are those whose friction is a cone
/// or a polygon; the bounds of coupled rows are those at the neighbor.
pub(crate) fn rounded(lcp: &Lcp, contacts: &[Contact], x: &[f64]) -> Option<Vec<f64>> {
    let sizes = sizes(lcp, contacts, x);
    let nearest = |i: usize, bounds: [f64; 2]| {
        let targets = bounds.into_iter().chain([0.0]);
        targets.into_iter().find(|target| (x[i] - target).abs() <= ROUNDING * sizes[i])
    };
    let mut moved = x.to_vec();
    for i in (0..x.len()).filter(|&i| !lcp.is_coupled(i)) {
        moved[i] = nearest(i, [lcp.lo()[i], lcp.hi()[i]]).unwrap_or(x[i]);
    }
    for i in (0..x.len()).filter(|&i| lcp.is_coupled(i)) {
        let (lo, hi) = lcp.bounds(i, &moved);
        moved[i] = nearest(i, [lo, hi]).unwrap_or(x[i]);
    }
    (moved != x).then_some(moved)
}

/// The verdict on the rounded neighbor of x, if there is one and it is accepted, and how far away
/// that is.
pub(crate) fn verdict(
    lcp: &Lcp,
    contacts: &[Contact],
    x: &[f64],
    judged: impl Fn(&[f64]) -> Verdict,
) -> Option<(Verdict, f64)> {
    let neighbor = rounded(lcp, contacts, x)?;
    let moved = distance(x, &neighbor);
    Some((judged(&neighbor).of_point_at(moved)?, moved))
}

/// The largest part of the size of its component by which an entry may differ, for x to be a
/// solution but for rounding: |x_i − x*_i| ≤ this.
pub(crate) fn rounding_of(sizes: &[f64]) -> Vec<f64> {
    sizes.iter().map(|size| SAME * size).collect()
}
