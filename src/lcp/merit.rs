//! How far is x from a solution? One function a measure, each with its definition.
//!
//! The bounds are those at x where rows are coupled. All sums here are plain floating point: what a
//! solver needs to know when to stop. The [judge](crate::certificate) has its own, more careful
//! arithmetic, and the same definitions.

use super::Lcp;

/// Terms in this range lose nothing to overflow or underflow, nor do their sums.
const SAFE: std::ops::Range<f64> = 1e-250..1e250;

/// What one row contributes to a residual: w_i with the sizes to measure it by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowTerms {
    /// w_i = Σ_j a_ij x_j + b_i, in units of 2^`exponent`.
    pub w: f64,
    /// Σ_j |a_ij x_j| + |b_i|: what w_i would be without cancellation, in units of 2^`exponent`; at least
    /// s_i times the [scale](Lcp::scale) of the problem.
    pub magnitude: f64,
    /// s_i = |a_ii|, or max_j |a_ij| where a_ii = 0: how much w_i moves with x_i.
    pub scale: f64,
    /// 0 unless the terms are so large or so small that they would overflow or vanish.
    pub exponent: i32,
}

/// How the terms of a row are added up.
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

    /// The terms whose sums were taken elsewhere; none if those may have overflowed or vanished.
    pub(crate) fn of_sums(lcp: &Lcp, w: f64, magnitude: f64, scale: f64) -> Option<Self> {
        let rest = lcp.scale() * scale;
        let terms = || RowTerms { w, magnitude: magnitude.max(rest), scale, exponent: 0 };
        SAFE.contains(&magnitude).then(terms)
    }

    /// The terms of row i at x, added up by S.
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

    /// ```text
    /// r_i = |x_i − Π(x_i − w_i / s_i)| s_i / (Σ_j |a_ij x_j| + |b_i|),   0/0 = 0
    /// ```
    ///
    /// Terms below s_i times the problem's [scale](Lcp::scale), if it has one, count as that much: such a
    /// row is at rest. No unit and no scaling of a row or column changes it; rounding alone makes it about 1e-16.
    pub fn scaled_residual(&self, x: f64, lo: f64, hi: f64) -> f64 {
        self.miss(x, lo, hi).relative()
    }

    /// How far x_i is from its own step, computed as the median of s (x − hi), w and s (x − lo), which
    /// needs no division by s.
    pub fn miss(&self, x: f64, lo: f64, hi: f64) -> Miss {
        let scale = if self.scale == 0.0 { 1.0 } else { self.scale };
        let slack = |bound: f64| match x - bound {
            distance if distance.is_infinite() && bound.is_finite() => {
                product(scale, 0.5 * x - 0.5 * bound, 1 - self.exponent) // beyond the largest number
            }
            distance => product(scale, distance, -self.exponent),
        };
        let size = self.w.min(slack(lo)).max(slack(hi)).abs();
        Miss { size, magnitude: self.magnitude, scale, exponent: self.exponent }
    }

    /// w_i itself, which may overflow.
    pub fn w(&self) -> f64 {
        libm::ldexp(self.w, self.exponent)
    }
}

/// How far a row or a contact is from its own projected step, in the unit of w.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Miss {
    /// |x − Π(x − w/s)| s, in units of 2^`exponent`.
    pub size: f64,
    /// The terms to measure it by, in the same units.
    pub magnitude: f64,
    /// s.
    pub scale: f64,
    /// 0 unless the terms are so large or so small that they would overflow or vanish.
    pub exponent: i32,
}

impl Miss {
    /// The size beside the terms, 0/0 = 0; NaN counts as ∞.
    pub fn relative(&self) -> f64 {
        match self.size / self.magnitude {
            _ if self.size == 0.0 => 0.0,
            _ if self.magnitude.is_infinite() => f64::INFINITY, // x is not finite
            relative if relative.is_nan() => f64::INFINITY,
            relative => relative,
        }
    }

    /// log₂ of |x − Π(x − w/s)| √s, −∞ for nothing. Its square is an energy, whatever the units of x
    /// and w.
    pub fn step(&self) -> f64 {
        match self.size {
            0.0 => f64::NEG_INFINITY,
            size => libm::log2(size) + f64::from(self.exponent) - 0.5 * libm::log2(self.scale),
        }
    }
}

