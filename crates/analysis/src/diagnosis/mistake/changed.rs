//! Variants of the problem, each with one mistake.

use lcplab_lcp::number::readable;
use lcplab_lcp::{Coupling, Lcp, Matrix};

use super::MistakeKind;
use super::nearest::solution;

/// Maximum number of rows for which rows lose their bounds or are left out one by one.
const MOST_ROWS: usize = 60;
/// A factor of μ that differs from 1 by less is none.
const NO_FACTOR: f64 = 1e-6;
/// An entry within this fraction of the largest of a bound is at the bound.
const AT_BOUND: f64 = 1e-9;

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
        "the opposite sign of b",
        lcp.with_b(negative(lcp.b())).ok(),
    ));
    if !lcp.matrix().is_symmetric() {
        let lcp = lcp.with_matrix(transposed(lcp.matrix())).ok();
        all.extend(Changed::new(MistakeKind::Transposed, "A transposed", lcp));
    }
    all.extend(without_side(lcp));
    if lcp.has_coupled_rows() {
        all.extend(changed_friction(lcp));
        all.extend(changed_coupling(lcp));
    } else {
        let bounds = (negative(lcp.hi()), negative(lcp.lo()));
        all.extend(Changed::new(
            MistakeKind::SignOfBounds,
            "bounds of the opposite sign, so that contacts pull",
            lcp.with_bounds(bounds.0, bounds.1).ok(),
        ));
    }
    if lcp.len() <= MOST_ROWS {
        all.extend((0..lcp.len()).filter_map(|i| without_bounds(lcp, i)));
        all.extend((0..lcp.len()).filter_map(|i| without_row(lcp, i)));
    }
    all
}

/// The problem with friction limited by these normal forces.
pub(super) fn with_last_normals(lcp: &Lcp, last: &[f64]) -> Option<Changed> {
    let what = "friction limited by the normal forces of the previous step";
    let frozen = lcp.has_coupled_rows().then(|| lcp.frozen_at(last));
    Changed::new(MistakeKind::LastNormals, what, frozen)
}

/// A + ε I instead of A, with the ε that makes w = −ε x in the `free` rows, as closely as one
/// number can; compliance left out if ε is negative.
pub(super) fn compliant(
    lcp: &Lcp,
    x: &[f64],
    free: &[usize],
) -> Option<(MistakeKind, String, Lcp)> {
    let along: f64 = free.iter().map(|&i| -lcp.row_w(i, x) * x[i]).sum();
    let softness = along / free.iter().map(|&i| x[i] * x[i]).sum::<f64>();
    if softness == 0.0 || !softness.is_finite() {
        return None;
    }
    let n = lcp.len();
    let all = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let entries: Vec<_> = all.chain((0..n).map(|i| (i, i, softness))).collect();
    let changed = lcp.with_matrix(Matrix::sparse(n, &entries)).ok()?;
    let size = readable(softness.abs(), 4);
    Some(match softness > 0.0 {
        true => {
            let what = format!("compliance (CFM) {size} on the diagonal of A");
            (MistakeKind::Compliance, what, changed)
        }
        false => {
            let what = format!("compliance (CFM) {size} left out of the diagonal of A");
            (MistakeKind::ComplianceLeftOut, what, changed)
        }
    })
}

/// The positive factor of b that brings the solution nearest to x. It can be computed only if all
/// bounds are 0, infinite, or friction, because the solution is then proportional to b. If rows are
/// redundant, x may be another solution than the one that is known, and the factor is that with
/// which A x + b comes nearest to 0 in the `free` rows.
pub(super) fn factor_of_b(
    lcp: &Lcp,
    x: &[f64],
    solution: &[f64],
    free: Option<&[usize]>,
) -> Option<f64> {
    let along = |v: &[f64], of: &[f64]| v.iter().zip(of).map(|(v, of)| v * of).sum::<f64>();
    let factor = match free {
        None => along(x, solution) / along(solution, solution),
        Some(free) => {
            let b: Vec<f64> = free.iter().map(|&i| lcp.b()[i]).collect();
            let held: Vec<f64> = free.iter().map(|&i| lcp.b()[i] - lcp.row_w(i, x)).collect();
            along(&held, &b) / along(&b, &b)
        }
    };
    (is_homogeneous(lcp) && factor > 0.0 && factor.is_finite()).then_some(factor)
}

/// The rows in which x is strictly between its bounds.
pub(super) fn free_rows(lcp: &Lcp, x: &[f64]) -> Vec<usize> {
    (0..lcp.len()).filter(|&i| is_inside(lcp, i, x)).collect()
}

/// Whether x_i is strictly between its bounds, by more than rounding.
pub(super) fn is_inside(lcp: &Lcp, i: usize, x: &[f64]) -> bool {
    let size = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let (lo, hi) = lcp.bounds(i, x);
    lo + AT_BOUND * size < x[i] && x[i] < hi - AT_BOUND * size
}

/// Whether a multiple of b has the same multiple of x.
pub(super) fn is_homogeneous(lcp: &Lcp) -> bool {
    let grows = |bound: &f64| *bound == 0.0 || bound.is_infinite();
    lcp.lo().iter().chain(lcp.hi()).all(grows)
}

