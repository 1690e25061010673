//! The main loop: rows are driven one after another, each until it is satisfied.

use std::cell::OnceCell;
use std::ops::ControlFlow;

use super::Side;
use super::blocking::Block;
use super::direction::Direction;
use crate::kernel::Width;
use crate::kernel::rows::Rows;
use crate::linalg::ldlt::Ldlt;
use crate::pivot::principal::Point;
use crate::{Event, Fallback, Iterate, Move, Observer, Settings, Status, StepDetail};
use lcplab_lcp::Lcp;
use lcplab_lcp::merit::RowTerms;

/// Maximum number of rounds of refinement and renewed driving at the end.
const POLISH_ROUNDS: usize = 20;

/// A run of the method on one problem.
pub(super) struct Run<'a> {
    pub(super) lcp: &'a Lcp,
    /// The rows of A, created on first use.
    rows: OnceCell<Rows>,
    pub(super) width: Width,
    /// √a_jj, which has the unit of √(x w) / x_j.
    pub(super) root: Vec<f64>,
    pub(super) settings: &'a Settings,
    pub(super) observer: &'a mut dyn Observer,
    pub(super) state: State,
    pub(super) basis: Basis,
    /// All rows from this one on are unprocessed.
    pub(super) end: usize,
    pub(super) scratch: Scratch,
    pub(super) pivots: usize,
    pub(super) fallback: Option<Fallback>,
}

/// x, and the side of each row.
pub(super) struct State {
    pub(super) x: Vec<f64>,
    /// Valid for rows at a bound and the driven row.
    pub(super) w: Vec<f64>,
    pub(super) side: Vec<Side>,
    /// For rows at a bound the direction in which w may always move, 1 or −1; 0 for rows that no w
    /// makes leave their side.
    pub(super) away: Vec<f64>,
}

/// The free rows and those at a bound, with the factor of the free ones.
pub(super) struct Basis {
    /// C, in the order of the factor's rows.
    pub(super) free: Vec<usize>,
    /// The rows at a bound, in the order in which they reached it.
    pub(super) bound: Vec<usize>,
    /// A_CC = L D Lᵀ.
    pub(super) factor: Ldlt,
}

/// Reusable vectors.
#[derive(Default)]
pub(super) struct Scratch {
    /// Directions that are no longer needed; boxed, because moving them would take a tenth of the
    /// time of small problems.
    #[expect(clippy::vec_box, reason = "they are taken out and put back")]
    pub(super) directions: Vec<Box<Direction>>,
    /// For each row the length of a move after which its x reaches a bound or its w is zero.
    pub(super) lengths: Vec<f64>,
}

impl<'a> Run<'a> {
    /// A run from x, after this number of earlier pivots.
    pub(super) fn new(
        lcp: &'a Lcp,
        x: Vec<f64>,
        pivots: usize,
        settings: &'a Settings,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let n = lcp.len();
        Run {
            rows: OnceCell::new(),
            width: Width::widest(),
            root: (0..n).map(|j| lcp.matrix().diagonal(j).max(0.0).sqrt()).collect(),
            lcp,
            settings,
            observer,
            state: State {
                x,
                w: vec![0.0; n],
                side: vec![Side::Unprocessed; n],
                away: vec![0.0; n],
            },
            basis: Basis {
                free: Vec::with_capacity(n),
                bound: Vec::with_capacity(n),
                factor: Ldlt::default(),
            },
            end: 0,
            scratch: Scratch { lengths: vec![0.0; n], ..Scratch::default() },
            pivots,
            fallback: None,
        }
    }

    pub(super) fn rows(&self) -> &Rows {
        self.rows.get_or_init(|| Rows::of(self.lcp.matrix(), self.width))
    }

    /// Drives all rows, free ones first since they never leave C, and refines x until it is a
    /// solution. Returns the last point, or the status if there is no solution.
    pub(super) fn solve(&mut self) -> Result<Point, Status> {
        let is_free = |&i: &usize| self.lcp.lo()[i].is_infinite() && self.lcp.hi()[i].is_infinite();
        let mut waiting = Vec::with_capacity(self.lcp.len());
        waiting.extend((0..self.lcp.len()).filter(is_free));
        waiting.extend((0..self.lcp.len()).filter(|i| !is_free(i)));
        for _ in 0..POLISH_ROUNDS {
            for i in waiting {
                if let ControlFlow::Break(status) = self.drive(i) {
                    return Err(status);
                }
            }
            if let Some(point) = self.refine_once() {
                return Ok(point);
            }
            waiting = self.refine();
            if waiting.is_empty() {
                return Ok(self.point());
            }
        }
        self.gauss_seidel_cleanup();
        Ok(self.point())
    }

    pub(super) fn point(&self) -> Point {
        Point::at(self.lcp, self.state.x.clone())
    }