/// a b 2^shift, which does not overflow on the way.
pub(super) fn product(a: f64, b: f64, shift: i32) -> f64 {
    match shift {
        0 => a * b,
        shift => {
            let (a, b) = shifted(a, b, shift);
            a * b
        }
    }
}

/// The exponent of a b, unless it is 0.
fn exponent(a: f64, b: f64) -> Option<i32> {
    (a != 0.0 && b != 0.0).then(|| libm::frexp(a).1 + libm::frexp(b).1)
}

/// Two factors whose product is a b 2^shift, neither of them extreme if the product is not.
fn shifted(a: f64, b: f64, shift: i32) -> (f64, f64) {
    if a == 0.0 || b == 0.0 || !b.is_finite() {
        return (a, b);
    }
    let ((a, m), (b, k)) = (libm::frexp(a), libm::frexp(b));
    (libm::ldexp(a, m + k + shift), b)
}

/// s_i: |a_ii|, or max_j |a_ij| where a_ii = 0.
pub fn row_scale(lcp: &Lcp, i: usize) -> f64 {
    match lcp.matrix().diagonal(i).abs() {
        0.0 => lcp.matrix().row(i).iter().fold(0.0, |s, (_, a)| f64::max(s, a.abs())),
        s => s,
    }
}

/// max_i r_i, the dimensionless residual that every stop test and the judge use
/// ([`RowTerms::scaled_residual`]); ∞ if x is not finite.
pub fn scaled_residual(lcp: &Lcp, x: &[f64]) -> f64 {
    worst(lcp.len(), |i| row_residual(lcp, i, x))
}

/// r_i.
fn row_residual(lcp: &Lcp, i: usize, x: &[f64]) -> f64 {
    miss(lcp, i, x).relative()
}

fn miss(lcp: &Lcp, i: usize, x: &[f64]) -> Miss {
    let (lo, hi) = lcp.bounds(i, x);
    RowTerms::at(lcp, i, x).miss(x[i], lo, hi)
}

/// Whether max_i r_i is at most the tolerance. The rows are looked at from `first` on, where the last
/// look found one that is not: while it is not, nothing else needs to be computed.
pub fn is_within(lcp: &Lcp, x: &[f64], tolerance: f64, first: &mut usize) -> bool {
    let n = lcp.len();
    let is_outside = |&i: &usize| !(row_residual(lcp, i, x) <= tolerance);
    let outside = (0..n).map(|k| (*first + k) % n).find(is_outside);
    *first = outside.unwrap_or(*first);
    outside.is_none()
}

/// An answer whose steps are not below this part of those of Π(0) is none.
const BETTER: f64 = 0.1;

/// Whether x is nearer to a solution than doing nothing, x = Π(0), by a factor of ten: the longest step
/// max_i |x_i − Π(x_i − w_i/s_i)| √s_i has fallen to a tenth. Where Π(0) is within the tolerance itself,
/// every x is.
///
/// The scaled residual alone cannot tell: it becomes small for any x that is far enough away along a
/// direction with A d = 0.
pub fn is_worth_something(lcp: &Lcp, x: &[f64], tolerance: f64) -> bool {
    let misses = |x: &[f64]| -> Vec<Miss> { (0..lcp.len()).map(|i| miss(lcp, i, x)).collect() };
    let mut nothing = vec![0.0; lcp.len()];
    lcp.project_all(&mut nothing);
    is_better(&misses(x), &misses(&nothing), tolerance)
}

/// Whether the longest of these steps is a tenth of the longest of those of Π(0) at most, or Π(0) is
/// within the tolerance.
pub(super) fn is_better(misses: &[Miss], of_nothing: &[Miss], tolerance: f64) -> bool {
    let longest = |misses: &[Miss]| misses.iter().map(Miss::step).fold(f64::NEG_INFINITY, f64::max);
    longest(misses) <= longest(of_nothing) + libm::log2(BETTER)
        || of_nothing.iter().all(|miss| miss.relative() <= tolerance)
}

