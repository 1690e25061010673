//! Which rows fight: the constraints of a problem that has no solution (the chapter's Figure 8).
//!
//! A vector d with d_i ≠ 0 only where x_i has no bound, A d = 0 and bᵀd < 0 proves that the rows
//! with d_i ≠ 0 cannot all be satisfied, whatever the forces ([`ray`](lcplab_judge::ray)). Leave
//! one of them out and this proof is gone. Iterative solvers reach no best fit there: x grows along
//! d for ever, and the order of the rows decides the motion. K&M "Bad Constraints", E61.

use super::Solve;
use crate::scene::Scene;
use lcplab_judge::ray::refute;
use lcplab_solver::Status;

/// Problems up to this size are proved exactly.
const PROVED: usize = 150;

impl Solve {
    /// The labels of rows that no forces satisfy together, proved in exact arithmetic from the ray
    /// that the solver ended on; empty without such a proof.
    pub fn conflict(&self, scene: &Scene) -> Vec<String> {
        let Status::Ray { row, direction } = &self.solution.status else { return Vec::new() };
        if self.problem.lcp.len() > PROVED {
            return Vec::new();
        }
        let Some(proof) = refute(&self.problem.lcp, *row, direction) else { return Vec::new() };
        let rows = self.problem.assembly.rows.iter().zip(&proof.vector);
        rows.filter(|(_, d)| !d.is_zero()).map(|(row, _)| row.label(scene)).collect()
    }
}
