//! The central path: slacks, multipliers, and the steps along it.

use std::ops::ControlFlow;

use super::step::StepEquations;
use crate::tolerances::{DUST, LATE, MIN_ADDED, SHORTEST_STEP, STAY_INSIDE, VANISHED_SLACK};
use crate::{Event, Status};
use lcplab_lcp::Lcp;

/// Number of corrections for the diagonal that is added to the equations of an active set.
const REFINEMENTS: usize = 6;

/// One finite bound.
#[derive(Debug, Clone, Copy)]
struct Bound {
    row: usize,
    /// 1 for a lower bound, −1 for an upper one.
    sign: f64,
    /// ρ_k, updated incrementally: x minus the bound would eventually round to 0.
    slack: f64,
    /// z_k.
    multiplier: f64,
}

/// A point near the central path.
pub(super) struct Path<'a> {
    lcp: &'a Lcp,
    pinned: Vec<bool>,
    bounds: Vec<Bound>,
    /// √(e / a_ii) of each row.
    unit: Vec<f64>,
    /// e.
    energy: f64,
}

/// A change of x, with the changes of the slacks and multipliers.
struct Direction {
    x: Vec<f64>,
    slack: Vec<f64>,
    multiplier: Vec<f64>,
}

impl<'a> Path<'a> {
    /// Moves x inside its bounds and chooses the multipliers such that every ρ z equals the energy
    /// e = Σ w_i² / a_ii, w = A Π(0) + b: bounds that exclude 0 act like b. The unit of distances
    /// is √(e / a_ii).
    ///
    /// A start whose energy is larger is replaced by Π(0): near the wrong bounds, with products ρ z
    /// that are small compared with w, steps would jump between bounds. Rows without bounds start
    /// at 0. Their equations are linear, so a start gains nothing, and from one time step to the
    /// next a part along a null direction would only grow.
    pub(super) fn from_inside(lcp: &'a Lcp, equations: &impl StepEquations, x: &mut [f64]) -> Self {
        let pinned: Vec<bool> = (0..x.len()).map(|i| lcp.lo()[i] == lcp.hi()[i]).collect();
        let mut least = vec![0.0; x.len()];
        lcp.project_all(&mut least);
        let energy_at = |x: &[f64]| -> f64 {
            let w = lcp.w(x).into_iter().enumerate();
            w.map(|(i, w)| w.powi(2) / equations.diagonal(i)).sum()
        };
        let energy = energy_at(&least);
        let is_free = |i: usize| !lcp.lo()[i].is_finite() && !lcp.hi()[i].is_finite();
        x.iter_mut().enumerate().filter(|(i, _)| is_free(*i)).for_each(|(_, x)| *x = 0.0);
        if !(energy_at(x) <= energy) {
            x.copy_from_slice(&least);
        }
        let energy = if energy > 0.0 { energy } else { 1.0 };
        let unit: Vec<f64> =
            (0..x.len()).map(|i| (energy / equations.diagonal(i)).sqrt()).collect();
        let mut bounds = Vec::new();
        for row in (0..x.len()).filter(|&i| !pinned[i]) {
            let (lo, hi) = (lcp.lo()[row], lcp.hi()[row]);
            let distance = f64::min(unit[row], 0.5 * (hi - lo));
            x[row] = x[row].max(lo + distance).min(hi - distance);
            for (sign, at) in [(1.0, lo), (-1.0, hi)] {
                if at.is_finite() {
                    let slack = sign * (x[row] - at);
                    bounds.push(Bound { row, sign, slack, multiplier: energy / slack });
                }
            }
        }
        Path { lcp, pinned, bounds, unit, energy }
    }

    /// Moves x along the path by a Newton step on the path equations.
    pub(super) fn step(
        &mut self,
        equations: &mut impl StepEquations,
        x: &mut [f64],
    ) -> ControlFlow<Status, Event> {
        let added = self.added(equations);
        if !equations.factor(&added, &self.pinned) {
            let reason = "A is not positive semidefinite";
            return ControlFlow::Break(match added.iter().all(|added| added.is_finite()) {
                true => Status::OutsideClass { reason },
                false => Status::NotFinite,
            });
        }
        let direction = self.direction(equations, x);
        let length = (STAY_INSIDE * self.longest(&direction)).min(1.0);
        if !(length > SHORTEST_STEP) || direction.x.iter().any(|d| !d.is_finite()) {
            return ControlFlow::Break(Status::Stalled);
        }
        for (x, d) in x.iter_mut().zip(&direction.x) {
            *x += length * d;
        }
        // A slack below the rounding error of x may leave x slightly off the bound.
        self.lcp.project_all(x);
        for (k, bound) in self.bounds.iter_mut().enumerate() {
            bound.slack += length * direction.slack[k];
            bound.multiplier += length * direction.multiplier[k];
            if bound.slack < VANISHED_SLACK * self.unit[bound.row] {
                let [lo, hi] = [self.lcp.lo(), self.lcp.hi()];
                x[bound.row] = if bound.sign > 0.0 { lo[bound.row] } else { hi[bound.row] };
            }
        }
        ControlFlow::Continue(Event::Step)
    }

