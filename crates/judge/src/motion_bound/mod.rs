//! Bounds the error of the motion, for problems whose x is not unique.
//!
//! If contacts are redundant, A is singular, and no residual bounds the distance to "the" solution
//! x. The motion u = u* + M⁻¹Jᵀx is still unique, because it solves a strictly convex program,
//! Gauss's principle; the LCP's program is its dual:
//!
//! ```text
//! P(u, s) = ½ |u − u*|²_M + ½ Σ γ_i s_i² + Σ σ_i(−(J u + bias + γ s)_i)      over all u, s
//! D(x)    = ½ xᵀA x + bᵀx                                                     over lo ≤ x ≤ hi
//! min P = P(û, ŝ) = −D(x̂) = −min D          |v|²_M = vᵀM v,   û = u(x̂),   u(x) = u* + M⁻¹Jᵀx
//! ```
//!
//! P grows from its minimum by at least ½ |u − û|²_M. D grows by at least ½ (x − x̂)ᵀA (x − x̂),
//! which is at least ½ |u(x) − û|²_M. So for any u, s where P is finite, and any x within its
//! bounds,
//!
//! ```text
//! |u − û|²_M + |u(x) − û|²_M ≤ 2 (P(u, s) + D(x))
//! ```
//!
//! however u and x were found. Computing the sum directly would subtract two nearly equal numbers.
//! Inserting u(x) gives a form in which every term is at least 0:
//!
//! ```text
//! P(u, s) + D(x) = ½ |u − u(x)|²_M + Σ g_i(w_i),     w = J u + bias + γ x
//! g_i(w) = (x_i − lo_i) w for w > 0,  (hi_i − x_i) |w| for w < 0;   at most w² / 2γ_i  for the best s_i
//! ```
//!
//! **An x outside its bounds.** The program applies to Πx only, and u(x) − u(Πx) is linear in the
//! part outside:
//!
//! ```text
//! |u(x) − û|_M ≤ |M⁻¹Jᵀ(x − Πx)|_M + |u(Πx) − û|_M
//! ```
//!
//! **A feasible u.** A penetrating contact, w < 0 with hi = ∞, makes P infinite, and so does an
//! equation with a rounding error. Therefore u(x) is repaired: the active rows F are moved to w = 0
//! by the smallest sufficient motion, u ← u + M⁻¹J_Fᵀ y, with y from a pseudo-inverse of A_FF; this
//! also makes the sum second order in the error of x. Contacts get an extra margin of a few
//! rounding errors, like lifting a table at 1e-16 m/s. If x is so wrong that the choice of the
//! active rows fails, all contacts are opened at the speed of the worst penetration. An equation is
//! satisfied by a motion that is only known to exist: e = M⁻¹J_Eᵀ A_EE⁻¹ (−w_E), of length |e|_M ≤
//! |w_E| / √λ_min(A_EE).
//!
//! **Rounding.** u consists of floating-point numbers. w, M (u − u*) − Jᵀx and all sums are
//! computed in interval arithmetic; λ_min of M and of A_EE are bounded as in
//! [`error_bound`](super::error_bound). The repair of u need not be trusted: a bad repair gives a
//! large bound, never a wrong one.
//!
//! The bound refers to the exact motion of the given data (M, J, bias, u*, γ, lo, hi). A margin m
//! costs Σ x m, so the smallest possible bound is √(2 Σ x m), about 1e-8 of the size of √(x u), if
//! the data need rounding.

mod consistency;
pub(crate) mod mass;
mod repair;
mod scaled;

use std::fmt;

use super::interval::{Interval, add_up, mul_up, sqrt_up};
pub use consistency::inconsistent_row;
use lcplab_lcp::Gauss;
use repair::Repair;
use scaled::Scaled;

/// The number of motions tried from each starting point: u(x), its repair, and repairs whose
/// margins grow by a factor of four. The best one counts.
const ATTEMPTS: i32 = 8;
/// After this many attempts, all contacts are lifted as long as one is violated.
const IMPROVEMENTS: i32 = 4;

/// How far the motion of x is from the exact one.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionBound {
    /// |u(x) − û|_M is at most this: √J at velocity level, where ½ |v|²_M is a kinetic energy. x is
    /// the answer itself, even outside its bounds.
    pub energy_norm: f64,
    /// Every entry of u(x) − û is at most this (m/s and rad/s, or m/s² and rad/s²).
    pub largest_entry: f64,
    /// A motion that satisfies all rows and proves the bound; |u − û|_M has the same bound.
    pub motion: Vec<f64>,
}

/// Why there is no bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unproved {
    /// x or the data are not finite, or too large for floating-point arithmetic.
    NotFinite,
    /// Too many rows or columns for dense matrices.
    TooLarge,
    /// M cannot be verified to be positive definite.
    Mass,
    /// A compliance is negative.
    NegativeCompliance {
        /// The row.
        row: usize,
    },
    /// Equations depend on each other, so rounding decides whether any motion satisfies them all.
    DependentEquations,
    /// No motion was found that verifiably satisfies this row and all others: they contradict each
    /// other, or leave no room for rounding, like a body clamped from two sides.
    NoRoom {
        /// The row.
        row: usize,
    },
}

impl fmt::Display for Unproved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unproved::NotFinite => write!(f, "numbers are not finite"),
            Unproved::TooLarge => write!(f, "too large"),
            Unproved::Mass => write!(f, "M is not verifiably definite"),
            Unproved::NegativeCompliance { row } => {
                write!(f, "row {row} has a negative compliance")
            }
            Unproved::DependentEquations => write!(f, "equations depend on each other"),
            Unproved::NoRoom { row } => write!(f, "the rounding error of row {row} has no bound"),
        }
    }
}

