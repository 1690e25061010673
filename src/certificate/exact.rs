//! Proof that an active set carries a solution, in exact arithmetic.
//!
//! Floating-point numbers are exact rationals. From x and w the active set is read off: row i is at
//! its lower bound, at its upper bound or free according to Π_i(x_i − w_i/s_i). Then the equations
//! w_F = 0 of the free rows are solved over the rationals, and every bound and every sign of w is
//! decided exactly. Where A_FF is singular, the unknowns that the equations leave open keep the
//! value they have in x.
//!
//! A failed proof refutes nothing: the active set may have been misread where x_i − w_i/s_i lies
//! within rounding of a bound.

use dashu_float::FBig;
use dashu_float::round::mode::Zero;
use dashu_int::IBig;
use dashu_int::ops::{Abs, UnsignedAbs};
use dashu_ratio::RBig;

use super::modular;
use crate::lcp::Lcp;

/// An exact binary fraction.
pub(super) type Dyadic = FBig<Zero, 2>;

/// A solution that exists exactly, near the x it was read off from.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// The exact solution.
    pub x: Vec<RBig>,
    /// max_i |x_i − x*_i|, rounded up.
    pub distance: f64,
    /// A direction d with A d = 0 among rows strictly between their bounds, if there is one: x* can
    /// be moved along it without moving any w, so it is not the only solution.
    pub null_direction: Option<Vec<RBig>>,
}

/// Proves that the active set of x carries a solution of a problem without coupling, if it does.
///
/// `w` is A x + b; it only serves to read the active set. Costs one exact linear solve.
pub fn prove(lcp: &Lcp, x: &[f64], w: &[f64]) -> Option<Proof> {
    let sides: Vec<Side> = (0..lcp.len()).map(|i| side(lcp, i, x[i], w[i])).collect();
    let fixed: Vec<f64> = (0..lcp.len())
        .map(|i| match sides[i] {
            Side::Lower => lcp.lo()[i],
            Side::Upper => lcp.hi()[i],
            Side::Free => x[i].clamp(lcp.lo()[i], lcp.hi()[i]),
        })
        .collect();
    if fixed.iter().any(|x| !x.is_finite()) {
        return None; // w_i/s_i is too large for a number, and the bound on that side infinite
    }
    let free: Vec<usize> = (0..lcp.len()).filter(|&i| sides[i] == Side::Free).collect();
    let (rows, unknowns) = independent(lcp, &free);
    let dependent = free.iter().copied().find(|i| !unknowns.contains(i));
    let candidate = Candidate::solve(lcp, &rows, unknowns.clone(), fixed)?;
    if !(0..lcp.len()).all(|i| candidate.satisfies(lcp, i, sides[i])) {
        return None;
    }
    let null = dependent.and_then(|i| null_direction(lcp, &candidate, &rows, unknowns, i));
    Some(candidate.proof(x, null))
}

/// Rows and columns among `free` of a largest regular submatrix of A.
pub(super) fn independent(lcp: &Lcp, free: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let profile = modular::rank_profile(&integer_rows(lcp, free, free));
    let chosen = |places: Vec<usize>| places.into_iter().map(|k| free[k]).collect();
    (chosen(profile.rows), chosen(profile.columns))
}

/// The direction with d_i = 1 in which the other unknowns follow x_i so that w stays; `None` if
/// some w moves after all or a row of it lies at a bound.
fn null_direction(
    lcp: &Lcp,
    solution: &Candidate,
    rows: &[usize],
    unknowns: Vec<usize>,
    i: usize,
) -> Option<Vec<RBig>> {
    let mut unit = vec![0.0; lcp.len()];
    unit[i] = 1.0;
    let homogeneous = lcp.homogeneous();
    let d = Candidate::solve(&homogeneous, rows, unknowns, unit)?;
    let stays = |j: usize| d.scaled_w(&homogeneous, j) == Dyadic::ZERO;
    let free = |j: usize| d.scaled_x(j) == Dyadic::ZERO || solution.is_inside(lcp, j);
    (0..lcp.len()).all(|j| stays(j) && free(j)).then(|| d.entries())
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Lower,
    Free,
    Upper,
}

/// Where Π_i(x_i − w_i/s_i) lies.
fn side(lcp: &Lcp, i: usize, x: f64, w: f64) -> Side {
    let (lo, hi) = (lcp.lo()[i], lcp.hi()[i]);
    let scale = match crate::lcp::merit::row_scale(lcp, i) {
        0.0 => 1.0,
        scale => scale,
    };
    if lo == hi || x - w / scale <= lo {
        Side::Lower
    } else if x - w / scale >= hi {
        Side::Upper
    } else {
        Side::Free
    }
}

/// An x of which the `unknowns` are numerators over a common denominator, the others numbers.
pub(super) struct Candidate {
    /// Which entry of `numerators` belongs to row i.
    position: Vec<Option<usize>>,
    numerators: Vec<Dyadic>,
    denominator: Dyadic,
    fixed: Vec<f64>,
}

