//! What does a whole step cost, and how does that grow with the scene?

#![allow(missing_docs)]

mod measure;

use lcplab_benches::study::step_speed::Plan;

fn main() {
    if measure::is_test() {
        let (towers, nets) = (vec![400, 800], vec![5, 10]); // rings of 20 and more keep clear of themselves
        measure::print(&Plan { towers, nets, steps: 1, ..Plan::default() });
    } else {
        measure::print(&Plan { steps: 30, ..Plan::default() });
    }
}
