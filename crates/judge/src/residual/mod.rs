//! The judge's own residuals, row by row: how far x is from a solution. No solver uses this code.
//!
//! ```text
//! w_i = Σ_j a_ij x_j + b_i        T_i = max(Σ_j |a_ij x_j| + |b_i|, s_i · the problem's scale)
//! s_i = |a_ii|, else max_j |a_ij|, else 1
//! e_i = min(T_i / s_i, R_i)       R_i: the size of the bounds, see `Rows::reach`
//! r_i = |x_i − Π_i(x_i − e_i w_i / T_i)| / e_i        0/0 = 0
//! ```
//!
//! w is summed as if in twice the precision (Dot2 of Ogita, Rump & Oishi 2005). The rows of a cone
//! or a polygon are measured together, per contact: [`cone`], [`polygon`].

pub(crate) mod cone;
pub(crate) mod polygon;
mod wide;

pub(crate) use wide::Wide;

use lcplab_lcp::Lcp;

/// Sums of terms in this range neither overflow nor lose digits to underflow.
const SAFE: std::ops::Range<f64> = 1e-250..1e250;
/// A bound ±μ x_k is a rounded product: an x_i within this fraction of it counts as being at it.
const PRODUCT_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// w_i and the sizes it is compared with.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row {
    /// w_i = (A x + b)_i.
    pub w: Wide,
    /// T_i: the size of the terms that add up to w_i.
    pub terms: Wide,
    /// s_i: the change of w_i per change of x_i; 1 for a row of zeros.
    pub scale: Wide,
}

/// The distance of a row, or of the tangents of a contact, from its projected step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Residual {
    /// |x − Π(x − w/s)| √s: the square root of an energy in any units of x and w.
    pub step: Wide,
    /// r_i.
    pub relative: f64,
}

/// The rows of a problem at some x.
pub(crate) struct Rows<'a> {
    pub lcp: &'a Lcp,
    pub x: &'a [f64],
    pub rows: Vec<Row>,
}

impl<'a> Rows<'a> {
    pub fn at(lcp: &'a Lcp, x: &'a [f64]) -> Self {
        Rows { lcp, x, rows: (0..lcp.len()).map(|i| row(lcp, i, x)).collect() }
    }

    /// w, rounded.
    pub fn w(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row.w.value()).collect()
    }

    /// The residuals of all rows with their bounds at x.
    pub fn residuals(&self) -> Vec<Residual> {
        (0..self.rows.len()).map(|i| self.residual(i)).collect()
    }

    /// The residual of row i with its bounds at x.
    pub fn residual(&self, i: usize) -> Residual {
        let (lo, hi) = self.lcp.bounds(i, self.x);
        let is_at = |bound: f64| {
            self.lcp.is_coupled(i) && (self.x[i] - bound).abs() <= PRODUCT_ROUNDING * hi
        };
        let own = [lo, hi].into_iter().find(|&bound| is_at(bound)).unwrap_or(self.x[i]);
        self.rows[i].residual(own, lo, hi, self.reach(i))
    }

    /// R_i: the size of the bounds of row i. An x_i that differs from a bound by as much as the
    /// bound is large is not at it, however large the terms of the row are.
    ///
    /// ```text
    /// R_i = max(|lo_i|, |hi_i|) of those that are finite, at least the scale; ∞ if they are all 0
    /// R_i = μ_i max(x_k, e_k), ∞ if that is 0          where row i is coupled to row k
    /// ```
    fn reach(&self, i: usize) -> Wide {
        if let Some((k, mu)) = self.lcp.coupled_to(i) {
            return friction_reach(mu, self.size(k));
        }
        let size = |bound: f64| if bound.is_finite() { bound.abs() } else { 0.0 };
        match size(self.lcp.lo()[i]).max(size(self.lcp.hi()[i])) {
            0.0 => Wide::INFINITY,
            reach => reach.max(self.lcp.scale()).into(),
        }
    }

    /// max(x_k, e_k): the size of x_k, or of its uncertainty if that is larger.
    pub fn size(&self, k: usize) -> Wide {
        let row = &self.rows[k];
        (row.terms / row.scale).min(self.reach(k)).max(self.x[k].into())
    }
}

