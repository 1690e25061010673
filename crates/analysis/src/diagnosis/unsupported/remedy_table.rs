//! The table of remedies: the error of the examined solve with each, and of a whole run.

use lcplab_page::document::{Block, Section};
use lcplab_page::number::readable;

use super::examine::UnsupportedLoad;
use super::remedy::{Remedy, RemedyEffect, UNCHANGED};
use super::show::percent;

/// Significant digits of measured values.
const DIGITS: usize = 2;

/// A remedy that leaves a larger part of the error is of little help.
const HELPFUL: f64 = 0.5;

const COLUMNS: [&str; 4] = ["change", "error of this solve", "error of the run", "cost"];

/// A change and what it did; `None` where it was not tried.
struct Trial<'a> {
    what: &'a str,
    /// The error of the examined solve, and the multiplications of that solve.
    solve: Option<(f64, f64)>,
    /// A whole run.
    run: Option<&'a RemedyEffect>,
}

/// The section of what was tried; `None` if nothing was.
pub(super) fn section(
    unsupported: Option<&UnsupportedLoad>,
    effects: &[RemedyEffect],
) -> Option<Section> {
    let title = unsupported.and_then(UnsupportedLoad::remedy_in_words);
    let mut section =
        Section::new(title.map_or("remedies".into(), |best| format!("remedies: {best}")));
    let now = unsupported.map(|found| (found.missing, found.work));
    let unchanged = effects.iter().find(|own| own.what == UNCHANGED);
    let best = unsupported.and_then(UnsupportedLoad::best_remedy);
    let (mut helpful, useless): (Vec<Trial>, Vec<Trial>) =
        trials(unsupported, effects).into_iter().partition(|trial| {
            let solve = trial.solve.zip(now).is_some_and(|(own, now)| own.0 < HELPFUL * now.0);
            let run = trial
                .run
                .zip(unchanged)
                .is_some_and(|(own, now)| own.missing < HELPFUL * now.missing);
            solve || run || best.is_some_and(|best| best.what == trial.what)
        });
    if helpful.is_empty() && useless.is_empty() && unchanged.is_none() {
        return None;
    }
    let of_run = |trial: &Trial| trial.run.map_or(f64::INFINITY, |own| own.missing);
    helpful.sort_by(|a, b| of_run(a).total_cmp(&of_run(b)));
    let first = unchanged.map(|run| Trial { what: UNCHANGED, solve: now, run: Some(run) });
    let shown: Vec<Trial> = first.into_iter().chain(helpful).collect();
    section.say(
        "Each change was tried alone; the best one is bold. An error of 0 % is the exact motion, one of 100 % is as large as \
         the effect of all constraints together; that of a run is the mean of its second half. The cost of \
         this solve is relative to the unchanged one. –: not measured.",
    );
    let rows = shown.iter().map(|trial| row(trial, now)).collect();
    section.table("the error with each change", &COLUMNS, rows);
    if let Some(Block::Table(table)) = section.blocks.last_mut() {
        table.chosen = best.and_then(|best| shown.iter().position(|own| own.what == best.what));
    }
    if !useless.is_empty() {
        let names: Vec<&str> = useless.iter().map(|own| own.what).collect();
        section.say(format!("More than half of the error remains with: {}.", names.join("; ")));
    }
    Some(section)
}

/// All changes, those that were tried on the examined solve first.
fn trials<'a>(
    unsupported: Option<&'a UnsupportedLoad>,
    effects: &'a [RemedyEffect],
) -> Vec<Trial<'a>> {
    let solved: &[Remedy] = unsupported.map_or(&[], |found| &found.remedies);
    let run_of = |what: &str| effects.iter().find(|own| own.what == what);
    let of_solve = solved.iter().map(|own| Trial {
        what: &own.what,
        solve: Some((own.missing, own.work)),
        run: run_of(&own.what),
    });
    let is_new = |own: &&RemedyEffect| {
        own.what != UNCHANGED && solved.iter().all(|remedy| remedy.what != own.what)
    };
    let of_run = effects.iter().filter(is_new);
    of_solve
        .chain(of_run.map(|own| Trial { what: &own.what, solve: None, run: Some(own) }))
        .collect()
}

fn row(trial: &Trial, now: Option<(f64, f64)>) -> Vec<String> {
    let short = |part: f64| percent(part).replace("less than", "<");
    let ratio = trial.solve.zip(now).map(|(own, now)| own.1 / now.1);
    let cells = [
        trial.solve.map(|(missing, _)| short(missing)),
        trial.run.map(|own| short(own.missing)),
        ratio.filter(|own| own.is_finite()).map(|own| format!("{}×", readable(own, DIGITS))),
    ];
    let cells = cells.into_iter().map(|cell| cell.unwrap_or("–".into()));
    [trial.what.to_string()].into_iter().chain(cells).collect()
}
