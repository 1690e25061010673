//! The table of other engines; times are not tested.

use lcplab_benches::recording::{Answer, Recording};
use lcplab_benches::table::{Goal, goals, page, recorded};
use lcplab_benches::timing::{Contender, Time, interleaved};

/// In each round every contender has its turn; the first round warms up and does not count.
#[test]
fn contenders_take_turns_and_the_first_round_does_not_count() {
    let turns = std::cell::RefCell::new(String::new());
    let contender = |name: char, seconds: [f64; 4]| {
        let turns = &turns;
        let mut runs = seconds.into_iter();
        Contender::new(move || {
            turns.borrow_mut().push(name);
            runs.next().unwrap()
        })
    };
    let mut both = [contender('a', [9.0, 3.0, 1.0, 2.0]), contender('b', [0.1, 5.0, 5.0, 4.0])];
    let times = interleaved(3, &mut both);
    assert_eq!(times, [Time { median: 2.0, best: 1.0 }, Time { median: 5.0, best: 4.0 }]);
    assert_eq!(*turns.borrow(), "abababab");
}

#[test]
fn the_committed_page_is_that_of_the_recording() {
    let written = include_str!("../peers.md");
    assert!(
        written == page(&recorded().unwrap(), &goals().unwrap()),
        "cargo run -p lcplab-benches"
    );
}

#[test]
fn every_goal_is_about_a_recorded_problem_and_contender() {
    let recording = recorded().unwrap();
    for goal in goals().unwrap() {
        assert!(recording.faster(&goal).is_some(), "{goal:?}");
    }
}

/// A recording of one problem: ours takes 2 and 3 ms, another library 5 ms, and one has no answer.
fn small() -> Recording {
    let answer = |contender: &str, ours, time: Option<f64>| Answer {
        contender: contender.into(),
        ours,
        residual: None,
        complaint: None,
        time: time.map(|best| Time { median: 2.0 * best, best }),
    };
    let mut recording = recorded().unwrap();
    recording.scenes.clear();
    recording.problems.truncate(1);
    recording.problems[0].name = "three rods".into();
    recording.problems[0].rows = 3;
    recording.problems[0].answers = vec![
        answer("dantzig", true, Some(2e-3)),
        answer("lemke", true, Some(3e-3)),
        answer("ODE Dantzig", false, Some(5e-3)),
        answer("Bullet Lemke", false, None),
    ];
    recording
}

#[test]
fn the_table_has_the_fastest_method_of_each_library_and_a_dash_without_an_answer() {
    let text = page(&small(), &[]);
    assert!(text.contains("\n| three rods | 3 | **2** | 5 | – | – | – | – | – |\n"), "{text}");
    assert!(text.ends_with("\n- none\n"), "{text}");
}

#[test]
fn a_goal_is_missed_below_the_required_number() {
    let goal = |ours: &str, faster| Goal {
        problem: "three rods".into(),
        ours: Some(ours.into()),
        peer: Some("ODE".into()),
        faster,
    };
    let text = page(&small(), &[goal("dantzig", 2.5), goal("lemke", 2.0)]);
    assert!(!text.contains("dantzig"), "{text}"); // 5/2 is enough
    assert!(text.ends_with("- three rods: lemke is 1.67 times as fast as ODE, not 2\n"), "{text}");
}
