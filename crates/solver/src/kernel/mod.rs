//! Performance kernels: the same operations in faster loops.
//!
//! [`Pgs`](super::Pgs) is a sweep as defined, and as the lessons show it. Processors work best with
//! eight numbers at a time, sequential memory access and no result that depends on the previous
//! one. The kernels here are arranged accordingly; tests compare each with the plain form.
//!
//! | kernel | cost of a sweep | why it is faster |
//! | --- | --- | --- |
//! | [`impulses::RowByRow`] | 12 entries per row, A never formed | the plain form of the next one |
//! | [`impulses::SimdPairs`] | the same | eight pairs of a group at once, one per lane |
//!
//! | kernel | cost of a pivot | why it is faster |
//! | --- | --- | --- |
//! | [`table::Table`] | n² entries read and written | eight pivots in one pass through memory |
//! | `tableau`, symmetric | n²/2 entries read and written | sixteen pivots in one pass through memory |
//!
//! The kernels do not test whether x is a solution; stop tests stay with the solvers. [`Width`]
//! selects the instruction set; results are bitwise identical with all.

pub mod impulses;
pub(crate) mod inverse_rows;
pub(crate) mod lanes;
pub(crate) mod moves;
pub(crate) mod rank_one;
pub(crate) mod rows;
pub mod table;
pub(crate) mod tableau;
mod terms;

pub use lanes::Width;
pub use terms::terms;
