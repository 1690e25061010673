//! Dantzig's pivoting method for boxed LCPs with symmetric positive semidefinite A.
//!
//! Rows are satisfied one after another (Cottle & Dantzig 1968; Baraff 1994 for contacts). To drive
//! w_i to zero, x_i moves and the *free* rows C move along so that their w stays zero:
//!
//! ```text
//! d_C = −A_CC⁻¹ A_Ci,   d_i = 1,   Δw = A d,   Δw_i = s = a_ii − A_iC A_CC⁻¹ A_Ci ≥ 0
//! ```
//!
//! until w_i = 0 (i becomes free), x_i meets a bound, some x_j of C meets a bound (j leaves C), or
//! some w_j at a bound reaches zero (j enters C). A_CC = L D Lᵀ is kept up to date.
//!
//! Redundant contacts make A singular. Then s = 0 for a row that depends on C, and since A is
//! semidefinite A d = 0: moving along d changes no w at all. If w_i = 0 already the row is *idle*:
//! C keeps its w at zero, and when a row leaves C an idle one takes its place. Otherwise x moves
//! until a bound stops it and that row leaves C; if nothing stops it, bᵀd < 0 with A d = 0 proves
//! that no solution exists (`Ray`). Whether a number is zero is decided relative to the terms it is
//! summed from, so no unit matters.
//!
//! Where several things end a move at once, the driven row goes first, then a row that enters C, the
//! one longest at its bound before the others, then a row that leaves C. The rule matters: Fathi's
//! problem, all ties, takes n² − n + 1 pivots with it and 2ⁿ − 1 if ties go to the least index.
//!
//! Ends with the exact active set but for rounding, after at most a few n pivots on contact
//! problems (2ⁿ in the worst case); a pivot costs O(c² + c n) for c free rows. Then w is recomputed,
//! x is refined, and rows that rounding has left unsatisfied are driven once more. Not symmetric or
//! not semidefinite A: `OutsideClass`. Coupled rows: see [`frozen`].

use std::ops::ControlFlow;

use super::elimination::difference;
use super::ldlt::Ldlt;
use super::{Event, Iterate, Observer, Settings, Solution, Solver, Start, Status, frozen};
use crate::lcp::{Lcp, merit};

/// A coefficient below this part of the terms it is summed from counts as zero.
const RELATIVE_ZERO: f64 = 1e-13;
/// So does a w that cannot be moved: it carries the rounding of all moves before.
const RELATIVE_ZERO_W: f64 = 1e-11;
/// So does a part of a null direction, which carries the rounding of the factor.
const RELATIVE_ZERO_D: f64 = 1e-11;
/// Moves whose lengths differ by less than this part of them end together.
const TIE: f64 = 1e-10;
/// Rounds of refinement and renewed driving at the end.
const POLISH_ROUNDS: usize = 5;
/// Steps of iterative refinement in a round: the second takes what the first has left.
const REFINEMENTS: usize = 2;
/// Above this many rows the dense factor would not fit.
const MAX_ROWS: usize = 8_000;

/// Dantzig's pivoting method with an updated L D Lᵀ factorisation.
#[derive(Debug, Clone, Default)]
pub struct Dantzig {
    /// The common settings; an iteration is a pivot.
    pub settings: Settings,
}

impl Solver for Dantzig {
    fn name(&self) -> &'static str {
        "dantzig"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if lcp.len() > MAX_ROWS {
            let reason = "a dense factor of more than 8000 rows";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        }
        if !lcp.matrix().is_symmetric() {
            let reason = "A is not symmetric";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        }
        if observer.observe(&Iterate { iteration: 0, x: &x, event: Event::Start }).is_break() {
            return Solution::new(lcp, x, Status::Stopped, 0);
        }
        frozen::solve(lcp, x, &self.settings, |lcp, start, pivots| {
            let mut run = Run::new(lcp, start.clone(), pivots, &self.settings, observer);
            let status = run.solve();
            if run.x.iter().any(|x| !x.is_finite()) {
                return Solution::new(lcp, start, Status::NotFinite, run.pivots);
            }
            Solution::new(lcp, run.x, status, run.pivots)
        })
    }
}

/// Where a row stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    /// Not looked at yet: nothing is asked of its w.
    Waiting,
    /// In C: w = 0 is kept by moving x.
    Free,
    /// Its w is a combination of those of C, and zero with them.
    Idle,
    /// At its lower bound, w ≥ 0.
    Lower,
    /// At its upper bound, w ≤ 0.
    Upper,
}

