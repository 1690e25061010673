//! Engine cards: which law holds in which engine, and what a violation looks like.

mod answer;
mod frames;
mod phenomenon;

use super::attempt::listed;
use super::{Headline, Outcome, ReportPage, View};
use crate::number::readable;
use crate::plot::Figure;
use crate::plot::grades::{Grade, Grades};
use crate::report::page::{Block, Cell, Table};
use crate::report::study::cards::{self, Engine, Phenomenon, Plan, Record};

/// The two configurations in which external engines are run.
const DEFAULTS: &str = "defaults";
const ACCURATE: &str = "accurate";
/// The engine whose configurations are schemes.
const OWN: &str = "lcplab";
/// The known violations or failures of lcplab's own schemes; any other violation is a fault.
///
/// - A spring is a compliant row with implicit integration, which loses energy; it would stay
///   within the tolerance only with steps of 0.02 ms.
/// - Friction is a box, which holds up to √2 times its coefficient; the cone has no such deviation.
/// - The bullet flies farther in a step than the margin within which a contact becomes a row; only
///   the acceleration level searches for the time of impact.
/// - The rows of Bricard's hinges become independent as position errors grow.
/// - Soft constraints are compliant under large loads, contacts as well as joints. XPBD's few
///   sweeps leave part of the load unsupported, and its velocities, which are differences of
///   positions, damp rotations.
const KNOWN_MISSES: [(&str, &[&str]); 5] = [
    ("velocity", &["spring", "directions", "bullet", "bricard"]),
    ("velocity, cone", &["spring", "bullet", "bricard"]),
    ("acceleration", &["spring", "directions", "bricard"]),
    ("soft", &["spring", "capstan", "directions", "mass_ratio", "bullet", "chain", "bricard"]),
    (
        "xpbd",
        &[
            "spring",
            "capstan",
            "directions",
            "mass_ratio",
            "tower",
            "bullet",
            "pendulum",
            "top",
            "closed_loop",
            "bricard",
        ],
    ),
];
/// The phenomenon that shows whether an adapter gives an engine the right masses, gravity and
/// steps.
const FALL: &str = "free_fall";
/// The phenomenon whose scene measures the speed of engines.
const PACED: &str = "tower";

impl View for Plan {
    const TITLE: &'static str = "Which law holds in which engine";

    fn show(&self, findings: &[Record], document: &mut ReportPage) {
        for record in findings {
            document.text(format!(
                "Tested: {}. To rerun a law on an installed engine: `python -m lcplab.cards --engine mujoco --phenomenon \
                 creep`. In the figures below the pale line is the law; the others are the engines that visibly break it \
                 as installed, each with the time step of its settings.",
                releases(record)
            ));
            document.table("cards_cost", answer::cost(record));
            let asked = record.phenomena.iter();
            let asked =
                asked.map(|own| format!("**{}**: {}", own.name.replace('_', " "), own.question));
            document.add(Block::Printed(asked.collect::<Vec<_>>().join(" ")));
            document.fold_rest();
            document.table("cards_settings", settings(record));
            frames::show(record, document);
            phenomenon::show_all(record, document);
        }
    }

    fn headline(&self, findings: &[Record]) -> Headline {
        let Some(record) = findings.first() else { return Headline::default() };
        let figure: Box<dyn Figure> = Box::new(heat(record));
        let table = Some(("cards_uses".into(), answer::uses(record)));
        let runs = || record.phenomena.iter().flat_map(|own| &own.columns);
        let measured = || runs().flat_map(|column| &column.measured);
        let agree = measured().filter(|own| !own.is_misjudged()).count();
        let tests = runs().filter(|column| !column.measured.is_empty()).count();
        let label = format!("numbers measured in {tests} tests agree with the recorded verdicts");
        let result = Some(([agree, measured().count()], label));
        Headline { result, figure: Some(figure), table, ..Headline::of(Some(answer::of(record))) }
    }

    fn outcome(&self, findings: &[Record]) -> Outcome {
        let phenomena = findings.iter().flat_map(|record| &record.phenomena);
        let runs: Vec<(&str, &cards::Column)> = phenomena
            .flat_map(|own| own.columns.iter().map(move |column| (own.name.as_str(), column)))
            .collect();
        let measured = runs.iter().filter(|(_, column)| !column.measured.is_empty()).count();
        let held = runs.iter().filter(|(_, column)| column.holds()).count();
        let faults: Vec<String> =
            runs.iter().filter_map(|(phenomenon, column)| fault(phenomenon, column)).collect();
        let mut says = format!("{held} of {measured} runs obey their law");
        if !faults.is_empty() {
            says += &format!("; unexpected: {}", faults.join("; "));
        }
        Outcome { good: faults.is_empty(), says }
    }
}

/// The fault of lcplab or of the record in a run. Violations by other engines are findings, not
/// faults.
fn fault(phenomenon: &str, column: &cards::Column) -> Option<String> {
    let misses = !column.holds() && column.unsupported.is_none();
    let is_known = KNOWN_MISSES
        .iter()
        .any(|(scheme, missed)| *scheme == column.settings && missed.contains(&phenomenon));
    let why = if column.measured.iter().any(cards::Measured::is_misjudged) {
        "its verdict contradicts its numbers"
    } else if misses && column.engine == OWN && !is_known {
        "violates its law"
    } else if misses && column.engine != OWN && column.settings == ACCURATE && phenomenon == FALL {
        "free fall is wrong, so the adapter is wrong"
    } else {
        return None;
    };
    Some(format!("{phenomenon} by {}, {}: {why}", column.engine, column.settings))
}

