//! A primal-dual interior-point method for the quadratic program over the box.
//!
//! Each finite bound k of a row i(k) gets a *room* ρ_k > 0, the distance from x_i to it, and a
//! *push* z_k > 0 away from it, with sign s_k = 1 at a lower bound and −1 at an upper one. Room
//! times push is not asked to vanish at once but approached along the *central path*, μ → 0:
//!
//! ```text
//! A x + b = Σ_k s_k z_k,   ρ_k z_k = μ
//! ```
//!
//! An iteration is a Newton step on these equations. Eliminating the changes of the pushes leaves
//!
//! ```text
//! (A + Σ_k z_k/ρ_k) dx = −(A x + b − Σ_k s_k z_k) + Σ_k s_k r_k/ρ_k,   r_k = μ − ρ_k z_k
//! dz_k = (r_k − s_k z_k dx) / ρ_k
//! ```
//!
//! It is solved twice with one factorisation (Mehrotra 1992): first for μ = 0, to see how far that
//! would get, say to μ'; then for (μ'/μ)³ μ, with the error dρ dz of the first step taken off r.
//! Ten to thirty iterations whatever the size and the condition of A, for symmetric semidefinite A;
//! singular is no difficulty, as the bounds add to the diagonal (rows without bounds get
//! 10⁻¹² a_ii). Each factorises a matrix with the pattern of A, within its
//! envelope (envelope.rs): n³/6 products for a dense A, n b²/2 where rows reach no farther
//! than b. Where solutions are not unique it finds one in their middle.
//!
//! Rows at a bound end beside it, by about μ/w_i: the answer is as exact as the tolerance and no
//! more. A start is only used where it lies well inside. A not symmetric, or no Cholesky factor:
//! `OutsideClass`; steps that have shrunk to nothing: `Stalled`. Coupled rows: see
//! [`frozen`].

use std::ops::ControlFlow;

use super::envelope::Envelope;
use super::iterate::iterate;
use super::metric::Metric;
use super::{Event, Observer, Settings, Solution, Solver, Start, Status, frozen};
use crate::lcp::Lcp;

/// The part of the way to the nearest bound that a step may use.
const STAY_INSIDE: f64 = 0.995;
/// Added to the diagonal, as a part of a_ii.
const REGULARISATION: f64 = 1e-12;
/// Steps shorter than this do not count as progress.
const SHORTEST: f64 = 1e-10;
/// The factor may have this many entries, a quarter of a gigabyte.
const MAX_ENTRIES: usize = 32_000_000;

/// Mehrotra's predictor-corrector method.
#[derive(Debug, Clone, Default)]
pub struct InteriorPoint {
    /// The common settings; an iteration is a factorisation and two solves.
    pub settings: Settings,
}

impl Solver for InteriorPoint {
    fn name(&self) -> &'static str {
        "interior-point"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let metric = match Metric::of_symmetric(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::new(lcp, x, status, 0),
        };
        let Some(room) = Envelope::of(lcp.matrix(), MAX_ENTRIES) else {
            let reason = "a factor of more than 32 million entries";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        };
        frozen::solve(lcp, x, &self.settings, |lcp, x, first| {
            let mut path = None; // a start that is a solution must not be moved inside
            iterate(lcp, x, first, &self.settings, observer, |x| {
                path.get_or_insert_with(|| Path::from_inside(lcp, &metric, &room, x)).step(x)
            })
        })
    }
}

/// One finite bound.
#[derive(Debug, Clone, Copy)]
struct Bound {
    row: usize,
    /// 1 for a lower bound, −1 for an upper one.
    sign: f64,
    /// ρ_k, carried along: x minus the bound would round to 0 in the end.
    room: f64,
    /// z_k.
    push: f64,
}

struct Path<'a> {
    lcp: &'a Lcp,
    metric: &'a Metric,
    bounds: Vec<Bound>,
    factor: Envelope,
}

/// A change of x, with the changes of the rooms and pushes.
struct Direction {
    x: Vec<f64>,
    room: Vec<f64>,
    push: Vec<f64>,
}

impl<'a> Path<'a> {
    /// Moves x inside its bounds and chooses the pushes such that every ρ z is the energy
    /// e = Σ b_i² / a_ii; distances are measured by √(e / a_ii).
    fn from_inside(lcp: &'a Lcp, metric: &'a Metric, room: &Envelope, x: &mut [f64]) -> Self {
        let energy: f64 = (0..x.len()).map(|i| lcp.b()[i].powi(2) / metric.diagonal[i]).sum();
        let energy = if energy > 0.0 { energy } else { 1.0 };
        let mut bounds = Vec::new();
        for row in (0..x.len()).filter(|&i| lcp.lo()[i] < lcp.hi()[i]) {
            let (lo, hi) = (lcp.lo()[row], lcp.hi()[row]);
            let distance = f64::min((energy / metric.diagonal[row]).sqrt(), 0.5 * (hi - lo));
            x[row] = x[row].max(lo + distance).min(hi - distance);
            for (sign, at) in [(1.0, lo), (-1.0, hi)] {
                if at.is_finite() {
                    let room = sign * (x[row] - at);
                    bounds.push(Bound { row, sign, room, push: energy / room });
                }
            }
        }
        Path { lcp, metric, bounds, factor: room.clone() }
    }

