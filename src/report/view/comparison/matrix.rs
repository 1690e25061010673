//! A matrix of schemes and scenes: whether gaps, joints and energy stay within tolerance.

use crate::plot::grades::{Grade, Grades};
use crate::report::study::comparison::{Comparison, Energy, HELD, Run};
use crate::report::view::attempt::listed;
use crate::scene::Scheme;

/// Errors relative to their tolerance, of gaps and joints and of the energy, in the scenes that
/// begin without larger errors: to correct those takes or gives energy.
pub fn matrix(findings: &[Comparison], schemes: &[Scheme]) -> Grades {
    let scenes = || findings.iter().filter(|own| own.starts_within_tolerance());
    let grades = |grade: fn(&Comparison, &Run) -> Grade, scheme: Scheme| -> Vec<Grade> {
        let of =
            |own: &Comparison| own.best_run(scheme).map_or(Grade::Unknown, |run| grade(own, run));
        scenes().map(of).collect()
    };
    let within = |grade: fn(&Comparison, &Run) -> Grade| {
        let all = schemes.iter().flat_map(|&scheme| grades(grade, scheme));
        let judged: Vec<Grade> = all.filter(|grade| *grade != Grade::Unknown).collect();
        let obeyed = judged.iter().filter(|grade| **grade == Grade::Obeyed).count();
        format!("{obeyed} of {} runs", judged.len())
    };
    let names = || scenes().map(|own| own.scene.replace('_', " ")).collect();
    let row = |&scheme: &Scheme| {
        (scheme.name().to_string(), [grades(closure, scheme), grades(energy, scheme)].concat())
    };
    let rows: Vec<(String, Vec<Grade>)> = schemes.iter().map(row).collect();
    let has = |wanted: Grade| rows.iter().any(|(_, cells)| cells.contains(&wanted));
    let marks = [
        (
            Grade::Missed(f64::INFINITY),
            " ✗: the run ended early, or a body passed through another one.",
        ),
        (Grade::Unknown, " –: not judged, because a motor acts."),
    ];
    let marks = marks.map(|(grade, words)| if has(grade) { words } else { "" });
    let others = findings.iter().filter(|own| !own.starts_within_tolerance());
    let others: Vec<String> = others.map(|own| own.scene.replace('_', " ")).collect();
    let others = match others.is_empty() {
        true => String::new(),
        false => format!(
            " Not shown, because gaps are outside the tolerance at the start: {}.",
            listed(&others)
        ),
    };
    Grades {
        id: "comparison_matrix".into(),
        title: format!(
            "Gaps and joints stay within tolerance in {}, the energy in {}",
            within(closure),
            within(energy)
        ),
        caption: format!(
            "A number is the largest error in multiples of its tolerance: {} % of the thinnest body for gaps and joints; \
             1 % of the largest kinetic energy for energy that is gained, or lost other than by friction, impacts and \
             motors.{}{others}",
            100.0 * HELD,
            marks.concat()
        ),
        groups: vec![("gaps and joints".into(), names()), ("energy".into(), names())],
        rows,
        links: Vec::new(),
    }
}

/// The error of gaps and joints of a run.
pub fn closure(comparison: &Comparison, run: &Run) -> Grade {
    let error = run.worst(|sample| sample.drift.max(sample.penetration));
    match run.steps < comparison.steps || run.laws.passages > 0 {
        true => Grade::Missed(f64::INFINITY),
        false => relative(error, HELD * comparison.thinnest),
    }
}

/// The error of the energy of a run.
pub fn energy(comparison: &Comparison, run: &Run) -> Grade {
    match run.laws.energy {
        _ if run.steps < comparison.steps => Grade::Missed(f64::INFINITY),
        Energy::Changes => Grade::Unknown,
        _ => match excess(run) {
            error if error <= 1.0 => Grade::Obeyed,
            error => Grade::Missed(error),
        },
    }
}

/// The error of the energy of a run relative to its tolerance.
pub fn excess(run: &Run) -> f64 {
    run.laws.energy_error.abs() / run.laws.energy_tolerance
}

fn relative(error: f64, tolerance: f64) -> Grade {
    match error <= tolerance {
        true => Grade::Obeyed,
        false => Grade::Missed(error / tolerance),
    }
}