/// Engines and their configurations as columns of a table: the heading, the engine and its
/// configuration.
type Ways<'a> = Vec<(String, &'a str, &'a str)>;

/// The external engines in one configuration.
fn others<'a>(record: &'a Record, way: &'a str) -> Ways<'a> {
    let run_so = |engine: &&Engine| engine.settings.iter().any(|settings| settings.name == way);
    let engines = record.engines.iter().filter(run_so);
    engines.map(|engine| (engine.title.clone(), engine.name.as_str(), way)).collect()
}

/// lcplab's schemes.
fn own(record: &Record) -> Ways<'_> {
    let engines = record.engines.iter().filter(|engine| engine.name == OWN);
    let schemes = engines.flat_map(|engine| &engine.settings);
    schemes.map(|scheme| (scheme.name.clone(), OWN, scheme.name.as_str())).collect()
}

/// All engines with both settings, and lcplab's own schemes.
fn heat(record: &Record) -> Grades {
    let groups = [
        ("as installed", others(record, DEFAULTS)),
        ("accurate settings", others(record, ACCURATE)),
        ("lcplab's schemes", own(record)),
    ];
    let row = |phenomenon: &Phenomenon| {
        let ways = groups.iter().flat_map(|(_, ways)| ways);
        let grades = ways.map(|(_, engine, settings)| grade(phenomenon, engine, settings));
        (phenomenon.name.replace('_', " "), grades.collect())
    };
    let mut laws: Vec<&Phenomenon> = record.phenomena.iter().collect();
    laws.sort_by_key(|law| answer::place(law).0);
    let (mut rows, mut links) = (Vec::new(), Vec::new());
    for laws in laws.chunk_by(|a, b| answer::place(a) == answer::place(b)) {
        rows.push((answer::place(laws[0]).1.into(), Vec::new()));
        links.push(Default::default());
        rows.extend(laws.iter().map(|law| row(law)));
        links
            .extend(laws.iter().map(|law| (phenomenon::section(law).into(), law.question.clone())));
    }
    let runs = record.phenomena.iter().flat_map(|own| &own.columns);
    let runs = runs.filter(|column| column.engine != OWN && column.settings == DEFAULTS);
    let measured = runs.filter(|column| column.unsupported.is_none());
    let (held, all) = (measured.clone().filter(|column| column.holds()).count(), measured.count());
    Grades {
        id: "cards_matrix".into(),
        title: format!("As installed, the engines obey the law in {held} of {all} tests"),
        caption: format!(
            "The name of a row leads to its law. A number is the largest violation in multiples of the tolerance, with k \
             for thousands; ✗: the run failed; –: the engine or its adapter does not support the scene. Chosen on these \
             scenes: the accurate settings of {} (Table 3), and the steps and stiffness of lcplab.",
            listed(&chosen_here(record))
        ),
        rows,
        has_counts: true,
        links,
        groups: groups
            .iter()
            .map(|(name, ways)| {
                (name.to_string(), ways.iter().map(|(heading, ..)| heading.clone()).collect())
            })
            .collect(),
    }
}

/// The engines whose accurate settings are the best of those that were tried on these scenes.
fn chosen_here(record: &Record) -> Vec<String> {
    let tried = |own: &&Engine| {
        own.settings.iter().any(|way| way.name == ACCURATE && way.words.contains(" tried"))
    };
    record.engines.iter().filter(tried).map(|own| own.title.clone()).collect()
}

/// The tested releases of the external engines.
fn releases(record: &Record) -> String {
    let others = record.engines.iter().filter(|engine| engine.name != OWN);
    others.map(|own| format!("{} {}", own.title, own.version)).collect::<Vec<_>>().join(", ")
}

fn grade(phenomenon: &Phenomenon, engine: &str, settings: &str) -> Grade {
    let of = |column: &&cards::Column| column.engine == engine && column.settings == settings;
    let Some(column) = phenomenon.columns.iter().find(of) else { return Grade::Unknown };
    match (column.worst(), &column.failed) {
        _ if column.holds() => Grade::Obeyed,
        (Some(worst), _) => Grade::Missed(worst.miss()),
        (None, Some(_)) => Grade::Missed(f64::INFINITY),
        (None, None) => Grade::Unknown,
    }
}

/// A deviation in tolerances.
fn times(miss: f64) -> String {
    match miss.is_finite() {
        true => format!("{}\u{a0}×", readable(miss, 2)),
        false => "no end".into(),
    }
}

fn settings(record: &Record) -> Table {
    let rows = record.engines.iter().flat_map(|engine| {
        engine.settings.iter().map(|settings| {
            vec![
                Cell::text(format!("{} {}", engine.package, engine.version)),
                Cell::text(&settings.name),
                Cell::text(&settings.words),
            ]
        })
    });
    Table::new(
        "Settings of the engines",
        "All differences from the default settings of an engine. Accurate settings are those that \
         the documentation of the engine recommends; if it recommends none, the text names their source. \
         The adapters translate and correct nothing; they reject scenes that an engine cannot express.",
        "package | settings | in words",
        rows.collect(),
    )
}
