//! Which engine for which use: the laws that a use requires, the engines that obey all of them, and
//! those with the largest deviations.

use super::{ACCURATE, DEFAULTS, OWN};
use crate::number::readable;
use crate::report::page::{Cell, Table};
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

/// The engines that obey all laws that a use requires, and the largest violation.
pub fn uses(record: &Record) -> Table {
    let rows = USES.iter().map(|(what, names)| row(record, what, names)).collect();
    Table::new(
        "Which engine for which use",
        "The engines that obey all of the laws that matter for a use, and the largest violation of one of them \
         with default settings.",
        "use | laws that matter | obeyed as installed by | with accurate settings by | largest violation as installed",
        rows,
    )
}

fn row(record: &Record, what: &str, names: &[&str]) -> Vec<Cell> {
    let rests_on: Vec<&Phenomenon> =
        record.phenomena.iter().filter(|own| names.contains(&own.name.as_str())).collect();
    let obeying = |settings: &str| {
        let others = record.engines.iter().filter(|engine| engine.name != OWN);
        let obey = others.filter(|engine| {
            rests_on
                .iter()
                .all(|own| column(own, &engine.name, settings).is_some_and(Column::holds))
        });
        let titles: Vec<&str> = obey.map(|engine| engine.title.as_str()).collect();
        Cell::text(if titles.is_empty() { "none".into() } else { titles.join(", ") })
    };
    let names = rests_on.iter().map(|own| words(&own.name)).collect::<Vec<_>>().join(", ");
    let links = rests_on.iter().map(|own| format!("[{}](#{})", words(&own.name), own.name));
    let markup = links.collect::<Vec<_>>().join(", ");
    let worst = rests_on.iter().filter_map(|own| farthest(record, own));
    let worst = worst.max_by(|a, b| a.0.total_cmp(&b.0)).map_or("none".into(), |(_, said)| said);
    vec![
        Cell::text(what),
        Cell { markup, ..Cell::text(names) },
        obeying(DEFAULTS),
        obeying(ACCURATE),
        Cell::text(worst),
    ]
}

fn column<'a>(phenomenon: &'a Phenomenon, engine: &str, settings: &str) -> Option<&'a Column> {
    phenomenon.columns.iter().find(|own| own.engine == engine && own.settings == settings)
}

fn words(name: &str) -> String {
    name.replace('_', " ")
}

/// The largest violation of a law with default settings, in tolerances, and that in words with its
/// number and the law's.
fn farthest(record: &Record, phenomenon: &Phenomenon) -> Option<(f64, String)> {
    let installed = phenomenon.columns.iter().filter(|own| own.settings == DEFAULTS);
    let missed = installed.filter_map(|own| Some((own, own.worst().filter(|worst| !worst.holds)?)));
    let (column, worst) = missed.max_by(|a, b| a.1.miss().total_cmp(&b.1.miss()))?;
    let law = match worst.law {
        0.0 => String::new(),
        law => format!(", not {}", quantity(law, &worst.unit)),
    };
    let (engine, found) = (record.title(&column.engine), quantity(worst.value, &worst.unit));
    let said = format!("{}: {engine} {} {found}{law}", words(&phenomenon.name), worst.what);
    Some((worst.miss(), said))
}

/// A number with its unit.
fn quantity(value: f64, unit: &str) -> String {
    let gap = if matches!(unit, "" | "°") { "" } else { " " };
    format!("{}{gap}{unit}", readable(value, 3))
}
