//! The chapter's listings in Rust, each as printed beside its corrected form.
//!
//! A file follows its listing line by line where the listing computes something, in f64 and on
//! nalgebra's dense matrices: these are specimens, small and slow. What is printed keeps the
//! listing's own signs; what is corrected has those of the library: J = ∂c/∂s, w = A x + b, u⁺ =
//! u* + M⁻¹ Jᵀ x, and x ≥ 0 pushes.

pub mod code01_unconstrained_step;
pub mod code02_constrained_step;
pub mod code03_update;
pub mod code04_drift_correction;
pub mod code05_rigid_body;
pub mod code06_solver;
pub mod code07_whole_step;
pub mod code08_matrix_program;
pub mod code09_10_dense_matrix;
pub mod code11_map_matrix;
pub mod constraint_class;

/// Which form of a listing, or of one of its lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// As it is printed.
    Printed,
    /// As it holds.
    Corrected,
}

/// A listing of the chapter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Listing {
    /// Its number: `Code 6`; of a piece without one its name.
    pub id: &'static str,
    /// What it is, in a line.
    pub title: &'static str,
    /// What is printed, in our own words; plain text.
    pub printed: &'static str,
    /// What is corrected; plain text.
    pub corrected: &'static str,
    /// The errata about it, in order.
    pub errata: &'static [&'static str],
}

/// The listings in order.
pub const LISTINGS: &[Listing] = &[
    code01_unconstrained_step::LISTING,
    code02_constrained_step::LISTING,
    code03_update::LISTING,
    code04_drift_correction::LISTING,
    code05_rigid_body::LISTING,
    code06_solver::LISTING,
    constraint_class::LISTING,
    code07_whole_step::LISTING,
    code08_matrix_program::LISTING,
    code09_10_dense_matrix::MEMBERS,
    code09_10_dense_matrix::ACCESS,
    code11_map_matrix::LISTING,
    code11_map_matrix::OPERATORS,
];

/// The listing of this number or name, if there is one.
///
/// ```
/// use lcplab::chapter::code;
///
/// assert_eq!(code::listing("Code 11").map(|listing| listing.title), Some("a sparse matrix as a map of maps"));
/// assert!(code::listing("Code 12").is_none());
/// ```
pub fn listing(id: &str) -> Option<&'static Listing> {
    LISTINGS.iter().find(|listing| listing.id == id)
}