struct Run<'a> {
    lcp: &'a Lcp,
    settings: &'a Settings,
    observer: &'a mut dyn Observer,
    x: Vec<f64>,
    /// Kept up to date for rows at a bound and the driven row.
    w: Vec<f64>,
    side: Vec<Side>,
    /// C, in the order of the factor's rows.
    free: Vec<usize>,
    /// The rows at a bound, in the order in which they came there.
    bound: Vec<usize>,
    factor: Ldlt,
    pivots: usize,
}

/// A direction of motion: x_i by 1, x_C by `free`.
struct Direction {
    /// d_C, in the order of C.
    free: Vec<f64>,
    /// A_Ci.
    column: Vec<f64>,
    /// Δw_i; 0 where row i depends on C.
    schur: f64,
}

/// What ends a move.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Block {
    length: f64,
    row: usize,
    /// Where the row goes.
    side: Side,
}

impl<'a> Run<'a> {
    fn new(
        lcp: &'a Lcp,
        x: Vec<f64>,
        pivots: usize,
        settings: &'a Settings,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let n = lcp.len();
        Run {
            w: vec![0.0; n],
            side: vec![Side::Waiting; n],
            free: Vec::new(),
            bound: Vec::new(),
            factor: Ldlt::default(),
            lcp,
            settings,
            observer,
            x,
            pivots,
        }
    }

    fn solve(&mut self) -> Status {
        let bounded = |&i: &usize| self.lcp.lo()[i].is_finite() || self.lcp.hi()[i].is_finite();
        let (bounded, free): (Vec<_>, Vec<_>) = (0..self.lcp.len()).partition(bounded);
        let mut waiting: Vec<usize> = free.into_iter().chain(bounded).collect(); // free rows never leave C
        for _ in 0..POLISH_ROUNDS {
            for i in waiting {
                if let ControlFlow::Break(status) = self.drive(i) {
                    return status;
                }
            }
            waiting = self.refine();
            if waiting.is_empty() {
                return Status::Solved;
            }
        }
        if merit::scaled_residual(self.lcp, &self.x) <= self.settings.tolerance {
            Status::Solved
        } else {
            Status::Inaccurate
        }
    }

    /// Moves x_i until row i is satisfied.
    fn drive(&mut self, i: usize) -> ControlFlow<Status> {
        self.w[i] = self.lcp.row_w(i, &self.x);
        loop {
            if let Some(side) = self.satisfied(i) {
                self.put(i, side);
                return ControlFlow::Continue(());
            }
            if self.pivots >= self.settings.max_iterations {
                return ControlFlow::Break(Status::IterationLimit);
            }
            let direction = self.direction(i)?;
            if direction.schur == 0.0 && self.is_zero_w(i) {
                self.w[i] = 0.0;
                self.put(i, self.satisfied(i).unwrap_or(Side::Idle));
                return ControlFlow::Continue(());
            }
            let sign = -self.w[i].signum();
            let delta_w = self.delta_w(i, &direction);
            let Some(block) = self.blocking(i, sign, &direction, &delta_w) else {
                if self.is_level(i, &direction) {
                    self.put(i, Side::Idle);
                    return ControlFlow::Continue(());
                }
                return ControlFlow::Break(self.ray(i, sign, &direction));
            };
            self.advance(i, sign * block.length, &direction, &delta_w);
            self.exchange(i, block, direction)?;
            self.pivots += 1;
            let event = Event::Pivot { driven: i, blocking: block.row };
            let iterate = Iterate { iteration: self.pivots, x: &self.x, event };
            if self.observer.observe(&iterate).is_break() {
                return ControlFlow::Break(Status::Stopped);
            }
        }
    }

    /// The side on which row i is satisfied already, if any.
    fn satisfied(&self, i: usize) -> Option<Side> {
        let (lo, hi, x, w) = (self.lcp.lo()[i], self.lcp.hi()[i], self.x[i], self.w[i]);
        match self.side[i] {
            Side::Free | Side::Idle => Some(self.side[i]),
            _ if x == lo && (w >= 0.0 || lo == hi) => Some(Side::Lower),
            _ if x == hi && w <= 0.0 => Some(Side::Upper),
            _ => None,
        }
    }

    /// Whether w_i is nothing but rounding.
    fn is_zero_w(&self, i: usize) -> bool {
        let terms = merit::RowTerms::at(self.lcp, i, &self.x);
        terms.w.abs() <= RELATIVE_ZERO_W * terms.magnitude
    }

