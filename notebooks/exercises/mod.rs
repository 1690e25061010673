//! One file an exercise: fill the hole, then run `cargo run --release -- exercise 1.1`.

pub mod e01_1_clamp;
pub mod e01_2_one_row;
pub mod e01_3_two_rows;
pub mod e04_1_sweep;
pub mod e04_2_impulse;
pub mod e04_3_omega;
pub mod e05_1_active_set;
pub mod e05_2_murty;
pub mod e05_3_ratio;
pub mod e06_1_residual;
pub mod e06_2_gap;
pub mod e06_3_farkas;
