//! The grammar of problems and proofs, by the cases of `proofs/cases.json`.

use serde_json::Value;

use super::checkers::{Pair, in_crate, others, own};

/// A case of the file: what is expected, and why.
struct Case {
    expected: String,
    reason: String,
    pair: Pair,
}

fn cases() -> Vec<Case> {
    let text = std::fs::read_to_string(in_crate("../../proofs/cases.json")).unwrap();
    let all: Vec<Value> = serde_json::from_str(&text).unwrap();
    let word = |case: &Value, key: &str| case[key].as_str().unwrap().to_string();
    // A text where the text matters, as that of 1.0 for an index; else the value itself.
    let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), String::from);
    let case = |case: &Value| Case {
        expected: word(case, "expected"),
        reason: word(case, "reason"),
        pair: (text(&case["problem"]), text(&case["proof"])),
    };
    all.iter().map(case).collect()
}

#[test]
fn every_checker_accepts_and_refuses_what_the_specification_does() {
    let cases = cases();
    assert!(cases.len() > 200, "{}", cases.len());
    let pairs: Vec<Pair> = cases.iter().map(|case| case.pair.clone()).collect();
    let own = pairs.iter().map(|(problem, proof)| own(problem, proof).to_string()).collect();
    let mut wrong = String::new();
    for (checker, verdicts) in [("lcplab", own)].into_iter().chain(others(&pairs)) {
        for (case, verdict) in cases.iter().zip(verdicts) {
            if verdict != case.expected {
                wrong += &format!(
                    "{checker} says {verdict}, expected is {}: {}\n  {:.300}\n  {:.300}\n",
                    case.expected, case.reason, case.pair.0, case.pair.1
                );
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
