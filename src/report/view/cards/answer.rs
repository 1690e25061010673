//! Which engine for which use: the laws that a use requires, and the engines that obey all of them.

use super::phenomenon::section;
use super::{ACCURATE, DEFAULTS, OWN, PACED};
use crate::number::readable;
use crate::report::page::{Cell, Table};
use crate::report::study::cards::{Column, Engine, Measured, Phenomenon, Record, Settings};

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

/// The place of a law in the matrix: among those of the first use that requires it.
pub fn place(law: &Phenomenon) -> (usize, &'static str) {
    let place = USES.iter().position(|(_, names)| names.contains(&law.name.as_str()));
    place.map_or((USES.len(), "Other"), |place| (place, USES[place].0))
}

/// How many engines obey all laws, and the one that obeys the most.
pub fn of(record: &Record) -> String {
    let others = || record.engines.iter().filter(|engine| engine.name != OWN);
    let laws = record.phenomena.len();
    let is_faultless = |engine: &&Engine| {
        [DEFAULTS, ACCURATE].iter().any(|own| obeyed(record, engine, own).0 == laws)
    };
    let faultless = match others().filter(is_faultless).count() {
        0 => "none obeys".to_string(),
        1 => "one obeys".into(),
        count => format!("{count} obey"),
    };
    let best = |ways: Vec<(&Engine, &str)>| {
        let best = ways.into_iter().max_by_key(|(own, way)| obeyed(record, own, way).0);
        let Some((engine, settings)) = best else { return Default::default() };
        let name = if engine.name == OWN { format!("*{settings}*") } else { engine.title.clone() };
        let (held, supported) = match obeyed(record, engine, settings) {
            (held, all) if all == laws => (held, all.to_string()),
            (held, some) => (held, format!("the {some} that it supports")),
        };
        let time = pace(record, engine, settings).map(|time| format!("{} s", readable(time, 2)));
        (format!("{name}, {held} of {supported}"), time.unwrap_or_default())
    };
    let with = |settings| best(others().map(|own| (own, settings)).collect());
    let own = record.engines.iter().filter(|engine| engine.name == OWN);
    let own = own.flat_map(|own| own.settings.iter().map(move |way| (own, way.name.as_str())));
    let [installed, accurate, own] = [with(DEFAULTS), with(ACCURATE), best(own.collect())];
    let served = |settings: &str| {
        USES.iter().filter(|(_, names)| !obeying(record, names, settings).is_empty()).count()
    };
    format!(
        "**Of {} physics engines {faultless} all {laws} laws of mechanics.** As installed, the engine that obeys most is \
         {}; with accurate settings {}; of lcplab's schemes {}. They take {}, {} and {} of wall time for one second of a \
         tower of ten cubes (Table 2). **Choose by use (Table 1)**: as installed, an engine obeys all laws that \
         matter for {} of {} uses, with accurate settings for {}.",
        others().count(),
        installed.0,
        accurate.0,
        own.0,
        installed.1,
        accurate.1,
        own.1,
        served(DEFAULTS),
        USES.len(),
        served(ACCURATE)
    )
}

/// The number of laws that an engine obeys, and of those that it supports.
fn obeyed(record: &Record, engine: &Engine, settings: &str) -> (usize, usize) {
    let runs = record.phenomena.iter().filter_map(|own| column(own, &engine.name, settings));
    let runs: Vec<&Column> = runs.filter(|own| own.unsupported.is_none()).collect();
    (runs.iter().filter(|own| own.holds()).count(), runs.len())
}

/// The wall time of an engine per simulated second of the scene that measures it.
fn pace(record: &Record, engine: &Engine, settings: &str) -> Option<f64> {
    let paced = record.phenomena.iter().find(|own| own.name == PACED)?;
    column(paced, &engine.name, settings)?.pace
}

