//! What does a sweep over a dense A cost beside reading A once?

#![allow(missing_docs)]

mod measure;

use lcplab_benches::study::sweep_speed::Plan;

fn main() {
    let rounds = if measure::is_test() { 1 } else { 61 };
    measure::print(&Plan { dense: vec![200, 500, 1000], rounds, ..Plan::default() });
}
