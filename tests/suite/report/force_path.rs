//! Forces through columns and chains, and what happens where they are left out.

use lcplab::report::study::Study;
use lcplab::report::study::force_path::{Chain, Finding, Plan};
use lcplab::report::study::sinking;
use lcplab::report::view::View;

const G: f64 = 9.81;

fn findings() -> (Plan, Vec<Finding>) {
    let chain = Some(Chain { scene: "ball_and_chain".into(), sweeps: vec![5] });
    let plan = Plan { bodies: 4, ratios: vec![100.0], sweeps: vec![4, 10, 30, 50], chain };
    let findings = (0..plan.tasks().len()).map(|k| plan.run(k).unwrap().0).collect();
    (plan, findings)
}

#[test]
fn a_contact_carries_what_stands_above_it() {
    let (_, findings) = findings();
    let loads = [103.0, 102.0, 101.0, 100.0].map(|mass| mass * G);
    for (expected, load) in findings[0].expected.iter().zip(loads) {
        assert!((expected - load).abs() < 1e-9);
    }
    assert!(findings[0].left_out(&findings[0].paths[0]) < 1e-9); // Dantzig
}

#[test]
fn sweeps_leave_out_the_published_part_of_the_force_between_two_balls() {
    let (plan, findings) = findings();
    // Benchmarks of the mass ratio: r = 100 after 4, 10, 30 and 50 sweeps.
    for (path, published) in findings[1].paths[1..].iter().zip([0.961, 0.905, 0.742, 0.608]) {
        let left = findings[1].left_out(path);
        assert!((left - published).abs() < 5e-4, "{}: {left}", path.name);
    }
    let outcome = plan.outcome(&findings);
    assert!(outcome.good, "{}", outcome.says);
}

#[test]
fn a_joint_of_a_chain_carries_what_hangs_below_it_and_few_sweeps_do_not_bring_it_there() {
    let (_, findings) = findings();
    let chain = &findings[2];
    assert_eq!(chain.expected.len(), 41);
    for (k, expected) in chain.expected.iter().enumerate() {
        let below = 4021.0 + 5.98 * (40 - k) as f64;
        assert!((expected - below * G).abs() < 1e-6, "joint {}", k + 1);
    }
    assert!(chain.left_out(&chain.paths[0]) < 1e-6);
    assert!(chain.left_out(&chain.paths[1]) > 0.99);
}

#[test]
fn a_stack_sinks_where_the_sweeps_carry_too_little_and_not_under_a_direct_solver() {
    let plan: sinking::Plan = toml::from_str(
        "boxes = 3\nratios = [100.0]\nduration = 0.2\nfilm = 100.0\nshots = 3\n\
         solvers = [{ solver = 'dantzig' }, { solver = 'pgs', sweeps = 10, warm = false },\n\
         { solver = 'pgs', sweeps = 40, warm = false }]",
    )
    .unwrap();
    let found = plan.run(0).unwrap().0;
    let [direct, few, more] = [0, 1, 2].map(|k| &found.runs[k]);
    assert!((direct.carried[0] - 1.0).abs() < 1e-9 && (direct.carried[1] - 1.0).abs() < 1e-9);
    assert!(few.carried[0] < more.carried[0] && more.carried[0] < 0.9);
    assert!(direct.history.penetration < 1e-9);
    assert!(few.history.penetration > 1e-3);
    // Of the stack that sweeps let sink nothing is claimed; the direct solver must carry it.
    assert!(plan.outcome(std::slice::from_ref(&found)).good);
    let mut sunk = found.clone();
    sunk.runs[0].history.penetration = 0.02;
    let outcome = plan.outcome(&[sunk]);
    assert!(!outcome.good && outcome.says.contains("0 of 1"), "{}", outcome.says);
    let footage = found.footage.unwrap();
    assert_eq!(footage.reels.len(), 3);
    assert_eq!(footage.film().unwrap().times().len(), 3);
}
