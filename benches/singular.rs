//! What does an exact answer cost where contacts are redundant, beside clarabel?

#![allow(missing_docs)]

mod measure;

use lcplab_benches::study::singular::Plan;

fn main() {
    let seconds = if measure::is_test() { 0.0 } else { 2.0 };
    measure::print(&Plan { seconds, ..Plan::default() });
}
