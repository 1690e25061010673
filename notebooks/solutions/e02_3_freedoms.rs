//! Exercise 2.3: how many freedoms are left.
//!
//! J has one row a constraint row and one column a velocity component of a moving body. How many
//! independent ways of moving does it leave? `DMatrix` knows `nrows()`, `ncols()` and `rank(1e-9)`.

use nalgebra::DMatrix;

/// The number of degrees of freedom.
pub fn answer(j: &DMatrix<f64>) -> usize {
    j.ncols() - j.rank(1e-9)
}
