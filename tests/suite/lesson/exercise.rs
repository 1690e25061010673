//! Each solution passes; each hole, each bug and two typical mistakes fail, with words that say
//! why.

use lcplab::lesson::exercise::{Exercise, exercises};

#[path = "../../../notebooks/exercises/mod.rs"]
#[allow(non_snake_case, unused_variables, unused_mut)]
mod holes;
#[path = "mistakes/mod.rs"]
mod mistakes;
#[path = "../../../notebooks/solutions/mod.rs"]
#[allow(non_snake_case)]
mod solutions;

const HOLES: &[Exercise] = exercises!(holes);
const SOLUTIONS: &[Exercise] = exercises!(solutions);

#[test]
fn every_solution_passes() {
    for exercise in SOLUTIONS {
        assert_eq!(exercise.verdict(), Ok(()), "{}", exercise.id);
    }
}

#[test]
fn every_hole_is_said_to_be_one() {
    for exercise in HOLES.iter().filter(|exercise| !exercise.id.ends_with('b')) {
        let reason = exercise.verdict().unwrap_err();
        assert_eq!(reason, format!("the gap is not filled in yet: open {}", exercise.file));
    }
}

#[test]
fn every_bug_shows_and_none_stops_the_program() {
    let bugs: Vec<_> = HOLES.iter().filter(|exercise| exercise.id.ends_with('b')).collect();
    assert_eq!(bugs.len(), 12);
    for exercise in bugs {
        let reason = exercise.verdict().unwrap_err();
        assert!(!reason.contains("panicked"), "{}: {reason}", exercise.id);
    }
}

#[test]
fn two_typical_mistakes_fail_in_every_exercise() {
    for exercise in SOLUTIONS {
        let made: Vec<_> =
            mistakes::all().into_iter().filter(|(id, _)| *id == exercise.id).collect();
        assert!(made.len() >= 2, "{} has {} mistakes", exercise.id, made.len());
        for (k, (id, verdict)) in made.iter().enumerate() {
            assert!(verdict.is_err(), "mistake {k} of {id} passes");
        }
    }
}
