//! The methods in textbook form: one function per method, on dense matrices, in the notation of the
//! lessons.
//!
//! There are no tolerances, limits or friction here, and a matrix outside a method's class gives a
//! wrong answer or none. Use the solvers of the same names instead; on problems without ties both
//! give the same x, which the tests check.
//!
//! | function | problem | full solver |
//! | --- | --- | --- |
//! | [`jacobi`] | lo ≤ x ≤ hi, few sweeps | [`Jacobi`](crate::Jacobi) |
//! | [`gauss_seidel`] | the same | [`Pgs`](crate::Pgs) |
//! | [`ldlt`] | w = 0, A symmetric | `linalg/ldlt.rs` |
//! | [`murty`] | 0 ≤ x ⟂ w ≥ 0, A a P-matrix | [`Murty`](crate::Murty) |
//! | [`dantzig`] | lo ≤ x ≤ hi, A symmetric and definite | [`Dantzig`](crate::Dantzig) |
//! | [`lemke`] | 0 ≤ x ⟂ w ≥ 0, A of many kinds | [`Lemke`](crate::Lemke) |
//! | [`interior_point`] | 0 ≤ x ⟂ w ≥ 0, A semidefinite | [`InteriorPoint`](crate::InteriorPoint) |
//!
//! ```
//! # #![allow(non_snake_case)]
//! use lcplab_solver::textbook::*;
//!
//! let A = Matrix::from_row_slice(2, 2, &[2.0, 1.0, 1.0, 2.0]);
//! let b = Vector::from_column_slice(&[-5.0, -6.0]);
//! let (lo, hi) = (Vector::zeros(2), Vector::repeat(2, f64::INFINITY));
//! let (L, D) = ldlt(&A);
//! let answers = [
//!     jacobi(&A, &b, &lo, &hi, 1.0, 60),
//!     gauss_seidel(&A, &b, &lo, &hi, 30),
//!     solve(&L, &D, &-&b),
//!     murty(&A, &b),
//!     dantzig(&A, &b, &lo, &hi),
//!     lemke(&A, &b).expect("no ray"),
//!     interior_point(&A, &b, 40),
//! ];
//! for x in answers {
//!     assert!((x - Vector::from_column_slice(&[4.0 / 3.0, 7.0 / 3.0])).norm() < 1e-12);
//! }
//! ```

#![allow(non_snake_case)]

mod dantzig;
mod gauss_seidel;
mod interior_point;
mod jacobi;
mod ldlt;
mod lemke;
mod murty;

pub use dantzig::dantzig;
pub use gauss_seidel::gauss_seidel;
pub use interior_point::interior_point;
pub use jacobi::jacobi;
pub use ldlt::{ldlt, solve};
pub use lemke::lemke;
pub use murty::murty;

/// The source text of a function of this module, for the lessons.
///
/// ```
/// assert!(lcplab_solver::textbook::text("murty").starts_with("/// The x of 0 ≤ x ⟂ A x + b ≥ 0"));
/// ```
///
/// # Panics
/// If there is no function with this name.
pub fn text(name: &str) -> &'static str {
    let page = match name {
        "jacobi" => include_str!("jacobi.rs"),
        "gauss_seidel" => include_str!("gauss_seidel.rs"),
        "ldlt" => include_str!("ldlt.rs"),
        "murty" => include_str!("murty.rs"),
        "dantzig" => include_str!("dantzig.rs"),
        "lemke" => include_str!("lemke.rs"),
        "interior_point" => include_str!("interior_point.rs"),
        other => panic!("the textbook has no function {other:?}"),
    };
    page.find("///").map_or(page, |start| &page[start..])
}

/// A.
pub type Matrix = nalgebra::DMatrix<f64>;
/// x, w, b.
pub type Vector = nalgebra::DVector<f64>;

/// The point of a set F of free rows: A_FF x_F = −b_F, and x = 0 elsewhere.
fn point(A: &Matrix, b: &Vector, free: &[bool]) -> Vector {
    let n = b.len();
    let in_F = |i: usize, j: usize| free[i] && free[j];
    let M = Matrix::from_fn(n, n, |i, j| if in_F(i, j) { A[(i, j)] } else { f64::from(i == j) });
    let r = Vector::from_fn(n, |i, _| if free[i] { -b[i] } else { 0.0 });
    M.lu().solve(&r).expect("A_FF is not singular")
}
