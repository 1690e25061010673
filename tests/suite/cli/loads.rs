//! `--loads`: the forces of an answer by bodies.

use serde_json::Value;

use super::{out, run};

/// Five boxes of 1 kg: 49.05 N on the ground, which four corners share in any way that balances.
#[test]
fn solve_judge_and_simulate_state_the_same_loads() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (problem, answer) = (path("stack.json"), path("x.json"));
    assert_eq!(run(&["export", "stack", "--step", "1", "--out", &problem]).status.code(), Some(0));
    let solved = out(&run(&["solve", &problem, "--loads", "--json"]));
    std::fs::write(&answer, &solved).unwrap();
    let judged = out(&run(&["judge", &problem, &answer, "--loads", "--json"]));
    let simulated = out(&run(&["simulate", "stack", "--steps", "1", "--loads", "--json"]));
    for text in [solved, judged, simulated] {
        let loads = serde_json::from_str::<Value>(&text).unwrap()["loads"].take();
        let pair = &loads["pairs"][0];
        assert_eq!(
            (&pair["by"], &pair["on"], &loads["unit"]),
            (&"ground".into(), &"box1".into(), &"N".into())
        );
        assert!((pair["carried"].as_f64().unwrap() - 49.05).abs() < 1e-6, "{pair}");
        assert_eq!(pair["range"]["is_unique"], true, "{pair}");
        for contact in pair["contacts"].as_array().unwrap() {
            let most = contact["range"]["most"].as_f64().unwrap();
            assert!((most - 49.05 / 2.0).abs() < 1e-3, "{contact}");
            assert_eq!(contact["range"]["is_unique"], false, "{contact}");
        }
    }
}

#[test]
fn loads_that_cannot_be_stated_have_a_reason() {
    let simulated = |more: &[&str]| {
        let all = [&["simulate", "stack", "--steps", "2", "--loads"], more].concat();
        let json = out(&run(&[&all[..], &["--json"]].concat()));
        let loads = serde_json::from_str::<Value>(&json).unwrap()["loads"].take();
        (out(&run(&all)), loads["unexamined"].as_str().unwrap().to_string())
    };
    let (text, why) = simulated(&["--scheme", "xpbd"]);
    assert_eq!(why, "the last step of the scheme xpbd solves no LCP");
    assert!(text.contains(&format!("not summed: {why}")), "{text}");
    let (text, why) = simulated(&["--set", "contact.model=coulomb-cone"]);
    assert!(why.ends_with("the friction model is coulomb-cone"), "{why}");
    assert!(text.contains(&format!("not summed: {why}")), "{text}");
    // A sum that is off by far allows no statement about other forces.
    let (text, why) = simulated(&["--solver", "pgs", "--sweeps", "3"]);
    assert!(why.starts_with("they need an answer whose motion error is at most 10⁻⁴"), "{why}");
    assert!(text.contains("no ranges: they need") && !text.contains("; unique"), "{text}");
}
