//! Gauss-Seidel sweeps whose bounds are applied wrongly.

use lcplab_lcp::Lcp;

use super::MistakeKind;
use super::nearest::distance;
use super::sweeps::{Nearest, SweepMatch};

/// Maximum number of sweeps from a multiple of the last answer.
const SCALED_SWEEPS: usize = 20;
/// The factors that are looked for; one next to 1 is none.
const FACTORS: std::ops::Range<f64> = 0.01..100.0;
const NO_FACTOR: f64 = 1e-6;
/// The fit of the factor: the number of corrections, and the distance of the two points of each.
const FITS: usize = 4;
const APART: f64 = 1e-4;

/// A wrong way to apply the bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flaw {
    /// The change of x_i is clamped to the bounds, and added.
    ClampedIncrements,
    /// x is clamped to its bounds after the last sweep.
    ClampAtEnd,
    /// The friction limits of the first sweep are kept.
    FirstFriction,
    /// The friction limits are those of x before the sweep.
    LateFriction,
}

impl Flaw {
    pub const ALL: [Flaw; 4] =
        [Flaw::ClampedIncrements, Flaw::ClampAtEnd, Flaw::FirstFriction, Flaw::LateFriction];

    pub fn kind(self) -> MistakeKind {
        match self {
            Flaw::ClampedIncrements => MistakeKind::ClampedIncrements,
            Flaw::ClampAtEnd => MistakeKind::ClampAtEnd,
            Flaw::FirstFriction => MistakeKind::FirstFriction,
            Flaw::LateFriction => MistakeKind::LateFriction,
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Flaw::ClampedIncrements => "Gauss-Seidel with clamped increments",
            Flaw::ClampAtEnd => "Gauss-Seidel without bounds, clamped at the end",
            Flaw::FirstFriction => "Gauss-Seidel with the friction limits of the first sweep",
            Flaw::LateFriction => "Gauss-Seidel with friction limits one sweep late",
        }
    }

    /// Whether sweeps on this problem differ from right ones.
    fn matters(self, lcp: &Lcp) -> bool {
        match self {
            Flaw::FirstFriction | Flaw::LateFriction => lcp.has_coupled_rows(),
            Flaw::ClampedIncrements | Flaw::ClampAtEnd => true,
        }
    }
}

/// Flawed sweeps from 0, stopped where they come nearest to x; `None` if a row has no positive
/// diagonal, or if the flaw changes nothing.
pub(super) fn flawed_sweeps(flaw: Flaw, lcp: &Lcp, most: usize, x: &[f64]) -> Option<SweepMatch> {
    let n = lcp.len();
    if !flaw.matters(lcp) || (0..n).any(|i| lcp.matrix().diagonal(i) <= 0.0) {
        return None;
    }
    let mut current = vec![0.0; n];
    lcp.project_all(&mut current);
    let mut limits = current.clone();
    let mut nearest = Nearest::to(x);
    for sweep in 1..=most {
        for i in 0..n {
            let change = -lcp.row_w(i, &current) / lcp.matrix().diagonal(i);
            let value = current[i] + change;
            current[i] = match flaw {
                Flaw::ClampedIncrements => current[i] + lcp.project(i, change, &current),
                Flaw::ClampAtEnd => value,
                Flaw::FirstFriction if sweep == 1 => lcp.project(i, value, &current),
                Flaw::FirstFriction | Flaw::LateFriction => lcp.project(i, value, &limits),
            };
        }
        if flaw == Flaw::LateFriction || sweep == 1 {
            limits.clone_from(&current);
        }
        let mut result = current.clone();
        if flaw == Flaw::ClampAtEnd {
            lcp.project_all(&mut result);
        }
        if !result.iter().all(|x| x.is_finite()) {
            break;
        }
        nearest.look_at(sweep, &result);
    }
    Some(nearest.swept(current))
}

/// The factor of the last answer, and the number of sweeps from there, that come nearest to x;
/// `sweeps` makes this number of sweeps from a start.
pub(super) fn scaled_start(
    last: &[f64],
    x: &[f64],
    sweeps: impl Fn(&[f64], usize) -> Vec<f64>,
) -> Option<(f64, SweepMatch)> {
    let fits = (0..=SCALED_SWEEPS).filter_map(|count| {
        let from = |factor: f64| {
            let start: Vec<f64> = last.iter().map(|x| factor * x).collect();
            if count == 0 { start } else { sweeps(&start, count) }
        };
        let (factor, y) = fitted_start(from, x)?;
        let is_factor = FACTORS.contains(&factor) && (factor - 1.0).abs() > NO_FACTOR;
        let swept = SweepMatch { sweeps: count, last: y.clone(), nearest: y, is_converged: false };
        is_factor.then_some((factor, swept))
    });
    fits.min_by(|(_, a), (_, b)| distance(x, &a.nearest).total_cmp(&distance(x, &b.nearest)))
}

/// The factor whose sweeps come nearest to x, with their end. Each step of the fit takes the sweeps
/// as linear in the factor, which they are as long as no row changes sides.
fn fitted_start(from: impl Fn(f64) -> Vec<f64>, x: &[f64]) -> Option<(f64, Vec<f64>)> {
    let mut factor = 0.9;
    for _ in 0..FITS {
        let (y, z) = (from(factor), from(factor + APART));
        let slopes = || z.iter().zip(&y).map(|(z, y)| (z - y) / APART);
        let along: f64 = slopes().zip(x.iter().zip(&y)).map(|(s, (x, y))| s * (x - y)).sum();
        let square: f64 = slopes().map(|slope| slope * slope).sum();
        factor += along / square;
        if !factor.is_finite() {
            return None;
        }
    }
    Some((factor, from(factor)))
}
