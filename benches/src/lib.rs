//! Shared by the benchmarks: their problems, the recorded comparison with other engines with its
//! table, and the times of solvers that reports show.

pub mod machine;
pub mod problems;
pub mod recording;
pub mod solver_times;
pub mod table;
pub mod timing;
