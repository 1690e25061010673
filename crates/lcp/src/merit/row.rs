//! Residual of one row: its w, the sizes it is compared with, and the distance of x from its
//! projected step.

use crate::{Lcp, Matrix};

/// Terms in this range and their sums neither overflow nor lose digits to underflow.
const SAFE: std::ops::Range<f64> = 1e-250..1e250;

/// The bounds ±μ x_k of a coupled row are rounded products: an x that differs from one by at most
/// this fraction counts as being at it.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The terms of one row in a residual: w_i and the sizes it is compared with.
///
/// ```
/// use lcplab_lcp::merit::{RowTerms, is_solution_by, row_residuals, row_scale};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = 2 x − 2 at x = 3.
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![9.0])?;
/// let x = [3.0];
/// let terms = RowTerms::at(&lcp, 0, &x);
/// assert_eq!((terms.w(), terms.magnitude), (4.0, 8.0)); // 6 − 2, and 6 + 2
/// assert_eq!((terms.scale, row_scale(&lcp, 0)), (2.0, 2.0));
/// assert_eq!(terms.scaled_residual(&lcp, 0, &x), 0.5);
/// // The step from 3 to x − w/s = 1 has the length 2, times s = 2.
/// assert_eq!(terms.row_residual(&lcp, 0, &x).size, 4.0);
/// assert_eq!(terms.reach(&lcp, 0, &x), 9.0); // no x is larger than hi
/// assert_eq!(terms.size(&lcp, 0, &x), 4.0); // the terms over s, 8/2, which is more than x
/// assert_eq!(RowTerms::of_sums(&lcp, 4.0, 8.0, 2.0), Some(terms));
///
/// let residuals = row_residuals(&lcp, &x, &[terms]);
/// assert!(!is_solution_by(&lcp, &x, &residuals, 1e-8));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowTerms {
    /// w_i = Σ_j a_ij x_j + b_i, in units of 2^`exponent`.
    pub w: f64,
    /// Σ_j |a_ij x_j| + |b_i|, the size of w_i without cancellation, in units of 2^`exponent`; at
    /// least s_i times the [scale](Lcp::scale) of the problem.
    pub magnitude: f64,
    /// s_i = |a_ii|, or max_j |a_ij| if a_ii = 0: the change of w_i per change of x_i.
    pub scale: f64,
    /// 0 unless the terms are so large or small that they would overflow or underflow.
    pub exponent: i32,
}

/// How the terms of a row are summed.
///
/// ```
/// use lcplab_lcp::merit::{RowTerms, Sum};
/// use lcplab_lcp::{Lcp, Matrix, accurate};
///
/// // 1e16 + 1 − 1e16, in plain and in compensated arithmetic.
/// fn total<S: Sum>() -> f64 {
///     let mut sum = S::default();
///     [1e16, 1.0, -1e16].into_iter().for_each(|term| sum.add_product(term, 1.0));
///     sum.value()
/// }
/// assert_eq!((total::<f64>(), total::<accurate::Sum>()), (0.0, 1.0));
///
/// let lcp = Lcp::new(Matrix::from([[1.0]]), vec![-1.0], vec![0.0], vec![2.0])?;
/// assert_eq!(RowTerms::summed::<accurate::Sum>(&lcp, 0, &[1.5]).w, 0.5);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub trait Sum: Default {
    /// Adds a b.
    fn add_product(&mut self, a: f64, b: f64);
    /// The sum, rounded.
    fn value(&self) -> f64;
}

/// Plain floating-point summation.
impl Sum for f64 {
    fn add_product(&mut self, a: f64, b: f64) {
        *self += a * b;
    }

    fn value(&self) -> f64 {
        *self
    }
}

impl RowTerms {
    /// The terms of row i at x, in plain floating point.
    pub fn at(lcp: &Lcp, i: usize, x: &[f64]) -> Self {
        Self::summed::<f64>(lcp, i, x)
    }

    /// The terms from sums computed elsewhere; `None` if those may have overflowed or underflowed.
    #[inline]
    pub fn of_sums(lcp: &Lcp, w: f64, magnitude: f64, scale: f64) -> Option<Self> {
        let rest = lcp.scale() * scale;
        let terms = || RowTerms { w, magnitude: magnitude.max(rest), scale, exponent: 0 };
        SAFE.contains(&magnitude).then(terms)
    }

    /// The terms of row i at x, summed by S.
    pub fn summed<S: Sum>(lcp: &Lcp, i: usize, x: &[f64]) -> Self {
        let products =
            || lcp.matrix().row(i).iter().map(|(j, a)| (a, x[j])).chain([(lcp.b()[i], 1.0)]);
        let (mut w, mut magnitude) = (S::default(), 0.0);
        for (a, x) in products() {
            w.add_product(a, x);
            magnitude += (a * x).abs();
        }
        let scale = row_scale(lcp, i);
        let rest = lcp.scale() * scale;
        if SAFE.contains(&magnitude) || magnitude < rest {
            let magnitude = magnitude.max(rest);
            return RowTerms { w: w.value(), magnitude, scale, exponent: 0 };
        }
        let largest = products().filter_map(|(a, x)| exponent(a, x)).max();
        match largest {
            Some(largest) if x.iter().all(|x| x.is_finite()) => {
                let (mut w, mut magnitude) = (S::default(), 0.0);
                for (a, x) in products() {
                    let (a, x) = shifted(a, x, -largest);
                    w.add_product(a, x);
                    magnitude += (a * x).abs();
                }
                RowTerms { w: w.value(), magnitude, scale, exponent: largest }
            }
            _ => RowTerms { w: w.value(), magnitude, scale, exponent: 0 },
        }
    }

