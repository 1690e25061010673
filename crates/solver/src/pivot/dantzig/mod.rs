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
//! semidefinite A d = 0: moving along d changes no w at all, and w_i is dᵀw. If that is zero the row
//! is *idle*: C keeps its w at zero, and when a row leaves C an idle one takes its place. What x may move
//! along d without harm is shared: x goes to the middle of it, so that few rows need leave C
//! (centring.rs). If dᵀw is not zero x moves until a bound stops it and that row leaves C; if nothing
//! stops it, bᵀd < 0 with A d = 0 proves that no solution exists (`Ray`).
//!
//! Whether s is zero is decided without units, and by what rounding can do. A itself is rounded, each
//! a_jk by up to ε √(a_jj a_kk), which moves s = dᵀA d by up to ε (Σ √a_jj |d_j|)²: an s below some
//! ten times that is none. direction.rs has the direction and this decision, blocking.rs what ends
//! a move and the rule for ties, exchange.rs the pivot, polish.rs the end.
//!
//! Ends with the exact active set but for rounding, after at most a few n pivots on contact
//! problems (2ⁿ in the worst case); a pivot costs O(c² + c n) for c free rows. Then x is refined with
//! accurate w, if need be with C chosen anew by the largest pivot, and rows that rounding has left
//! unsatisfied are driven once more. Masses that differ by a million leave rounding in the lighter
//! bodies' rows; sweeps take it away, and the solution names them ([`Fallback`]). Not symmetric or not
//! semidefinite A: `OutsideClass`. Coupled rows: see [`frozen`].

mod blocking;
mod centring;
mod direction;
mod exchange;
mod polish;

use std::ops::ControlFlow;

use self::blocking::Block;
use self::direction::Direction;
use super::kernel::Width;
use super::kernel::rows::Rows;
use super::ldlt::Ldlt;
use super::{
    Event, Fallback, Iterate, Move, Observer, Part, Settings, Solution, Solver, Start, Status,
    frozen,
};
use lcplab_problem::memory::Memory;
use lcplab_problem::{Lcp, merit};

/// Rounds of refinement and renewed driving at the end.
const POLISH_ROUNDS: usize = 20;
/// Above this many rows a dense factor takes too long.
const MAX_ROWS: usize = 8_000;

/// Dantzig's pivoting method with an updated L D Lᵀ factorisation.
#[derive(Debug, Clone, Default)]
pub struct Dantzig {
    /// The common settings; an iteration is a move of x, most of them pivots.
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
        if let Some(status) = self.settings.refusal(Memory::square(lcp.len())) {
            return Solution::new(lcp, x, status, 0); // two triangles: a factor, and one made anew
        }
        if !lcp.matrix().is_symmetric() {
            let reason = "A is not symmetric";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        }
        if observer.observe(&Iterate { iteration: 0, x: &x, event: Event::Start }).is_break() {
            return Solution::new(lcp, x, Status::Stopped, 0);
        }
        frozen::solve(lcp, x, &self.settings, |frozen, start, pivots| {
            frozen::tell(lcp, frozen, observer);
            let lcp = frozen;
            let mut run = Run::new(lcp, start.clone(), pivots, &self.settings, observer);
            let status = run.solve();
            if run.x.iter().any(|x| !x.is_finite()) {
                return Solution::new(lcp, start, Status::NotFinite, run.pivots);
            }
            Solution::new(lcp, run.x, status, run.pivots).with_fallback(run.fallback)
        })
    }
}

