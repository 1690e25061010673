//! Newton's method on the LCP written as nonsmooth equations H(x) = 0.
//!
//! With w̃_i = w_i / a_ii, the distance to the solution as seen by row i alone,
//!
//! ```text
//! minimum map          H_i = x_i − Π_i(x_i − w̃_i) = the median of x_i − lo_i, w̃_i, x_i − hi_i
//! Fischer-Burmeister   H_i = φ(x_i − lo_i, −φ(hi_i − x_i, −w̃_i)),   φ(a, b) = a + b − √(a² + b²)
//! ```
//!
//! vanish exactly at the solutions (an infinite bound drops its φ; Billups 1995 for two finite
//! ones); upper bounds need no extra variables. With a generalized Jacobian J at x, a step d solves
//! J d = −H. Whole steps are taken as long as |H| decreases. For the minimum map, up to ten whole
//! steps may also raise |H| (a *watchdog*: Chamberlain and others 1982), since a whole step ends at
//! the point of an active set and a shorter one does not. If they do not lead below the least |H|
//! so far, the step from the best point is halved until |H| decreases enough.
//!
//! For the minimum map, row i of J is that of A if row i is free (F), and a row of the identity if
//! it is at a bound: the step solves for the guessed active set, which is final once the guess is
//! right. If A is symmetric, this uses the factor of A_FF that suits A (free_rows.rs) or, if
//! redundant contacts make A_FF singular, that of A_FF + 2⁻²⁸ D_FF, D = diag(A), which leaves x
//! unchanged along a null direction:
//!
//! ```text
//! x_i + d_i = the bound of row i at a bound,   A_FF d_F = −w_F at x_F and these bounds
//! ```
//!
//! At a kink there may be no step length, down to 1/16, that reduces |H|. Then a proximal step
//! begins (proximal.rs): ρ D (x − c) is added to w with c = x, and ρ grows until some step length
//! reduces |H|. A root of these equations is the next c, and ρ decreases again. From ρ = 1 on, and
//! if A is not symmetric, d is halved further, and finally a sweep of [`Pgs`](crate::Pgs) is taken
//! instead and reported to the observer as `Sweep` instead of `Step`.
//!
//! For Fischer-Burmeister |H|² is smooth, so d is always a descent direction, and the limit solves
//! the LCP if A is a P0 matrix, which includes semidefinite ones. Here J has all rows of A, and
//! redundant contacts make it singular. The step is a least-squares solution by QR, as it is for
//! the minimum map if A is not symmetric:
//!
//! ```text
//! (JᵀJ + ν I) d = −Jᵀ H,   ν = 10⁻¹⁰ |H|² / Σ b_i²/a_ii
//! ```
//!
//! The term ν (Levenberg-Marquardt) selects the least change of x if J is singular. Since it
//! vanishes with |H|², it preserves the convergence rate (Yamashita & Fukushima 2001). Near a
//! solution both equations double the number of correct digits in each step (Qi & Sun 1993; De
//! Luca, Facchinei & Kanzow 1996).
//!
//! The sum |H|² = Σ a_ii H_i² is an energy. A step costs f³/6 products for f free rows by Cholesky,
//! fewer if A is sparse, and 5/3 n³ by QR, for any A with a positive diagonal, up to 2000 rows. The
//! bounds of coupled rows are part of H, with their derivatives; a coupled row at a moving bound
//! needs QR. If that does not converge in 20 steps, for the minimum map and a symmetric A, the
//! bounds are [`frozen`] and updated after each solve.
//! `ZeroDiagonal` and `Diverged` as for PGS. The solution reports whether proximal steps
//! were taken ([`Fallback`]).

use std::ops::ControlFlow;

use faer::Mat;
use faer::prelude::SolveLstsq;

