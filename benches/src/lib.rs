//! What the benchmarks share: their problems, and the recorded run beside other engines with its
//! table.

pub mod problems;
pub mod recording;
pub mod table;
pub mod timing;