/// Bounds the distance of the motion u(x) = u* + M⁻¹Jᵀx from the exact motion û, for any x, within
/// its bounds or not.
///
/// # Errors
/// If no motion was found that verifiably satisfies all rows; the error says why.
///
/// # Panics
/// If x does not have n entries.
///
/// ```
/// use lcplab_judge::motion_bound::motion_bound;
/// use lcplab_lcp::Gauss;
///
/// // 2 kg fall at 3 m/s on two contacts that share the load in any way: A = [½ ½; ½ ½].
/// let gauss = Gauss {
///     mass: vec![(0, 0, 2.0)],
///     jacobian: vec![vec![(0, 1.0)]; 2],
///     bias: vec![0.0; 2],
///     compliance: vec![0.0; 2],
///     target: vec![-3.0],
///     lo: vec![0.0; 2],
///     hi: vec![f64::INFINITY; 2],
///     level: None,
/// };
/// assert!(motion_bound(&gauss, &[4.0, 2.0]).unwrap().energy_norm < 1e-14); // rounding
/// // 0.5 N s too little: u(x) = −0.25 m/s, and |u(x) − 0|_M = √2 · 0.25.
/// let bound = motion_bound(&gauss, &[4.0, 1.5]).unwrap();
/// assert!((bound.energy_norm - 0.25 * 2f64.sqrt()).abs() < 1e-12);
/// // One contact pulls with 2 N s, beyond its bound 0: u(x) = −2 m/s.
/// let bound = motion_bound(&gauss, &[4.0, -2.0]).unwrap();
/// assert!((bound.energy_norm - 2.0 * 2f64.sqrt()).abs() < 1e-12);
/// ```
pub fn motion_bound(gauss: &Gauss, x: &[f64]) -> Result<MotionBound, Unproved> {
    assert_eq!(x.len(), gauss.jacobian.len(), "x needs one entry per row");
    if !x.iter().all(|x| x.is_finite()) {
        return Err(Unproved::NotFinite);
    }
    let inside: Vec<f64> = (0..x.len()).map(|i| x[i].max(gauss.lo[i]).min(gauss.hi[i])).collect();
    let problem = Scaled::new(gauss, &inside)?;
    let (mut best, mut row): (Option<(f64, Vec<f64>)>, usize) = (None, 0);
    for mut repair in [Repair::of_pushing(&problem), Repair::of_loaded(&problem)] {
        for attempt in 0..ATTEMPTS {
            let trial = Trial::of(&problem, &repair)?;
            let distance = trial.distance();
            if distance.is_finite() && best.as_ref().is_none_or(|(least, _)| distance < *least) {
                best = Some((distance, repair.motion.clone()));
            }
            let violated: Vec<usize> =
                (0..x.len()).filter(|&i| trial.gaps[i].is_infinite()).collect();
            row = violated.first().copied().unwrap_or(row);
            let margin = if attempt == 0 { 0.0 } else { f64::EPSILON * 4f64.powi(attempt - 1) };
            if attempt < IMPROVEMENTS {
                repair.improve(&trial.w, &violated, margin);
            } else {
                repair.lift(&trial.w, &violated, margin);
            }
        }
    }
    let (distance, motion) = best.ok_or(Unproved::NoRoom { row })?;
    let energy_norm = add_up(problem.motion_beyond_bounds(x), distance);
    if !energy_norm.is_finite() {
        return Err(Unproved::NotFinite);
    }
    let entry = |j| mul_up(energy_norm, problem.largest_motion(j));
    let largest_entry = (0..motion.len()).map(entry).fold(0.0, f64::max);
    Ok(MotionBound { energy_norm, largest_entry, motion: problem.unscaled(&motion) })
}

/// A motion u and the terms of its bound.
struct Trial {
    /// w_i = (J u + bias + γ x)_i.
    w: Vec<Interval>,
    /// An upper bound on each g_i, ∞ for a row that may be violated.
    gaps: Vec<f64>,
    /// An upper bound on |u − u(x)|_M.
    deviation: f64,
}

impl Trial {
    fn of(problem: &Scaled<'_>, repair: &Repair<'_>) -> Result<Self, Unproved> {
        let w: Vec<Interval> = (0..problem.x.len()).map(|i| problem.w(i, &repair.motion)).collect();
        if !w.iter().all(|w| w.magnitude().is_finite()) {
            return Err(Unproved::NotFinite);
        }
        // |e|_M
        let still = problem.length_of_correction(&w)?;
        let gap = |i: usize| {
            if problem.is_equation(i) {
                return 0.0;
            }
            let moved = Interval::around_zero(mul_up(problem.row_length(i), still));
            problem.gap(i, w[i] + moved)
        };
        let gaps = (0..w.len()).map(gap).collect();
        let deviation = add_up(problem.deviation(&repair.motion, &repair.change), still);
        Ok(Trial { w, gaps, deviation })
    }

    /// √(2 (P + D)), rounded up.
    fn distance(&self) -> f64 {
        let gaps = self.gaps.iter().fold(0.0, |sum, &gap| add_up(sum, gap));
        let square = add_up(mul_up(self.deviation, self.deviation), mul_up(2.0, gaps));
        sqrt_up(square)
    }
}
