//! A vector of fractions over one denominator.

use dashu_int::IBig;
use dashu_int::ops::Abs;
use dashu_ratio::RBig;

use super::Place;
use super::dyadic::{Dyadic, dyadic, rational, rounded_up, whole};

/// An exact vector.
///
/// ```
/// use lcplab_lcp::exact::Point;
/// use lcplab_lcp::exact::dyadic::dyadic;
///
/// let x = Point::new(vec![dyadic(1.0), dyadic(2.0)], dyadic(3.0)); // (1/3, 2/3)
/// assert_eq!((x.len(), x.is_empty()), (2, false));
/// assert_eq!((x.scaled(1), x.denominator()), (&dyadic(2.0), &dyadic(3.0)));
/// assert_eq!(x.entries()[1].to_string(), "2/3");
/// // The nearest floating-point number to 1/3 is 1.9e-17 off; that of 2/3 twice as far.
/// let distance = x.distance(&[1.0 / 3.0, 2.0 / 3.0]);
/// assert!(3.7e-17 < distance && distance < 3.8e-17);
/// ```
#[derive(Debug, Clone)]
pub struct Point {
    numerators: Vec<Dyadic>,
    /// Always positive.
    denominator: Dyadic,
}

impl Point {
    /// The point with these numerators over a positive denominator.
    pub fn new(numerators: Vec<Dyadic>, denominator: Dyadic) -> Self {
        Point { numerators, denominator }
    }

    /// The point at which the unknowns have these values (numerators over the denominator).
    pub(super) fn of(places: &[Place], numerators: Vec<IBig>, denominator: IBig) -> Self {
        let numerators: Vec<Dyadic> = numerators.into_iter().map(whole).collect();
        let denominator = whole(denominator);
        let numerator = |place: &Place| match place {
            Place::Known(x) => x * &denominator,
            Place::Times(u, factor) => factor * &numerators[*u],
        };
        Point { numerators: places.iter().map(numerator).collect(), denominator }
    }

    /// The number of entries.
    pub fn len(&self) -> usize {
        self.numerators.len()
    }

    /// Whether there are no entries.
    pub fn is_empty(&self) -> bool {
        self.numerators.is_empty()
    }

    /// Entry i times the denominator.
    pub fn scaled(&self, i: usize) -> &Dyadic {
        &self.numerators[i]
    }

    /// The common denominator of all entries.
    pub fn denominator(&self) -> &Dyadic {
        &self.denominator
    }

    /// All entries as fractions.
    pub fn entries(&self) -> Vec<RBig> {
        let denominator = rational(&self.denominator);
        self.numerators.iter().map(|x| rational(x) / &denominator).collect()
    }

    /// max_i |x_i − x*_i| for finite x, rounded up.
    pub fn distance(&self, x: &[f64]) -> f64 {
        // The differences are scaled by the denominator, so that one fraction is reduced instead of
        // n.
        let distances =
            self.numerators.iter().zip(x).map(|(own, &x)| own - dyadic(x) * &self.denominator);
        let largest = distances.map(Abs::abs).max().unwrap_or(Dyadic::ZERO);
        rounded_up(&(rational(&largest) / rational(&self.denominator)))
    }
}
