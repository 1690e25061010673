//! Proves in exact arithmetic that an active set has a solution.
//!
//! Floating-point numbers are exact rationals. The active set is determined from x and w: row i is
//! at its lower bound, at its upper bound or free according to Π_i(x_i − w_i/s_i), where a coupled
//! row has the bounds ±μ x_k at x. The equations of these sides are solved over the rationals
//! ([`lcp::exact`](lcplab_lcp::exact)), and the resulting point is checked against the original
//! problem: every bound (for a coupled row with the x_k of the point itself) and every sign of w is
//! decided exactly. If the equations are singular, the unknowns that they leave open keep their
//! value in x.
//!
//! Before this, the judge tries to enclose a solution without fractions.
//!
//! A failed proof does not show that x is wrong: the active set is uncertain where x_i − w_i/s_i
//! lies within rounding of a bound. Therefore the active set of x itself and the alternatives of
//! such ties are tried too, and the nearest solution counts.

use dashu_ratio::RBig;

use crate::Demand;
use crate::residual::{Rows, Wide};
use lcplab_lcp::Lcp;
use lcplab_lcp::exact::dyadic::{dyadic, rational};
use lcplab_lcp::exact::{Exact, Point, Side};

/// If x_i − w_i/s_i is this close to a bound, relative to its terms, it may lie on either side.
const TIE: f64 = 64.0 * f64::EPSILON;
/// If there are more ties, their alternatives are not tried.
const MOST_TIES: usize = 4;
/// For this number of points that are not solutions their own active sets are tried, too.
const MOST_STEPS: usize = 3;

/// An exact solution found near x.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// The exact solution.
    pub x: Vec<RBig>,
    /// max_i |x_i − x*_i|, rounded up.
    pub distance: f64,
    /// A direction d with A d = 0 among rows strictly between their bounds, if there is one: x* can
    /// move along it while every w stays the same, so x* is not the only solution. Sliding rows
    /// follow the row that bounds them.
    pub null_direction: Option<Vec<RBig>>,
}

/// Proves, if possible, that an active set of x has an exact solution; returns the nearest one
/// found.
///
/// Costs one exact linear solve if the first active set has a solution within rounding of x, and
/// about twenty at most; for problems with more than 150 rows only the first active set is tried.
///
/// ```
/// use lcplab_judge::exact::prove;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = 3 x − 1: 0.3333 has the active set of 1/3, which is 1/30000 away.
/// let lcp = Lcp::new(Matrix::from([[3.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let proof = prove(&lcp, &[0.3333]).expect("an exact solution");
/// assert_eq!(proof.x[0].to_string(), "1/3");
/// assert!((proof.distance - 1.0 / 30000.0).abs() < 1e-16);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn prove(lcp: &Lcp, x: &[f64]) -> Option<Proof> {
    let (nearest, distance) = nearest_to(lcp, x)?;
    let null_direction = nearest.null_direction.map(|d| d.entries());
    Some(Proof { x: nearest.x.entries(), distance, null_direction })
}

/// As [`prove`], without the fractions of x*: reducing them takes as long as the rest.
pub(super) fn nearest_to(lcp: &Lcp, x: &[f64]) -> Option<(ExactSolution, f64)> {
    let size = x.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    nearest(lcp, x, size, |point| point.distance(x))
}

/// An exact solution, and a direction along which it can move.
pub(super) struct ExactSolution {
    pub x: Point,
    pub null_direction: Option<Point>,
}

