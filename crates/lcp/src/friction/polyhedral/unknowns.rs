//! The unknowns β of a polygon: their contributions to x, and the products that form the matrix.

use std::cmp::Ordering;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use crate::Matrix;
use crate::friction::FrictionProblem;

/// The β of a contact's x: at most two adjacent ones are not 0.
pub(super) fn beta([_, x1, x2]: [f64; 3], k: usize) -> Vec<f64> {
    let cross = |[p1, p2]: [f64; 2], [q1, q2]: [f64; 2]| p1 * q2 - p2 * q1;
    let components = |j: usize| {
        let (d, e) = (direction(j, k), direction((j + 1) % k, k));
        [cross([x1, x2], e) / cross(d, e), cross(d, [x1, x2]) / cross(d, e)]
    };
    let inside = |j: usize| f64::min(components(j)[0], components(j)[1]);
    let j = (0..k).max_by(|&i, &j| inside(i).total_cmp(&inside(j))).unwrap_or(0);
    let mut beta = vec![0.0; k];
    let [first, second] = components(j);
    (beta[j], beta[(j + 1) % k]) = (first.max(0.0), second.max(0.0));
    beta
}

/// The contribution of each unknown to x: unit vectors for other rows and normals, then the d_j.
pub(super) fn impulses(problem: &FrictionProblem, k: usize) -> Vec<Vec<(usize, f64)>> {
    let (contacts, others) = (problem.contacts(), problem.others());
    let normals = contacts.iter().map(|contact| contact.rows[0]);
    let mut impulses: Vec<_> =
        others.iter().copied().chain(normals).map(|i| vec![(i, 1.0)]).collect();
    for contact in contacts.iter().filter(|contact| contact.mu > 0.0) {
        let [_, t1, t2] = contact.rows;
        impulses.extend((0..k).map(|j| {
            let [d1, d2] = direction(j, k);
            vec![(t1, d1), (t2, d2)]
        }));
    }
    impulses
}

/// d_j = (cos 2πj/k, sin 2πj/k). Each quarter is the previous one turned by exactly 90°, and its
/// halves are mirror images, so that symmetric sums cancel without rounding errors.
pub(super) fn direction(j: usize, k: usize) -> [f64; 2] {
    let (quarter, rest) = (j / (k / 4), j % (k / 4));
    let cos_sin = |rest: usize| {
        let angle = TAU * rest as f64 / k as f64;
        [libm::cos(angle), libm::sin(angle)]
    };
    let first = match (8 * rest).cmp(&k) {
        Ordering::Less => cos_sin(rest),
        Ordering::Equal => [FRAC_1_SQRT_2; 2],
        Ordering::Greater => {
            let [cos, sin] = cos_sin(k / 4 - rest);
            [sin, cos]
        }
    };
    (0..quarter).fold(first, |[d1, d2], _| [-d2, d1])
}

/// The nonzero entries u_pᵀ A u_q for the impulses u.
pub(super) fn delassus(a: &Matrix, impulses: &[Vec<(usize, f64)>]) -> Vec<(usize, usize, f64)> {
    let mut entries = Vec::new();
    for (p, u_p) in impulses.iter().enumerate() {
        // u_pᵀ A
        let mut row = vec![0.0; a.len()];
        for &(i, value) in u_p {
            for (j, a) in a.row(i).iter() {
                row[j] += value * a;
            }
        }
        let products = impulses.iter().enumerate().map(|(q, u_q)| (p, q, along(u_q, &row)));
        entries.extend(products.filter(|entry| entry.2 != 0.0));
    }
    entries
}

/// u · v.
pub(super) fn along(u: &[(usize, f64)], v: &[f64]) -> f64 {
    u.iter().map(|&(i, value)| value * v[i]).sum()
}
