//! Encloses a solution in floating point, which proves most answers in microseconds.
//!
//! The active set of x gives one linear equation M x = c per row that is not at a fixed bound:
//! w_i = 0, or x_i ∓ μ_i x_k = 0 for a sliding row. With any matrix R and any point y
//!
//! ```text
//! x* − y = −R (M y − c) + (I − R M) (x* − y)
//! |x*_i − y_i| ≤ v_i + E_i max_j v_j / (1 − max_j E_j)      v = |R| |M y − c|,  E_i = Σ_j |I − R M|_ij
//! ```
//!
//! If every E_i is below 1, M is regular and x* exists (Rump 1999). Here R is the rounded inverse
//! of M, and y is x corrected by a few steps of y ← y − R (M y − c), with compensated sums. All
//! quantities on the right are rounded up. Then the inequalities of every row are checked for all
//! points this close to y. Where one of them holds with equality, as at a kink, or where M is
//! singular, nothing is proved here, and [`exact`](crate::exact) decides with fractions.

use lcplab_lcp::Lcp;
use lcplab_lcp::accurate::Sum;
use lcplab_lcp::exact::Side;
use lcplab_lcp::merit::Sum as _;

use crate::exact::sides;
use crate::interval::{Interval, add_up};
use crate::inverse::inverse;
use crate::residual::Rows;

/// Each step gains the digits that double precision leaves of the condition number.
const MOST_STEPS: usize = 4;
/// A step is not worth taking if it is smaller than this fraction of those before.
const LAST_STEP: f64 = 1e-10;
/// The unit roundoff.
const U: f64 = f64::EPSILON / 2.0;
/// More than all rounding errors of a sum of up to 100,000 positive numbers.
const SLACK: f64 = 1.0 + 1e-10;
/// Sums of terms in this range neither overflow nor lose digits to underflow.
const SAFE: std::ops::Range<f64> = 1e-250..1e250;
/// The radius of the enclosure is at most this fraction of the distance that is stated.
const PRECISION: f64 = 1e-6;

/// max_i |x_i − x*_i| for an exact solution x* on the active set of x, rounded up; `None` if none
/// can be enclosed closely enough to state this distance to six digits.
pub(crate) fn distance(at: &Rows<'_>) -> Option<f64> {
    let system = System::of(at)?;
    let matrix = system.matrix();
    let inverse = inverse(matrix.clone())?;
    let point = system.solve(at.x, &matrix, &inverse)?;
    if !(0..at.x.len()).all(|i| point.satisfies(i)) {
        return None;
    }
    let distance = (0..at.x.len()).map(|i| point.distance_from(at.x[i], i)).fold(0.0, f64::max);
    let radius = point.radius.iter().copied().fold(0.0, f64::max);
    (radius <= PRECISION * distance).then_some(distance)
}

/// A linear form Σ a_j x_j + b.
struct Form {
    terms: Vec<(usize, f64)>,
    constant: f64,
}

impl Form {
    /// w_i.
    fn of_row(lcp: &Lcp, i: usize) -> Self {
        Form { terms: lcp.matrix().row(i).iter().collect(), constant: lcp.b()[i] }
    }

    /// Its value at start + shift, and a bound on the rounding error: Dot2 of Ogita, Rump & Oishi
    /// (2005). `None` if products may overflow or underflow.
    fn value(&self, start: &[f64], shift: &[f64]) -> Option<(f64, f64)> {
        let (mut sum, mut size) = (Sum::default(), self.constant.abs());
        sum.add_product(self.constant, 1.0);
        for &(j, a) in &self.terms {
            for x in [start[j], shift[j]].into_iter().filter(|x| *x != 0.0) {
                sum.add_product(a, x);
                size += (a * x).abs();
            }
        }
        let products = (2 * self.terms.len() + 1) as f64 * U;
        let error = 2.0 * U * sum.value().abs() + 4.0 * products * products * size;
        (size == 0.0 || SAFE.contains(&size))
            .then(|| (sum.value(), error * SLACK + f64::MIN_POSITIVE))
    }
}

/// The equations of the active set of x.
struct System<'a> {
    lcp: &'a Lcp,
    sides: Vec<Side>,
    /// The rows whose x is not a fixed bound.
    unknowns: Vec<usize>,
    /// One equation per unknown.
    equations: Vec<Form>,
    /// The fixed bounds; x for the unknowns.
    start: Vec<f64>,
}

impl<'a> System<'a> {
    /// `None` if a row is at an infinite bound.
    fn of(at: &Rows<'a>) -> Option<Self> {
        let (lcp, sides) = (at.lcp, sides(at));
        let is_unknown = |i: usize| sides[i] == Side::Free || lcp.is_coupled(i);
        let unknowns: Vec<usize> = (0..lcp.len()).filter(|&i| is_unknown(i)).collect();
        let start: Vec<f64> = (0..lcp.len())
            .map(|i| match sides[i] {
                _ if is_unknown(i) => at.x[i],
                Side::Upper => lcp.hi()[i],
                _ => lcp.lo()[i],
            })
            .collect();
        let equation = |&i: &usize| match (sides[i], lcp.coupled_to(i)) {
            (Side::Lower, Some((k, mu))) => Form { terms: vec![(i, 1.0), (k, mu)], constant: 0.0 },
            (Side::Upper, Some((k, mu))) => Form { terms: vec![(i, 1.0), (k, -mu)], constant: 0.0 },
            _ => Form::of_row(lcp, i),
        };
        let equations = unknowns.iter().map(equation).collect();
        start.iter().all(|x| x.is_finite()).then_some(System {
            lcp,
            sides,
            unknowns,
            equations,
            start,
        })
    }