    /// The point of the active set that the path suggests, near its end: x is at a bound whose
    /// slack is smaller than its multiplier, each in its unit, and w = 0 in the other rows.
    /// Rounding errors of entries that should be 0 are removed.
    pub(super) fn refined<E: StepEquations>(
        &self,
        equations: &mut E,
        x: &[f64],
    ) -> Option<Vec<f64>> {
        let product = self.bounds.iter().map(|k| k.slack * k.multiplier).sum::<f64>();
        if !E::REFINES || product > LATE * self.energy * self.bounds.len() as f64 {
            return None;
        }
        let (mut x, mut active) = (x.to_vec(), self.pinned.clone());
        for k in &self.bounds {
            let unit = self.unit[k.row];
            if k.slack / unit < k.multiplier * unit / self.energy {
                let bound = if k.sign > 0.0 { self.lcp.lo() } else { self.lcp.hi() };
                (x[k.row], active[k.row]) = (bound[k.row], true);
            }
        }
        let added: Vec<f64> = (0..x.len()).map(|i| E::UNBOUNDED * equations.diagonal(i)).collect();
        if !equations.factor(&added, &active) {
            return None;
        }
        for _ in 0..REFINEMENTS {
            let mut change: Vec<f64> = equations.w(&x).iter().map(|w| -w).collect();
            change.iter_mut().zip(&active).filter(|(_, at)| **at).for_each(|(d, _)| *d = 0.0);
            equations.solve(&mut change);
            x.iter_mut().zip(&change).for_each(|(x, d)| *x += d);
        }
        let largest = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        x.iter_mut().filter(|x| x.abs() <= DUST * largest).for_each(|x| *x = 0.0);
        self.lcp.project_all(&mut x);
        Some(x)
    }

    /// The diagonal D added to A: Σ_k z_k/ρ_k, and at least enough to compensate for rounding.
    fn added<E: StepEquations>(&self, equations: &E) -> Vec<f64> {
        let mut added = vec![0.0; self.pinned.len()];
        for k in &self.bounds {
            added[k.row] += k.multiplier / k.slack;
        }
        for (i, added) in added.iter_mut().enumerate() {
            let least = if *added > 0.0 { MIN_ADDED } else { E::UNBOUNDED };
            *added += least * equations.diagonal(i);
        }
        added
    }

    /// The corrected predictor.
    fn direction(&self, equations: &mut impl StepEquations, x: &[f64]) -> Direction {
        let w = equations.w(x);
        let product: Vec<f64> = self.bounds.iter().map(|k| k.slack * k.multiplier).collect();
        let predictor = self.towards(equations, &w, product.iter().map(|p| -p).collect());
        if self.bounds.is_empty() {
            // The equation w = 0 is linear.
            return predictor;
        }
        let target = self.target(&product, &predictor);
        let second_order = predictor.slack.iter().zip(&predictor.multiplier).map(|(r, z)| r * z);
        let r = product.iter().zip(second_order).map(|(p, e)| target - p - e).collect();
        self.towards(equations, &w, r)
    }

    /// The solution of the linear equations for these r_k.
    fn towards(&self, equations: &mut impl StepEquations, w: &[f64], r: Vec<f64>) -> Direction {
        let mut rhs: Vec<f64> = w.iter().map(|w| -w).collect();
        for (k, r) in self.bounds.iter().zip(&r) {
            rhs[k.row] += k.sign * (k.multiplier + r / k.slack);
        }
        for (rhs, _) in rhs.iter_mut().zip(&self.pinned).filter(|(_, pinned)| **pinned) {
            *rhs = 0.0;
        }
        equations.solve(&mut rhs);
        let dx = rhs;
        let slack: Vec<f64> = self.bounds.iter().map(|k| k.sign * dx[k.row]).collect();
        let changes = self.bounds.iter().zip(r.iter().zip(&slack));
        let multiplier =
            changes.map(|(k, (r, slack))| (r - k.multiplier * slack) / k.slack).collect();
        Direction { x: dx, slack, multiplier }
    }

    /// The target μ: small if the predictor gets far.
    fn target(&self, product: &[f64], predictor: &Direction) -> f64 {
        let count = product.len().max(1) as f64;
        let mu = product.iter().sum::<f64>() / count;
        let reach = self.longest(predictor).min(1.0);
        let changes = predictor.slack.iter().zip(&predictor.multiplier);
        let ahead = |(k, (slack, multiplier)): (&Bound, (&f64, &f64))| {
            (k.slack + reach * slack) * (k.multiplier + reach * multiplier)
        };
        let ahead = self.bounds.iter().zip(changes).map(ahead).sum::<f64>() / count;
        if mu > 0.0 { mu * (ahead / mu).powi(3) } else { 0.0 }
    }

    /// The step length at which the first slack or multiplier would vanish.
    fn longest(&self, direction: &Direction) -> f64 {
        let until = |value: f64, change: f64| {
            if change < 0.0 { -value / change } else { f64::INFINITY }
        };
        let slacks = self.bounds.iter().zip(&direction.slack).map(|(k, d)| until(k.slack, *d));
        let multipliers =
            self.bounds.iter().zip(&direction.multiplier).map(|(k, d)| until(k.multiplier, *d));
        slacks.chain(multipliers).fold(f64::INFINITY, f64::min)
    }
}
