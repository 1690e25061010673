//! Variants of the problem, each with one mistake.

use lcplab_problem::{Lcp, Matrix};

use super::MistakeKind;
use super::nearest::solution;

/// Maximum number of rows for which bounds are removed row by row.
const MOST_ROWS: usize = 60;

/// A problem that was solved instead of the given one.
pub(super) struct Changed {
    pub kind: MistakeKind,
    /// The change.
    pub what: String,
    pub lcp: Lcp,
}

impl Changed {
    fn new(kind: MistakeKind, what: impl Into<String>, lcp: Option<Lcp>) -> Option<Self> {
        Some(Changed { kind, what: what.into(), lcp: lcp? })
    }
}

/// All variants, the simplest changes first.
pub(super) fn changed_problems(lcp: &Lcp) -> Vec<Changed> {
    let mut all = Vec::new();
    all.extend(Changed::new(
        MistakeKind::SignOfB,
        "b with the opposite sign",
        lcp.with_b(negative(lcp.b())).ok(),
    ));
    if !lcp.matrix().is_symmetric() {
        let bounds = (lcp.lo().to_vec(), lcp.hi().to_vec());
        let lcp = with(lcp, transposed(lcp.matrix()), bounds);
        all.extend(Changed::new(MistakeKind::Transposed, "A transposed", lcp));
    }
    if lcp.has_coupled_rows() {
        all.extend(changed_friction(lcp));
    } else {
        let bounds = (negative(lcp.hi()), negative(lcp.lo()));
        all.extend(Changed::new(
            MistakeKind::SignOfBounds,
            "bounds with the opposite sign, so that contacts pull",
            with(lcp, lcp.matrix().clone(), bounds),
        ));
    }
    if lcp.len() <= MOST_ROWS {
        all.extend((0..lcp.len()).filter_map(|i| without_bounds(lcp, i)));
    }
    all
}

/// The problem with friction limited by these normal forces.
pub(super) fn with_last_normals(lcp: &Lcp, last: &[f64]) -> Option<Changed> {
    let what = "friction limited by the normal forces of the previous frame";
    let frozen = lcp.has_coupled_rows().then(|| lcp.frozen_at(last));
    Changed::new(MistakeKind::LastNormals, what, frozen)
}

/// A + ε I instead of A, with the ε that makes w = −ε x in the free rows, as closely as one number
/// can.
pub(super) fn compliant(lcp: &Lcp, x: &[f64]) -> Option<(f64, Lcp)> {
    let is_inside = |i: usize| {
        let (lo, hi) = lcp.bounds(i, x);
        lo < x[i] && x[i] < hi
    };
    let free: Vec<usize> = (0..lcp.len()).filter(|&i| is_inside(i)).collect();
    let along: f64 = free.iter().map(|&i| -lcp.row_w(i, x) * x[i]).sum();
    let softness = along / free.iter().map(|&i| x[i] * x[i]).sum::<f64>();
    if !(softness > 0.0 && softness.is_finite()) {
        return None;
    }
    let n = lcp.len();
    let all = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let entries: Vec<_> = all.chain((0..n).map(|i| (i, i, softness))).collect();
    let bounds = (lcp.lo().to_vec(), lcp.hi().to_vec());
    Some((softness, with(lcp, Matrix::sparse(n, &entries), bounds)?))
}

/// b times the positive factor that brings the solution nearest to x. The factor can be computed
/// only if all bounds are 0, infinite, or friction, because the solution is then proportional to b.
pub(super) fn with_factor(lcp: &Lcp, x: &[f64], solution: &[f64]) -> Option<(f64, Lcp)> {
    let grows = |bound: &f64| *bound == 0.0 || bound.is_infinite();
    if !lcp.lo().iter().chain(lcp.hi()).all(grows) {
        return None;
    }
    let along: f64 = x.iter().zip(solution).map(|(x, s)| x * s).sum();
    let factor = along / solution.iter().map(|s| s * s).sum::<f64>();
    if !(factor > 0.0 && factor.is_finite()) {
        return None;
    }
    let b = lcp.b().iter().map(|b| factor * b).collect();
    Some((factor, lcp.with_b(b).ok()?))
}

/// Mistakes in friction rows.
fn changed_friction(lcp: &Lcp) -> Vec<Changed> {
    let bounded = |size: f64| {
        let pick = |own: &[f64], bound: f64| -> Vec<f64> {
            (0..lcp.len()).map(|i| if lcp.is_coupled(i) { bound } else { own[i] }).collect()
        };
        let bounds = (pick(lcp.lo(), -size), pick(lcp.hi(), size));
        Lcp::new(lcp.matrix().clone(), lcp.b().to_vec(), bounds.0, bounds.1).ok()
    };
    let without = bounded(0.0);
    let normals = without.as_ref().and_then(solution);
    let limited = "friction limited by the normal forces of a solve without friction";
    let all = [
        Changed::new(MistakeKind::FrictionLeftOut, "friction left out", without),
        Changed::new(
            MistakeKind::UnlimitedFriction,
            "friction without a limit",
            bounded(f64::INFINITY),
        ),
        Changed::new(
            MistakeKind::FrictionlessNormals,
            limited,
            normals.map(|normals| lcp.frozen_at(&normals)),
        ),
    ];
    all.into_iter().flatten().collect()
}

/// Row i as an equation.
fn without_bounds(lcp: &Lcp, i: usize) -> Option<Changed> {
    let (mut lo, mut hi) = (lcp.lo().to_vec(), lcp.hi().to_vec());
    if lcp.is_coupled(i) || lo[i].is_infinite() && hi[i].is_infinite() {
        return None;
    }
    (lo[i], hi[i]) = (f64::NEG_INFINITY, f64::INFINITY);
    let changed = with(lcp, lcp.matrix().clone(), (lo, hi));
    Changed::new(MistakeKind::UnboundedRow, format!("row {i} without its bounds"), changed)
}

fn negative(v: &[f64]) -> Vec<f64> {
    v.iter().map(|v| -v).collect()
}

fn transposed(matrix: &Matrix) -> Matrix {
    let entries: Vec<(usize, usize, f64)> =
        (0..matrix.len()).flat_map(|i| matrix.row(i).iter().map(move |(j, a)| (j, i, a))).collect();
    Matrix::sparse(matrix.len(), &entries)
}

/// The problem with another matrix and other bounds.
fn with(lcp: &Lcp, matrix: Matrix, (lo, hi): (Vec<f64>, Vec<f64>)) -> Option<Lcp> {
    let plain = Lcp::new(matrix, lcp.b().to_vec(), lo, hi).ok()?;
    match lcp.coupling() {
        Some(coupling) => plain.with_coupling(coupling.clone()).ok(),
        None => Some(plain),
    }
}
