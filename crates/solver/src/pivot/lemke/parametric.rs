//! Follows Lemke's path by principal pivots, for symmetric A.
//!
//! While z₀ decreases, x solves the boxed problem with b + z₀ e instead of b. Between two pivots it
//! moves along a line, as if z₀ were another x: with the border e, the
//! [tableau](crate::kernel::tableau) of the free rows contains its speeds,
//!
//! ```text
//! ( A   e )
//! ( eᵀ  0 )      dx_C/dz₀ = −S_zC,   dw_B/dz₀ = S_zB
//! ```
//!
//! When w_r reaches zero, row r enters C, and when x_r reaches its bound, it leaves C; then z₀
//! decreases further. One pivot at s_rr makes w_r nonbasic and x_r basic, and the table stays
//! symmetric. This needs half the products of Lemke's own pivots and keeps digits that those lose.
//! It requires an s_rr well above rounding; otherwise the path is followed by Lemke's tableau from
//! the start, which gives the same path.
//!
//! See Van de Panne & Whinston 1969 and Cottle 1972. For definite A each z₀ has one x, so z₀ only
//! decreases.

use std::ops::ControlFlow;

use super::end::from_active_set;
use crate::kernel::rank_one::{Block, get};
use crate::kernel::tableau::Tableau;
use crate::pivot::active_set::{self, ActiveSet};
use crate::pivot::basic::Basic;
use crate::pivot::dantzig::Side;
use crate::pivot::principal::Point;
use crate::pivot::ratio_test::keep_least;
use crate::pivot::refinement::refined;
use crate::tolerances::{CONTRADICTION, LENGTH_TIE, MIN_PIVOT, REDUNDANT_PIVOT};
use crate::{Event, Iterate, Observer, Settings, Status};
use lcplab_lcp::Lcp;

/// A path in progress.
pub(super) struct Parametric<'a> {
    lcp: &'a Lcp,
    /// e, with the sign that moves w away from the wrong side of zero; 0 for a row without bounds.
    cover: Vec<f64>,
    z: f64,
    /// The largest |e_i| / √a_ii: the weight of z₀ relative to √a_jj x_j.
    unit: f64,
    tableau: Tableau,
    basic: Basic,
    side: Vec<Side>,
    /// C.
    free: Vec<usize>,
    x: Vec<f64>,
    /// √a_jj.
    root: Vec<f64>,
    /// Row z of the tableau, and another row.
    speeds: Vec<Block>,
    other: Vec<Block>,
    /// The number of rows that have left C since the tableau was computed.
    left: usize,
    pub(super) pivots: usize,
}

/// The end of a path that does not need the tableau.
pub(super) enum End {
    /// z₀ = 0.
    Point(Point),
    /// At the last x.
    Status(Status, Vec<f64>),
}

impl<'a> Parametric<'a> {
    /// The start of the path, after `pivots` pivots on other paths.
    pub(super) fn new(lcp: &'a Lcp, cover: Vec<f64>, pivots: usize) -> Self {
        let n = lcp.len();
        let start = |i: usize| match (lcp.lo()[i], lcp.hi()[i]) {
            (lo, _) if lo.is_finite() => (Side::Lower, lo),
            (_, hi) if hi.is_finite() => (Side::Upper, hi),
            _ => (Side::Unprocessed, 0.0),
        };
        let (side, x) = (0..n).map(start).unzip();
        let root: Vec<f64> = (0..n).map(|i| lcp.matrix().diagonal(i).max(0.0).sqrt()).collect();
        let lifts = cover.iter().zip(&root).filter(|(e, _)| **e != 0.0);
        let unit = lifts.map(|(e, root)| e.abs() / root).fold(0.0, f64::max);
        let tableau = Tableau::bordered(lcp.matrix(), cover.clone());
        let mut speeds = tableau.room();
        tableau.read(n, &mut speeds);
        Parametric {
            lcp,
            cover,
            z: 0.0,
            unit,
            basic: Basic::of(n + 1),
            side,
            free: Vec::with_capacity(n),
            x,
            root,
            speeds,
            other: tableau.room(),
            tableau,
            left: 0,
            pivots,
        }
    }

