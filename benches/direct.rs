//! What do direct and Newton-like methods cost on definite problems beside clarabel, and what is the last
//! active set worth?

#![allow(missing_docs)]

mod measure;

use lcplab_benches::study::{direct_speed, warm_factor};

fn main() {
    if measure::is_test() {
        let (one_sided, two_sided) = (vec![20], vec![20]);
        let plan = direct_speed::Plan { one_sided, two_sided, seconds: 0.0, ..Default::default() };
        measure::print(&plan);
        measure::print(&warm_factor::Plan { rows: vec![20], seconds: 0.0, ..Default::default() });
    } else {
        measure::print(&direct_speed::Plan { seconds: 2.0, ..Default::default() });
        measure::print(&warm_factor::Plan { seconds: 2.0, ..Default::default() });
    }
}
