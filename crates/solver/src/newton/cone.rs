//! Newton's method for circular friction cones under Coulomb's law, on compliant rows whose
//! compliance decreases to 0.
//!
//! ```text
//! w = A x + b + ε S x                                 S = the scales of the rows
//! x_n = max(x_n − w_n/s_n, 0),  x_t = the point of the disk |x_t| ≤ μ x_n nearest to x_t − w_t/s_t
//! ```
//!
//! The two equations of a contact are piecewise smooth (Alart & Curnier 1991). Newton's method with
//! a line search solves them in a few steps if it starts near a solution and their derivative is
//! invertible. With redundant contacts A is singular. Contacts that nearly stick then slip so
//! slowly that sweeps need millions of steps to move their friction to its limit. Compliant rows
//! have neither problem: Newton's method starts at ε = 1/10, and each solution is the start for
//! ε/4. Every x is tested on the rigid problem, ε = 0, and the best one counts.
//!
//! Convergence is not guaranteed: Coulomb's law is not convex, and for small ε Newton's method may
//! cycle. It then starts again with other scales in the projections. The fallback sequence
//! therefore uses it after the sweeps.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};

use crate::iterate::iterate;
use crate::tolerances::{
    ADDED_DIAGONAL_FACTOR, ENOUGH_DECREASE, EQUATIONS_HOLD, FIRST_ADDED_DIAGONAL,
    LAST_ADDED_DIAGONAL,
};
use crate::{ConeSolver, Event, Observer, Settings, Solution, Start, Status};
use lcplab_lcp::Complementarity;
use lcplab_lcp::friction::{ConeProblem, Contact, Law};

/// The factors on the scales in the projections, tried one after the other: they do not change the
/// solutions, but the path of Newton's method.
const STIFFNESSES: [f64; 5] = [1e-2, 1e-3, 1.0, 0.1, 1e-4];
/// Newton steps for each ε.
const STEPS: usize = 30;
/// The lengths of a step that are tried.
const LENGTHS: [f64; 6] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.01];

/// Newton's method for cones under Coulomb's law.
#[derive(Debug, Clone, Default)]
pub struct ConeNewton {
    /// The common settings; an iteration is a problem with its own ε.
    pub settings: Settings,
}

impl ConeNewton {
    /// Its name in the attempts of the fallback sequence.
    pub const NAME: &'static str = "cone-newton";
}

impl ConeSolver for ConeNewton {
    fn name(&self) -> &str {
        ConeNewton::NAME
    }

    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let x = start.point(problem);
        let equations = match Equations::new(problem) {
            Ok(equations) => equations,
            Err(status) => return Solution::outside_class(problem, x, status, 0, &self.settings),
        };
        let first = DVector::from_vec(x.clone());
        let (mut y, mut epsilon, mut least) = (first.clone(), FIRST_ADDED_DIAGONAL, f64::INFINITY);
        let mut stiffnesses = STIFFNESSES.into_iter();
        let mut stiffness = stiffnesses.next();
        iterate(problem, x, 0, &self.settings, observer, |x| {
            if epsilon < LAST_ADDED_DIAGONAL {
                (y, epsilon, stiffness) = (first.clone(), FIRST_ADDED_DIAGONAL, stiffnesses.next());
            }
            let Some(stiffness) = stiffness else { return ControlFlow::Break(Status::Stalled) };
            y = equations.solved(epsilon, stiffness, y.clone());
            epsilon *= ADDED_DIAGONAL_FACTOR;
            let candidate = equations.within_bounds(&y);
            let residual = problem.scaled_residual(&candidate);
            if residual < least {
                least = residual;
                x.copy_from_slice(&candidate);
            }
            ControlFlow::Continue(Event::Step)
        })
    }
}

/// The equations of a problem.
struct Equations<'p> {
    problem: &'p ConeProblem,
    a: DMatrix<f64>,
    b: DVector<f64>,
    /// S, one number for the normal of a contact and one for its tangents.
    scales: Vec<f64>,
}

impl<'p> Equations<'p> {
    /// The equations; an error for another law, or for a row that no x moves.
    fn new(problem: &'p ConeProblem) -> Result<Self, Status> {
        let (lcp, friction) = (problem.lcp(), problem.friction());
        if problem.law() != Law::Coulomb {
            return Err(Status::OutsideClass { reason: "the law is not Coulomb's" });
        }
        let n = lcp.len();
        let a = DMatrix::from_fn(n, n, |i, j| lcp.matrix().entry(i, j));
        let mut scales: Vec<f64> = (0..n).map(|i| a[(i, i)]).collect();
        for Contact { rows: [_, t1, t2], .. } in friction.contacts() {
            let sum = |i: usize| a[(i, *t1)].abs() + a[(i, *t2)].abs();
            let scale = sum(*t1).max(sum(*t2));
            (scales[*t1], scales[*t2]) = (scale, scale);
        }
        if let Some(row) = scales.iter().position(|scale| !(*scale > 0.0)) {
            return Err(Status::ZeroDiagonal { row });
        }
        Ok(Equations { problem, a, b: DVector::from_column_slice(lcp.b()), scales })
    }