    /// Follows the path to its end; `None` if a pivot is unreliable.
    pub(super) fn solve(
        &mut self,
        settings: &Settings,
        observer: &mut dyn Observer,
    ) -> Option<End> {
        self.solve_free_rows()?;
        let end = match self.enter_cover() {
            None => ControlFlow::Continue(()),
            Some(row) => self.follow(row, settings, observer)?,
        };
        match end {
            ControlFlow::Break(status) => Some(End::Status(status, self.x.clone())),
            ControlFlow::Continue(()) => {
                let (lcp, x) = (self.lcp, self.x.clone());
                let is_dependent = |i: usize| self.side[i] == Side::Dependent;
                let exact =
                    refined(lcp, &self.tableau, &self.free, x, settings.tolerance, is_dependent);
                let point =
                    exact.unwrap_or_else(|last| from_active_set(lcp, &self.active_set(), &last.x));
                if point.is_solution(self.lcp, settings.tolerance) {
                    return Some(End::Point(point));
                }
                let is_nearly = point.largest_residual() <= CONTRADICTION
                    && self.side.contains(&Side::Dependent);
                is_nearly.then_some(End::Status(Status::Inaccurate, point.x))
            }
        }
    }

    /// Solves w = 0 for the x of the rows without bounds. A row that depends on earlier ones, as in
    /// redundant joints, stays out of C: its w is a combination of theirs, whatever x is, and no
    /// row that it depends on ever leaves C. Whether that w is zero is tested at the end.
    fn solve_free_rows(&mut self) -> Option<()> {
        for row in 0..self.lcp.len() {
            if self.side[row] != Side::Unprocessed {
                continue;
            }
            self.tableau.read(row, &mut self.other);
            let size = self.root[row] + self.basic.size(&self.other);
            match get(&self.other, row).abs() <= REDUNDANT_PIVOT * size * size {
                true => self.side[row] = Side::Dependent,
                false => self.enter(row)?,
            }
        }
        if self.free.is_empty() {
            return Some(());
        }
        let w = self.lcp.w(&self.x);
        for &j in &self.free {
            self.tableau.read(j, &mut self.other);
            self.x[j] = self.free.iter().map(|&k| get(&self.other, k) * w[k]).sum();
        }
        Some(())
    }

    /// Increases z₀ until no w is on the wrong side of zero; returns the row where w is zero, or
    /// `None` if z₀ = 0.
    fn enter_cover(&mut self) -> Option<usize> {
        let w = self.lcp.w(&self.x);
        let asked = |i: usize| if self.cover[i] == 0.0 { 0.0 } else { -w[i] / self.cover[i] };
        self.z = (0..w.len()).map(asked).fold(0.0, f64::max);
        let last = (0..w.len()).rev().find(|&i| asked(i) >= self.z * (1.0 - LENGTH_TIE));
        for i in 0..w.len() {
            let value = match self.side[i] {
                Side::Free => self.x[i],
                _ if last == Some(i) => 0.0,
                _ => w[i] + self.z * self.cover[i],
            };
            self.put(i, self.side[i], value);
        }
        last.filter(|_| self.z > 0.0)
    }

    /// Pivots until z₀ = 0; `None` if a pivot is unreliable.
    fn follow(
        &mut self,
        first: usize,
        settings: &Settings,
        observer: &mut dyn Observer,
    ) -> Option<ControlFlow<Status>> {
        let (mut row, mut side, mut idle) = (first, Side::Free, 0);
        let mut event = Event::Pivot { driven: row, blocking: row };
        loop {
            if self.pivots >= settings.max_iterations {
                return Some(ControlFlow::Break(Status::IterationLimit));
            }
            self.pivots += 1;
            let iterate = Iterate { iteration: self.pivots, x: &self.x, event };
            if observer.observe(&iterate).is_break() {
                return Some(ControlFlow::Break(Status::Stopped));
            }
            if self.z == 0.0 {
                return Some(ControlFlow::Continue(()));
            }
            match side {
                Side::Free => self.enter(row)?,
                side => self.leave(row, side),
            }
            let (length, next) = self.blocking()?;
            self.advance(length);
            idle = if length > 0.0 { 0 } else { idle + 1 };
            if idle > self.x.len() {
                // Rounding may cause a cycle.
                return None;
            }
            if next.is_none() {
                self.z = 0.0;
            }
            let driven = row;
            (row, side) = next.unwrap_or((row, side));
            match side {
                Side::Lower => self.x[row] = self.lcp.lo()[row],
                Side::Upper => self.x[row] = self.lcp.hi()[row],
                _ => {}
            }
            event = Event::Pivot { driven, blocking: row };
        }
    }

