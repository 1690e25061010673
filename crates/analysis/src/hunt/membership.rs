//! Decides in rational arithmetic whether a matrix belongs to a class (the entries are binary
//! fractions).

use lcplab_judge::error_bound::is_definite;
use lcplab_judge::regularity::least_eigenvalue;
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::MatrixClass;

use crate::card::class_of;

/// Above this many rows, a verified floating-point factorization is tried before exact arithmetic.
const QUICK_ROWS: usize = 12;
/// Rounding may make the least eigenvalue of a semidefinite A (scaled to a unit diagonal) this
/// negative.
const ROUNDING: f64 = 1e-12;
/// The relative increases of the diagonal that are tried until A is definite.
const ENLARGED: [f64; 4] = [1e-15, 1e-13, 1e-12, 1e-11];

/// Whether A is shown to belong to a class; false if the matrix is too large to decide.
///
/// [`MatrixClass::CopositivePlus`], [`MatrixClass::P0`] and [`MatrixClass::POrSemidefinite`] are
/// shown through their decidable subclasses: definite, semidefinite, P.
pub(super) fn is_of(class: MatrixClass, lcp: &Lcp) -> bool {
    use MatrixClass::{CopositivePlus, Definite, General, P, P0, POrSemidefinite, Semidefinite};
    if class == General || (lcp.len() > QUICK_ROWS && is_definite(lcp)) {
        // A definite matrix is in all classes.
        return true;
    }
    let of = class_of(lcp.matrix());
    match class {
        General => true,
        Definite => of == Some(Definite),
        P => matches!(of, Some(P | Definite)),
        Semidefinite | CopositivePlus => matches!(of, Some(Definite | Semidefinite)),
        P0 | POrSemidefinite => matches!(of, Some(P | Definite | Semidefinite)),
    }
}

/// A problem whose A is semidefinite up to rounding, such as an engine's J M⁻¹ Jᵀ, made exactly
/// definite: its symmetric part with a relatively increased diagonal; also returns the increase.
/// `None` if A is farther from semidefinite than rounding explains.
pub(super) fn made_definite(lcp: &Lcp) -> Option<(Lcp, f64)> {
    let n = lcp.len();
    let a = lcp.matrix();
    if !a.is_nearly_symmetric() {
        return None;
    }
    let symmetric = |i: usize, j: usize| 0.5 * a.entry(i, j) + 0.5 * a.entry(j, i);
    let with_diagonal = |part: f64| {
        let entry = |k: usize| match (k / n, k % n) {
            (i, j) if i == j => a.diagonal(i) + part * a.diagonal(i),
            (i, j) => symmetric(i, j),
        };
        let entries: Vec<f64> = (0..n * n).map(entry).collect();
        lcp.with_matrix(Matrix::dense(n, &entries)).ok()
    };
    let least = least_eigenvalue(&with_diagonal(0.0)?)?;
    if least < -ROUNDING {
        return None;
    }
    ENLARGED.into_iter().find_map(|part| {
        let lcp = with_diagonal(part)?;
        is_of(MatrixClass::Definite, &lcp).then_some((lcp, part))
    })
}
