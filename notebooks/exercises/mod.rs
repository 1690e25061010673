//! One file an exercise: fill the hole, then run `cargo run --release -- exercise 1.1`.

pub mod e01_1_clamp;
pub mod e01_2_one_row;
pub mod e01_3_two_rows;
pub mod e04_1_sweep;
pub mod e04_2_impulse;
pub mod e04_3_omega;