    /// Newton's method for one ε, and a factor on the scales in the projections, from x.
    fn solved(&self, epsilon: f64, stiffness: f64, mut x: DVector<f64>) -> DVector<f64> {
        let mut a = self.a.clone();
        (0..x.len()).for_each(|i| a[(i, i)] += epsilon * self.scales[i]);
        let goal = EQUATIONS_HOLD * self.b.norm();
        let (mut value, mut derivative) = self.at(&a, stiffness, &x);
        for _ in 0..STEPS {
            let size = value.norm();
            if size <= goal {
                break;
            }
            let Some(step) = derivative.lu().solve(&-&value) else { break };
            let tried = LENGTHS.map(|length| {
                let next = &x + length * &step;
                (length, self.at(&a, stiffness, &next).0.norm(), next)
            });
            let is_enough = |(length, norm, _): &&(f64, f64, _)| {
                *norm < size * (1.0 - ENOUGH_DECREASE * length)
            };
            let shortest = || tried.iter().min_by(|one, other| one.1.total_cmp(&other.1));
            let Some((_, norm, next)) = tried.iter().find(is_enough).or_else(shortest) else {
                break;
            };
            if !norm.is_finite() {
                break;
            }
            x.clone_from(next);
            (value, derivative) = self.at(&a, stiffness, &x);
        }
        x
    }

    /// The equations in units of w, and their derivative.
    fn at(
        &self,
        a: &DMatrix<f64>,
        stiffness: f64,
        x: &DVector<f64>,
    ) -> (DVector<f64>, DMatrix<f64>) {
        let (lcp, friction) = (self.problem.lcp(), self.problem.friction());
        let w = a * x + &self.b;
        let scales: Vec<f64> = self.scales.iter().map(|scale| stiffness * scale).collect();
        // Where x is not at a bound: w = 0.
        let (mut value, mut derivative) = (w.clone(), a.clone());
        let mut set_to = |i: usize, bound: f64, value: &mut DVector<f64>| {
            value[i] = scales[i] * (x[i] - bound);
            derivative.row_mut(i).fill(0.0);
            derivative[(i, i)] = scales[i];
        };
        for &i in friction.others() {
            let next = x[i] - w[i] / scales[i];
            let bound = next.clamp(lcp.lo()[i], lcp.hi()[i]);
            if bound != next {
                set_to(i, bound, &mut value);
            }
        }
        for Contact { rows: [normal, ..], .. } in friction.contacts() {
            if x[*normal] - w[*normal] / scales[*normal] <= 0.0 {
                set_to(*normal, 0.0, &mut value);
            }
        }
        for contact in friction.contacts() {
            self.slide((contact, scales[contact.rows[1]]), a, x, &w, (&mut value, &mut derivative));
        }
        (value, derivative)
    }

    /// The equations of the tangents of a contact whose friction is at its limit.
    fn slide(
        &self,
        (contact, s): (&Contact, f64),
        a: &DMatrix<f64>,
        x: &DVector<f64>,
        w: &DVector<f64>,
        (value, derivative): (&mut DVector<f64>, &mut DMatrix<f64>),
    ) {
        let Contact { rows: [normal, t1, t2], mu } = *contact;
        let limit = mu * x[normal].max(0.0);
        let next = [t1, t2].map(|i| x[i] - w[i] / s);
        let length = lcplab_lcp::hypot(next[0], next[1]);
        if length <= limit {
            return;
        }
        let along = next.map(|part| part / length);
        for (k, i) in [t1, t2].into_iter().enumerate() {
            value[i] = s * (x[i] - limit * along[k]);
            derivative.row_mut(i).fill(0.0);
            derivative[(i, i)] = s;
            // The direction turns with the part of the step across it.
            for (l, other) in [t1, t2].into_iter().enumerate() {
                let unit = if k == l { 1.0 } else { 0.0 };
                let turn = limit / length * (unit - along[k] * along[l]);
                derivative[(i, other)] -= s * turn;
                for j in 0..x.len() {
                    derivative[(i, j)] += turn * a[(other, j)];
                }
            }
            if x[normal] > 0.0 {
                derivative[(i, normal)] -= s * mu * along[k];
            }
        }
    }

    /// x with friction shortened to its limit.
    fn within_bounds(&self, x: &DVector<f64>) -> Vec<f64> {
        let (lcp, friction) = (self.problem.lcp(), self.problem.friction());
        let mut x = x.as_slice().to_vec();
        for &i in friction.others() {
            x[i] = x[i].clamp(lcp.lo()[i], lcp.hi()[i]);
        }
        for contact in friction.contacts() {
            let [n, t1, t2] = contact.of(&x);
            let (n, length) = (n.max(0.0), lcplab_lcp::hypot(t1, t2));
            let part = if length > contact.mu * n { contact.mu * n / length } else { 1.0 };
            contact.put([n, part * t1, part * t2], &mut x);
        }
        x
    }
}
