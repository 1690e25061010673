//! What does a sweep over a tower of 700 cubes cost, and what does a tolerance?

#![allow(missing_docs)]

mod measure;

use lcplab::report::study::settings::AtStep;
use lcplab_benches::study::sweep_speed::Plan;

fn main() {
    let rounds = if measure::is_test() { 1 } else { 41 };
    let scenes = vec![AtStep { scene: "tower".into(), step: 3 }];
    measure::print(&Plan { scenes, rounds, ..Plan::default() });
}