impl Row {
    /// The residual of an x between these bounds.
    pub fn residual(&self, x: f64, lo: f64, hi: f64, reach: Wide) -> Residual {
        let Row { w, terms, scale } = *self;
        let room = |bound: f64| Wide::from(x) - bound.into();
        let clamped = |step: Wide, below: Wide, above: Wide| step.min(below).max(above).abs();
        // |x − Π(x − w/s)| s
        let size = clamped(w, room(lo) * scale, room(hi) * scale);
        let relative = if scale * reach < terms {
            clamped(w / terms, room(lo) / reach, room(hi) / reach).relative_to(1.0.into())
        } else {
            size.relative_to(terms)
        };
        let step = if size.is_zero() { Wide::ZERO } else { size / scale.sqrt() };
        Residual { step, relative }
    }
}

/// R of friction with this μ under a normal force of this [size](Rows::size).
pub(crate) fn friction_reach(mu: f64, normal: Wide) -> Wide {
    match Wide::from(mu) * normal {
        reach if reach.is_zero() => Wide::INFINITY,
        reach => reach,
    }
}

/// Whether x is at least ten times closer to a solution than Π(0): its longest step is at most a
/// tenth of that of Π(0). Always true if Π(0) is within the tolerance.
///
/// The relative residual alone is not sufficient: it becomes small for any x that is far enough
/// away along a direction with A d = 0.
pub(crate) fn improves_on_zero(
    residuals: &[Residual],
    at_zero: &[Residual],
    tolerance: f64,
) -> bool {
    let longest = |all: &[Residual]| all.iter().map(|own| own.step).fold(Wide::ZERO, Wide::max);
    longest(residuals) <= longest(at_zero) * 0.1.into()
        || at_zero.iter().all(|residual| residual.relative <= tolerance)
}

/// The first row with the largest residual, and that residual.
pub(crate) fn worst(residuals: impl Iterator<Item = f64>) -> (usize, f64) {
    residuals.enumerate().fold((0, 0.0), |worst, (i, r)| if r > worst.1 { (i, r) } else { worst })
}

fn row(lcp: &Lcp, i: usize, x: &[f64]) -> Row {
    let products = || lcp.matrix().row(i).iter().map(|(j, a)| (a, x[j])).chain([(lcp.b()[i], 1.0)]);
    let (w, terms) = match sums(products()) {
        (w, terms) if SAFE.contains(&terms) || !terms.is_finite() && !is_finite(x) => {
            (Wide::from(w), Wide::from(terms))
        }
        _ => scaled_sums(products().collect()),
    };
    let scale = Wide::from(row_scale(lcp, i));
    let rest = scale * lcp.scale().into();
    let scale = if scale.is_zero() { Wide::from(1.0) } else { scale };
    Row { w, terms: terms.max(rest), scale }
}

/// s_i, but 0 for a row of zeros.
pub(crate) fn row_scale(lcp: &Lcp, i: usize) -> f64 {
    match lcp.matrix().diagonal(i).abs() {
        0.0 => lcp.matrix().row(i).iter().fold(0.0, |s, (_, a)| f64::max(s, a.abs())),
        own => own,
    }
}

fn is_finite(x: &[f64]) -> bool {
    x.iter().all(|x| x.is_finite())
}

/// Σ a x and Σ |a x|.
fn sums(products: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    let (mut sum, mut error, mut terms) = (0.0f64, 0.0f64, 0.0);
    for (a, x) in products {
        let product = a * x;
        // a x − product
        error += a.mul_add(x, -product);
        let next = sum + product;
        let part = next - sum;
        // sum + product − next
        error += (sum - (next - part)) + (product - part);
        sum = next;
        terms += product.abs();
    }
    (sum + error, terms)
}

/// The same sums in units of a power of two near the largest product, if products overflow or
/// underflow.
fn scaled_sums(products: Vec<(f64, f64)>) -> (Wide, Wide) {
    let products = products.into_iter().filter(|&(a, x)| a != 0.0 && x != 0.0);
    let pairs: Vec<[(f64, i64); 2]> =
        products.map(|(a, x)| [a, x].map(|value| Wide::from(value).parts())).collect();
    let largest = pairs.iter().map(|[(_, m), (_, k)]| m + k).max().unwrap_or(0);
    let scaled = |[(a, m), (x, k)]: [(f64, i64); 2]| (a, Wide::new(x, m + k - largest).value());
    let (w, terms) = sums(pairs.into_iter().map(scaled));
    (Wide::new(w, largest), Wide::new(terms, largest))
}
