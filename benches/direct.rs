//! What do direct and Newton-like solvers cost by the number of rows, beside clarabel?

#![allow(missing_docs)]

mod measure;

use lcplab::report::study::direct_speed::Plan;

fn main() {
    if measure::is_test() {
        let (one_sided, two_sided) = (vec![50], vec![50]);
        measure::print(&Plan { one_sided, two_sided, seconds: 0.0, ..Plan::default() });
    } else {
        measure::print(&Plan { seconds: 5.0, ..Plan::default() });
    }
}
