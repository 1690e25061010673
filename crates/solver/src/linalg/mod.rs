//! Factorizations: dense, envelope, sparse, and one with row insertion and removal.

pub mod cholesky;
pub mod elimination;
pub mod envelope;
pub mod ldlt;
pub mod reordered;
