//! The linear equations of a step, in whatever form they are solved.

/// (A + D) dx = r with a positive diagonal D; where x is pinned, dx = 0 in place of its row.
pub(super) trait StepEquations {
    /// The least part of a_ii that D may be in a row without bounds; with bounds it is [`LEAST`].
    const UNBOUNDED: f64;

    /// a_ii; 1 where x_i is pinned and A has none.
    fn diagonal(&self, i: usize) -> f64;

    /// w = A x + b.
    fn w(&self, x: &[f64]) -> Vec<f64>;

    /// Factorises the equations with this D; false if a pivot is not positive.
    fn factor(&mut self, added: &[f64], pinned: &[bool]) -> bool;

    /// r ← dx; r is 0 where x is pinned.
    fn solve(&mut self, r: &mut [f64]);
}

/// The least part of a_ii that D may be.
pub(super) const LEAST: f64 = 1e-12;
