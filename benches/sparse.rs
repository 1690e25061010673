//! What does an exact answer cost where A is large and sparse, beside clarabel?

#![allow(missing_docs)]

mod measure;

use lcplab_benches::study::sparse_speed::{Plan, Problem};

fn main() {
    let net = Problem { scene: "net".into(), step: 3, goal: 1.4 };
    if measure::is_test() {
        measure::print(&Plan { problems: vec![net], seconds: 0.0, ..Plan::default() });
    } else {
        measure::print(&Plan { seconds: 5.0, ..Plan::default() });
    }
}
