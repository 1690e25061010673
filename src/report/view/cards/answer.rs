//! Which engine for which use: the laws that a use requires, the engines that obey all of them, and
//! those with the largest deviations.

use super::{ACCURATE, DEFAULTS, OWN};
use crate::number::readable;
use crate::report::study::cards::{Column, Engine, Phenomenon, Record};

/// Possible uses, and the phenomena that each requires.
const USES: [(&str, &[&str]); 7] = [
    ("A gripper, a leg", &["creep", "wall", "capstan", "stopping", "weight", "standing_tree"]),
    ("A tower, a load", &["tower", "mass_ratio", "weight"]),
    ("Rolling and sliding", &["directions", "rolling", "stopping"]),
    ("A mechanism", &["spring", "pendulum", "chain", "closed_loop", "bricard"]),
    ("Flight", &["free_fall", "angular_momentum", "flying_tree", "top"]),
    ("Throws and impacts", &["lift", "bounce", "bullet"]),
    ("Learning and optimization", &["predictability", "order", "repeat"]),
];

/// What was tested, and the engine that obeys the most laws.
pub fn of(record: &Record) -> String {
    let others = || record.engines.iter().filter(|engine| engine.name != OWN);
    let held = |name: &str, settings: &str| {
        let obeys = |own: &&Phenomenon| column(own, name, settings).is_some_and(Column::holds);
        record.phenomena.iter().filter(obeys).count()
    };
    let best = |settings: &str| {
        let count = |engine: &&Engine| held(&engine.name, settings);
        let best = others().max_by_key(count);
        best.map_or(String::new(), |best| format!("{} obeys {}", best.title, count(&best)))
    };
    format!(
        "{} laws of mechanics, each in its own scene, tested on {} physics engines. With default settings {} \
         of them, the most of all; with accurate settings {}.",
        record.phenomena.len(),
        others().count(),
        best(DEFAULTS),
        best(ACCURATE)
    )
}

/// One paragraph per use.
pub fn uses(record: &Record) -> String {
    let begins = "For each use: the engines that obey all of the laws that matter for it, and the engine \
                  that violates them most.";
    let paragraphs = USES.iter().map(|(what, names)| paragraph(record, what, names));
    std::iter::once(begins.to_string()).chain(paragraphs).collect::<Vec<_>>().join("\n\n")
}

fn paragraph(record: &Record, what: &str, names: &[&str]) -> String {
    let rests_on: Vec<&Phenomenon> =
        record.phenomena.iter().filter(|own| names.contains(&own.name.as_str())).collect();
    let keeping = |settings: &str| -> Vec<&str> {
        let others = record.engines.iter().filter(|engine| engine.name != OWN);
        let keep = others.filter(|engine| {
            rests_on
                .iter()
                .all(|own| column(own, &engine.name, settings).is_some_and(Column::holds))
        });
        keep.map(|engine| engine.title.as_str()).collect()
    };
    let (installed, accurate) = (keeping(DEFAULTS), keeping(ACCURATE));
    let tuned: Vec<_> = accurate.into_iter().filter(|own| !installed.contains(own)).collect();
    let links = rests_on.iter().map(|own| format!("[{}](#{})", words(&own.name), own.name));
    let who = match (&installed[..], &tuned[..]) {
        ([], []) => "no engine obeys all of these laws".into(),
        ([], tuned) => {
            format!(
                "with default settings no engine obeys all of these laws; with accurate settings {}",
                list(tuned)
            )
        }
        (installed, []) => {
            format!("with default settings {} obey all of these laws", list(installed))
        }
        (installed, tuned) => format!(
            "with default settings {} obey all of these laws; with accurate settings also {}",
            list(installed),
            list(tuned)
        ),
    };
    let misses: Vec<String> = rests_on.iter().filter_map(|own| farthest(record, own)).collect();
    let farthest = match misses.is_empty() {
        true => String::new(),
        false => format!(" Largest violation with default settings: {}.", misses.join("; ")),
    };
    format!("**{what}** ({}): {who}.{farthest}", links.collect::<Vec<_>>().join(", "))
}

fn column<'a>(phenomenon: &'a Phenomenon, engine: &str, settings: &str) -> Option<&'a Column> {
    phenomenon.columns.iter().find(|own| own.engine == engine && own.settings == settings)
}

fn words(name: &str) -> String {
    name.replace('_', " ")
}

fn list(names: &[&str]) -> String {
    match names {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        names => names.concat(),
    }
}

/// The external engine with the largest deviation from a law with default settings, with its number
/// and the law's.
fn farthest(record: &Record, phenomenon: &Phenomenon) -> Option<String> {
    let installed = phenomenon.columns.iter().filter(|own| own.settings == DEFAULTS);
    let missed = installed.filter_map(|own| Some((own, own.worst().filter(|worst| !worst.holds)?)));
    let (column, worst) = missed.max_by(|a, b| a.1.miss().total_cmp(&b.1.miss()))?;
    let law = match worst.law {
        0.0 => String::new(),
        law => format!(", not {}", quantity(law, &worst.unit)),
    };
    let (engine, found) = (record.title(&column.engine), quantity(worst.value, &worst.unit));
    let law_of = words(&phenomenon.name);
    Some(format!("{law_of}, where {engine} {} {found}{law}", worst.what))
}

/// A number with its unit.
fn quantity(value: f64, unit: &str) -> String {
    let gap = if matches!(unit, "" | "°") { "" } else { " " };
    format!("{}{gap}{unit}", readable(value, 3))
}
