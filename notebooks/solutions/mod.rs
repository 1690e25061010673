//! One solution an exercise; look only after you have tried.

pub mod e01_1_clamp;
pub mod e01_2_one_row;
pub mod e01_3_two_rows;
pub mod e04_1_sweep;
pub mod e04_2_impulse;
pub mod e04_3_omega;
