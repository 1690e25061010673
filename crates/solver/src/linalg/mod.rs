//! Factorisations: dense, in an envelope, sparse, and one that rows enter and leave.

pub mod cholesky;
pub mod elimination;
pub mod envelope;
pub mod ldlt;
pub mod sparse_factor;
