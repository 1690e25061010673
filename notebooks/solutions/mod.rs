//! One solution an exercise; look only after you have tried.

pub mod e01_1_clamp;
pub mod e01_2_one_row;
pub mod e01_3_two_rows;
pub mod e08_1_friction_row;
pub mod e08_2_cone;
pub mod e08_3_uphill;
pub mod e09_1_two_balls;
pub mod e09_2_all_answers;
pub mod e09_3_critical_friction;
pub mod e11_1_layers;
pub mod e11_2_warm_start;
pub mod e11_3_sweeps;