/// Whether x may be called a solution: the scaled residual is within the tolerance, and x is worth
/// something.
pub fn is_solution(lcp: &Lcp, x: &[f64], tolerance: f64) -> bool {
    scaled_residual(lcp, x) <= tolerance && is_worth_something(lcp, x, tolerance)
}

/// max_i |x_i − Π(x_i − w_i)|: zero exactly at the solutions; it mixes the units of x and w.
pub fn natural_residual(lcp: &Lcp, x: &[f64]) -> f64 {
    worst(lcp.len(), |i| x[i] - lcp.project(i, x[i] - lcp.row_w(i, x), x))
}

/// max_i |φ_i| with the Fischer-Burmeister function φ(a, b) = a + b − √(a² + b²) of the distance to
/// each bound and the w that pushes to it (Billups' form for two finite bounds).
pub fn fischer_burmeister(lcp: &Lcp, x: &[f64]) -> f64 {
    let phi = |a: f64, b: f64| if a.is_infinite() { b } else { a + b - a.hypot(b) };
    worst(lcp.len(), |i| {
        let ((lo, hi), w) = (lcp.bounds(i, x), lcp.row_w(i, x));
        phi(x[i] - lo, -phi(hi - x[i], -w))
    })
}

/// ½ xᵀ A x + bᵀ x, which solving an LCP with symmetric positive semidefinite A minimises. For
/// impulses and velocities its unit is the joule.
pub fn objective(lcp: &Lcp, x: &[f64]) -> f64 {
    (0..lcp.len()).map(|i| x[i] * (0.5 * lcp.matrix().row_dot(i, x) + lcp.b()[i])).sum()
}

/// |A x + b|₂ / |b|₂, the chapter's stop test. K&M (4), kept as a specimen: at a solution with an
/// active bound it does not vanish, because w does not (E04).
pub fn km4(lcp: &Lcp, x: &[f64]) -> f64 {
    euclidean(&lcp.w(x)) / euclidean(lcp.b())
}

/// |x − Π(x − w)|₂ / |b|₂, or the numerator alone where b = 0: the error by which Siconos judges an
/// LCP (`lcp_compute_error`); [`friction::merit::rr9118`](super::friction::merit::rr9118) is the same for
/// cones. It adds rows of different units, and grows with the number of rows.
pub fn siconos(lcp: &Lcp, x: &[f64]) -> f64 {
    let residual: Vec<f64> =
        (0..lcp.len()).map(|i| x[i] - lcp.project(i, x[i] - lcp.row_w(i, x), x)).collect();
    match euclidean(lcp.b()) {
        0.0 => euclidean(&residual),
        norm => euclidean(&residual) / norm,
    }
}

/// max_i |x_i − Π(x_i − w_i)| / max(1, |b|∞, |A|∞ |x|∞), |A|∞ the largest absolute row sum: what
/// DART's comparison of solvers holds against a relative tolerance of 1e-4. The 1 in it has a unit:
/// small impulses pass whatever they are.
pub fn dart(lcp: &Lcp, x: &[f64]) -> f64 {
    let row_sum = |i: usize| lcp.matrix().row(i).iter().map(|(_, a)| a.abs()).sum();
    let a = worst(lcp.len(), row_sum);
    let (b, x_size) = (worst(lcp.len(), |i| lcp.b()[i]), worst(lcp.len(), |i| x[i]));
    natural_residual(lcp, x) / f64::max(1.0, b).max(a * x_size)
}

/// The number of rows whose x lies strictly between its bounds.
pub fn free_rows(lcp: &Lcp, x: &[f64]) -> usize {
    (0..lcp.len())
        .filter(|&i| {
            let (lo, hi) = lcp.bounds(i, x);
            lo < x[i] && x[i] < hi
        })
        .count()
}

/// |v|₂.
pub(super) fn euclidean(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn worst(n: usize, row: impl Fn(usize) -> f64) -> f64 {
    (0..n)
        .map(|i| row(i).abs())
        .fold(0.0, |worst, r| if r.is_nan() { f64::INFINITY } else { worst.max(r) })
}
