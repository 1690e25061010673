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
//! | [`newton`] | the same | [`Newton`](crate::Newton) |
//! | [`lemke`] | 0 ≤ x ⟂ w ≥ 0, A of many kinds | [`Lemke`](crate::Lemke) |
//! | [`interior_point`] | 0 ≤ x ⟂ w ≥ 0, A semidefinite | [`InteriorPoint`](crate::InteriorPoint) |
//!
//! Gauss-Seidel, L D Lᵀ, Dantzig, Newton and the interior-point method run in single precision too;
//! `_with` lets their linear equations have a precision of their own.
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
//!     newton(&A, &b, &lo, &hi, 20),
//!     lemke(&A, &b).expect("no ray"),
//!     interior_point(&A, &b, 40),
//! ];
//! for x in answers {
//!     assert!((x - Vector::from_column_slice(&[4.0 / 3.0, 7.0 / 3.0])).norm() < 1e-12);
//! }
//!
//! // The same in single precision, whose unit roundoff is 2⁻²⁴, but with equations in double.
//! let single = |v: &Vector| v.map(f32::nearest);
//! let (A32, b32, lo32, hi32) = (A.map(f32::nearest), single(&b), single(&lo), single(&hi));
//! let x = dantzig_with(&A32, &b32, &lo32, &hi32, |A, b, free| {
//!     let x = point(&A.map(f32::double), &b.map(f32::double), free)?;
//!     Some(x.map(f32::nearest))
//! });
//! assert_eq!(x, Some(Vector::from_column_slice(&[1.3333334, 2.3333333])));
//! assert_eq!(x, newton_with(&A32, &b32, &lo32, &hi32, 20, point));
//! let by_lu = |A: &Matrix<f32>, r: &Vector<f32>| A.clone().lu().solve(r).expect("A is regular");
//! let x = interior_point_with(&A32, &b32, 40, by_lu);
//! assert!((x[0].double() - 4.0 / 3.0).abs() < 1e-6);
//! ```

#![allow(non_snake_case)]

mod dantzig;
mod gauss_seidel;
mod interior_point;
mod jacobi;
mod ldlt;
mod lemke;
mod murty;
mod newton;
mod real;

pub use dantzig::{dantzig, dantzig_with};
pub use gauss_seidel::gauss_seidel;
pub use interior_point::{interior_point, interior_point_with};
pub use jacobi::jacobi;
pub use ldlt::{ldlt, solve};
pub use lemke::lemke;
pub use murty::murty;
pub use newton::{newton, newton_with};
pub use real::Real;

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
pub type Matrix<T = f64> = nalgebra::DMatrix<T>;
/// x, w, b.
pub type Vector<T = f64> = nalgebra::DVector<T>;

/// The point of a set F of free rows: A_FF x_F = −b_F, and x = 0 elsewhere; `None` if A_FF is
/// singular.
pub fn point<T: Real>(A: &Matrix<T>, b: &Vector<T>, free: &[bool]) -> Option<Vector<T>> {
    let n = b.len();
    let in_F = |i: usize, j: usize| free[i] && free[j];
    let unit = |is_one: bool| if is_one { T::one() } else { T::zero() };
    let M = Matrix::from_fn(n, n, |i, j| if in_F(i, j) { A[(i, j)] } else { unit(i == j) });
    let r = Vector::from_fn(n, |i, _| if free[i] { -b[i] } else { T::zero() });
    M.lu().solve(&r)
}