    /// Whether bᵀd is nothing but rounding. Where A d = 0 and w_C = 0 it is w_i, without the rounding
    /// of x.
    fn is_level(&self, i: usize, direction: &Direction) -> bool {
        let b = self.lcp.b();
        let terms = self.free.iter().zip(&direction.free).map(|(&j, d)| b[j] * d);
        let (sum, magnitude) =
            terms.fold((b[i], b[i].abs()), |(sum, magnitude), t| (sum + t, magnitude + t.abs()));
        sum.abs() <= RELATIVE_ZERO * magnitude
    }

    /// d_C = −A_CC⁻¹ A_Ci and the Schur complement s.
    fn direction(&self, i: usize) -> ControlFlow<Status, Direction> {
        let a = self.lcp.matrix();
        let column: Vec<f64> = self.free.iter().map(|&j| a.entry(i, j)).collect();
        let mut d = column.clone();
        self.factor.solve(&mut d);
        let (mut schur, mut magnitude) = (a.diagonal(i), a.diagonal(i).abs());
        for (d, a) in d.iter_mut().zip(&column) {
            *d = -*d;
            schur += a * *d;
            magnitude += (a * *d).abs();
        }
        if schur < -RELATIVE_ZERO.sqrt() * magnitude {
            let reason = "A is not positive semidefinite";
            return ControlFlow::Break(Status::OutsideClass { reason });
        }
        if schur <= RELATIVE_ZERO * magnitude {
            schur = 0.0;
            self.clean_null_direction(i, &mut d);
        }
        ControlFlow::Continue(Direction { free: d, column, schur })
    }

    /// Sets to zero what is only rounding in d where A d = 0: along such a d a move may be long, and
    /// must not end at a bound that only rounding leads to. √a_jj d_j has the same unit in all rows.
    fn clean_null_direction(&self, i: usize, d: &mut [f64]) {
        let root = |j: usize| self.lcp.matrix().diagonal(j).max(0.0).sqrt();
        let size = |j: usize, d: f64| root(j) * d.abs();
        let largest = self.free.iter().zip(&*d).map(|(&j, &d)| size(j, d)).fold(root(i), f64::max);
        for (&j, d) in self.free.iter().zip(d) {
            if size(j, *d) <= RELATIVE_ZERO_D * largest {
                *d = 0.0;
            }
        }
    }

    /// Δw for a unit move of x_i, for the rows at a bound; 0 where it is only rounding.
    fn delta_w(&self, i: usize, direction: &Direction) -> Vec<f64> {
        let mut d = vec![0.0; self.x.len()];
        d[i] = 1.0;
        for (&j, &value) in self.free.iter().zip(&direction.free) {
            d[j] = value;
        }
        let at_bound = |j: usize| matches!(self.side[j], Side::Lower | Side::Upper) && j != i;
        let delta = |j: usize| {
            let (mut sum, mut magnitude) = (0.0, 0.0);
            for (k, a) in self.lcp.matrix().row(j).iter() {
                sum += a * d[k];
                magnitude += (a * d[k]).abs();
            }
            if f64::abs(sum) <= RELATIVE_ZERO * magnitude { 0.0 } else { sum }
        };
        // where s = 0 the whole of A d vanishes
        let moves = |j: usize| direction.schur > 0.0 && at_bound(j);
        (0..d.len()).map(|j| if moves(j) { delta(j) } else { 0.0 }).collect()
    }

    /// The first thing that ends a move of x_i by sign · t, t ≥ 0; see the module for ties.
    fn blocking(&self, i: usize, sign: f64, d: &Direction, delta_w: &[f64]) -> Option<Block> {
        let mut blocks: Vec<Block> = Vec::new();
        let mut consider = |length: f64, row: usize, side: Side| {
            if length < f64::INFINITY {
                blocks.push(Block { length: length.max(0.0), row, side });
            }
        };
        if d.schur > 0.0 {
            consider(self.w[i].abs() / d.schur, i, Side::Free);
        }
        let (length, side) = self.distance_to_bound(i, sign);
        consider(length, i, side);
        for &j in &self.bound {
            let delta = sign * delta_w[j];
            let falls = self.side[j] == Side::Lower && delta < 0.0;
            let rises = self.side[j] == Side::Upper && delta > 0.0;
            if (falls || rises) && self.lcp.lo()[j] < self.lcp.hi()[j] {
                consider(-self.w[j] / delta, j, Side::Free);
            }
        }
        for (&j, d) in self.free.iter().zip(&d.free) {
            let (length, side) = self.distance_to_bound(j, sign * d);
            consider(length, j, side);
        }
        let least = blocks.iter().map(|block| block.length).fold(f64::INFINITY, f64::min);
        blocks.into_iter().find(|block| block.length <= least * (1.0 + TIE))
    }

