//! Replayed defects as a table with one row per defect.

use super::{Headline, Outcome, ReportPage, View};
use crate::number::{count, readable};
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::defects::{Defect, Plan, Record, Replay};
use crate::report::study::receipt::Stage;

impl View for Plan {
    const TITLE: &'static str = "Known defects of physics engines, replayed";

    fn show(&self, findings: &[Record], document: &mut ReportPage) {
        for Record { defects, .. } in findings {
            document.table("defects", table(&by_stage(defects)));
        }
    }

    fn headline(&self, findings: &[Record]) -> Headline {
        let Some(record) = findings.first() else { return Headline::default() };
        let [rejected, compared, accepted, all] = counts(record);
        let others = match compared {
            0 => String::new(),
            _ => format!("; {compared} more only in comparison with the corrected release"),
        };
        let answer = format!(
            "A *receipt* is lcplab's verification report of one step of an engine. **Receipts reject {rejected} of {all} \
             releases with known defects**, each in a scene made to show its defect{others}."
        );
        let label = "corrected releases accepted".into();
        let result = Some(([accepted, all], label));
        Headline { result, table: example(&record.defects), ..Headline::of(Some(answer)) }
    }

    fn outcome(&self, findings: &[Record]) -> Outcome {
        let mut all = findings.iter().flat_map(|record| &record.defects);
        let is_good = |defect: &Defect| defect.mended.refused == 0 && !defect.is_misjudged();
        let good = !findings.is_empty() && all.all(is_good);
        Outcome { good, says: findings.iter().map(says).collect::<Vec<_>>().join("; ") }
    }
}

fn says(record: &Record) -> String {
    let [rejected, compared, accepted, all] = counts(record);
    format!(
        "{rejected} of {all} defective releases rejected at the right stage, {compared} more only in \
         comparison with a run of the corrected release; {accepted} of {all} corrected releases accepted"
    )
}

/// The defective releases that are rejected, and those that only a comparison detects; the accepted
/// corrected ones; all.
fn counts(record: &Record) -> [usize; 4] {
    let all = &record.defects;
    let of = |has: fn(&Defect) -> bool| all.iter().filter(|defect| has(defect)).count();
    let rejected = of(|defect| defect.outcome == "detected");
    let accepted = of(|defect| defect.mended.refused == 0 && defect.mended.unavailable.is_none());
    [rejected, of(Defect::is_detected) - rejected, accepted, all.len()]
}

fn by_stage(defects: &[Defect]) -> Vec<&Defect> {
    let mut sorted: Vec<_> = defects.iter().collect();
    sorted.sort_by_key(|defect| defect.stage);
    sorted
}

/// The first rejected release and its correction, as their receipts describe them.
fn example(defects: &[Defect]) -> Option<(String, Table)> {
    let shown = by_stage(defects).into_iter().find(|defect| defect.outcome == "detected")?;
    let row = |run: &Replay, says: &str| {
        let mark = if run.refused == 0 { Mark::Good } else { Mark::Bad };
        let says = format!("{} of {} steps rejected{says}", run.refused, run.frames);
        vec![Cell::text(run.versions.join(", ")), Cell::text(says).marked(mark)]
    };
    let error = format!(": {}: {}", shown.stage, said(shown));
    let rows = vec![row(&shown.bad, &error), row(&shown.mended, "")];
    let title = format!("One scene before and after the correction: {}", shown.what);
    Some(("receipt".into(), Table::new(title, "", "release | its receipts", rows)))
}

fn table(defects: &[&Defect]) -> Table {
    let rows = defects.iter().map(|defect| {
        let mark = match (defect.is_detected(), defect.bad.refused) {
            (true, 0) => Mark::Plain, // by comparison
            (true, _) => Mark::Good,
            (false, _) => Mark::Bad,
        };
        let releases = format!("{} → {}", defect.bad.versions.join(", "), version(defect));
        let address = defect.source.split_once(", #").map(|(engine, issue)| address(engine, issue));
        vec![
            Cell::text(&defect.what),
            Cell::text(defect.stage.name()),
            Cell { link: address.unwrap_or_default(), ..Cell::text(releases) },
            rejected(&defect.bad).marked(mark),
            rejected(&defect.mended),
            Cell::text(said(defect)),
        ]
    });
    let how = "*stage*: the part of the step that was wrong: collision (contacts and their geometry), assembly (the \
               rows and matrices of the problem), solver, or write-back (new velocities and reported forces). \
               *releases*: with a link to the issue, if it has one. *detected in*: the rejected steps of the defective \
               release. *the receipt says*: the first error of the first \
               rejected step or, if none is rejected, the comparison with the corrected release.";
    let headings = "what was wrong | stage | releases | #detected in | #after the correction | the receipt says";
    Table::new("Steps rejected by receipts", how, headings, rows.collect())
}

/// What the first rejected step's receipt says, with the size of an error of the motion, or the
/// comparison.
fn said(defect: &Defect) -> String {
    let what = defect.bad.what.as_ref().or(defect.bad.worse.first());
    let signs = |words: &str| words.replace('_', " ").replace(" -", " −");
    let size = defect.bad.largest_motion_error.filter(|_| defect.stage == Stage::Solver);
    match (what, size, &defect.bad.what) {
        (Some(what), Some(size), Some(_)) => {
            format!("{what}; relative error up to {}", readable(size, 2))
        }
        (Some(what), ..) => signs(what),
        (None, ..) => "–".into(),
    }
}

/// The address of an issue of an engine on GitHub, by the name of its release.
fn address(release: &str, issue: &str) -> String {
    let repository = match release.rsplit_once(' ').map_or(release, |(name, _)| name) {
        "MuJoCo Warp" => "google-deepmind/mujoco_warp",
        "DART" => "dartsim/dart",
        "Drake" => "RobotLocomotion/drake",
        "Newton" => "newton-physics/newton",
        name if name.starts_with("Rapier") => "dimforge/rapier",
        _ => "google-deepmind/mujoco",
    };
    format!("https://github.com/{repository}/issues/{issue}")
}

/// The corrected releases, without the names that the defective ones have too.
fn version(defect: &Defect) -> String {
    let name = |release: &str| release.rsplit_once(' ').map(|(name, _)| format!("{name} "));
    let bad = defect.bad.versions.first().and_then(|release| name(release)).unwrap_or_default();
    let short = |release: &String| release.strip_prefix(&bad).unwrap_or(release).to_string();
    defect.mended.versions.iter().map(short).collect::<Vec<_>>().join(", ")
}

/// The number of rejected steps and of all, or why there are none.
fn rejected(run: &Replay) -> Cell {
    match &run.unavailable {
        Some(why) => Cell::text(format!("{}: {why}", run.packages.join(", "))),
        None if run.refused == 0 => Cell::count(0),
        None => Cell::text(format!("{} of {}", count(run.refused), count(run.frames))),
    }
}
