//! Shared by the benchmarks: their problems, and the recorded comparison with other engines with
//! its table.

pub mod problems;
pub mod recording;
pub mod table;
pub mod timing;
