//! Attempts of solvers in the tables of several studies.

use super::ReportPage;
use crate::number::{count, readable};
use crate::report::page::{Cell, Mark};
use crate::report::study::trial::Outcome;
use crate::solver::Registry;

/// The outcome of an attempt, marked.
pub(crate) fn outcome(outcome: &Outcome) -> Cell {
    let mark = match outcome {
        Outcome::Proved | Outcome::Accepted => Mark::Good,
        Outcome::Rejected => Mark::Bad,
        Outcome::Withdrawn | Outcome::Failed(_) => Mark::Note,
        Outcome::Outside(_) => Mark::Plain,
    };
    let text = match outcome {
        Outcome::Outside(reason) => format!("outside its class: {reason}"),
        outcome => outcome.words().to_string(),
    };
    Cell::text(text).marked(mark)
}

/// `1,234 sweeps`.
pub(crate) fn iterations_in_words(solver: &str, iterations: usize) -> String {
    let entry = Registry::standard().entry(solver);
    let unit = entry.map_or("iterations", |entry| entry.group.unit());
    let unit = if iterations == 1 { unit.trim_end_matches('s') } else { unit };
    format!("{} {unit}", count(iterations))
}

/// A large number rounded to two digits, in a readable form: `12,000`, `1.2×10⁸`.
pub(crate) fn rough(value: f64) -> String {
    if !(10.0..1e6).contains(&value) {
        return readable(value, 2);
    }
    let unit = 10f64.powf(value.log10().floor() - 1.0);
    count(((value / unit).round() * unit).round() as usize)
}

/// `a, b and c`; empty for nothing.
pub(crate) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    match names {
        [] => String::new(),
        [one] => one.as_ref().to_string(),
        [first @ .., last] => {
            let first: Vec<&str> = first.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", first.join(", "), last.as_ref())
        }
    }
}

/// A tolerance: `10⁻⁸`.
pub(crate) fn tolerance(value: f64) -> String {
    readable(value, 1)
}

/// The id of the current section: the prefix of its figures and tables.
pub(crate) fn section_id(document: &ReportPage) -> String {
    document.page.sections.last().map_or_else(String::new, |section| section.id.clone())
}

/// A scene's name as part of a file name; a scene may have any name.
pub fn stem(scene: &str) -> String {
    scene.replace(|c: char| !(c.is_ascii_alphanumeric() || "_-".contains(c)), "-")
}

/// Words as part of a file name.
pub(crate) fn anchor(words: &str) -> String {
    let parts = words.split(|c: char| !c.is_ascii_alphanumeric()).filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("-").to_ascii_lowercase()
}