/// Where a row of Dantzig's method stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
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
    rows: Rows<'a>,
    /// √a_jj, which has the unit of √(x w) / x_j.
    root: Vec<f64>,
    settings: &'a Settings,
    observer: &'a mut dyn Observer,
    x: Vec<f64>,
    /// Kept up to date for rows at a bound and the driven row.
    w: Vec<f64>,
    side: Vec<Side>,
    /// The sign of a Δw that takes a row away from its bound: 1 at the upper one, −1 at the lower one, 0
    /// where both are the same.
    away: Vec<f64>,
    /// C, in the order of the factor's rows.
    free: Vec<usize>,
    /// The rows at a bound, in the order in which they came there.
    bound: Vec<usize>,
    factor: Ldlt,
    pivots: usize,
    fallback: Option<Fallback>,
    /// Directions that are done with: room for the next.
    spare: Vec<Direction>,
    /// Room for what may end a move.
    lengths: Vec<f64>,
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
            rows: Rows::of(lcp.matrix(), Width::widest()),
            root: (0..n).map(|j| lcp.matrix().diagonal(j).max(0.0).sqrt()).collect(),
            w: vec![0.0; n],
            side: vec![Side::Waiting; n],
            away: vec![0.0; n],
            free: Vec::with_capacity(n),
            bound: Vec::with_capacity(n),
            factor: Ldlt::default(),
            lcp,
            settings,
            observer,
            x,
            pivots,
            fallback: None,
            spare: Vec::new(),
            lengths: Vec::with_capacity(n + 2),
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
            if self.is_refined() {
                return self.claim();
            }
            waiting = self.refine();
            if waiting.is_empty() {
                return self.claim();
            }
        }
        self.settle();
        self.claim()
    }

    fn claim(&self) -> Status {
        match merit::is_solution(self.lcp, &self.x, self.settings.tolerance) {
            true => Status::Solved,
            false => Status::Inaccurate,
        }
    }

    /// Moves x_i until row i is satisfied.
    fn drive(&mut self, i: usize) -> ControlFlow<Status> {
        self.w[i] = self.lcp.row_w(i, &self.x);
        if self.pivots < self.settings.max_iterations && self.rests(i) {
            return self.moved(i, i);
        }
        let (pivots, mut served) = (self.pivots, Vec::new());
        loop {
            if let Some(side) = self.satisfied(i) {
                if self.pivots == pivots && self.observer.asks_for_parts() {
                    self.observer.part(&Part::Satisfied { row: i, w: self.w[i], side });
                }
                self.put(i, side);
                return ControlFlow::Continue(());
            }
            if self.pivots >= self.settings.max_iterations {
                return ControlFlow::Break(Status::IterationLimit);
            }
            let mut direction = self.direction(i)?;
            if direction.schur == 0.0 {
                self.w[i] = self.slope(i, &direction);
                let idle = (self.w[i] == 0.0).then_some(Side::Idle);
                if let Some(side) = self.satisfied(i).or(idle) {
                    self.put(i, side);
                    self.spare.push(direction);
                    return ControlFlow::Continue(());
                }
            }
            let sign = -self.w[i].signum();
            self.respond(i, &mut direction);
            let Some(block) = self.blocking(i, sign, &mut direction)? else {
                return ControlFlow::Break(self.endless(i, sign, &direction));
            };
            self.tell(i, sign, &direction, &block);
            self.advance(i, sign * block.length, &direction);
            let row = block.row;
            if self.gives_way(row, &mut served) {
                self.spare.push(direction);
            } else {
                self.exchange(i, block, direction)?;
            }
            self.moved(i, row)?;
        }
    }

    /// Counts a move of x, which `blocking` has ended.
    fn moved(&mut self, driven: usize, blocking: usize) -> ControlFlow<Status> {
        self.pivots += 1;
        let event = Event::Pivot { driven, blocking };
        let iterate = Iterate { iteration: self.pivots, x: &self.x, event };
        self.observer.observe(&iterate).map_break(|()| Status::Stopped)
    }

    /// Tells an observer that asks of the move that is about to be done.
    fn tell(&mut self, i: usize, sign: f64, d: &Direction, block: &Block) {
        if self.observer.asks_for_parts() {
            self.observer.part(&Part::Move(Move {
                lcp: self.lcp,
                driven: i,
                sign,
                x: &self.x,
                w: &self.w,
                side: &self.side,
                free: &self.free,
                direction: &d.free,
                schur: d.schur,
                delta_w: &d.delta_w,
                length: block.length,
                blocking: block.row,
                to: block.side,
            }));
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

    /// Notes that a row stands on this side from now on.
    fn put(&mut self, row: usize, side: Side) {
        if matches!(self.side[row], Side::Lower | Side::Upper) {
            self.bound.retain(|&j| j != row);
        }
        self.side[row] = side;
        if matches!(side, Side::Lower | Side::Upper) {
            self.bound.push(row);
            self.away[row] = match side {
                _ if self.lcp.lo()[row] == self.lcp.hi()[row] => 0.0,
                Side::Upper => 1.0,
                _ => -1.0,
            };
        }
    }

    /// Why nothing ends a move: w_i does not change, or is zero only beyond the largest number.
    fn endless(&self, i: usize, sign: f64, direction: &Direction) -> Status {
        if direction.schur > 0.0 {
            return Status::NotFinite;
        }
        let mut ray = vec![0.0; self.x.len()];
        ray[i] = sign;
        for (&j, d) in self.free.iter().zip(&direction.free) {
            ray[j] = sign * d;
        }
        Status::Ray { row: i, direction: ray }
    }
}