use super::equations::{Equations, Row};
use crate::frozen;
use crate::iterate::iterate;
use crate::metric;
use crate::pivot::free_rows::FreeRows;
use crate::pivot::proximal::Rho;
use crate::tolerances::{DAMPING, LEVEL_MERIT, MIN_DAMPING, SUFFICIENT_DECREASE};
use crate::{Event, Fallback, Observer, Settings, Solution, Solver, Start, Status};
use lcplab_lcp::memory::Memory;
use lcplab_lcp::{Complementarity, Lcp};

/// Maximum number of halvings before a proximal step is tried, and before the step is given up if
/// no proximal step is possible.
const HALVINGS: [i32; 2] = [4, 12];
/// Maximum number of whole steps that need not reduce |H|².
const PATIENCE: usize = 10;
/// The steps with moving bounds before the bounds are frozen; where they converge, they need few.
const COUPLED_STEPS: usize = 20;
/// Maximum number of rows; with more, the dense problem takes too long.
const MAX_ROWS: usize = 2_000;

/// Newton's method with line search on nonsmooth equations.
#[derive(Debug, Clone, Default)]
pub struct Newton {
    /// The equations to solve.
    pub equations: Equations,
    /// The common settings; an iteration is a step.
    pub settings: Settings,
}

impl Newton {
    /// Its name in the registry, on the minimum map.
    pub const NAME: &'static str = "newton";
    /// Its name on the Fischer-Burmeister equations.
    pub const FISCHER_BURMEISTER: &'static str = "fischer-newton";
}

impl Solver for Newton {
    fn name(&self) -> &str {
        match self.equations {
            Equations::MinimumMap => Newton::NAME,
            Equations::FischerBurmeister => Newton::FISCHER_BURMEISTER,
        }
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if lcp.len() > MAX_ROWS {
            let reason = "a dense Jacobian of more than 2000 rows";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        }
        if let Some(status) = self.settings.refusal(Memory::square(lcp.len()).times(4)) {
            // Memory: the 2n × n least-squares problem and its factors.
            return Solution::new(lcp, x, status, 0);
        }
        let diagonal = match metric::diagonal(lcp) {
            Ok(diagonal) => diagonal,
            Err(status) => return Solution::outside_class(lcp, x, status, 0, &self.settings),
        };
        if lcp.is_frozen() || !self.freezes(lcp) {
            return self.steps(lcp, &diagonal, x, [0, self.settings.max_iterations], observer);
        }
        let most = self.settings.max_iterations;
        let coupled = self.steps(lcp, &diagonal, x.clone(), [0, most.min(COUPLED_STEPS)], observer);
        if !has_given_up(&coupled) || most <= COUPLED_STEPS {
            return coupled;
        }
        let frozen = frozen::solve(lcp, x, &self.settings, |frozen, x, before| {
            let first = before.max(coupled.iterations);
            self.steps(frozen, &diagonal, x, [first, most], observer)
        });
        match has_given_up(&frozen) && frozen.iterations < most {
            true => self.steps(lcp, &diagonal, frozen.x, [frozen.iterations, most], observer),
            false => frozen,
        }
    }
}

/// Whether a run ended without a solution although it was not stopped.
fn has_given_up(solution: &Solution) -> bool {
    !matches!(solution.status, Status::Solved | Status::Stopped)
}

impl Newton {
    /// Whether coupled bounds can be frozen, so that the steps need no dense least squares.
    fn freezes(&self, lcp: &Lcp) -> bool {
        self.equations == Equations::MinimumMap && lcp.matrix().is_nearly_symmetric()
    }

    /// Newton steps from x, counted from `first` to at most `max_iterations`.
    fn steps(
        &self,
        lcp: &Lcp,
        diagonal: &[f64],
        x: Vec<f64>,
        [first, max_iterations]: [usize; 2],
        observer: &mut dyn Observer,
    ) -> Solution {
        let settings = Settings { max_iterations, ..self.settings.clone() };
        let mut run = Run::of(lcp, diagonal, self.equations);
        let mut known = None;
        let solution = iterate(lcp, x, first, &settings, observer, |x| {
            loop {
                let rows = known.take().unwrap_or_else(|| run.rows(x));
                if let Some(next) = run.newton_step(x, &rows) {
                    x.copy_from_slice(&next.x);
                    let has_moved = next.is_root && run.move_center(x);
                    known = (!has_moved).then_some(next.rows);
                    return ControlFlow::Continue(Event::Step);
                }
                if !run.raise_rho(x) {
                    run.sweep(x);
                    return ControlFlow::Continue(Event::Sweep);
                }
            }
        });
        let fallback = run.proximal.map(|_| Fallback::Proximal);
        solution.with_fallback(fallback)
    }
}

