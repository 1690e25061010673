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
    let names = || scenes().map(|own| own.scene.replace('_', " ")).collect();
    let row = |&scheme: &Scheme| {
        (scheme.name().to_string(), [grades(closure, scheme), grades(energy, scheme)].concat())
    };
    let kept = kept(findings, schemes);
    let broken = schemes.iter().filter(|scheme| !kept.contains(scheme));
    let rows: Vec<(String, Vec<Grade>)> = kept.iter().chain(broken).map(row).collect();
    let title = match &kept[..] {
        [] => "No scheme keeps all gaps and joints".into(),
        [only] => format!("Only {} keeps all gaps and joints", only.name()),
        [best, ..] => format!(
            "{} of {} schemes keep all gaps and joints; of them {} has the smallest worst error of the energy",
            kept.len(),
            schemes.len(),
            best.name()
        ),
    };
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
        title,
        caption: format!(
            "The schemes that keep all gaps and joints are on top. A number is the largest error in multiples of its tolerance: {} % of the thinnest body for gaps and joints; \
             1 % of the largest kinetic energy for energy that is gained, or lost other than by friction, impacts and \
             motors.{}{others}",
            100.0 * HELD,
            marks.concat()
        ),
        groups: vec![("gaps and joints".into(), names()), ("energy".into(), names())],
        rows,
        links: Vec::new(),
        has_counts: false,
    }
}

/// The schemes that keep gaps and joints within tolerance in every scene that begins so, the one
/// with the smallest error of the energy first.
pub fn kept(findings: &[Comparison], schemes: &[Scheme]) -> Vec<Scheme> {
    let is_kept = |scheme: &&Scheme| worst(findings, **scheme, error) <= 1.0;
    let mut kept: Vec<Scheme> = schemes.iter().filter(is_kept).copied().collect();
    let energy = |scheme: &Scheme| worst(findings, *scheme, excess);
    kept.sort_by(|a, b| energy(a).total_cmp(&energy(b)));
    kept
}

/// The largest error of a scheme in the scenes that begin within tolerance; infinite without a run.
pub fn worst(findings: &[Comparison], scheme: Scheme, error: fn(&Comparison, &Run) -> f64) -> f64 {
    let scenes = findings.iter().filter(|own| own.starts_within_tolerance());
    let errors =
        scenes.map(|own| own.best_run(scheme).map_or(f64::INFINITY, |run| error(own, run)));
    errors.max_by(f64::total_cmp).unwrap_or(f64::INFINITY)
}

/// The largest error of gaps and joints of a run relative to its tolerance; infinite if it ended
/// early or a body passed through another one.
pub fn error(comparison: &Comparison, run: &Run) -> f64 {
    match run.steps < comparison.steps || run.laws.passages > 0 {
        true => f64::INFINITY,
        false => {
            let error = run.worst(|sample| sample.drift.max(sample.penetration));
            error / (HELD * comparison.thinnest)
        }
    }
}

fn closure(comparison: &Comparison, run: &Run) -> Grade {
    graded(error(comparison, run))
}

/// The error of the energy of a run.
fn energy(comparison: &Comparison, run: &Run) -> Grade {
    match run.laws.energy {
        _ if run.steps < comparison.steps => Grade::Missed(f64::INFINITY),
        Energy::Changes => Grade::Unknown,
        _ => graded(excess(comparison, run)),
    }
}

/// The error of the energy of a run relative to its tolerance.
pub fn excess(_: &Comparison, run: &Run) -> f64 {
    run.laws.energy_error.abs() / run.laws.energy_tolerance
}

fn graded(error: f64) -> Grade {
    match error <= 1.0 {
        true => Grade::Obeyed,
        false => Grade::Missed(error),
    }
}