    fn step(&mut self, x: &mut [f64]) -> ControlFlow<Status, Event> {
        if !self.factorise() {
            let reason = "A is not positive semidefinite";
            return ControlFlow::Break(Status::OutsideClass { reason });
        }
        let w = self.lcp.w(x);
        let product: Vec<f64> = self.bounds.iter().map(|k| k.room * k.push).collect();
        let predictor = self.direction(&w, product.iter().map(|p| -p).collect());
        let target = self.target(&product, &predictor);
        let second_order = predictor.room.iter().zip(&predictor.push).map(|(r, z)| r * z);
        let r = product.iter().zip(second_order).map(|(p, e)| target - p - e).collect();
        let corrector = self.direction(&w, r);
        let length = (STAY_INSIDE * self.longest(&corrector)).min(1.0);
        if !(length > SHORTEST) || corrector.x.iter().any(|d| !d.is_finite()) {
            return ControlFlow::Break(Status::Stalled);
        }
        for (x, d) in x.iter_mut().zip(corrector.x.iter()) {
            *x += length * d;
        }
        self.lcp.project_all(x); // a room below the rounding of x may leave it beside the bound
        for (k, bound) in self.bounds.iter_mut().enumerate() {
            bound.room += length * corrector.room[k];
            bound.push += length * corrector.push[k];
        }
        ControlFlow::Continue(Event::Step)
    }

    /// The factors of A + Σ_k z_k/ρ_k, with a unit row for a pinned x; false if there are none.
    fn factorise(&mut self) -> bool {
        let mut added: Vec<f64> = self.metric.diagonal.iter().map(|d| REGULARISATION * d).collect();
        for k in &self.bounds {
            added[k.row] += k.push / k.room;
        }
        self.factor.factor(self.lcp.matrix(), &added, |i| is_pinned(self.lcp, i)).is_ok()
    }

    /// The solution of the linear equations for these r_k.
    fn direction(&self, w: &[f64], r: Vec<f64>) -> Direction {
        let mut rhs: Vec<f64> = w.iter().map(|w| -w).collect();
        for (k, r) in self.bounds.iter().zip(&r) {
            rhs[k.row] += k.sign * (k.push + r / k.room);
        }
        for i in (0..rhs.len()).filter(|&i| is_pinned(self.lcp, i)) {
            rhs[i] = 0.0;
        }
        self.factor.solve(&mut rhs);
        let dx = rhs;
        let room: Vec<f64> = self.bounds.iter().map(|k| k.sign * dx[k.row]).collect();
        let changes = self.bounds.iter().zip(r.iter().zip(&room));
        let push = changes.map(|(k, (r, room))| (r - k.push * room) / k.room).collect();
        Direction { x: dx, room, push }
    }

    /// The μ to aim at: small if the predictor gets far.
    fn target(&self, product: &[f64], predictor: &Direction) -> f64 {
        let count = product.len().max(1) as f64;
        let mu = product.iter().sum::<f64>() / count;
        let reach = self.longest(predictor).min(1.0);
        let changes = predictor.room.iter().zip(&predictor.push);
        let ahead = |(k, (room, push)): (&Bound, (&f64, &f64))| {
            (k.room + reach * room) * (k.push + reach * push)
        };
        let ahead = self.bounds.iter().zip(changes).map(ahead).sum::<f64>() / count;
        if mu > 0.0 { mu * (ahead / mu).powi(3) } else { 0.0 }
    }

    /// The length at which the first room or push would vanish.
    fn longest(&self, direction: &Direction) -> f64 {
        let until = |value: f64, change: f64| {
            if change < 0.0 { -value / change } else { f64::INFINITY }
        };
        let rooms = self.bounds.iter().zip(&direction.room).map(|(k, d)| until(k.room, *d));
        let pushes = self.bounds.iter().zip(&direction.push).map(|(k, d)| until(k.push, *d));
        rooms.chain(pushes).fold(f64::INFINITY, f64::min)
    }
}

fn is_pinned(lcp: &Lcp, i: usize) -> bool {
    lcp.lo()[i] == lcp.hi()[i]
}