    /// How far x_j can move at this velocity, and the bound it meets then.
    fn distance_to_bound(&self, j: usize, velocity: f64) -> (f64, Side) {
        if velocity > 0.0 {
            ((self.lcp.hi()[j] - self.x[j]) / velocity, Side::Upper)
        } else if velocity < 0.0 {
            ((self.lcp.lo()[j] - self.x[j]) / velocity, Side::Lower)
        } else {
            (f64::INFINITY, Side::Free)
        }
    }

    /// x ← x + t d, w ← w + t A d.
    fn advance(&mut self, i: usize, t: f64, direction: &Direction, delta_w: &[f64]) {
        self.x[i] += t;
        for (&j, d) in self.free.iter().zip(&direction.free) {
            self.x[j] = difference(self.x[j], -t * d);
        }
        for (w, delta) in self.w.iter_mut().zip(delta_w) {
            *w = difference(*w, -t * delta); // exactly 0 where it should be, or ties are missed
        }
        self.w[i] += t * direction.schur;
    }

    /// Puts the blocking row on its new side.
    fn exchange(&mut self, i: usize, block: Block, direction: Direction) -> ControlFlow<Status> {
        let Block { row, side, .. } = block;
        match side {
            Side::Lower => self.x[row] = self.lcp.lo()[row],
            Side::Upper => self.x[row] = self.lcp.hi()[row],
            _ => self.w[row] = 0.0,
        }
        match (self.side[row], side) {
            (Side::Free, _) => {
                let k = self.free.iter().position(|&j| j == row).expect("a free row is in C");
                self.free.remove(k);
                self.factor.remove(k);
                self.w[row] = 0.0;
                self.put(row, side);
                return self.wake_idle();
            }
            (_, Side::Free) => {
                let d = if row == i { direction } else { self.direction(row)? };
                if d.schur > 0.0 {
                    self.enter(row, d);
                } else {
                    self.put(row, Side::Idle); // only rounding had moved its w
                }
            }
            _ => self.put(row, side),
        }
        ControlFlow::Continue(())
    }

    fn enter(&mut self, row: usize, direction: Direction) {
        self.factor.append(&direction.column, direction.schur);
        self.free.push(row);
        self.put(row, Side::Free);
    }

    /// Notes that a row stands on this side from now on.
    fn put(&mut self, row: usize, side: Side) {
        self.side[row] = side;
        self.bound.retain(|&j| j != row);
        if matches!(side, Side::Lower | Side::Upper) {
            self.bound.push(row);
        }
    }

    /// After a row has left C, lets the idle row that no longer depends on C enter in its place.
    fn wake_idle(&mut self) -> ControlFlow<Status> {
        for row in 0..self.side.len() {
            if self.side[row] == Side::Idle {
                let direction = self.direction(row)?;
                if direction.schur > 0.0 {
                    self.enter(row, direction);
                    break;
                }
            }
        }
        ControlFlow::Continue(())
    }

    fn ray(&self, i: usize, sign: f64, direction: &Direction) -> Status {
        let mut ray = vec![0.0; self.x.len()];
        ray[i] = sign;
        for (&j, d) in self.free.iter().zip(&direction.free) {
            ray[j] = sign * d;
        }
        Status::Ray { row: i, direction: ray }
    }

    /// x_C ← x_C − A_CC⁻¹ w_C with w recomputed; returns the rows that are still not satisfied.
    fn refine(&mut self) -> Vec<usize> {
        for _ in 0..REFINEMENTS {
            let mut correction: Vec<f64> =
                self.free.iter().map(|&j| self.lcp.row_w(j, &self.x)).collect();
            self.factor.solve(&mut correction);
            for (&j, c) in self.free.iter().zip(&correction) {
                self.x[j] = (self.x[j] - c).max(self.lcp.lo()[j]).min(self.lcp.hi()[j]);
            }
        }
        self.w = self.lcp.w(&self.x);
        let unsatisfied: Vec<usize> = (0..self.x.len())
            .filter(|&j| {
                let terms = merit::RowTerms::at(self.lcp, j, &self.x);
                let (lo, hi) = (self.lcp.lo()[j], self.lcp.hi()[j]);
                !(terms.scaled_residual(self.x[j], lo, hi) <= self.settings.tolerance)
            })
            .collect();
        for &j in &unsatisfied {
            if self.side[j] != Side::Free {
                self.put(j, Side::Waiting); // to be driven once more
            }
        }
        unsatisfied
    }
}