    /// How far z₀ can decrease, and the row that then reaches its bound, with its side; no row if
    /// z₀ = 0 comes first. `None` if this cannot be decided reliably.
    fn blocking(&mut self) -> Option<(f64, Option<(usize, Side)>)> {
        let size = self.unit + self.basic.size(&self.speeds);
        let others = self.basic.reach(&self.speeds, -1.0, size, self.z);
        if self.z <= others * (1.0 + LENGTH_TIE) {
            return Some((self.z, None));
        }
        let mut tied = self.basic.all_within(others * (1.0 + LENGTH_TIE));
        let (first, is_only) = (tied.next()?, tied.next().is_none());
        let row = if is_only { first } else { self.least(others * (1.0 + LENGTH_TIE))? };
        if !others.is_finite() || !self.basic.speed(row).is_finite() {
            // Numbers have overflowed.
            return None;
        }
        let side = match self.side[row] {
            Side::Free if self.basic.speed(row) > 0.0 => Side::Upper,
            Side::Free => Side::Lower,
            _ => Side::Free,
        };
        Some((others, Some((row, side))))
    }

    /// Of the rows that reach their bounds within this length, the first one if the initial w are
    /// perturbed by (ε, ε², …).
    fn least(&self, length: f64) -> Option<usize> {
        let tied: Vec<usize> = self.basic.all_within(length).collect();
        if tied.iter().any(|&row| row >= self.lcp.len()) {
            // Numbers have overflowed.
            return None;
        }
        let rows: Vec<Vec<Block>> = tied
            .iter()
            .map(|&row| {
                let mut own = self.tableau.room();
                self.tableau.read(row, &mut own);
                own
            })
            .collect();
        let mut left: Vec<usize> = (0..tied.len()).collect();
        for v in (0..self.lcp.len()).filter(|&v| self.cover[v] != 0.0) {
            if left.len() == 1 {
                break;
            }
            let lift = self.cover[v].signum();
            keep_least(&mut left, |&k| {
                let (row, entry) = (tied[k], get(&rows[k], v));
                let change = match (self.side[v], self.side[row]) {
                    (Side::Free, Side::Free) => lift * entry,
                    (Side::Free, _) => -lift * entry,
                    _ if v == row => lift,
                    _ => 0.0,
                };
                -change / self.basic.speed(row)
            });
        }
        left.first().map(|&k| tied[k])
    }

    /// Decreases z₀ by this length.
    fn advance(&mut self, length: f64) {
        self.z -= length;
        self.basic.advance(length);
        for &j in &self.free {
            self.x[j] = self.basic.value(j);
        }
    }

    /// Row `row` enters C; `None` if its s is unreliable.
    fn enter(&mut self, row: usize) -> Option<()> {
        self.tableau.read(row, &mut self.other);
        let size = self.root[row] + self.basic.size(&self.other);
        if !(get(&self.other, row) > MIN_PIVOT * size * size) {
            return None;
        }
        self.free.push(row);
        self.pivot(row, 1.0);
        self.put(row, Side::Free, self.x[row]);
        Some(())
    }

    /// Row `row` leaves C for this side.
    fn leave(&mut self, row: usize, side: Side) {
        self.tableau.read(row, &mut self.other);
        self.free.retain(|&j| j != row);
        self.pivot(row, -1.0);
        self.put(row, side, 0.0);
        self.left += 1;
        if self.left > self.lcp.len() / 2 {
            self.renew();
        }
    }

    /// The row in `other` enters C (sign = 1) or leaves it (sign = −1).
    fn pivot(&mut self, row: usize, sign: f64) {
        let followed = Some((self.lcp.len(), &mut self.speeds));
        self.tableau.pivot(row, &self.other, sign, followed);
    }

    /// Recomputes the tableau of C.
    fn renew(&mut self) {
        self.left = 0;
        self.tableau.reset(self.lcp.matrix());
        for &row in &self.free {
            self.tableau.read(row, &mut self.other);
            self.tableau.pivot(row, &self.other, 1.0, None);
        }
        self.tableau.read(self.lcp.len(), &mut self.speeds);
    }

    /// Sets a row to this side, with this value of x or w, whichever may move.
    fn put(&mut self, row: usize, side: Side, value: f64) {
        self.side[row] = side;
        let bounds = (self.lcp.lo()[row], self.lcp.hi()[row]);
        self.basic.put(row, side, value, bounds, self.root[row]);
    }

    fn active_set(&self) -> ActiveSet {
        let side = |side: &Side| match side {
            Side::Lower => active_set::Side::Lower,
            Side::Upper => active_set::Side::Upper,
            _ => active_set::Side::Free,
        };
        ActiveSet(self.side.iter().map(side).collect())
    }
}
