//! Enumeration: tries every active set, in exact arithmetic, and finds all solutions.
//!
//! Each row is at its lower bound, free, or at its upper bound: 2ⁿ sets for contacts, 3ⁿ for boxes.
//! For each set the equations w_F = 0 are solved over the rationals (every floating-point number is
//! one) and all signs are decided exactly. So the answer is the truth: a solution, or `NoSolution`.
//! It knows no class of matrices; it is the reference that the other methods are tested against, and
//! the proof that the worst case of pivoting, 2ⁿ, is no worse than trying everything.
//!
//! Where A_FF is singular, the solutions of that set form a polyhedron. Its corners are found by
//! asking w_D = 0 of as many more rows D as unknowns are left open, for every such D. Of a row of
//! solutions that has no corner (free rows that depend on each other), one is given: the dependent
//! x are 0. So [`all_solutions`] is empty only if there is no solution.
//!
//! Exact elimination costs O(n³) a set, so the number of sets is limited: `OutsideClass` above 65536
//! (16 contacts, 10 boxes). Sets are counted with row 0 fastest. Coupled rows: see
//! [`frozen`].

use dashu_ratio::RBig;

use super::active_set::claim;
use super::rational::Exact;
use super::{
    Event, Iterate, Observer, Settings, Solution, Solver, Start, Status, frozen, pivoting,
};
use crate::lcp::Lcp;
use crate::memory::Memory;

/// More active sets than this are not tried.
const MAX_SETS: usize = 1 << 16;

/// Enumeration of all active sets; stops at the first solution.
#[derive(Debug, Clone, Default)]
pub struct Enumeration {
    /// The common settings; an iteration is an active set.
    pub settings: Settings,
}

impl Solver for Enumeration {
    fn name(&self) -> &'static str {
        "enumeration"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if let Some(status) =
            pivoting::at_once(lcp, &x, Memory::numbers(0), &self.settings, observer)
        {
            return Solution::new(lcp, x, status, 0);
        }
        let is_coupled = lcp.coupling().is_some();
        frozen::solve(lcp, x, &self.settings, |lcp, x, before| {
            let Some(problem) = Exact::new(lcp, MAX_SETS) else {
                let reason = "more than 65536 active sets";
                return Solution::new(lcp, x, Status::OutsideClass { reason }, before);
            };
            let mut count = before;
            for sides in Exact::active_sets(lcp) {
                if count >= self.settings.max_iterations {
                    return Solution::new(lcp, x, Status::IterationLimit, count);
                }
                count += 1;
                let found = problem.solutions(&sides).first().map(|x| rounded(x));
                let is_finite = found.iter().flatten().all(|x| x.is_finite());
                if !is_finite {
                    return Solution::new(lcp, x, Status::NotFinite, count); // beyond 1.8e308
                }
                let iterate = found.as_deref().unwrap_or(&x);
                let iterate = Iterate { iteration: count, x: iterate, event: Event::Trial };
                if observer.observe(&iterate).is_break() {
                    return Solution::new(lcp, x, Status::Stopped, count);
                }
                if let Some(x) = found {
                    let status = claim(lcp, &x, &self.settings);
                    return Solution::new(lcp, x, status, count);
                }
            }
            // with other frozen bounds there may be one
            let status = if is_coupled { Status::Stalled } else { Status::NoSolution };
            Solution::new(lcp, x, status, count)
        })
    }
}

/// All solutions of a problem without coupling, exactly: every isolated one, and the corners of
/// every connected family. `None` if there are more than 65536 active sets.
///
/// ```
/// use lcplab::lcp::{Lcp, Matrix};
/// use lcplab::solver::all_solutions;
///
/// // The segment x1 + x2 = 1.
/// let a = Matrix::dense(2, &[1.0; 4]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let corners = all_solutions(&lcp).unwrap();
/// assert_eq!(corners, [[1.into(), 0.into()], [0.into(), 1.into()]]);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
///
/// # Panics
/// If rows are coupled.
pub fn all_solutions(lcp: &Lcp) -> Option<Vec<Vec<RBig>>> {
    assert!(lcp.coupling().is_none(), "the bounds of coupled rows are not numbers");
    let problem = Exact::new(lcp, MAX_SETS)?;
    let mut all: Vec<Vec<RBig>> = Vec::new();
    for sides in Exact::active_sets(lcp) {
        for x in problem.solutions(&sides) {
            if !all.contains(&x) {
                all.push(x);
            }
        }
    }
    Some(all)
}

fn rounded(x: &[RBig]) -> Vec<f64> {
    x.iter().map(|x| x.to_f64().value()).collect()
}
