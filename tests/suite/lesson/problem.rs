//! Problem sets: what is right is taken, what is a typical mistake gets its own hint, and each set
//! is complete.

use std::collections::BTreeMap;
use std::process::Command;

use lcplab::lesson::problem::{Kind, Problem, Reply};
use lcplab::lesson::template::Template;

#[derive(serde::Deserialize)]
struct Set {
    problem: Vec<Template>,
}

/// The problems of all lessons.
pub(super) fn templates() -> Vec<(usize, Vec<Template>)> {
    let read = |number: usize| {
        let path = format!("{}/notebooks/problems/{number:02}.toml", env!("CARGO_MANIFEST_DIR"));
        let set: Set = toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        (number, set.problem)
    };
    (1..=17).map(read).collect()
}

/// With the numbers that the lessons print.
fn sets() -> Vec<(usize, Vec<Problem>)> {
    let printed =
        |templates: Vec<Template>| templates.iter().map(|own| own.printed().unwrap()).collect();
    templates().into_iter().map(|(lesson, templates)| (lesson, printed(templates))).collect()
}

#[test]
fn each_lesson_has_problems_on_paper_and_in_all_four_in_five_ask_to_run_or_drag_something() {
    let mut to_try = 0;
    for (lesson, problems) in sets() {
        assert!(problems.len() >= 2 && problems[0].kind == Kind::Pencil, "{lesson}");
        to_try += usize::from(problems.iter().any(|problem| problem.kind != Kind::Pencil));
        for (k, problem) in problems.iter().enumerate() {
            let (letter, shows) = match problem.kind {
                Kind::Pencil => ("p", ""),
                Kind::Predict => ("r", ""),
                Kind::Live => ("x", "](../live/"),
            };
            let before = problems[..k].iter().filter(|other| other.kind == problem.kind).count();
            assert_eq!(problem.id, format!("{lesson}.{letter}{}", before + 1));
            assert!(problem.text.contains(shows), "{}", problem.id);
            assert!((1..=3).contains(&problem.level) && (3..=20).contains(&problem.minutes));
            assert!(!problem.traps.is_empty() && problem.within < 0.1, "{}", problem.id);
        }
    }
    assert!(5 * to_try >= 4 * sets().len(), "{to_try}");
}

#[test]
fn the_answer_is_right_and_a_typical_mistake_gets_its_own_hint() {
    for problem in sets().into_iter().flat_map(|(_, problems)| problems) {
        let id = &problem.id;
        assert_eq!(problem.reply(problem.answer), Reply::Right, "{id}");
        for trap in &problem.traps {
            assert_eq!(problem.reply(trap.answer), Reply::Wrong(trap.hint.clone()), "{id}");
        }
    }
}

#[test]
fn a_wrong_number_is_said_to_be_too_much_too_little_or_of_the_wrong_sign() {
    let problem = Problem {
        id: "0.p1".into(),
        kind: Kind::Pencil,
        title: String::new(),
        minutes: 5,
        level: 1,
        parameters: BTreeMap::new(),
        text: String::new(),
        unit: "N s".into(),
        answer: 2.0,
        within: 0.01,
        also: Vec::new(),
        traps: Vec::new(),
        because: String::new(),
    };
    let says = |number: f64| match problem.reply(number) {
        Reply::Wrong(reason) => reason,
        Reply::Right | Reply::AlsoRight(_) => "right".into(),
    };
    assert_eq!(says(2.019), "right");
    assert_eq!(says(2.021), "2.021 N s is too much");
    assert_eq!(says(1.9), "1.9 N s is too little");
    assert_eq!(says(-2.0), "the magnitude is right, the sign is not");
    assert_eq!(says(f64::NAN), "enter a finite number");
}

#[test]
fn a_prediction_cannot_be_found_by_halving() {
    for problem in sets().into_iter().flat_map(|(_, problems)| problems) {
        if problem.kind == Kind::Pencil {
            continue;
        }
        let size = 1.0 + problem.answer.abs();
        for off in [-7.3, 9.1] {
            let Reply::Wrong(words) = problem.reply(problem.answer + off * size) else {
                panic!("{}: {off} off is taken", problem.id);
            };
            assert!(!words.contains("too much") && !words.contains("too little"), "{words}");
        }
    }
}

/// The largest speed of one of three balls whose momentum is 0 and whose Σ m v² is the gap: v,
/// −v/2, −v/2, so 3/2 m v² = gap.
#[test]
fn right_answers_by_a_sharper_argument_or_another_sign_are_taken() {
    let all: Vec<Problem> = sets().into_iter().flat_map(|(_, problems)| problems).collect();
    let named = |id: &str| all.iter().find(|problem| problem.id == id).unwrap();
    let sharper = (0.06_f64 / 1.5).sqrt();
    assert!(matches!(named("8.p1").reply(sharper), Reply::AlsoRight(_)));
    assert_eq!(named("8.p1").reply(0.06_f64.sqrt()), Reply::Right);
    // 1/m + r r₀/I = 0
    let place = -0.24 / (2.0 * 0.6);
    assert!(matches!(named("3.p1").reply(place), Reply::AlsoRight(_)));
    assert_eq!(named("3.p1").reply(-place), Reply::Right);
}

#[test]
fn the_command_states_a_problem_and_answers_with_its_exit_code() {
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_lcplab")).args(arguments).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        (output.status.code().unwrap(), text, String::from_utf8(output.stderr).unwrap())
    };
    assert!(run(&["exercise", "12.p1"]).1.contains("stay at rest"));
    assert_eq!(run(&["exercise", "12.p1", "3"]).0, 0);
    assert_eq!(run(&["exercise", "12.p1", "-3"]).0, 1);
    assert_eq!(run(&["exercise", "12.p1", "three"]).0, 2);
    assert!(run(&["exercise", "12.p1", "0,3"]).2.contains("decimal point"));
    assert!(run(&["exercise", "12.p1", "3 N s"]).2.contains("without a unit"));
    assert_eq!(run(&["exercise", "12.p1", "9/3"]).0, 0);
    assert_eq!(run(&["exercise", "12.p1", "-9/3"]).0, 1);
    assert!(run(&["exercise"]).1.contains("12.p1  "));
    let (code, _, complaint) = run(&["exercise", "9.p7", "3"]);
    assert!(code == 2 && complaint.contains("9.p1"), "{complaint}");
}