struct Run<'a> {
    lcp: &'a Lcp,
    diagonal: &'a [f64],
    equations: Equations,
    is_symmetric: bool,
    /// The current proximal step, if any.
    proximal: Option<Proximal>,
    watch: Option<Watch>,
    /// The equations that were solved last, for A itself and with a ρ.
    posed: Option<RegularizedSystem>,
    softened: Option<RegularizedSystem>,
}

/// ρ D (x − c) is added to w.
struct Proximal {
    rho: Rho,
    center: Vec<f64>,
}

/// A + ρ D and its equations.
struct RegularizedSystem {
    rho: f64,
    problem: Lcp,
    equations: FreeRows,
}

/// The point with the least |H|² so far, and how many more whole steps may be taken before |H|²
/// falls below it: steps with the same |H|², as when a stack closes contact after contact, and
/// steps with a larger one.
struct Watch {
    x: Vec<f64>,
    rows: Vec<Row>,
    square: f64,
    level: usize,
    higher: usize,
}

impl Watch {
    /// Whether a step to this |H|² is allowed; counts it.
    fn allows(&mut self, square: f64) -> bool {
        let is_level = square <= (1.0 + LEVEL_MERIT) * self.square;
        let left = if is_level { &mut self.level } else { &mut self.higher };
        let allows = *left > 0 && square.is_finite();
        *left = left.saturating_sub(1);
        allows
    }
}

/// The result of a step.
struct Next {
    x: Vec<f64>,
    rows: Vec<Row>,
    /// |H|².
    square: f64,
    /// Whether H = 0 there up to rounding: the whole step was taken, and all rows are in the
    /// guessed set.
    is_root: bool,
}

impl<'a> Run<'a> {
    fn of(lcp: &'a Lcp, diagonal: &'a [f64], equations: Equations) -> Self {
        let is_symmetric = lcp.matrix().is_nearly_symmetric();
        Run {
            lcp,
            diagonal,
            equations,
            is_symmetric,
            proximal: None,
            watch: None,
            posed: None,
            softened: None,
        }
    }

    /// c ← x, and ρ decreases; returns whether a proximal step is active.
    fn move_center(&mut self, x: &[f64]) -> bool {
        let Some(own) = &mut self.proximal else { return false };
        own.center.copy_from_slice(x);
        own.rho.fall(true);
        self.watch = None;
        true
    }

    /// Whether a proximal step, or a larger ρ, can help.
    fn can_raise_rho(&self) -> bool {
        let is_safe = self.proximal.as_ref().is_some_and(|own| own.rho.is_safe());
        self.is_symmetric && self.equations == Equations::MinimumMap && !is_safe
    }

    /// Begins a proximal step at x with a larger ρ than the last one; false if that can no longer
    /// help.
    fn raise_rho(&mut self, x: &[f64]) -> bool {
        if !self.can_raise_rho() {
            return false;
        }
        // The equations have changed.
        self.watch = None;
        match &mut self.proximal {
            None => self.proximal = Some(Proximal { rho: Rho::least(), center: x.to_vec() }),
            Some(own) => {
                own.center.copy_from_slice(x);
                own.rho.rise();
            }
        }
        true
    }

    /// A sweep of projected Gauss-Seidel.
    fn sweep(&self, x: &mut [f64]) {
        for i in 0..x.len() {
            x[i] = self.lcp.project(i, x[i] - self.w(i, x) / self.diagonal[i], x);
        }
    }

