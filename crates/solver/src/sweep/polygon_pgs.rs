//! Projected Gauss-Seidel for polygons: one contact at a time, first its normal, then its tangents.
//!
//! ```text
//! x_n ← max(x_n − w_n/a_nn, 0)
//! x_t ← the point of μ x_n conv{d_j} nearest to x_t − w_t/s_t          d_j the polygon's corners
//! x_i ← Π(x_i − w_i/a_ii)                                              each other row
//! ```
//!
//! The friction impulse of the polygon that dissipates most is a fixed point of the second line and
//! therefore of the whole iteration. β and γ of the [LCP](lcplab_lcp::friction::Polyhedral)
//! need not be known, and the matrix has only rows for x. s_t bounds the eigenvalues of the
//! contact's tangent block. Each update uses the newest x. Like the coupled box, to which it is
//! equivalent with four corners along the tangents turned by 45°, it minimizes no function, so
//! convergence is observed but not proved.
//!
//! `Solved` is tested on the LCP, with the z reconstructed from x.

use crate::{Event, Iterate, Observer, Settings, Solution, Start, Status};
use lcplab_lcp::friction::Polyhedral;
use lcplab_lcp::merit;

/// The number of sweeps between two solution tests; one test costs as much as several sweeps.
const LOOK_EVERY: usize = 10;

/// Projected Gauss-Seidel for friction polygons.
///
/// ```
/// use lcplab_lcp::friction::{Contact, FrictionProblem, Polyhedral};
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{PolygonPgs, Start, Status};
///
/// // A point of 1 kg reaches the ground with 2 m/s and slides along t1 with 3 m/s; μ = 0.5.
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let polygons = Polyhedral::new(&problem, 4)?;
/// let solution = PolygonPgs::default().solve(&polygons, &Start::default(), &mut ());
/// assert_eq!((solution.status, solution.x), (Status::Solved, vec![2.0, 1.0, 0.0]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct PolygonPgs {
    /// The common settings; an iteration is a sweep over all contacts and other rows.
    pub settings: Settings,
}

impl PolygonPgs {
    /// Its name in tables.
    pub const NAME: &'static str = "polygon-pgs";

    /// Solves a polyhedral problem, starting from x, and returns x.
    pub fn solve(
        &self,
        problem: &Polyhedral,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let friction = problem.friction();
        let (lcp, contacts) = (friction.lcp(), friction.contacts());
        let mut x = start.x.map_or_else(|| vec![0.0; lcp.len()], <[f64]>::to_vec);
        let normals = contacts.iter().map(|contact| contact.rows[0]);
        let divided = friction.others().iter().copied().chain(normals);
        if let Some(row) = divided.into_iter().find(|&i| !(lcp.matrix().diagonal(i) > 0.0)) {
            return Solution::new(lcp, x, Status::ZeroDiagonal { row }, 0);
        }
        let tolerance = self.settings.tolerance;
        let mut event = Event::Start;
        for iteration in 0..=self.settings.max_iterations {
            if iteration > 0 {
                sweep(problem, &mut x);
                event = Event::Sweep;
            }
            if observer.observe(&Iterate { iteration, x: &x, event }).is_break() {
                return Solution::new(lcp, x, Status::Stopped, iteration);
            }
            if x.iter().any(|x| !x.is_finite()) {
                return Solution::new(lcp, x, Status::Diverged, iteration);
            }
            if iteration % LOOK_EVERY == 0 && problem.is_solution(&x, tolerance) {
                return Solution::new(lcp, x, Status::Solved, iteration);
            }
        }
        Solution::new(lcp, x, Status::IterationLimit, self.settings.max_iterations)
    }
}

fn sweep(problem: &Polyhedral, x: &mut [f64]) {
    let friction = problem.friction();
    let lcp = friction.lcp();
    for &i in friction.others() {
        x[i] = lcp.project(i, x[i] - lcp.row_w(i, x) / lcp.matrix().diagonal(i), x);
    }
    for contact in friction.contacts() {
        let [n, t1, t2] = contact.rows;
        x[n] = (x[n] - lcp.row_w(n, x) / lcp.matrix().diagonal(n)).max(0.0);
        let s = match merit::block_scale(lcp.matrix(), &[t1, t2]) {
            0.0 => 1.0,
            s => s,
        };
        let aim = [t1, t2].map(|t| x[t] - lcp.row_w(t, x) / s);
        [x[t1], x[t2]] = problem.nearest(contact.mu * x[n], aim);
    }
}
