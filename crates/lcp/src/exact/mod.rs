//! LCPs in exact arithmetic: floating-point numbers are binary fractions.
//!
//! In a solution each row is on one of three sides. A side is a linear equation, even if the row is
//! coupled to another one:
//!
//! ```text
//! lower    x_i = lo_i    or    x_i = −μ_i x_k
//! free     w_i = (A x + b)_i = 0
//! upper    x_i = hi_i    or    x_i = +μ_i x_k
//! ```
//!
//! A choice of a side for every row is a *piece*. The equations of a piece are solved in integers;
//! the definition, row by row, decides whether a point solves the problem.

pub mod bareiss;
mod check;
pub mod dyadic;
mod echelon;
pub mod modular;
mod pieces;
mod point;
mod ranges;
mod solution_set;

pub use dyadic::rounded_up;
pub use pieces::{Pieces, all_solutions};
pub use point::Point;
pub use solution_set::{Face, SolutionSet, TooMany};

use super::Lcp;
use dashu_int::IBig;
use dyadic::{Dyadic, dyadic, integers};

/// Systems of up to this number of unknowns are solved by elimination.
const MOST_ELIMINATED: usize = 10;

/// The side of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// x at its lower bound, w ≥ 0.
    Lower,
    /// w = 0, x between its bounds.
    Free,
    /// x at its upper bound, w ≤ 0.
    Upper,
}

/// An LCP in binary fractions.
///
/// ```
/// use dashu_ratio::RBig;
/// use lcplab_lcp::exact::dyadic::dyadic;
/// use lcplab_lcp::exact::{Exact, Side};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = 3 x − 1: the solution 1/3 is not a floating-point number.
/// let lcp = Lcp::new(Matrix::from([[3.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let exact = Exact::new(&lcp);
/// assert_eq!((exact.len(), exact.is_empty()), (1, false));
/// let (third, null) = exact.point(&[Side::Free], &[0.3]).unwrap();
/// assert_eq!(third.entries(), [RBig::from_parts(1.into(), 3u8.into())]);
/// assert!(null.is_none() && exact.is_solved_by(&third));
/// assert_eq!(exact.scaled_w(0, &third), dyadic(0.0));
/// assert_eq!(exact.scaled_bounds(0, &third), (Some(dyadic(0.0)), None)); // 0 and ∞
///
/// // On its lower side x is 0, where w = −1: no solution.
/// let (zero, _) = exact.point(&[Side::Lower], &[0.3]).unwrap();
/// assert!(!exact.is_solved_by(&zero));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub struct Exact {
    /// The nonzero entries of A, row by row.
    a: Vec<Vec<(usize, Dyadic)>>,
    b: Vec<Dyadic>,
    bounds: Vec<Bounds>,
}

/// The bounds of a row's x.
enum Bounds {
    /// Numbers; `None` for infinity.
    Box(Option<Dyadic>, Option<Dyadic>),
    /// ±μ times the x of this row.
    Coupled(usize, Dyadic),
}

/// How the x of a row is determined once every row has a side.
#[derive(Clone)]
enum Place {
    /// It is this number.
    Known(Dyadic),
    /// It is an unknown times a factor.
    Times(usize, Dyadic),
}

impl Exact {
    /// Converts the problem exactly.
    pub fn new(lcp: &Lcp) -> Self {
        let row = |i: usize| lcp.matrix().row(i).iter().filter(|&(_, a)| a != 0.0);
        let number = |x: f64| x.is_finite().then(|| dyadic(x));
        let bounds = |i: usize| match lcp.coupled_to(i) {
            Some((_, 0.0)) => Bounds::Box(Some(Dyadic::ZERO), Some(Dyadic::ZERO)),
            Some((k, mu)) => Bounds::Coupled(k, dyadic(mu)),
            None => Bounds::Box(number(lcp.lo()[i]), number(lcp.hi()[i])),
        };
        Exact {
            a: (0..lcp.len()).map(|i| row(i).map(|(j, a)| (j, dyadic(a))).collect()).collect(),
            b: lcp.b().iter().map(|&b| dyadic(b)).collect(),
            bounds: (0..lcp.len()).map(bounds).collect(),
        }
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.b.is_empty()
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.b.len()
    }