    /// w_i, including the proximal term.
    fn w(&self, i: usize, x: &[f64]) -> f64 {
        let added =
            self.proximal.as_ref().map_or(0.0, |own| own.rho.value() * (x[i] - own.center[i]));
        self.lcp.row_w(i, x) + self.diagonal[i] * added
    }

    /// The whole step while the watchdog allows it; otherwise x returns to the watched point and
    /// moves to x + λ d with the first λ = ½, ¼, … that reduces |H|² enough, if any.
    fn newton_step(&mut self, x: &mut [f64], rows: &[Row]) -> Option<Next> {
        let square = self.square(rows);
        let mut watch = match self.watch.take() {
            Some(watch) if square > (1.0 - SUFFICIENT_DECREASE) * watch.square => watch,
            _ => self.watch_from(x, rows, square),
        };
        let direction = self.direction(x, rows, square);
        if let Some(d) = &direction {
            let whole = self.along(x, rows, d, 1.0);
            let is_enough = whole.square <= (1.0 - SUFFICIENT_DECREASE) * watch.square;
            if is_enough || watch.allows(whole.square) {
                self.watch = Some(watch);
                return Some(whole);
            }
        }
        let is_here = *x == watch.x;
        x.copy_from_slice(&watch.x);
        let Watch { rows, square, .. } = watch;
        let d = if is_here { direction } else { self.direction(x, &rows, square) }?;
        let shorter = |k: i32| {
            let lambda = 0.5f64.powi(k);
            let next = self.along(x, &rows, &d, lambda);
            (next.square <= (1.0 - SUFFICIENT_DECREASE * lambda) * square).then_some(next)
        };
        let most = if self.can_raise_rho() { HALVINGS[0] } else { HALVINGS[1] };
        let next = (1..=most).find_map(shorter)?;
        self.watch = Some(self.watch_from(&next.x, &next.rows, next.square));
        Some(next)
    }

    /// The watchdog for whole steps from this point.
    fn watch_from(&self, x: &[f64], rows: &[Row], square: f64) -> Watch {
        let is_minimum_map = self.equations == Equations::MinimumMap;
        let (level, higher) = if is_minimum_map { (x.len(), PATIENCE) } else { (0, 0) };
        Watch { x: x.to_vec(), rows: rows.to_vec(), square, level, higher }
    }

    fn along(&self, x: &[f64], rows: &[Row], d: &[f64], lambda: f64) -> Next {
        let next: Vec<f64> = x.iter().zip(d).map(|(x, d)| x + lambda * d).collect();
        let after = self.rows(&next);
        let is_same = || after.iter().zip(rows).all(|(after, row)| after.by_w == row.by_w);
        let is_root = lambda == 1.0 && is_same();
        Next { square: self.square(&after), x: next, rows: after, is_root }
    }

    /// A solution d of J d = −H.
    fn direction(&mut self, x: &[f64], rows: &[Row], square: f64) -> Option<Vec<f64>> {
        let by_active_set = self.active_set_direction(x, rows);
        by_active_set.or_else(|| self.least_squares_direction(x, rows, square))
    }

    fn rows(&self, x: &[f64]) -> Vec<Row> {
        let row = |i: usize| {
            let (lo, hi) = self.lcp.bounds(i, x);
            self.equations.row(x[i], self.w(i, x) / self.diagonal[i], lo, hi)
        };
        (0..x.len()).map(row).collect()
    }

    /// Σ a_ii H_i².
    fn square(&self, rows: &[Row]) -> f64 {
        rows.iter().enumerate().map(|(i, row)| self.diagonal[i] * row.value.powi(2)).sum()
    }