    /// M, one row per equation.
    fn matrix(&self) -> Vec<Vec<f64>> {
        let mut position = vec![None; self.start.len()];
        self.unknowns.iter().enumerate().for_each(|(k, &i)| position[i] = Some(k));
        let row = |equation: &Form| {
            let mut row = vec![0.0; self.unknowns.len()];
            for &(j, a) in &equation.terms {
                if let Some(k) = position[j] {
                    row[k] += a;
                }
            }
            row
        };
        self.equations.iter().map(row).collect()
    }

    /// y and the largest |x*_i − y_i|, row by row.
    fn solve(
        &self,
        x: &[f64],
        matrix: &[Vec<f64>],
        inverse: &[Vec<f64>],
    ) -> Option<Solution<'_, 'a>> {
        let largest = |of: &[f64]| of.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        let mut shift = vec![0.0; x.len()];
        let mut left = self.left(&shift)?;
        for _ in 0..MOST_STEPS {
            let entry = |row: &Vec<f64>| row.iter().zip(&left).map(|(r, (left, _))| r * left).sum();
            let step: Vec<f64> = inverse.iter().map(entry).collect();
            if largest(&step) <= LAST_STEP * largest(&shift) {
                break;
            }
            self.unknowns.iter().zip(step).for_each(|(&i, step)| shift[i] -= step);
            left = self.left(&shift)?;
        }
        let left: Vec<f64> = left.into_iter().map(|(left, error)| left.abs() + error).collect();
        let misses: Vec<f64> = inverse.iter().map(|row| miss(row, &left)).collect();
        let parts: Vec<f64> =
            inverse.iter().enumerate().map(|(i, row)| rest(i, row, matrix)).collect();
        let contraction = largest(&parts);
        if !(contraction < 0.5) || shift.iter().any(|shift| !shift.is_finite()) {
            return None;
        }
        let mut radius = vec![0.0; x.len()];
        let farthest = largest(&misses) / (1.0 - contraction);
        for (k, &i) in self.unknowns.iter().enumerate() {
            radius[i] = (misses[k] + parts[k] * farthest) * SLACK;
        }
        Some(Solution { system: self, shift, radius })
    }

    /// M y − c, and bounds on the rounding errors.
    fn left(&self, shift: &[f64]) -> Option<Vec<(f64, f64)>> {
        self.equations.iter().map(|equation| equation.value(&self.start, shift)).collect()
    }
}

/// v_i, from row i of R.
fn miss(row: &[f64], left: &[f64]) -> f64 {
    let sum: f64 = row.iter().zip(left).map(|(r, left)| r.abs() * left).sum();
    sum * SLACK + f64::MIN_POSITIVE
}

/// E_i, from row i of R.
fn rest(i: usize, row: &[f64], matrix: &[Vec<f64>]) -> f64 {
    let mut left = vec![0.0; row.len()];
    let mut size = vec![0.0; row.len()];
    (left[i], size[i]) = (1.0, 1.0);
    for (r, equation) in row.iter().zip(matrix) {
        for (j, m) in equation.iter().enumerate() {
            left[j] -= r * m;
            size[j] += (r * m).abs();
        }
    }
    let rounding = 2.0 * (row.len() + 2) as f64 * U;
    let sum: f64 = left.iter().zip(size).map(|(left, size)| left.abs() + rounding * size).sum();
    sum * SLACK
}

/// y = start + shift, and the radius around it that contains x*; both 0 at fixed bounds.
struct Solution<'s, 'a> {
    system: &'s System<'a>,
    shift: Vec<f64>,
    radius: Vec<f64>,
}

impl Solution<'_, '_> {
    fn x(&self, i: usize) -> Interval {
        Interval::from(self.system.start[i])
            + Interval::from(self.shift[i])
            + Interval::around_zero(self.radius[i])
    }

    fn w(&self, i: usize) -> Option<Interval> {
        let form = Form::of_row(self.system.lcp, i);
        let (w, error) = form.value(&self.system.start, &self.shift)?;
        let spread: f64 = form.terms.iter().map(|&(j, a)| a.abs() * self.radius[j]).sum();
        let radius = add_up(error, spread * SLACK + f64::MIN_POSITIVE);
        Some(Interval::from(w) + Interval::around_zero(radius))
    }

    /// Whether the inequalities of row i hold at every point within the radius.
    fn satisfies(&self, i: usize) -> bool {
        let lcp = self.system.lcp;
        match (self.system.sides[i], lcp.coupled_to(i)) {
            (Side::Free, Some((k, mu))) => {
                self.x(i).magnitude() <= (Interval::from(mu) * self.x(k)).lo
            }
            (Side::Free, None) => {
                let x = self.x(i);
                lcp.lo()[i] <= x.lo && x.hi <= lcp.hi()[i]
            }
            _ if self.is_fixed(i) => true,
            (Side::Lower, _) => self.w(i).is_some_and(|w| w.lo > 0.0),
            (Side::Upper, _) => self.w(i).is_some_and(|w| w.hi < 0.0),
        }
    }

    /// Whether both bounds of row i are equal at x*.
    fn is_fixed(&self, i: usize) -> bool {
        let System { lcp, sides, start, .. } = self.system;
        match lcp.coupled_to(i) {
            Some((k, mu)) => mu == 0.0 || sides[k] != Side::Free && start[k] == 0.0,
            None => lcp.lo()[i] == lcp.hi()[i],
        }
    }

    /// The largest |x_i − x*_i|.
    fn distance_from(&self, x: f64, i: usize) -> f64 {
        let away = (Interval::from(self.system.start[i]) - Interval::from(x)).magnitude();
        add_up(add_up(away, self.shift[i].abs()), self.radius[i])
    }
}
