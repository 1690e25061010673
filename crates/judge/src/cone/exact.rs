//! Exact solutions of cone problems in which every contact sticks or is open.
//!
//! ```text
//! open    x_n = x_t = 0      w_n ≥ 0; under the associated law w_n ≥ μ |w_t|, that is w_n² ≥ μ² (w_t1² + w_t2²)
//! sticks  w_n = w_t = 0      x_n ≥ 0 and |x_t| ≤ μ x_n, that is x_t1² + x_t2² ≤ μ² x_n²
//! ```
//!
//! These are linear equations and polynomial inequalities with rational coefficients, which can be
//! decided exactly. A contact with μ = 0 has x_t = 0 and any w_t. The equations of a sliding
//! contact contain square roots; nothing is proved then.

use dashu_ratio::RBig;

use super::super::exact::{is_within, sides};
use super::super::residual::Rows;
use lcplab_problem::exact::dyadic::{Dyadic, dyadic};
use lcplab_problem::exact::{Exact, Point, Side};
use lcplab_problem::friction::{ConeProblem, Contact, Law};

/// The distance max |x − x*|, rounded up, of an exact solution x* in which each contact is open or
/// sticks as in x. `bounds`, if given, limits the distance of each entry.
pub fn prove(problem: &ConeProblem, x: &[f64], bounds: Option<&[f64]>) -> Option<f64> {
    let friction = problem.friction();
    let boxed = friction.coupled_box();
    let exact = Exact::new(&boxed);
    let mut sides = sides(&Rows::at(&boxed, x));
    for contact in friction.contacts() {
        let side = if sides[contact.rows[0]] == Side::Free { Side::Free } else { Side::Lower };
        let tangential = if contact.mu == 0.0 { Side::Lower } else { side };
        contact.rows.iter().zip([side, tangential, tangential]).for_each(|(&i, s)| sides[i] = s);
    }
    let inside: Vec<f64> = (0..x.len()).map(|i| boxed.project(i, x[i], x)).collect();
    let (point, _) = exact.point(&sides, &inside)?;
    let at = ExactCheck { exact: &exact, point: &point, law: problem.law() };
    let solves = friction.others().iter().all(|&i| at.row_holds(i))
        && friction.contacts().iter().all(|contact| at.contact_holds(contact, &sides));
    let entries: Vec<RBig> = if bounds.is_some() { point.entries() } else { Vec::new() };
    let is_close = bounds.is_none_or(|bounds| is_within(x, &entries, bounds));
    (solves && is_close).then(|| point.distance(x))
}

/// A point and the problem to check it against; all numbers are multiplied by the point's positive
/// denominator.
struct ExactCheck<'a> {
    exact: &'a Exact,
    point: &'a Point,
    law: Law,
}

impl ExactCheck<'_> {
    /// Whether a row that belongs to no contact is solved.
    fn row_holds(&self, i: usize) -> bool {
        let (lo, hi) = self.exact.scaled_bounds(i, self.point);
        let (w, x) = (self.exact.scaled_w(i, self.point), self.point.scaled(i));
        lo.as_ref().is_none_or(|lo| x >= lo)
            && hi.as_ref().is_none_or(|hi| x <= hi)
            && (w <= Dyadic::ZERO || lo.as_ref() == Some(x))
            && (w >= Dyadic::ZERO || hi.as_ref() == Some(x))
    }

    fn contact_holds(&self, contact: &Contact, sides: &[Side]) -> bool {
        let mu = dyadic(contact.mu);
        let w = contact.rows.map(|i| self.exact.scaled_w(i, self.point));
        let x = contact.rows.map(|i| self.point.scaled(i).clone());
        let [n, _, _] = contact.rows;
        if sides[n] == Side::Free {
            let is_still = w[0] == Dyadic::ZERO
                && (contact.mu == 0.0 || w[1] == Dyadic::ZERO && w[2] == Dyadic::ZERO);
            return is_still && is_in_cone(&mu, &x);
        }
        let is_zero = x.iter().all(|x| *x == Dyadic::ZERO);
        is_zero
            && match self.law {
                Law::Coulomb => w[0] >= Dyadic::ZERO,
                // w_n ≥ μ |w_t|: w lies in the dual cone
                Law::Associated => w[0] >= Dyadic::ZERO && &w[0] * &w[0] >= &mu * &mu * squares(&w),
            }
    }
}

/// Whether |x_t| ≤ μ x_n.
fn is_in_cone(mu: &Dyadic, x: &[Dyadic; 3]) -> bool {
    let limit = mu * &x[0];
    x[0] >= Dyadic::ZERO && squares(x) <= &limit * &limit
}

/// The squared length of the tangential part.
fn squares([_, t1, t2]: &[Dyadic; 3]) -> Dyadic {
    t1 * t1 + t2 * t2
}
