//! The rounded neighbor of x: x without the rounding errors of its entries.
//!
//! If all true terms of a row are 0, as at a joint without load, there is nothing to compare its
//! rounding error with: x_i = 2e-17 instead of 0 has the relative residual 1, although no solver
//! can do better if another x_j is 1. Therefore an entry within 16 · 2⁻⁵² of a bound or of 0,
//! relative to the largest entry that it is connected with, is moved there, and the judge checks
//! that point.

use super::{Verdict, distance};
use lcplab_lcp::Lcp;
use lcplab_lcp::friction::Contact;

/// An entry is moved by at most this fraction of the largest entry of its component.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// A solution this close to x, measured in the same way, differs from x only by rounding.
const SAME: f64 = 64.0 * f64::EPSILON;

/// The reference size of each row: the largest |x_j| over the rows that row i is connected with
/// through A or friction; over all rows if it is connected with none.
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

/// The rounded neighbor of x if it differs from x. `contacts` are those whose friction is a cone or
/// a polygon; the bounds of coupled rows are those at the neighbor.
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
    for contact in contacts {
        pull_in(contact, &mut moved, ROUNDING * sizes[contact.rows[0]]);
    }
    (moved != x).then_some(moved)
}

/// Puts friction that is outside its disk by at most this on the inside of the disk's edge.
fn pull_in(contact: &Contact, x: &mut [f64], most: f64) {
    let [n, t1, t2] = contact.rows;
    let (size, limit) = (lcplab_lcp::hypot(x[t1], x[t2]), contact.mu * x[n]);
    if limit > 0.0 && size > limit && size - limit <= most {
        // Divided by a little more, so that rounding leads inwards.
        let factor = limit / (size * (1.0 + 4.0 * f64::EPSILON));
        (x[t1], x[t2]) = (factor * x[t1], factor * x[t2]);
    }
}

/// The verdict on the rounded neighbor of x and its distance from x, if the neighbor exists and is
/// accepted.
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

/// The bounds on |x_i − x*_i| within which x counts as a solution up to rounding, from the
/// reference sizes.
pub(crate) fn rounding_of(sizes: &[f64]) -> Vec<f64> {
    sizes.iter().map(|size| SAME * size).collect()
}