impl Candidate {
    /// Solves w_rows = 0 for the unknowns, the other entries of x being `fixed`.
    pub(super) fn solve(
        lcp: &Lcp,
        rows: &[usize],
        unknowns: Vec<usize>,
        fixed: Vec<f64>,
    ) -> Option<Self> {
        let mut position = vec![None; lcp.len()];
        for (k, &j) in unknowns.iter().enumerate() {
            position[j] = Some(k);
        }
        let (denominator, numerators) = (Dyadic::ONE, vec![Dyadic::ZERO; unknowns.len()]);
        let mut candidate = Candidate { position, numerators, denominator, fixed };
        let known: Vec<Dyadic> = rows.iter().map(|&i| -candidate.scaled_w(lcp, i)).collect();
        let shifts: Vec<isize> = rows.iter().map(|&i| least_exponent(lcp, i, &unknowns)).collect();
        let scaled: Vec<Dyadic> = known.into_iter().zip(&shifts).map(|(r, &k)| r >> k).collect();
        let common = scaled.iter().map(exponent).min().unwrap_or(0).min(0);
        let rhs: Vec<IBig> = scaled.into_iter().map(|r| integer(r >> common)).collect();
        let (numerators, denominator) = modular::solve(&integer_rows(lcp, rows, &unknowns), &rhs)?;
        candidate.numerators = numerators.into_iter().map(|x| exact(x) << common).collect();
        candidate.denominator = exact(denominator);
        Some(candidate)
    }

    /// w_i times the denominator, exactly.
    pub(super) fn scaled_w(&self, lcp: &Lcp, i: usize) -> Dyadic {
        let mut known = dyadic(lcp.b()[i]);
        let mut sum = Dyadic::ZERO;
        for (j, a) in lcp.matrix().row(i).iter().filter(|&(_, a)| a != 0.0) {
            match self.position[j] {
                Some(k) => sum += dyadic(a) * &self.numerators[k],
                None => known += dyadic(a) * dyadic(self.fixed[j]),
            }
        }
        sum + known * &self.denominator
    }

    /// x_i times the denominator, exactly.
    pub(super) fn scaled_x(&self, i: usize) -> Dyadic {
        match self.position[i] {
            Some(k) => self.numerators[k].clone(),
            None => dyadic(self.fixed[i]) * &self.denominator,
        }
    }

    fn satisfies(&self, lcp: &Lcp, i: usize, side: Side) -> bool {
        let (lo, hi, w) = (lcp.lo()[i], lcp.hi()[i], self.scaled_w(lcp, i));
        let within = || {
            let x = self.scaled_x(i);
            (lo.is_infinite() || x >= dyadic(lo) * &self.denominator)
                && (hi.is_infinite() || x <= dyadic(hi) * &self.denominator)
        };
        match side {
            Side::Lower => lo == hi || w >= Dyadic::ZERO,
            Side::Upper => w <= Dyadic::ZERO,
            Side::Free => w == Dyadic::ZERO && within(),
        }
    }

    /// Whether x_i lies strictly between its bounds.
    fn is_inside(&self, lcp: &Lcp, i: usize) -> bool {
        let (lo, hi, x) = (lcp.lo()[i], lcp.hi()[i], self.scaled_x(i));
        (lo.is_infinite() || x > dyadic(lo) * &self.denominator)
            && (hi.is_infinite() || x < dyadic(hi) * &self.denominator)
    }

    /// All entries as fractions.
    pub(super) fn entries(&self) -> Vec<RBig> {
        let denominator = rational(&self.denominator);
        let entry = |i| rational(&self.scaled_x(i)) / &denominator;
        (0..self.position.len()).map(entry).collect()
    }

    fn proof(&self, x: &[f64], null_direction: Option<Vec<RBig>>) -> Proof {
        let exact = self.entries();
        let distance = exact.iter().zip(x).map(|(exact, x)| {
            let rounded = (exact - rational(&dyadic(*x))).abs().to_f64_fast();
            if rounded == 0.0 { rounded } else { rounded.next_up().next_up() }
        });
        Proof { distance: distance.fold(0.0, f64::max), x: exact, null_direction }
    }
}

/// The entries of A in these rows and columns, each row times a power of two that makes it integer.
fn integer_rows(lcp: &Lcp, rows: &[usize], columns: &[usize]) -> Vec<Vec<IBig>> {
    let row = |&i: &usize| {
        let shift = least_exponent(lcp, i, columns);
        columns.iter().map(|&j| integer(dyadic(lcp.matrix().entry(i, j)) >> shift)).collect()
    };
    rows.iter().map(row).collect()
}

fn least_exponent(lcp: &Lcp, i: usize, columns: &[usize]) -> isize {
    let exponents = columns.iter().map(|&j| lcp.matrix().entry(i, j)).filter(|&a| a != 0.0);
    exponents.map(|a| exponent(&dyadic(a))).min().unwrap_or(0)
}

pub(super) fn dyadic(x: f64) -> Dyadic {
    exact_precision(Dyadic::try_from(x + 0.0).expect("a finite number")) // + 0 turns −0 into 0
}

fn exact(x: IBig) -> Dyadic {
    exact_precision(Dyadic::from(x))
}

/// Precision 0 stands for unlimited: sums and products are exact from then on.
fn exact_precision(x: Dyadic) -> Dyadic {
    x.with_precision(0).value()
}

fn exponent(x: &Dyadic) -> isize {
    if *x == Dyadic::ZERO { 0 } else { x.repr().exponent() }
}

fn integer(x: Dyadic) -> IBig {
    if x == Dyadic::ZERO {
        return IBig::ZERO;
    }
    let (significand, exponent) = x.into_repr().into_parts();
    significand << usize::try_from(exponent).expect("scaled to an integer")
}

fn rational(x: &Dyadic) -> RBig {
    let (significand, exponent) = x.repr().clone().into_parts();
    let power = IBig::ONE << exponent.unsigned_abs();
    if exponent >= 0 {
        RBig::from(significand * power)
    } else {
        RBig::from_parts(significand, power.unsigned_abs())
    }
}