    /// The solution of J d = −H for the minimum map, if A is symmetric and semidefinite and the
    /// bounds do not move.
    fn active_set_direction(&mut self, x: &[f64], rows: &[Row]) -> Option<Vec<f64>> {
        let is_free = |i: &usize| rows[*i].by_w != 0.0;
        let moves = |i: usize| self.bound_slope(i, x).is_some_and(|(_, slope)| slope != 0.0);
        let (free, bound): (Vec<usize>, Vec<usize>) = (0..x.len()).partition(is_free);
        let is_minimum_map = self.equations == Equations::MinimumMap;
        if !is_minimum_map || !self.is_symmetric || bound.iter().any(|&i| moves(i)) {
            return None;
        }
        let mut d = vec![0.0; x.len()];
        bound.iter().for_each(|&i| d[i] = -rows[i].value);
        let moved: Vec<f64> = x.iter().zip(&d).map(|(x, d)| x + d).collect();
        let rhs: Vec<f64> = free.iter().map(|&i| -self.w(i, &moved)).collect();
        let rho = self.proximal.as_ref().map_or(0.0, |own| own.rho.value());
        let solved = self.solved(&free, rho, &rhs);
        let solved = solved.or_else(|| self.solved(&free, rho + Rho::least().value(), &rhs))?;
        free.iter().zip(solved).for_each(|(&i, z)| d[i] = z);
        d.iter().all(|d| d.is_finite()).then_some(d)
    }

    /// The solution z of (A_FF + ρ D_FF) z = rhs, if the matrix is not singular.
    fn solved(&mut self, free: &[usize], rho: f64, rhs: &[f64]) -> Option<Vec<f64>> {
        let kept = if rho == 0.0 { &mut self.posed } else { &mut self.softened };
        if kept.as_ref().is_none_or(|kept| kept.rho != rho) {
            let problem =
                if rho == 0.0 { self.lcp.clone() } else { self.lcp.softened(rho).ok()? };
            *kept = Some(RegularizedSystem { rho, equations: FreeRows::of(&problem), problem });
        }
        let RegularizedSystem { problem, equations, .. } = kept.as_mut()?;
        let mut z = rhs.to_vec();
        equations.solve(problem, free, &mut z).ok()?;
        Some(z)
    }

    /// The least-squares solution of J d = −H, √ν d = 0, in the variables √a_ii x_i.
    fn least_squares_direction(&self, x: &[f64], rows: &[Row], square: f64) -> Option<Vec<f64>> {
        let n = x.len();
        let root: Vec<f64> = (0..n).map(|i| self.diagonal[i].sqrt()).collect();
        let start: f64 = (0..n).map(|i| (self.lcp.b()[i] / root[i]).powi(2)).sum();
        let reduction = if start > 0.0 { (square / start).min(1.0) } else { 1.0 };
        // √ν
        let damping = (DAMPING * reduction).max(MIN_DAMPING).sqrt();
        let mut j = Mat::<f64>::zeros(2 * n, n);
        let mut rhs = Mat::<f64>::zeros(2 * n, 1);
        for (i, row) in rows.iter().enumerate() {
            rhs[(i, 0)] = -root[i] * row.value;
            j[(n + i, i)] = damping;
            if row.by_w != 0.0 {
                for (k, a) in self.lcp.matrix().row(i).iter() {
                    j[(i, k)] += row.by_w * a / root[i] / root[k];
                }
            }
            j[(i, i)] += row.by_x;
            if let Some((k, slope)) = self.bound_slope(i, x) {
                j[(i, k)] += slope * (row.by_hi - row.by_lo) * root[i] / root[k];
            }
        }
        let solution = j.qr().solve_lstsq(&rhs);
        let d: Vec<f64> = (0..n).map(|i| solution[(i, 0)] / root[i]).collect();
        d.iter().all(|d| d.is_finite()).then_some(d)
    }

    /// For a coupled row: the row k that bounds it, and the derivative of hi_i = −lo_i with respect
    /// to x_k.
    fn bound_slope(&self, i: usize, x: &[f64]) -> Option<(usize, f64)> {
        let coupling = self.lcp.coupling()?;
        let k = coupling.index(i)?;
        Some((k, if x[k] > 0.0 { coupling.mu(i) } else { 0.0 }))
    }
}