    /// The point of a piece where w = 0 in a maximal independent set of free rows; the x of the
    /// other free rows are kept. If there are other free rows, also a null vector of the equations.
    pub fn point(&self, sides: &[Side], x: &[f64]) -> Option<(Point, Option<Point>)> {
        if (0..self.len()).any(|i| self.is_at_infinity(i, sides[i])) {
            return None;
        }
        let free: Vec<usize> = (0..self.len()).filter(|&i| sides[i] == Side::Free).collect();
        let (rows, unknowns) = self.independent(sides, &free, &free);
        let places = self.places(sides, &unknowns, &|i| dyadic(x[i]));
        let point = self.solve(&rows, &places, unknowns.len())?;
        let open = free.iter().copied().find(|i| !unknowns.contains(i));
        let null = open.and_then(|open| {
            let one = |i| if i == open { Dyadic::ONE } else { Dyadic::ZERO };
            let homogeneous = self.homogeneous();
            let places = homogeneous.places(sides, &unknowns, &one);
            homogeneous.solve(&rows, &places, unknowns.len())
        });
        Some((point, null))
    }

    /// Changes these entries of x so that w = 0 in a maximal independent set of these rows.
    ///
    /// ```
    /// use lcplab_lcp::exact::{Exact, Side};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // Two supports share a load of 1: x_0 + x_1 = 1. The given x is too small; x_0 changes.
    /// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
    /// let exact = Exact::new(&Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?);
    /// let repaired = exact.repaired(&[0.25, 0.25], &[0, 1], &[0]).unwrap();
    /// assert_eq!(repaired.distance(&[0.75, 0.25]), 0.0);
    ///
    /// // Force can move from one support to the other.
    /// let sides = [Side::Free; 2];
    /// let (x, null) = exact.point(&sides, &[0.25, 0.25]).unwrap();
    /// let null = null.unwrap();
    /// assert_eq!(null.distance(&[-1.0, 1.0]), 0.0);
    /// assert!(exact.is_free_along(&null, &x, &sides));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn repaired(&self, x: &[f64], rows: &[usize], entries: &[usize]) -> Option<Point> {
        let sides = vec![Side::Free; self.len()];
        let (rows, unknowns) = self.independent(&sides, rows, entries);
        let places = self.places(&sides, &unknowns, &|i| dyadic(x[i]));
        self.solve(&rows, &places, unknowns.len())
    }

    /// A maximal set of these rows and unknowns whose equations are independent.
    fn independent(
        &self,
        sides: &[Side],
        rows: &[usize],
        unknowns: &[usize],
    ) -> (Vec<usize>, Vec<usize>) {
        let places = self.places(sides, unknowns, &|_| Dyadic::ZERO);
        let m = unknowns.len();
        let coefficients = |&i: &usize| integers(&self.equation(i, &places, m)[..m]);
        let profile = modular::rank_profile(&rows.iter().map(coefficients).collect::<Vec<_>>());
        let of = |all: &[usize], chosen: &[usize]| chosen.iter().map(|&k| all[k]).collect();
        (of(rows, &profile.rows), of(unknowns, &profile.columns))
    }

    /// The problem with b and all finite bounds set to 0: its solutions are directions.
    fn homogeneous(&self) -> Exact {
        let zero = |bound: &Option<Dyadic>| bound.as_ref().map(|_| Dyadic::ZERO);
        let bounds = |bounds: &Bounds| match bounds {
            Bounds::Box(lo, hi) => Bounds::Box(zero(lo), zero(hi)),
            Bounds::Coupled(k, mu) => Bounds::Coupled(*k, mu.clone()),
        };
        Exact {
            a: self.a.clone(),
            b: vec![Dyadic::ZERO; self.len()],
            bounds: self.bounds.iter().map(bounds).collect(),
        }
    }

    /// The sides that a row can be on.
    fn sides(&self, i: usize) -> &'static [Side] {
        match &self.bounds[i] {
            Bounds::Box(lo, hi) => match (lo, hi) {
                (None, None) => &[Side::Free],
                (Some(_), None) => &[Side::Lower, Side::Free],
                (None, Some(_)) => &[Side::Upper, Side::Free],
                (lo, hi) if lo == hi => &[Side::Lower],
                _ => &[Side::Lower, Side::Free, Side::Upper],
            },
            Bounds::Coupled(..) => &[Side::Lower, Side::Free, Side::Upper],
        }
    }

    fn is_at_infinity(&self, i: usize, side: Side) -> bool {
        match &self.bounds[i] {
            Bounds::Box(lo, _) if side == Side::Lower => lo.is_none(),
            Bounds::Box(_, hi) if side == Side::Upper => hi.is_none(),
            _ => false,
        }
    }

    /// How each x is determined: by its side as a number or a multiple; for a free row as an
    /// unknown, or as the given x if the row is not in the list.
    fn places(
        &self,
        sides: &[Side],
        unknowns: &[usize],
        open: &dyn Fn(usize) -> Dyadic,
    ) -> Vec<Place> {
        let mut position = vec![None; self.len()];
        for (k, &i) in unknowns.iter().enumerate() {
            position[i] = Some(k);
        }
        let own = |i: usize| match (sides[i], position[i], &self.bounds[i]) {
            (Side::Free, Some(k), _) => Place::Times(k, Dyadic::ONE),
            (Side::Lower, _, Bounds::Box(Some(bound), _))
            | (Side::Upper, _, Bounds::Box(_, Some(bound))) => Place::Known(bound.clone()),
            _ => Place::Known(open(i)),
        };
        let place = |i: usize| match (&self.bounds[i], sides[i]) {
            (Bounds::Box(..), _) | (_, Side::Free) => own(i),
            (Bounds::Coupled(k, mu), side) => {
                let factor = if side == Side::Lower { -mu.clone() } else { mu.clone() };
                match own(*k) {
                    Place::Known(x) => Place::Known(factor * x),
                    Place::Times(u, one) => Place::Times(u, factor * one),
                }
            }
        };
        (0..self.len()).map(place).collect()
    }

    /// w_i as the coefficients of m unknowns, followed by a constant.
    fn equation(&self, i: usize, places: &[Place], m: usize) -> Vec<Dyadic> {
        let mut equation = vec![Dyadic::ZERO; m + 1];
        equation[m] = self.b[i].clone();
        for (j, a) in &self.a[i] {
            match &places[*j] {
                Place::Known(x) => equation[m] += a * x,
                Place::Times(u, factor) => equation[*u] += a * factor,
            }
        }
        equation
    }

    /// The point where w = 0 in these rows; there are as many rows as unknowns.
    fn solve(&self, rows: &[usize], places: &[Place], m: usize) -> Option<Point> {
        let mut equations: Vec<Vec<IBig>> =
            rows.iter().map(|&i| integers(&self.equation(i, places, m))).collect();
        for equation in &mut equations {
            equation[m] = -std::mem::take(&mut equation[m]);
        }
        let (numerators, denominator) = match m <= MOST_ELIMINATED {
            true => bareiss::solve(equations)?,
            false => {
                let constant = |equation: &mut Vec<IBig>| equation.pop().expect("m + 1 entries");
                let c: Vec<IBig> = equations.iter_mut().map(constant).collect();
                modular::solve(&equations, &c)?
            }
        };
        Some(Point::of(places, numerators, denominator))
    }
}