/// The laws that each engine obeys, and the time that it takes.
pub fn cost(record: &Record) -> Table {
    let cells = |engine: &Engine, settings: &str| {
        let held = match obeyed(record, engine, settings) {
            (_, 0) => "–".into(),
            (held, all) => format!("{held} of {all}"),
        };
        let time = pace(record, engine, settings);
        [Cell::text(held), time.map_or(Cell::text("–"), |time| Cell::number(time, 2))]
    };
    let row = |(engine, way): (&Engine, &Settings)| {
        let name = match engine.name == OWN {
            true => format!("{OWN}, {}", way.name),
            false => engine.title.clone(),
        };
        let both = [cells(engine, DEFAULTS), cells(engine, &way.name)].concat();
        [Cell::text(name)].into_iter().chain(both).collect()
    };
    let engines = record.engines.iter();
    let ways = engines.flat_map(|own| own.settings.iter().map(move |way| (own, way)));
    Table::new(
        "Laws obeyed, and the wall time for one second of the tower",
        "Of the laws that an engine supports. The tower has ten cubes; each engine takes steps of its own length (Table 3); bodies that \
         sleep cost little. MuJoCo Warp and Newton are made for graphics processors; they ran on the main processor.",
        "engine | as installed | #time (s) | accurate settings | #time (s)",
        ways.filter(|(_, way)| way.name != DEFAULTS).map(row).collect(),
    )
}

/// The engines that obey all of these laws with these settings.
fn obeying<'a>(record: &'a Record, names: &[&str], settings: &str) -> Vec<&'a str> {
    let laws = || record.phenomena.iter().filter(|own| names.contains(&own.name.as_str()));
    let obeys = |engine: &&Engine| {
        laws().all(|own| column(own, &engine.name, settings).is_some_and(Column::holds))
    };
    let others = record.engines.iter().filter(|engine| engine.name != OWN);
    others.filter(obeys).map(|engine| engine.title.as_str()).collect()
}

/// The engines that obey all laws that a use requires.
pub fn uses(record: &Record) -> Table {
    let rows = USES.iter().map(|(what, names)| row(record, what, names)).collect();
    Table::new(
        "Which engine for which use",
        "The engines that obey all of the laws that matter for a use.",
        "use | laws that matter | obeyed as installed by | with accurate settings by",
        rows,
    )
}

fn row(record: &Record, what: &str, names: &[&str]) -> Vec<Cell> {
    let rests_on: Vec<&Phenomenon> =
        record.phenomena.iter().filter(|own| names.contains(&own.name.as_str())).collect();
    let engines = |settings: &str| match &obeying(record, names, settings)[..] {
        [] => Cell::text("none"),
        titles => Cell::text(titles.join(", ")),
    };
    let plain = rests_on.iter().map(|own| words(&own.name)).collect::<Vec<_>>().join(", ");
    let links = rests_on.iter().map(|own| format!("[{}](#{})", words(&own.name), section(own)));
    let markup = links.collect::<Vec<_>>().join(", ");
    vec![
        Cell::text(what),
        Cell { markup, ..Cell::text(plain) },
        engines(DEFAULTS),
        engines(ACCURATE),
    ]
}

fn column<'a>(phenomenon: &'a Phenomenon, engine: &str, settings: &str) -> Option<&'a Column> {
    phenomenon.columns.iter().find(|own| own.engine == engine && own.settings == settings)
}

fn words(name: &str) -> String {
    name.replace('_', " ")
}

/// A measured number, and that of the law unless this is 0.
pub fn found(measured: &Measured) -> String {
    let law = match measured.law {
        0.0 => String::new(),
        // Of "% of a body's weight" only the sign.
        law => {
            let unit = measured.unit.split(" of ").next().unwrap_or_default();
            format!(", not {},", quantity(law, unit))
        }
    };
    format!("{}{law}", quantity(measured.value, &measured.unit))
}

/// A number with its unit, or with a larger one if it has thousands.
fn quantity(value: f64, unit: &str) -> String {
    let (value, unit) = match (value.abs(), unit) {
        (size, "µm/s") if size >= 1e6 => (1e-6 * value, "m/s"),
        (size, "µm/s") if size >= 1e3 => (1e-3 * value, "mm/s"),
        (size, "mm") if size >= 1e3 => (1e-3 * value, "m"),
        _ => (value, unit),
    };
    let gap = if matches!(unit, "" | "°") { "" } else { "\u{a0}" };
    format!("{}{gap}{unit}", readable(value, 3))
}
