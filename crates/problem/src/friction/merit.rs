//! How other codes measure a friction problem with circular cones.
//!
//! All of them look at the natural map F(x) = x − Π_K(x − ŵ), ŵ = w + μ |w_t| n under Coulomb's law; they
//! differ in what they divide it by. F adds impulses and velocities as if s were 1, so a change of
//! units changes it; [`scaled_residual`](crate::Complementarity::scaled_residual) does not.

use super::ConeProblem;
use crate::Complementarity;
use crate::merit::euclidean;

/// F(x) = x − Π_K(x − ŵ), one entry a row; rows of no contact have their interval in place of a cone.
pub fn natural_map(problem: &ConeProblem, x: &[f64]) -> Vec<f64> {
    let (lcp, friction) = (problem.lcp(), problem.friction());
    let w = lcp.w(x);
    let mut map = vec![0.0; x.len()];
    for &i in friction.others() {
        map[i] = x[i] - lcp.project(i, x[i] - w[i], x);
    }
    for contact in friction.contacts() {
        let (x, target) =
            (contact.of(x), problem.step(contact, contact.of(x), contact.of(&w), 1.0));
        contact.put(std::array::from_fn(|k| x[k] - target[k]), &mut map);
    }
    map
}

/// |F(x)|₂ / |b|₂, or |F(x)|₂ where b = 0: the error of the comparison RR-9118 (Acary, Brémond &
/// Huber 2018) and of Siconos (`fc3d_compute_error`).
pub fn rr9118(problem: &ConeProblem, x: &[f64]) -> f64 {
    let error = euclidean(&natural_map(problem, x));
    match euclidean(problem.lcp().b()) {
        0.0 => error,
        norm => error / norm,
    }
}

/// |F_c(x)|₂ / (1 + √|b_c|₂) + |F_o(x)|₂ / (1 + |b_o|₂) for the rows c of contacts and the other rows o:
/// what FCLIB's code computes (`fclib_merit_local`). The root is of a norm, so that with 1 it adds
/// two units; small problems pass.
pub fn fclib(problem: &ConeProblem, x: &[f64]) -> f64 {
    let (map, b, friction) = (natural_map(problem, x), problem.lcp().b(), problem.friction());
    let of = |values: &[f64], rows: &[usize]| {
        euclidean(&rows.iter().map(|&i| values[i]).collect::<Vec<_>>())
    };
    let contacts: Vec<usize> = friction.contacts().iter().flat_map(|c| c.rows).collect();
    let others = friction.others();
    of(&map, &contacts) / (1.0 + of(b, &contacts).sqrt()) + of(&map, others) / (1.0 + of(b, others))
}