    /// The terms of a row with one more term in its sum.
    pub(crate) fn plus(&self, term: f64) -> Self {
        let term = libm::ldexp(term, -self.exponent);
        RowTerms { w: self.w + term, magnitude: self.magnitude + term.abs(), ..*self }
    }

    /// r_i at the x of these terms ([`scaled_residual`](super::scaled_residual)).
    #[inline]
    pub fn scaled_residual(&self, lcp: &Lcp, i: usize, x: &[f64]) -> f64 {
        self.row_residual(lcp, i, x).residual
    }

    /// The distance of x_i from its projected step, between the bounds of row i at x.
    #[inline]
    pub fn row_residual(&self, lcp: &Lcp, i: usize, x: &[f64]) -> RowResidual {
        let (lo, hi) = lcp.bounds(i, x);
        let is_at = |bound: f64| lcp.is_coupled(i) && (x[i] - bound).abs() <= ROUNDING * hi;
        let own = [lo, hi].into_iter().find(|&bound| is_at(bound)).unwrap_or(x[i]);
        self.row_residual_between(own, lo, hi, || self.reach(lcp, i, x))
    }

    /// [`RowTerms::row_residual`] for an x_i with any bounds and their [reach](Self::reach), which
    /// is computed only if x_i is not at the bound to which its step leads.
    ///
    /// The step is the median of x − lo, w/s and x − hi: multiplied by s it needs no division by s,
    /// and in units of e = R no division by the terms.
    #[inline]
    pub(crate) fn row_residual_between(
        &self,
        x: f64,
        lo: f64,
        hi: f64,
        reach: impl FnOnce() -> f64,
    ) -> RowResidual {
        let scale = self.positive_scale();
        let slack = |bound: f64| match x - bound {
            distance if distance.is_infinite() && bound.is_finite() => {
                // x − bound would overflow.
                product(scale, 0.5 * x - 0.5 * bound, 1 - self.exponent)
            }
            distance => product(scale, distance, -self.exponent),
        };
        let size = self.w.min(slack(lo)).max(slack(hi)).abs();
        let mut residual = relative(size, self.magnitude);
        let is_inside = lo <= x && x <= hi;
        let is_held = self.w >= 0.0 && x == lo || self.w <= 0.0 && x == hi;
        let is_settled = is_inside && (is_held || size == self.w.abs());
        if !is_settled && residual.is_finite() {
            let reach = reach();
            if product(scale, reach, -self.exponent) < self.magnitude {
                let part = relative(self.w, self.magnitude);
                let away = |bound: f64| match (x - bound) / reach {
                    away if away.is_infinite() && bound.is_finite() => x / reach - bound / reach,
                    away => away,
                };
                residual = part.min(away(lo)).max(away(hi)).abs();
            }
        }
        RowResidual { size, scale, magnitude: self.magnitude, exponent: self.exponent, residual }
    }

    /// R_i: the largest size of x_i that the bounds of row i imply, from these terms of the row
    /// ([`scaled_residual`](super::scaled_residual)).
    ///
    /// ```text
    /// R_i = max(|lo_i|, |hi_i|) of those that are finite, ∞ if they are all 0
    /// R_i = μ_i max(x_k, e_k), ∞ if that is 0      where row i is coupled to row k
    /// ```
    ///
    /// A bound of 0 implies no size, and R_i is never below the [scale](Lcp::scale) of the problem.
    /// The bounds of a coupled row may vanish with x_k, but the accuracy of x_k is relative to e_k.
    pub fn reach(&self, lcp: &Lcp, i: usize, x: &[f64]) -> f64 {
        if let Some((k, mu)) = lcp.coupled_to(i) {
            return reach_of_friction(mu, RowTerms::at(lcp, k, x).size(lcp, k, x));
        }
        let size = |bound: f64| if bound.is_finite() { bound.abs() } else { 0.0 };
        match size(lcp.lo()[i]).max(size(lcp.hi()[i])) {
            0.0 => f64::INFINITY,
            reach => reach.max(lcp.scale()),
        }
    }

    /// max(x_k, e_k): the size of x_k, or of its uncertainty if that is larger.
    pub fn size(&self, lcp: &Lcp, k: usize, x: &[f64]) -> f64 {
        self.natural().min(self.reach(lcp, k, x)).max(x[k])
    }

