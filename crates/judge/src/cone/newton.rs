//! Newton's method in extended precision: the center of an enclosure.
//!
//! F is evaluated exactly, F'(c)⁻¹ in double precision after scaling rows and columns by powers of
//! two, and c is rounded to multiples of 2^−k. Each step gains the digits that double precision
//! leaves of the condition number.

use dashu_int::ops::Abs;

use super::enclosure::{Enclosure, Krawczyk};
use super::redundant::{Dependence, largest_offset};
use super::system::{AtPoint, System};
use crate::inverse::inverse;
use lcplab_lcp::exact::Point;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, exponent, floor};

/// The last digit of the center is 2^−192 of the largest |x|.
const DIGITS: isize = 192;
/// With a well-conditioned system about five steps reach the last digit.
const MOST_STEPS: usize = 40;
/// A step below 2^32 units in the last place is the last one: entries that are rounded to one unit
/// can move others by that much.
const LAST_STEP: isize = 32;
/// Newton's method has failed if this number of steps are not shorter than those before.
const MOST_STALLS: usize = 3;
/// The radius is doubled at most this often.
const MOST_GROWTHS: usize = 60;

/// The zero of the system near x, to the last digit; x has one entry per row, and redundant rows
/// keep theirs. `None` if the steps
/// do not become shorter, or if they lead farther from x than the bounds.
pub(super) fn center(system: &System<'_>, x: &[f64], bounds: Option<&[f64]>) -> Option<Center> {
    let one = dyadic(1.0);
    let largest = x.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    let unit = (exponent(&dyadic(largest)).unwrap_or(0) - DIGITS).min(0);
    let half = dyadic(0.5) << unit;
    let start = |i: usize| system.given(i).unwrap_or_else(|| dyadic(x[i]));
    let mut c: Vec<Dyadic> = (0..x.len()).map(start).collect();
    let (mut last, mut stalls) = (isize::MAX, 0);
    for _ in 0..MOST_STEPS {
        let at = system.at(&c, &one);
        let scaled = Scaled::new(&system.derivatives(&at))?;
        let step = scaled.solve(&system.values(&at))?;
        let length = step.iter().filter_map(exponent).max();
        for (&i, step) in system.unknowns().iter().zip(&step) {
            c[i] = floor(&(&c[i] - step + &half), unit);
        }
        let is_near = bounds.is_none_or(|bounds| {
            // The box itself is checked later; here it may be a little larger.
            let is_near = |i: usize| (&c[i] - dyadic(x[i])).abs() <= dyadic(bounds[i]) << 1;
            (0..x.len()).all(is_near)
        });
        match length {
            length if length.is_none_or(|length| length <= unit + LAST_STEP) => {
                let inverse = inverse_at(system, &system.at(&c, &one))?;
                return Some(Center { x: c, unit, inverse });
            }
            _ if !is_near || stalls == MOST_STALLS => return None,
            length => {
                stalls += usize::from(length >= Some(last));
                last = length.unwrap_or(last);
            }
        }
    }
    None
}

/// An approximate inverse of the derivatives at a point with the denominator 1; `None` if they are
/// singular in double precision.
pub(super) fn inverse_at(system: &System<'_>, at: &AtPoint<'_>) -> Option<Vec<Vec<f64>>> {
    Scaled::new(&system.derivatives(at))?.inverse()
}

/// A point, and an approximate inverse of the derivatives there.
pub(super) struct Center {
    pub x: Vec<Dyadic>,
    /// The last binary digit of x.
    unit: isize,
    inverse: Vec<Vec<f64>>,
}

impl Center {
    /// A box around the center that its map contracts, whether or not the inequalities hold; `None`
    /// if it would be larger than x: the bound of the image is quadratic in the radius, and from
    /// there on each round doubles the digits.
    pub fn enclosure(self, system: &System<'_>, redundant: Vec<Dependence>) -> Option<Enclosure> {
        let bias_change = largest_offset(system, &redundant);
        let one = dyadic(1.0);
        let at = system.at(&self.x, &one);
        let test = Krawczyk::new(system, &at, &self.inverse);
        let last = dyadic(1.0) << self.unit;
        let mut radius = vec![Dyadic::ZERO; self.x.len()];
        system.unknowns().iter().for_each(|&i| radius[i] = last.clone());
        for _ in 0..MOST_GROWTHS {
            let image = test.image(system, &radius);
            let mut is_inside = true;
            for (image, &i) in image.into_iter().zip(system.unknowns()) {
                if image >= radius[i] {
                    is_inside = false;
                    radius[i] = floor(&(image << 1), self.unit) + &last;
                    if exponent(&radius[i]) > Some(self.unit + DIGITS) {
                        return None;
                    }
                }
            }
            if is_inside {
                let center = Point::new(self.x, one);
                let states = system.states().to_vec();
                let inverse = self.inverse;
                return Some(Enclosure { states, redundant, bias_change, center, radius, inverse });
            }
        }
        None
    }
}

/// The inverse of a matrix in double precision, and the exponents of its scaling:
/// a_ij 2^(−row_i − column_j) has the inverse s.
struct Scaled {
    inverse: Vec<Vec<f64>>,
    row: Vec<isize>,
    column: Vec<isize>,
}

impl Scaled {
    /// `None` if the matrix is singular in double precision.
    fn new(a: &[Vec<Dyadic>]) -> Option<Self> {
        let row: Option<Vec<isize>> =
            a.iter().map(|row| row.iter().filter_map(exponent).max()).collect();
        let row = row?;
        let largest =
            |j: usize| a.iter().zip(&row).filter_map(|(a, row)| Some(exponent(&a[j])? - row)).max();
        let column: Option<Vec<isize>> = (0..a.len()).map(largest).collect();
        let column = column?;
        let entry =
            |i: usize, j: usize| (a[i][j].clone() << (-row[i] - column[j])).to_f64().value();
        let scaled = (0..a.len()).map(|i| (0..a.len()).map(|j| entry(i, j)).collect()).collect();
        Some(Scaled { inverse: inverse(scaled)?, row, column })
    }

    /// a⁻¹ f, to the precision of the inverse; `None` if an entry is not a finite number.
    fn solve(&self, f: &[Dyadic]) -> Option<Vec<Dyadic>> {
        let scaled: Vec<Dyadic> =
            f.iter().zip(&self.row).map(|(f, row)| f.clone() << -row).collect();
        let Some(size) = scaled.iter().filter_map(exponent).max() else {
            return Some(vec![Dyadic::ZERO; f.len()]);
        };
        let scaled: Vec<f64> = scaled.into_iter().map(|f| (f << -size).to_f64().value()).collect();
        let product = |row: &Vec<f64>| row.iter().zip(&scaled).map(|(s, f)| s * f).sum::<f64>();
        let entry = |(row, column): (&Vec<f64>, &isize)| {
            let product = Some(product(row)).filter(|product| product.is_finite())?;
            Some(dyadic(product) << (size - column))
        };
        self.inverse.iter().zip(&self.column).map(entry).collect()
    }

    /// a⁻¹; `None` if an entry is not a finite number.
    fn inverse(&self) -> Option<Vec<Vec<f64>>> {
        let entry = |i: usize, j: usize| {
            let value = (dyadic(self.inverse[i][j]) << (-self.column[i] - self.row[j])).to_f64();
            Some(value.value()).filter(|value| value.is_finite())
        };
        let n = self.row.len();
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
    }
}
