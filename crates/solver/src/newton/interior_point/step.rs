//! The linear equations of a step, independent of how they are solved.

/// (A + D) dx = r with a positive diagonal D; where x is pinned, the row is replaced by dx = 0.
pub(super) trait StepEquations {
    /// The minimum of D relative to a_ii in a row without bounds; with bounds it is
    /// `MIN_ADDED`.
    const UNBOUNDED: f64;

    /// Whether the end of the path is refined by a guess of the active set. Symmetric problems do
    /// without: their solvers of choice pivot.
    const REFINES: bool = false;

    /// a_ii, or the size of row i; 1 if x_i is pinned and A has no diagonal entry.
    fn diagonal(&self, i: usize) -> f64;

    /// w = A x + b.
    fn w(&self, x: &[f64]) -> Vec<f64>;

    /// Factorizes the equations with this D; false if a pivot is not positive.
    fn factor(&mut self, added: &[f64], pinned: &[bool]) -> bool;

    /// r ← dx; r is 0 where x is pinned.
    fn solve(&mut self, r: &mut [f64]);
}