/// The μ of the coupled rows times the largest |x_t| / (μ x_n), if it is not 1.
pub(super) fn with_factor_of_mu(lcp: &Lcp, x: &[f64]) -> Option<(f64, Lcp)> {
    let coupling = lcp.coupling()?;
    let used = |(i, k): (usize, usize)| {
        let limit = coupling.mu(i) * x[k];
        (limit > 0.0).then(|| x[i].abs() / limit)
    };
    let factor = coupling.rows().filter_map(used).fold(0.0, f64::max);
    let is_factor = factor > 0.0 && factor.is_finite() && (factor - 1.0).abs() > NO_FACTOR;
    let changed = is_factor.then(|| with_mu(lcp, |mu| factor * mu))??;
    Some((factor, changed))
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

/// μ squared, and friction limited by the normal force of the next or the previous contact.
fn changed_coupling(lcp: &Lcp) -> Vec<Changed> {
    let mut normals: Vec<usize> =
        lcp.coupling().into_iter().flat_map(|own| own.rows().map(|(_, k)| k)).collect();
    normals.sort_unstable();
    normals.dedup();
    let count = normals.len();
    let other = |by: usize| {
        let of = |k: usize| normals.iter().position(|&own| own == k).map(|at| (at + by) % count);
        with_normals(lcp, |k| of(k).map_or(k, |at| normals[at]))
    };
    let squared = with_mu(lcp, |mu| mu * mu);
    let mut all = vec![Changed::new(MistakeKind::FactorOfMu, "μ squared", squared)];
    if count > 1 {
        let what = "friction limited by the normal force of the next contact";
        all.push(Changed::new(MistakeKind::OtherNormals, what, other(1)));
        let what = "friction limited by the normal force of the previous contact";
        all.push(Changed::new(MistakeKind::OtherNormals, what, other(count - 1)));
    }
    all.into_iter().flatten().collect()
}

/// The problem with other coefficients of friction.
fn with_mu(lcp: &Lcp, mu: impl Fn(f64) -> f64) -> Option<Lcp> {
    let coupling = lcp.coupling()?.with_mu(|_, _, own| mu(own)).ok()?;
    lcp.clone().with_coupling(coupling).ok()
}

/// The problem with friction limited by other normal rows.
fn with_normals(lcp: &Lcp, normal: impl Fn(usize) -> usize) -> Option<Lcp> {
    let coupling = lcp.coupling()?;
    let index = (0..lcp.len()).map(|i| coupling.index(i).map(&normal)).collect();
    let mu = (0..lcp.len()).map(|i| coupling.mu(i)).collect();
    lcp.clone().with_coupling(Coupling::new(index, mu).ok()?).ok()
}

/// Without all lower or all upper bounds, if some are finite.
fn without_side(lcp: &Lcp) -> Vec<Changed> {
    let (lo, hi) = (lcp.lo().to_vec(), lcp.hi().to_vec());
    let (none, all) = (vec![f64::NEG_INFINITY; lo.len()], vec![f64::INFINITY; hi.len()]);
    let is_bounded = |bounds: &[f64]| bounds.iter().any(|bound| bound.is_finite());
    let mut found = Vec::new();
    for (what, is_there, bounds) in [
        ("lower bounds not applied", is_bounded(&lo), (none, hi.clone())),
        ("upper bounds not applied", is_bounded(&hi), (lo.clone(), all)),
    ] {
        let changed = is_there.then(|| lcp.with_bounds(bounds.0, bounds.1).ok()).flatten();
        found.extend(Changed::new(MistakeKind::MissingBound, what, changed));
    }
    found
}

/// Row i with its friction rows, held at 0; rows that cannot be 0 are not left out.
fn without_row(lcp: &Lcp, i: usize) -> Option<Changed> {
    let (mut lo, mut hi) = (lcp.lo().to_vec(), lcp.hi().to_vec());
    if lcp.is_coupled(i) || lo[i] > 0.0 || hi[i] < 0.0 {
        return None;
    }
    (lo[i], hi[i]) = (0.0, 0.0);
    let what = match lcp.coupling().is_some_and(|own| own.rows().any(|(_, k)| k == i)) {
        true => format!("the contact of row {i} left out"),
        false => format!("row {i} left out"),
    };
    Changed::new(MistakeKind::ContactLeftOut, what, lcp.with_bounds(lo, hi).ok())
}

/// Row i as an equation.
fn without_bounds(lcp: &Lcp, i: usize) -> Option<Changed> {
    let (mut lo, mut hi) = (lcp.lo().to_vec(), lcp.hi().to_vec());
    if lcp.is_coupled(i) || lo[i].is_infinite() && hi[i].is_infinite() {
        return None;
    }
    (lo[i], hi[i]) = (f64::NEG_INFINITY, f64::INFINITY);
    let what = format!("row {i} without its bounds");
    Changed::new(MistakeKind::UnboundedRow, what, lcp.with_bounds(lo, hi).ok())
}

fn negative(v: &[f64]) -> Vec<f64> {
    v.iter().map(|v| -v).collect()
}

fn transposed(matrix: &Matrix) -> Matrix {
    let entries: Vec<(usize, usize, f64)> =
        (0..matrix.len()).flat_map(|i| matrix.row(i).iter().map(move |(j, a)| (j, i, a))).collect();
    Matrix::sparse(matrix.len(), &entries)
}
