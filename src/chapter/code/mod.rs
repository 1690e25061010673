//! The chapter's listings in Rust, each as printed and corrected.
//!
//! A file follows its listing line by line where the listing computes something, in f64 and with
//! nalgebra's dense matrices; this code is for demonstration, small and slow. Printed forms keep
//! the listing's signs; corrected forms have those of the library: J = ∂c/∂s, w = A x + b,
//! u⁺ = u* + M⁻¹ Jᵀ x, and x ≥ 0 pushes.

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

/// The form of a listing, or of one of its lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// As printed.
    Printed,
    /// Corrected.
    Corrected,
}

/// A listing of the chapter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Listing {
    /// Its number, such as `Code 6`; for a piece without number, its name.
    pub id: &'static str,
    /// A one-line description.
    pub title: &'static str,
    /// What is printed, in our own words; plain text.
    pub printed: &'static str,
    /// The correction; plain text.
    pub corrected: &'static str,
    /// The related errata, in order.
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

/// The listing with this number or name, if there is one.
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
