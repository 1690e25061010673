//! Finds rows that contradict each other.
//!
//! A vector d with dᵀA = 0 whose rows have no bounds gives dᵀw = dᵀb for every x; but w is 0 in
//! such rows. Therefore dᵀb ≠ 0 means that there is no solution. If bounds are involved, the ray of
//! a pivoting solver or a linear program provides d. Either is then checked in exact arithmetic; d
//! may not involve rows with friction, whose bounds depend on x. Small problems with such rows are
//! tried piece by piece.

use super::cause::Proof;
use lcplab_judge::ray::Farkas;
use lcplab_judge::{Demand, Refutation, refutation, refuted_by, refuting_vector};
use lcplab_lcp::Lcp;
use lcplab_solver::{Dantzig, Solver, Start, Status};

/// Maximum number of rows for exact proofs.
const PROVED: usize = 150;

/// A dᵀb below this fraction of the possible size of its terms, each row in its own unit, counts as
/// zero.
const ROUNDING: f64 = 1e-9;

/// A contradiction up to this fraction of its terms lies in the last digits of the numbers.
const LAST_DIGITS: f64 = 64.0 * f64::EPSILON;

/// The rows that contradict each other, and how that is known. `is_box` is whether friction rows,
/// if there are any, are those of the coupled box.
pub(super) fn rows(
    lcp: &Lcp,
    dependencies: &[Vec<f64>],
    is_box: bool,
) -> Option<(Vec<usize>, Proof)> {
    let falling: Vec<Vec<f64>> = dependencies.iter().map(|d| falling(d, lcp.b())).collect();
    if lcp.len() <= PROVED {
        let tolerance = Demand::default().tolerance;
        if let Some(proof) = clearest(lcp, &falling, tolerance) {
            let is_by_rounding = proof.margin <= LAST_DIGITS;
            let kind = if is_by_rounding { Proof::LastDigits } else { Proof::Vector };
            return Some((support_of(&proof), kind));
        }
        let ray = ray(lcp);
        let hints: Vec<&[f64]> = ray.iter().map(Vec::as_slice).collect();
        let refutation = match is_box {
            true => refutation(lcp, &hints, tolerance),
            false => refuting_vector(lcp, &hints, tolerance).map(Refutation::Vector),
        };
        match refutation {
            Some(Refutation::Vector(proof)) => return Some((support_of(&proof), Proof::Vector)),
            Some(Refutation::CaseSplit { pieces }) => {
                // The contradiction needs all rows.
                return Some((Vec::new(), Proof::CaseSplit { pieces }));
            }
            None => {}
        }
    }
    let seems = falling.iter().find(|d| is_free(lcp, d) && contradicts(lcp, d))?;
    Some((support(seems), Proof::Rounding))
}

/// The proof by one of these vectors: the first that does not depend on the last digits, or else
/// the one with the largest margin. Contradictions that the judge ignores because of the problem's
/// scale do not count.
fn clearest(lcp: &Lcp, vectors: &[Vec<f64>], tolerance: f64) -> Option<Farkas> {
    let mut clearest: Option<Farkas> = None;
    let proofs = vectors.iter().filter_map(|d| refuted_by(lcp, d));
    for proof in proofs.filter(|proof| proof.is_significant(tolerance)) {
        if clearest.as_ref().is_none_or(|known| known.margin < proof.margin) {
            clearest = Some(proof);
        }
        if clearest.as_ref().is_some_and(|proof| proof.margin > LAST_DIGITS) {
            break;
        }
    }
    clearest
}

/// d with the sign that makes dᵀb negative.
fn falling(d: &[f64], b: &[f64]) -> Vec<f64> {
    let sum: f64 = d.iter().zip(b).map(|(d, b)| d * b).sum();
    d.iter().map(|&entry| if sum > 0.0 { -entry } else { entry }).collect()
}

/// Whether x is unbounded in all rows of d; friction rows are bounded.
fn is_free(lcp: &Lcp, d: &[f64]) -> bool {
    let free =
        |i: usize| lcp.lo()[i].is_infinite() && lcp.hi()[i].is_infinite() && !lcp.is_coupled(i);
    (0..d.len()).all(|i| d[i] == 0.0 || free(i))
}

fn contradicts(lcp: &Lcp, d: &[f64]) -> bool {
    let units: Vec<f64> = lcp.matrix().row_sizes().iter().map(|size| size.sqrt()).collect();
    let sum: f64 = d.iter().zip(lcp.b()).map(|(d, b)| d * b).sum();
    let own = |(b, unit): (&f64, &f64)| (b.abs() / unit).max(lcp.scale() * unit);
    let size = lcp.b().iter().zip(&units).map(own).fold(0.0, f64::max);
    let weight: f64 = d.iter().zip(&units).map(|(d, unit)| d.abs() * unit).sum();
    sum.abs() > ROUNDING * size * weight
}

fn support_of(proof: &Farkas) -> Vec<usize> {
    (0..proof.vector.len()).filter(|&i| !proof.vector[i].is_zero()).collect()
}

fn support(d: &[f64]) -> Vec<usize> {
    (0..d.len()).filter(|&i| d[i] != 0.0).collect()
}

/// Dantzig's ray, if there is no friction and it ends on one.
fn ray(lcp: &Lcp) -> Option<Vec<f64>> {
    if lcp.coupling().is_some() || !lcp.matrix().is_symmetric() {
        return None;
    }
    let solver = Dantzig::default();
    match solver.solve(lcp, &Start::default(), &mut ()).status {
        Status::Ray { direction, .. } => Some(direction),
        _ => None,
    }
}
