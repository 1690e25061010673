//! How it is shown: tables, and what was asked for beside what was measured.

mod direct_speed;
mod goal;
mod peers;
mod singular;
mod sparse_speed;
mod step_speed;
mod sweep_speed;
mod warm_factor;
mod yardstick;
