//! Rows that contradict each other.
//!
//! A d with dᵀA = 0 whose rows have no bounds gives dᵀw = dᵀb for every x; but w is 0 in such rows. So
//! dᵀb ≠ 0 says that there is no solution. Where bounds have a part in it, the ray of a pivoting
//! solver is the d. Either is then checked in exact arithmetic.

use crate::certificate::ray::refute;
use crate::lcp::Lcp;
use crate::solver::{Dantzig, Settings, Solver, Start, Status};

/// Problems up to this size are proved exactly.
const PROVED: usize = 150;

/// A dᵀb below this part of what its terms could be counts as zero.
const ROUNDING: f64 = 1e-9;

/// The rows that contradict each other, and whether that was proved.
pub(super) fn rows(lcp: &Lcp, dependencies: &[Vec<f64>]) -> Option<(Vec<usize>, bool)> {
    let open = open(lcp)?;
    for d in dependencies {
        let falling = falling(d, lcp.b());
        if let Some(rows) = proved(&open, pivot(&falling), &falling) {
            return Some((rows, true));
        }
        if is_free(lcp, d) && contradicts(d, lcp.b()) {
            return Some((support(d), false));
        }
    }
    by_pivoting(lcp)
}

/// The problem with friction rows free: a d that leaves them out proves as much for any friction.
fn open(lcp: &Lcp) -> Option<Lcp> {
    Lcp::new(lcp.matrix().clone(), lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec()).ok()
}

/// d with the sign that makes dᵀb negative.
fn falling(d: &[f64], b: &[f64]) -> Vec<f64> {
    let sum: f64 = d.iter().zip(b).map(|(d, b)| d * b).sum();
    d.iter().map(|&entry| if sum > 0.0 { -entry } else { entry }).collect()
}

fn pivot(d: &[f64]) -> usize {
    (0..d.len()).fold(0, |most, i| if d[i].abs() > d[most].abs() { i } else { most })
}

fn proved(open: &Lcp, row: usize, direction: &[f64]) -> Option<Vec<usize>> {
    if open.len() > PROVED {
        return None;
    }
    let proof = refute(open, row, direction)?;
    Some((0..open.len()).filter(|&i| !proof.vector[i].is_zero()).collect())
}

/// Whether x has no bound in any row of d: friction rows have one.
fn is_free(lcp: &Lcp, d: &[f64]) -> bool {
    let coupled = |i: usize| lcp.coupling().is_some_and(|coupling| coupling.index(i).is_some());
    let free = |i: usize| lcp.lo()[i].is_infinite() && lcp.hi()[i].is_infinite() && !coupled(i);
    (0..d.len()).all(|i| d[i] == 0.0 || free(i))
}

fn contradicts(d: &[f64], b: &[f64]) -> bool {
    let sum: f64 = d.iter().zip(b).map(|(d, b)| d * b).sum();
    let size = b.iter().fold(0.0_f64, |most, b| most.max(b.abs()));
    sum.abs() > ROUNDING * size * d.iter().map(|d| d.abs()).sum::<f64>()
}

fn support(d: &[f64]) -> Vec<usize> {
    (0..d.len()).filter(|&i| d[i] != 0.0).collect()
}

/// Dantzig's ray, if there is no friction and it ends on one.
fn by_pivoting(lcp: &Lcp) -> Option<(Vec<usize>, bool)> {
    if lcp.coupling().is_some() || !lcp.matrix().is_symmetric() || lcp.len() > PROVED {
        return None;
    }
    let solver = Dantzig { settings: Settings::default() };
    match solver.solve(lcp, &Start::default(), &mut ()).status {
        Status::Ray { row, direction } => proved(lcp, row, &direction).map(|rows| (rows, true)),
        _ => None,
    }
}
