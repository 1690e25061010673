//! What takes the time, arranged for speed: same operations, other loops.
//!
//! [`Pgs`](super::Pgs) is a sweep as it is defined, and what the lessons show. A processor would
//! rather have eight numbers at a time, memory in the order it lies in, and no result that waits
//! for the last one. The kernels here are arranged so; tests hold each against the plain form.
//!
//! | kernel | a sweep costs | what it gains |
//! | --- | --- | --- |
//! | [`dense::Rows`] | n² entries read | four rows at a time, their four sums independent |
//! | [`dense::Columns`] | n entries for each x that changes | rows that stay at a bound are skipped |
//! | [`impulses::RowByRow`] | 12 entries a row, A never formed | the plain form of the next |
//! | [`impulses::EightPairs`] | the same | eight pairs of a group at once, one a lane |
//!
//! | kernel | a pivot costs | what it gains |
//! | --- | --- | --- |
//! | [`table::Table`] | n² entries read and written | eight pivots on one way through memory |
//! | `tableau`, symmetric | n²/2 entries read and written | sixteen pivots on one way through memory |
//!
//! They do not ask whether x solves anything: stop tests stay with the solvers. [`Width`] says with
//! which instructions they run; the bits are the same with all.

pub mod dense;
pub mod impulses;
pub(crate) mod lanes;
pub(crate) mod panels;
pub(crate) mod rank_one;
pub mod reading;
pub(crate) mod rows;
pub mod table;
pub(crate) mod tableau;
mod terms;

pub use lanes::Width;
pub use terms::terms;