/// The nearest exact solution on an active set of x, and its distance. `distance` returns the
/// distance of a point, `size` is the size of x in the same unit.
pub(super) fn nearest(
    lcp: &Lcp,
    x: &[f64],
    size: f64,
    distance: impl Fn(&Point) -> f64,
) -> Option<(ExactSolution, f64)> {
    let exact = Exact::new(lcp);
    let inside: Vec<f64> = (0..x.len()).map(|i| lcp.project(i, x[i], x)).collect();
    let mut nearest: Option<(ExactSolution, f64)> = None;
    let mut sets = active_sets(&Rows::at(lcp, x));
    let mut steps = MOST_STEPS;
    if lcp.len() > Demand::EXACT_ROWS {
        sets.truncate(1);
        steps = 0;
    }
    let mut next = 0;
    while let Some(sides) = sets.get(next).cloned() {
        next += 1;
        let Some((point, null)) = exact.point(&sides, &inside) else { continue };
        if exact.is_solved_by(&point) {
            let distance = distance(&point);
            if nearest.as_ref().is_none_or(|(_, least)| distance < *least) {
                let null_direction = null.filter(|d| exact.is_free_along(d, &point, &sides));
                nearest = Some((ExactSolution { x: point.clone(), null_direction }, distance));
            }
            if distance <= TIE * size {
                break;
            }
        } else if steps > 0 {
            steps -= 1;
            let y: Vec<f64> = point.entries().iter().map(|x| x.to_f64().value()).collect();
            let of_point = y.iter().all(|y| y.is_finite()).then(|| sides_at(lcp, &y));
            sets.extend(of_point.filter(|set| !sets.contains(set)));
        }
    }
    nearest
}

/// The active set of a point.
fn sides_at(lcp: &Lcp, x: &[f64]) -> Vec<Side> {
    sides(&Rows::at(lcp, x))
}

/// Whether every |x_i − x*_i| is at most the bound of its row.
pub(super) fn is_within(x: &[f64], solution: &[RBig], bounds: &[f64]) -> bool {
    x.iter().zip(solution).zip(bounds).all(|((&x, solution), &bound)| {
        let away = rational(&dyadic(x)) - solution;
        let away = if away < RBig::ZERO { -away } else { away };
        away <= rational(&dyadic(bound))
    })
}

/// Candidates for the active set of x: from Π(x − w/s); from x itself; and with both sides of each
/// row in which x − w/s lies within rounding of a bound.
fn active_sets(at: &Rows<'_>) -> Vec<Vec<Side>> {
    let first = sides(at);
    let own: Vec<Side> = (0..at.x.len()).map(|i| own_side(at, i)).collect();
    let ties: Vec<(usize, [Side; 2])> =
        (0..at.x.len()).filter_map(|i| Some((i, tied_sides(at, i)?))).collect();
    let mut sets = vec![first.clone()];
    let mut add = |set: Vec<Side>| {
        if !sets.contains(&set) {
            sets.push(set);
        }
    };
    add(own);
    let count = if ties.len() <= MOST_TIES { 1 << ties.len() } else { 0 };
    for choice in 0..count {
        let mut set = first.clone();
        for (k, &(i, both)) in ties.iter().enumerate() {
            set[i] = both[choice >> k & 1];
        }
        add(set);
    }
    sets
}

/// The side of Π(x − w/s), row by row.
pub(super) fn sides(at: &Rows<'_>) -> Vec<Side> {
    let side = |i: usize| {
        let (lo, hi) = at.lcp.bounds(i, at.x);
        let target = target(at, i);
        if lo == hi || target <= lo {
            Side::Lower
        } else if target >= hi {
            Side::Upper
        } else {
            Side::Free
        }
    };
    (0..at.x.len()).map(side).collect()
}

/// x_i − w_i/s_i.
fn target(at: &Rows<'_>, i: usize) -> f64 {
    at.x[i] - (at.rows[i].w / at.rows[i].scale).value()
}

/// The side of x_i itself.
fn own_side(at: &Rows<'_>, i: usize) -> Side {
    let (lo, hi) = at.lcp.bounds(i, at.x);
    match at.x[i] {
        x if x <= lo => Side::Lower,
        x if x >= hi => Side::Upper,
        _ => Side::Free,
    }
}

/// The two sides of a row whose x_i − w_i/s_i lies within rounding of a bound.
fn tied_sides(at: &Rows<'_>, i: usize) -> Option<[Side; 2]> {
    let (lo, hi) = at.lcp.bounds(i, at.x);
    let (row, target) = (&at.rows[i], Wide::from(target(at, i)));
    let terms = row.terms / row.scale + Wide::from(at.x[i]).abs();
    let is_tied = |bound: f64| (target - bound.into()).abs() <= terms * TIE.into();
    match (lo < hi, is_tied(lo), is_tied(hi)) {
        (true, true, _) => Some([Side::Free, Side::Lower]),
        (true, _, true) => Some([Side::Free, Side::Upper]),
        _ => None,
    }
}
