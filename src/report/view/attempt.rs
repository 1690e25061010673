//! How attempts of solvers are shown in the tables of several studies.

use super::Document;
use crate::number::{count, readable};
use crate::report::page::{Cell, Mark};
use crate::report::study::attempt::Outcome;
use crate::solver::Group;

/// What came of it, marked.
pub fn outcome(outcome: &Outcome) -> Cell {
    let mark = match outcome {
        Outcome::Proved | Outcome::Accepted => Mark::Good,
        Outcome::Refuted => Mark::Bad,
        Outcome::Withdrawn | Outcome::Failed(_) => Mark::Note,
        Outcome::Outside(_) => Mark::Plain,
    };
    let text = match outcome {
        Outcome::Outside(reason) => format!("outside its class: {reason}"),
        outcome => outcome.words().to_string(),
    };
    Cell::text(text).marked(mark)
}

/// `1 234 sweeps`.
pub fn iterations_in_words(solver: &str, iterations: usize) -> String {
    let unit = Group::of(solver).map_or("iterations", Group::unit);
    let unit = if iterations == 1 { unit.trim_end_matches('s') } else { unit };
    format!("{} {unit}", count(iterations))
}

/// Two digits of a large number, in a form that can be read aloud: `12 000`, `1.2×10⁸`.
pub fn rough(value: f64) -> String {
    if !(10.0..1e6).contains(&value) {
        return readable(value, 2);
    }
    let unit = 10f64.powf(value.log10().floor() - 1.0);
    count(((value / unit).round() * unit).round() as usize)
}

/// `a, b and c`; empty for nothing.
pub fn listed<S: AsRef<str>>(names: &[S]) -> String {
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
pub fn tolerance(value: f64) -> String {
    readable(value, 1)
}

/// The id of the section that is open: what figures and tables of it are named after.
pub fn section_id(document: &Document) -> String {
    document.page.sections.last().map_or_else(String::new, |section| section.id.clone())
}

/// A scene's name as part of a file's name: a scene may be called anything.
pub fn stem(scene: &str) -> String {
    scene.replace(|c: char| !(c.is_ascii_alphanumeric() || "_-".contains(c)), "-")
}

/// Words as part of a file's name.
pub fn anchor(words: &str) -> String {
    let parts = words.split(|c: char| !c.is_ascii_alphanumeric()).filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("-").to_ascii_lowercase()
}
