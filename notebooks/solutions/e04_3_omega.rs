//! Exercise 4.3: the best ω.
//!
//! On a chain or a column Jacobi's method, which moves all rows at once, shrinks the error by `jacobi` (below 1) an
//! iteration. Which ω makes SOR fastest?

/// Young's ω*.
pub fn answer(jacobi: f64) -> f64 {
    2.0 / (1.0 + (1.0 - jacobi * jacobi).sqrt())
}
