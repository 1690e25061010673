//! Code 6: the iterative solver; the library contains both forms.
//!
//! The printed form is [`Code6`], which clamps after the whole sweep (E06); the corrected form is
//! [`Pgs`], which clamps each row as it is updated. Here both take the dense matrices of the
//! listings and do a fixed number of sweeps. The listing solves A x = b; its corrected form uses
//! w = A x + b like the library (E02).
#![allow(non_snake_case)]

use nalgebra::{DMatrix, DVector};

use super::{Form, Listing};
use crate::error::Result;
use crate::lcp::{Lcp, Matrix};
use crate::solver::{Code6, Pgs, Settings, Solver, Start};

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 6",
    title: "the iterative solver",
    printed: "Clear x, sweep ten times over the rows of A x = b, and clamp x after each sweep.",
    corrected: "Start from the last step's x, and clamp each row before the next one is updated.",
    errata: &["E02", "E06", "E11", "E12"],
};

/// The listing's number of sweeps.
pub const SWEEPS: usize = 10;

/// The listing: x of A x = b after this number of sweeps from 0; with the listing's bounds, or
/// none.
///
/// # Errors
/// If a number is not finite or a lower bound exceeds its upper bound.
pub fn printed(
    A: &DMatrix<f64>,
    b: &DVector<f64>,
    lo: Option<&[f64]>,
    hi: Option<&[f64]>,
    sweeps: usize,
) -> Result<DVector<f64>> {
    swept(Form::Printed, A, &-b, lo, hi, None, sweeps)
}

/// x of w = A x + b after this number of sweeps from 0, each row clamped as it is updated.
///
/// # Errors
/// As for [`printed`].
pub fn corrected(
    A: &DMatrix<f64>,
    b: &DVector<f64>,
    lo: Option<&[f64]>,
    hi: Option<&[f64]>,
    sweeps: usize,
) -> Result<DVector<f64>> {
    swept(Form::Corrected, A, b, lo, hi, None, sweeps)
}

/// x of w = A x + b after this number of sweeps of either form from `start`, or from 0.
///
/// # Errors
/// As for [`printed`].
pub(crate) fn swept(
    form: Form,
    A: &DMatrix<f64>,
    b: &DVector<f64>,
    lo: Option<&[f64]>,
    hi: Option<&[f64]>,
    start: Option<&[f64]>,
    sweeps: usize,
) -> Result<DVector<f64>> {
    let bound =
        |given: Option<&[f64]>, none: f64| given.map_or(vec![none; b.len()], <[f64]>::to_vec);
    let (lo, hi) = (bound(lo, f64::NEG_INFINITY), bound(hi, f64::INFINITY));
    let lcp = Lcp::new(Matrix::from(A.as_view()), b.as_slice().to_vec(), lo, hi)?;
    let settings = Settings::default()
        .with_tolerance(0.0)
        .with_max_iterations(sweeps)
        .with_check_every(sweeps.max(1));
    let solver: Box<dyn Solver> = match form {
        Form::Printed => Box::new(Code6 { settings }),
        Form::Corrected => Box::new(Pgs { settings, ..Pgs::default() }),
    };
    Ok(DVector::from_vec(solver.solve(&lcp, &Start { x: start, ..Start::default() }, &mut ()).x))
}
