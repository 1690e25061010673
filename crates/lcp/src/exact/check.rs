//! Checks whether a point solves a problem, by the definition, row by row.

use super::dyadic::Dyadic;
use super::{Bounds, Exact, Point, Side};

impl Exact {
    /// Whether a point solves the problem, by the definition.
    pub fn is_solved_by(&self, x: &Point) -> bool {
        (0..self.len()).all(|i| {
            let w = self.scaled_w(i, x);
            let ((lo, hi), x) = (self.scaled_bounds(i, x), x.scaled(i));
            lo.as_ref().is_none_or(|lo| x >= lo)
                && hi.as_ref().is_none_or(|hi| x <= hi)
                && (w <= Dyadic::ZERO || lo.as_ref() == Some(x))
                && (w >= Dyadic::ZERO || hi.as_ref() == Some(x))
        })
    }

    /// Whether x can be moved from a solution along both d and −d within all bounds, with w
    /// unchanged.
    pub fn is_free_along(&self, d: &Point, solution: &Point, sides: &[Side]) -> bool {
        let zero = |i: usize| *d.scaled(i) == Dyadic::ZERO;
        let inside = |i: usize| {
            let ((lo, hi), x) = (self.scaled_bounds(i, solution), solution.scaled(i));
            lo.is_none_or(|lo| *x > lo) && hi.is_none_or(|hi| *x < hi)
        };
        (0..self.len()).all(|i| {
            let stays = self.scaled_w(i, d) == &self.b[i] * d.denominator();
            let has_way = match &self.bounds[i] {
                Bounds::Coupled(k, _) if sides[i] != Side::Free => inside(*k) || zero(*k),
                Bounds::Coupled(k, _) => zero(i) && zero(*k) || inside(i),
                Bounds::Box(..) => zero(i) || inside(i),
            };
            stays && has_way
        })
    }

    /// w_i times the point's denominator.
    pub fn scaled_w(&self, i: usize, x: &Point) -> Dyadic {
        let nonzero = self.a[i].iter().filter(|(j, _)| *x.scaled(*j) != Dyadic::ZERO);
        let terms = nonzero.map(|(j, a)| a * x.scaled(*j));
        terms.fold(&self.b[i] * x.denominator(), |sum, term| sum + term)
    }

    /// The bounds of row i at a point, times its denominator; `None` for infinity.
    pub fn scaled_bounds(&self, i: usize, x: &Point) -> (Option<Dyadic>, Option<Dyadic>) {
        let scaled = |bound: &Option<Dyadic>| bound.as_ref().map(|b| b * x.denominator());
        match &self.bounds[i] {
            Bounds::Box(lo, hi) => (scaled(lo), scaled(hi)),
            Bounds::Coupled(k, mu) => {
                let limit = mu * x.scaled(*k).max(&Dyadic::ZERO);
                (Some(-limit.clone()), Some(limit))
            }
        }
    }
}
