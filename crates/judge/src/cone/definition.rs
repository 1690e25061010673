//! Whether an exact point solves a cone problem, by the definition of its law.
//!
//! ```text
//! both         x_n ≥ 0,  x_t1² + x_t2² ≤ μ² x_n²,  w_n ≥ 0
//! Coulomb      x_n = 0 or w_n = 0;  w_t = 0, or x_t1² + x_t2² = μ² x_n², x_t1 w_t2 = x_t2 w_t1 and x_t·w_t ≤ 0
//! associated   w_n² ≥ μ² (w_t1² + w_t2²),  x_n w_n + x_t·w_t = 0
//! ```
//!
//! These are polynomials with rational coefficients, whose signs are decided exactly.

use lcplab_lcp::exact::dyadic::{Dyadic, dyadic};
use lcplab_lcp::exact::{Exact, Point};
use lcplab_lcp::friction::{ConeProblem, Contact, Law};

/// Whether the point solves the problem.
pub(super) fn is_solved_by(problem: &ConeProblem, exact: &Exact, point: &Point) -> bool {
    let friction = problem.friction();
    friction.others().iter().all(|&i| row_holds(exact, point, i))
        && friction.contacts().iter().all(|contact| {
            let w = contact.rows.map(|i| exact.scaled_w(i, point));
            contact_holds(contact, problem.law(), contact.rows.map(|i| point.scaled(i)), &w)
        })
}

/// Whether a row that belongs to no contact is solved.
fn row_holds(exact: &Exact, point: &Point, i: usize) -> bool {
    let (lo, hi) = exact.scaled_bounds(i, point);
    let (w, x) = (exact.scaled_w(i, point), point.scaled(i));
    lo.as_ref().is_none_or(|lo| x >= lo)
        && hi.as_ref().is_none_or(|hi| x <= hi)
        && (w <= Dyadic::ZERO || lo.as_ref() == Some(x))
        && (w >= Dyadic::ZERO || hi.as_ref() == Some(x))
}

/// Whether a contact obeys the law; x and w are multiplied by the same positive number.
fn contact_holds(contact: &Contact, law: Law, [n, t1, t2]: [&Dyadic; 3], w: &[Dyadic; 3]) -> bool {
    let [w_n, w1, w2] = w;
    let (zero, limit) = (Dyadic::ZERO, dyadic(contact.mu) * n);
    let (length, limit) = (t1 * t1 + t2 * t2, &limit * &limit);
    let power = t1 * w1 + t2 * w2;
    if *n < zero || length > limit || *w_n < zero {
        return false;
    }
    match law {
        Law::Coulomb => {
            let is_opposite = || length == limit && t1 * w2 == t2 * w1 && power <= zero;
            (*n == zero || *w_n == zero) && (*w1 == zero && *w2 == zero || is_opposite())
        }
        Law::Associated => {
            let mu = dyadic(contact.mu);
            w_n * w_n >= &mu * &mu * (w1 * w1 + w2 * w2) && n * w_n + power == zero
        }
    }
}