    /// terms_i / s_i: the size of x that corresponds to the terms; 0 only if they are 0.
    fn natural(&self) -> f64 {
        let size = libm::ldexp(self.magnitude / self.positive_scale(), self.exponent);
        if self.magnitude > 0.0 { size.max(f64::from_bits(1)) } else { size }
    }

    /// s_i, or 1 if the whole row is 0.
    #[inline]
    pub(crate) fn positive_scale(&self) -> f64 {
        if self.scale == 0.0 { 1.0 } else { self.scale }
    }

    /// w_i without the exponent; may overflow.
    #[inline]
    pub fn w(&self) -> f64 {
        match self.exponent {
            0 => self.w,
            exponent => libm::ldexp(self.w, exponent),
        }
    }
}

/// R of friction with this μ under a normal of this [size](RowTerms::size).
pub(crate) fn reach_of_friction(mu: f64, normal: f64) -> f64 {
    match mu * normal {
        0.0 => f64::INFINITY,
        reach => reach,
    }
}

/// The distance of a row or a contact from its projected step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowResidual {
    /// |x − Π(x − w/s)| s, in units of 2^`exponent`.
    pub size: f64,
    /// s.
    pub scale: f64,
    /// The size of the terms that w is the sum of, in units of 2^`exponent`.
    pub magnitude: f64,
    /// 0 unless the terms are so large or small that they would overflow or underflow.
    pub exponent: i32,
    /// The scaled residual; NaN counts as ∞.
    pub residual: f64,
}

impl RowResidual {
    /// A residual without a step.
    pub(crate) fn of_residual(residual: f64) -> Self {
        RowResidual { size: 0.0, scale: 1.0, magnitude: 0.0, exponent: 0, residual }
    }

    /// log₂ of the longest |x − Π(x − w/s)| √s, −∞ for an empty list. Its square is an energy in
    /// any units of x and w.
    pub(crate) fn longest_step(row_residuals: &[RowResidual]) -> f64 {
        if row_residuals.iter().all(|row_residual| row_residual.exponent == 0) {
            let longest = row_residuals.iter().map(RowResidual::length).fold(0.0, f64::max);
            return libm::log2(longest);
        }
        row_residuals.iter().map(RowResidual::step).fold(f64::NEG_INFINITY, f64::max)
    }

    /// log₂ of |x − Π(x − w/s)| √s.
    pub(super) fn step(&self) -> f64 {
        libm::log2(self.length()) + f64::from(self.exponent)
    }

    /// |x − Π(x − w/s)| √s in units of 2^`exponent`.
    fn length(&self) -> f64 {
        if self.size == 0.0 { 0.0 } else { self.size / self.scale.sqrt() }
    }
}

/// size / magnitude with the sign of size, 0/0 = 0; NaN counts as ∞.
#[inline]
pub fn relative(size: f64, magnitude: f64) -> f64 {
    match size / magnitude {
        _ if size == 0.0 => 0.0,
        // x is not finite.
        _ if magnitude.is_infinite() => f64::INFINITY,
        relative if relative.is_nan() => f64::INFINITY,
        relative => relative,
    }
}

/// a b 2^shift without overflow of intermediate results.
#[inline]
pub fn product(a: f64, b: f64, shift: i32) -> f64 {
    match shift {
        0 => a * b,
        shift => {
            let (a, b) = shifted(a, b, shift);
            a * b
        }
    }
}

/// The exponent of a b; `None` if the product is 0.
fn exponent(a: f64, b: f64) -> Option<i32> {
    (a != 0.0 && b != 0.0).then(|| libm::frexp(a).1 + libm::frexp(b).1)
}

/// Two factors whose product is a b 2^shift, neither extreme unless the product is.
fn shifted(a: f64, b: f64, shift: i32) -> (f64, f64) {
    if a == 0.0 || b == 0.0 || !b.is_finite() {
        return (a, b);
    }
    let ((a, m), (b, k)) = (libm::frexp(a), libm::frexp(b));
    (libm::ldexp(a, m + k + shift), b)
}

/// s_i: |a_ii|, or max_j |a_ij| where a_ii = 0.
#[inline]
pub fn row_scale(lcp: &Lcp, i: usize) -> f64 {
    match lcp.matrix().diagonal(i).abs() {
        0.0 => lcp.matrix().row(i).iter().fold(0.0, |s, (_, a)| f64::max(s, a.abs())),
        s => s,
    }
}

/// The largest absolute row sum of these rows and columns of A, an upper bound on the modulus of
/// their eigenvalues.
///
/// ```
/// use lcplab_lcp::Matrix;
/// use lcplab_lcp::merit::block_scale;
///
/// let a = Matrix::from([[2.0, -1.0, 9.0], [-1.0, 3.0, 0.0], [9.0, 0.0, 1.0]]);
/// assert_eq!(block_scale(&a, &[0, 1]), 4.0); // row 1: |−1| + 3; row 2 is not in the block
/// ```
pub fn block_scale(a: &Matrix, rows: &[usize]) -> f64 {
    let row_sum = |&i: &usize| rows.iter().map(|&j| a.entry(i, j).abs()).sum();
    rows.iter().map(row_sum).fold(0.0, f64::max)
}
