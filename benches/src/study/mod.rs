//! What is measured: one study a file. Nothing is timed before it is known to be right.

pub mod contest;
pub mod direct_speed;
pub mod peers;
pub mod singular;
pub mod sparse_speed;
pub mod step_speed;
pub mod sweep_speed;
pub mod timing;
pub mod warm_factor;
pub mod yardstick;
