//! One file an exercise: fill the hole, then run `cargo run --release -- exercise 1.1`.

pub mod e01_1_clamp;
pub mod e01_2_one_row;
pub mod e01_3_two_rows;
pub mod e02_1_rod;
pub mod e02_2_nail;
pub mod e02_3_freedoms;
pub mod e03_1_offset;
pub mod e03_2_delassus;
pub mod e03_3_two_levels;
pub mod e07_1_tangent;
pub mod e07_2_bias;
pub mod e07_3_spring;
pub mod e04_1_sweep;
pub mod e04_2_impulse;
pub mod e04_3_omega;
pub mod e05_1_active_set;
pub mod e05_2_murty;
pub mod e05_3_ratio;
pub mod e06_1_residual;
pub mod e06_2_gap;
pub mod e06_3_farkas;
