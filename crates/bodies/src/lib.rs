//! Rigid bodies, and the [`constraint`]s between them as rows: c, J, J'u and bounds.

pub mod body;
pub mod constraint;
