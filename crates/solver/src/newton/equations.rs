//! Complementarity as nonsmooth equations H(x) = 0, row by row, as [`Newton`](crate::Newton)
//! describes.

/// The equations to solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Equations {
    /// The median of x − lo, w̃ and x − hi.
    #[default]
    MinimumMap,
    /// φ(x − lo, −φ(hi − x, −w̃)).
    FischerBurmeister,
}

/// H_i with its derivatives with respect to x_i, w̃_i, lo_i and hi_i.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row {
    pub(crate) value: f64,
    pub(crate) by_x: f64,
    pub(crate) by_w: f64,
    pub(crate) by_lo: f64,
    pub(crate) by_hi: f64,
}

impl Equations {
    /// H_i for these x_i, w̃_i and bounds.
    pub(crate) fn row(self, x: f64, w: f64, lo: f64, hi: f64) -> Row {
        match self {
            Equations::MinimumMap => minimum_map(x, w, lo, hi),
            Equations::FischerBurmeister => fischer_burmeister(x, w, lo, hi),
        }
    }
}

fn minimum_map(x: f64, w: f64, lo: f64, hi: f64) -> Row {
    let row = |value, by_x, by_w, by_lo, by_hi| Row { value, by_x, by_w, by_lo, by_hi };
    if w.min(x - lo) < x - hi {
        row(x - hi, 1.0, 0.0, 0.0, -1.0)
    } else if w < x - lo {
        row(w, 0.0, 1.0, 0.0, 0.0)
    } else {
        row(x - lo, 1.0, 0.0, -1.0, 0.0)
    }
}

fn fischer_burmeister(x: f64, w: f64, lo: f64, hi: f64) -> Row {
    let [inner, p, q] = phi(hi - x, -w);
    let [value, a, b] = phi(x - lo, -inner);
    Row { value, by_x: a + b * p, by_w: b * q, by_lo: -a, by_hi: -b * p }
}

/// φ(a, b) = a + b − √(a² + b²) with its derivatives; at (0, 0) the limit along a = b.
fn phi(a: f64, b: f64) -> [f64; 3] {
    if a == f64::INFINITY {
        return [b, 0.0, 1.0];
    }
    let r = lcplab_lcp::hypot(a, b);
    if r == 0.0 {
        let slope = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
        return [0.0, slope, slope];
    }
    // a + b − r loses all digits if one of a and b is small and the other positive
    let value = if a + b > 0.0 { 2.0 * a * b / (a + b + r) } else { a + b - r };
    [value, 1.0 - a / r, 1.0 - b / r]
}
