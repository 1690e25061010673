//! Runs a report's studies, which simulate and solve.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;

use super::experiment::Experiment;
use super::results::{Results, Task};
use super::tasks::Tasks;
use super::text::printable;
use crate::error::Result;
use crate::solver::{Registry, Stop};

/// Minimum interval between saves while the report runs.
const PAUSE: Duration = Duration::from_secs(1);

/// Runs every task that is missing in the `earlier` results, with solvers of this registry, until a
/// stop; `save` receives the growing results.
///
/// The findings do not depend on the number of threads. A task that fails becomes a row with its
/// reason.
///
/// # Errors
/// If the results cannot be saved before the first task.
pub fn run(
    experiment: &Experiment,
    earlier: Option<&Results>,
    solvers: &Registry,
    progress: &ProgressBar,
    stop: &Stop,
    save: &dyn Fn(&Results) -> Result<()>,
) -> Result<Results> {
    let start = Instant::now();
    let mut results = Results::empty(experiment);
    if let Some(earlier) = earlier {
        results.resume(earlier);
    }
    save(&results)?;
    let missing = missing(&results);
    progress.set_length(missing.len() as u64);
    let studies: Vec<_> = experiment.sections.iter().map(|part| part.study.clone()).collect();
    let study = |section: usize| studies[section].as_ref();
    let is_alone = |&(section, task): &Place| study(section).is_some_and(|study| study.alone(task));
    let (alone, together) = missing.into_iter().partition(is_alone);
    let (names, bar, solvers) = (names(&results), progress.clone(), solvers.clone());
    let work = move |&(section, task): &Place| {
        // A section with text only has no tasks.
        let study = studies[section].as_ref()?;
        let message = format!("{}: {}", study.name(), names[section][task]);
        bar.set_message(printable(&message).into_owned());
        Some(study.run(task, &solvers))
    };
    let mut saved = Instant::now();
    Tasks { together, alone, grace: Duration::ZERO }.run(
        stop,
        work,
        |(section, task), ended| {
            if let Some(ended) = ended {
                results.note(section, task, ended);
            }
            progress.inc(1);
            if saved.elapsed() >= PAUSE {
                // A disk that is full now may not be at the end, when a failure is reported.
                let _ = save(&results);
                saved = Instant::now();
            }
            Ok(())
        },
    )?;
    in_order(&mut results);
    results.machine.seconds = start.elapsed().as_secs_f64();
    Ok(results)
}

/// A task, by its section and its number in it.
type Place = (usize, usize);

/// The places of the unfinished tasks.
fn missing(results: &Results) -> Vec<Place> {
    let open = |tasks: &[Task]| -> Vec<usize> {
        (0..tasks.len()).filter(|&task| !tasks[task].is_over()).collect()
    };
    let sections = results.sections.iter().enumerate();
    sections.flat_map(|(s, part)| open(&part.tasks).into_iter().map(move |t| (s, t))).collect()
}

/// The names of the tasks, section by section.
fn names(results: &Results) -> Vec<Vec<String>> {
    let of = |tasks: &[Task]| tasks.iter().map(|task| task.name.clone()).collect();
    results.sections.iter().map(|part| of(&part.tasks)).collect()
}

/// Sorts the times in the order of the report, regardless of which task ended first.
fn in_order(results: &mut Results) {
    let Results { sections, machine, .. } = results;
    let place = |section: &str, task: &str| {
        let s = sections.iter().position(|part| part.id == section);
        let t = s.and_then(|s| sections[s].tasks.iter().position(|other| other.name == task));
        (s, t)
    };
    machine.times.sort_by_key(|timed| place(&timed.section, &timed.task));
}