    /// Moves x_i until row i is satisfied.
    fn drive(&mut self, i: usize) -> ControlFlow<Status> {
        self.state.w[i] = self.lcp.row_w(i, &self.state.x);
        self.end = self.end.max(i + 1);
        if self.pivots < self.settings.max_iterations && self.is_made_dependent(i) {
            return self.moved(i, i);
        }
        let (pivots, mut served) = (self.pivots, Vec::new());
        loop {
            if let Some(side) = self.satisfied(i) {
                self.report_satisfied(i, side, pivots);
                self.put(i, side);
                return ControlFlow::Continue(());
            }
            if self.pivots >= self.settings.max_iterations {
                return ControlFlow::Break(Status::IterationLimit);
            }
            let mut direction = self.direction(i)?;
            if direction.schur == 0.0 {
                self.state.w[i] = self.slope(i, &direction);
                let dependent = (self.state.w[i] == 0.0).then_some(Side::Dependent);
                if let Some(side) = self.satisfied(i).or(dependent) {
                    self.put(i, side);
                    self.scratch.directions.push(direction);
                    return ControlFlow::Continue(());
                }
            }
            let sign = -self.state.w[i].signum();
            self.respond(i, &mut direction);
            let Some(block) = self.blocking(i, sign, &mut direction)? else {
                if direction.schur > 0.0 {
                    // w_i = 0 would need an x that overflows.
                    return ControlFlow::Break(Status::NotFinite);
                }
                if self.residual_for_good(i) > self.settings.tolerance {
                    let ray = self.ray(i, sign, &direction);
                    return ControlFlow::Break(ray);
                }
                self.put(i, Side::Dependent);
                self.scratch.directions.push(direction);
                return ControlFlow::Continue(());
            };
            self.report(i, sign, &direction, &block);
            self.advance(i, sign * block.length, &direction);
            let row = block.row;
            self.center_or_leave(i, block, direction, &mut served)?;
            self.moved(i, row)?;
        }
    }

    /// Counts a move of x that `blocking` has ended.
    #[inline]
    pub(super) fn moved(&mut self, driven: usize, blocking: usize) -> ControlFlow<Status> {
        self.pivots += 1;
        let event = Event::Pivot { driven, blocking };
        let iterate = Iterate { iteration: self.pivots, x: &self.state.x, event };
        self.observer.observe(&iterate).map_break(|()| Status::Stopped)
    }

    /// Reports to an observer of step details that row i is satisfied without a move, if no pivot
    /// was made since `pivots`.
    #[inline]
    pub(super) fn report_satisfied(&mut self, i: usize, side: Side, pivots: usize) {
        if self.pivots == pivots && self.observer.wants_details() {
            self.observer.part(&StepDetail::Satisfied { row: i, w: self.state.w[i], side });
        }
    }

    /// Reports the next move to an observer of step details.
    fn report(&mut self, i: usize, sign: f64, d: &Direction, block: &Block) {
        if self.observer.wants_details() {
            self.observer.part(&StepDetail::Move(Move {
                lcp: self.lcp,
                driven: i,
                sign,
                x: &self.state.x,
                w: &self.state.w,
                side: &self.state.side,
                free: &self.basis.free,
                direction: &d.free[..self.basis.free.len()],
                schur: d.schur,
                delta_w: &self.of_bound(&d.delta_w),
                length: block.length,
                blocking: block.row,
                to: block.side,
            }));
        }
    }

    /// These entries of the rows at a bound; 0 for all others.
    fn of_bound(&self, values: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.state.x.len()];
        self.basis.bound.iter().for_each(|&j| all[j] = values[j]);
        all
    }

    /// The side on which row i is already satisfied, if any.
    #[inline]
    pub(super) fn satisfied(&self, i: usize) -> Option<Side> {
        let (lo, hi, x, w) = (self.lcp.lo()[i], self.lcp.hi()[i], self.state.x[i], self.state.w[i]);
        match self.state.side[i] {
            Side::Free | Side::Dependent => Some(self.state.side[i]),
            _ if x == lo && (w >= 0.0 || lo == hi) => Some(Side::Lower),
            _ if x == hi && w <= 0.0 => Some(Side::Upper),
            _ => None,
        }
    }

    /// The scaled residual of row i from a w_i that no motion of x can change.
    ///
    /// Rows of redundant joints agree only up to the rounding of their data, an error of position
    /// of 1e-16 m fed back by β/dt, and up to the drift of one joint relative to the other. Then
    /// w_i is not zero, and nothing can make it zero.
    pub(super) fn residual_for_good(&self, i: usize) -> f64 {
        let x = &self.state.x;
        let terms = RowTerms::at(self.lcp, i, x);
        let w = libm::ldexp(self.state.w[i], -terms.exponent);
        RowTerms { w, ..terms }.scaled_residual(self.lcp, i, x)
    }

    /// Moves a row to this side.
    pub(super) fn put(&mut self, row: usize, side: Side) {
        if matches!(self.state.side[row], Side::Lower | Side::Upper) {
            self.basis.bound.retain(|&j| j != row);
        }
        self.state.side[row] = side;
        if matches!(side, Side::Lower | Side::Upper) {
            self.basis.bound.push(row);
        }
        self.state.away[row] = match side {
            Side::Lower if self.may_leave(row) => 1.0,
            Side::Upper if self.may_leave(row) => -1.0,
            _ => 0.0,
        };
    }

    /// Whether row j is at one of two bounds and may leave it.
    pub(super) fn may_leave(&self, j: usize) -> bool {
        let is_at_bound = matches!(self.state.side[j], Side::Lower | Side::Upper);
        is_at_bound && self.lcp.lo()[j] < self.lcp.hi()[j]
    }

    /// The ray from x along which w_i does not change: x_i by `sign`, x of the free rows by d.
    fn ray(&self, i: usize, sign: f64, d: &Direction) -> Status {
        let mut ray = vec![0.0; self.state.x.len()];
        ray[i] = sign;
        for &j in &self.basis.free {
            ray[j] = sign * d.d[j];
        }
        Status::Ray { row: i, direction: ray }
    }
}
