//! Counting degrees of freedom: constraints remove as many as the rank of J, which may be less than
//! its number of rows.

use nalgebra::DMatrix;

use super::Assembly;

/// A singular value below this fraction of the largest counts as 0.
const NEGLIGIBLE: f64 = 1e-9;

impl Assembly {
    /// J, n × k and dense: one row per constraint row, one column per velocity component of a
    /// moving body.
    pub fn jacobian(&self) -> DMatrix<f64> {
        let mut j = DMatrix::zeros(self.rows.len(), self.columns());
        for i in 0..self.rows.len() {
            for (column, value) in self.jacobian_row(i) {
                j[(i, column)] = value;
            }
        }
        j
    }

    /// The rank of J by singular values: the number of independent rows at this instant.
    pub fn rank(&self) -> usize {
        let j = self.jacobian();
        if j.is_empty() {
            return 0;
        }
        let values = j.singular_values();
        let largest = values.iter().copied().fold(0.0, f64::max);
        values.iter().filter(|&&value| value > NEGLIGIBLE * largest).count()
    }

    /// The remaining degrees of freedom if every row holds as an equation: k − rank J.
    ///
    /// ```
    /// use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
    /// use lcplab_mechanics::scene::Scene;
    ///
    /// let scene = Scene::load("bricard")?; // 5 rods, 6 hinges: 30 columns and 30 rows
    /// let assembly = Assembly::new(&scene, &scene.states, &[], ConstraintFilter::Near)?;
    /// assert_eq!((assembly.rank(), assembly.degrees_of_freedom()), (29, 1)); // and yet it moves
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn degrees_of_freedom(&self) -> usize {
        self.columns() - self.rank()
    }
}
