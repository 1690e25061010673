//! All solvers at both levels, scene by scene.

mod answer;
mod matrix;
mod timings;

pub use answer::answer;

use super::attempt::{listed, stem};
use super::{Headline, Outcome, ReportPage, View};
use crate::animation::Animation;
use crate::number::{count, counted, readable};
use crate::plot::{Axis, Figure, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Page, Table, markup};
use crate::report::study::comparison::{
    Case, Comparison, HELD, LeftOut, Plan, Run, Sample, Timing, best,
};
use crate::scene::Scheme;
use crate::solver::Status;

/// The position of the column for the reason of a failure, left of the measures so that a narrow
/// screen shows it.
const TROUBLE: usize = 6;
impl View for Plan {
    const TITLE: &'static str = "Comparison of solvers at velocity and acceleration level";

    fn show(&self, findings: &[Comparison], document: &mut ReportPage) {
        let runs = || findings.iter().flat_map(|comparison| &comparison.runs);
        let (solves, claimed) = (
            runs().map(|run| run.tally.solves).sum::<usize>(),
            runs().map(|run| run.tally.claimed).sum::<usize>(),
        );
        let rejected = runs().map(|run| run.tally.rejected_claims).sum::<usize>();
        let none = if rejected == 0 { "none".into() } else { count(rejected) };
        let unanswered = match solves - claimed {
            0 => String::new(),
            left => format!(" ({} left unanswered{})", count(left), self.given_up(findings)),
        };
        document.text(format!(
            "**The judge rejects {none} of the {} answers that the solvers report as solutions**, to {} problems{unanswered}. Each \
             solver of the comparison simulates each scene with {}. Every solve starts from the answer of the previous step.",
            count(claimed),
            count(solves),
            listed(&self.schemes.iter().map(|&scheme| in_words(scheme)).collect::<Vec<_>>())
        ));
        // With a single run of each scheme, the tables of the scenes have the same rows.
        let mut schemes =
            findings.iter().flat_map(|own| own.runs.chunk_by(|a, b| a.scheme == b.scheme));
        if schemes.any(|runs| runs.len() > 1) {
            document.table("comparison_schemes", by_scheme(findings));
        }
        let words = |comparison: &Comparison| {
            let (title, teaches) = (&comparison.title, comparison.teaches.trim());
            let scene = markup::literal(&comparison.scene);
            format!("**{scene}: {}.** {}", markup::literal(title), markup::literal(teaches))
        };
        let scenes: Vec<String> = findings.iter().map(words).collect();
        document.aside("The scenes", scenes.join("\n\n"));
        for (k, comparison) in findings.iter().enumerate() {
            let id = format!("comparison_{}", stem(&comparison.scene));
            let how_to_read = if k == 0 { MEASURES.into() } else { String::new() };
            document.table(&id, scene_table(comparison, how_to_read));
        }
    }

    fn headline(&self, findings: &[Comparison]) -> Headline {
        let sum = |count: fn(&Run) -> usize| -> usize {
            findings.iter().flat_map(|comparison| &comparison.runs).map(count).sum()
        };
        let claimed = sum(|run| run.tally.claimed);
        let confirmed = claimed - sum(|run| run.tally.rejected_claims);
        let mut label = "answers accepted by an independent judge".to_string();
        let solves = sum(|run| run.tally.solves);
        if claimed < solves {
            let (left, by) = (count(solves - claimed), self.given_up(findings).replace('*', ""));
            label += &format!("; {left} of {} problems are left unanswered{by}", count(solves));
        }
        let none = listed(&self.without_problems(findings));
        if !none.is_empty() {
            label += &format!("; {none} pose none");
        }
        let result = Some(([confirmed, claimed], label));
        let answer = self.held(findings);
        let figure = answer
            .is_some()
            .then(|| -> Box<dyn Figure> { Box::new(matrix::matrix(findings, &self.schemes)) });
        Headline { result, figure, ..Headline::of(answer) }
    }

    fn outcome(&self, findings: &[Comparison]) -> Outcome {
        let sum = |of: fn(&Run) -> usize| -> usize {
            findings.iter().flat_map(|comparison| &comparison.runs).map(of).sum()
        };
        let rejected = sum(|run| run.tally.rejected_claims);
        let says = format!(
            "{} problems of {} scenes: {} reported as solved, {} answers accepted by the judge, {rejected} false claims",
            count(sum(|run| run.tally.solves)),
            findings.len(),
            count(sum(|run| run.tally.claimed)),
            count(sum(|run| run.tally.accepted)),
        );
        Outcome { good: rejected == 0, says }
    }

    fn show_times(&self, times: &[Vec<Timing>], document: &mut ReportPage) {
        document.table("timings", timings::table(&times.concat()));
    }
}

impl Plan {
    /// Of more schemes than the two levels: which keep gaps and joints within tolerance in every
    /// scene that starts so, and which of these has the smallest error of the energy.
    fn held(&self, findings: &[Comparison]) -> Option<String> {
        let scenes: Vec<_> = findings.iter().filter(|own| own.starts_within_tolerance()).collect();
        if self.schemes.len() <= Scheme::LEVELS.len() || scenes.is_empty() {
            return None;
        }
        let title = |scheme: &Scheme| format!("*{}*", scheme.name());
        let all = listed(&scenes.iter().map(|own| own.scene.replace('_', " ")).collect::<Vec<_>>());
        let mut steps: Vec<_> = scenes.iter().map(|own| readable(own.dt, 3)).collect();
        steps.dedup();
        let held = format!(
            "gaps and joints within {} % of a body's thickness in {all} (dt = {} s{})",
            readable(100.0 * HELD, 2),
            listed(&steps),
            self.without_feedback()
        );
        let schemes = counted(self.schemes.len(), "time-stepping scheme");
        let kept = matrix::kept(findings, &self.schemes);
        let Some((best, also)) = kept.split_first() else {
            return Some(format!("**None of {schemes} keeps {held}.**"));
        };
        let excess =
            |scheme: &Scheme| readable(matrix::worst(findings, *scheme, matrix::excess), 2);
        let rivals = also.last().map_or(String::new(), |last| {
            format!(
                " So do {}, but their worst error of the energy is larger: up to {} times its tolerance, not {}.",
                listed(&also.iter().map(title).collect::<Vec<_>>()),
                excess(last),
                excess(best)
            )
        });
        let margin = readable(100.0 * matrix::worst(findings, *best, matrix::error), 2);
        Some(format!(
            "**Of {schemes} use {}: it keeps {held}.**{rivals} **Its limit**: its gaps and joints use {margin} % of their tolerance.",
            title(best)
        ))
    }

    /// The scenes that run without feedback of position errors, on which levels depend.
    fn without_feedback(&self) -> String {
        let is_off = |case: &&Case| {
            let step = case.change.get("step");
            let factor = step.and_then(|step| step.get("baumgarte"));
            factor.and_then(toml::Value::as_integer) == Some(0)
        };
        let scenes: Vec<String> =
            self.scenes.iter().filter(is_off).map(|own| own.scene.replace('_', " ")).collect();
        match scenes.is_empty() {
            true => String::new(),
            false => format!(
                "; {} without error feedback, which *velocity* and *acceleration* need against drift",
                listed(&scenes)
            ),
        }
    }

    /// The schemes that pose no problem in any scene.
    fn without_problems(&self, findings: &[Comparison]) -> Vec<String> {
        let solves = |scheme: &Scheme| {
            let runs = findings.iter().flat_map(|comparison| &comparison.runs);
            runs.filter(|run| run.scheme == scheme.name())
                .map(|run| run.tally.solves)
                .sum::<usize>()
        };
        let schemes = self.schemes.iter().filter(|scheme| solves(scheme) == 0);
        schemes.map(|scheme| scheme.name().to_string()).collect()
    }

    /// The schemes or solvers with problems without an answer, and the reason of a single one.
    fn given_up(&self, findings: &[Comparison]) -> String {
        let runs = findings.iter().flat_map(|comparison| &comparison.runs);
        let mut ways: Vec<(&str, String)> = Vec::new();
        for run in runs.filter(|run| run.tally.claimed < run.tally.solves) {
            let way = match run.solver.as_str() {
                "none" => run.scheme.as_str(),
                solver => solver,
            };
            let reason = run.tally.unsolved.clone().unwrap_or_default();
            let reason = match run.tally.iterations % run.tally.solves {
                0 if reason == Status::IterationLimit.to_string() => {
                    format!("which stops after {} sweeps", run.tally.iterations / run.tally.solves)
                }
                _ => reason,
            };
            if !ways.iter().any(|(own, _)| *own == way) {
                ways.push((way, reason));
            }
        }
        match &ways[..] {
            [(way, reason)] if !reason.is_empty() => format!(" by *{way}*, {reason}"),
            _ => format!(": {}", ways.iter().map(|(way, _)| *way).collect::<Vec<_>>().join(", ")),
        }
    }
}

/// A scheme in a sentence.
fn in_words(scheme: Scheme) -> String {
    match scheme {
        Scheme::Velocity => "impulses (*velocity* level)".into(),
        Scheme::Acceleration => "forces (*acceleration* level)".into(),
        other => format!("*{}*", other.name()),
    }
}

/// The levels side by side: the best run of each scene and level.
fn by_scheme(findings: &[Comparison]) -> Table {
    let row = |comparison: &Comparison, run: &Run| {
        vec![
            Cell::text(&comparison.scene),
            Cell::text(&run.scheme),
            Cell::text(&run.solver),
            Cell::count(run.steps).marked(match run.steps == comparison.steps {
                true => Mark::Plain,
                false => Mark::Bad,
            }),
            Cell::number(run.energy_change(), 2),
            Cell::number(run.worst(|sample| sample.drift), 2),
            Cell::number(run.worst(|sample| sample.penetration), 2),
        ]
    };
    let rows = |comparison: &Comparison| -> Vec<Vec<Cell>> {
        let of_scheme = comparison.runs.chunk_by(|a, b| a.scheme == b.scheme);
        of_scheme.filter_map(best).map(|run| row(comparison, run)).collect()
    };
    Table::new(
        "The best run of each scene and level",
        "One row per scene and level, for one solver: the one that took the most steps, then among equals the \
                      one with the fewest rejected answers, then the first in the list. *largest \
                      energy change*: since the start; *drift* and *penetration* are the largest errors.",
        "scene | level | solver | #steps | #largest energy change (J) | #drift (m) | \
         #penetration (m)",
        findings.iter().flat_map(rows).collect(),
    )
}

/// The explanation of the columns of the scenes' tables.
const MEASURES: &str = "In the tables of the scenes, *problems* counts the LCPs: at acceleration level, each impact is a \
 separate problem. (An iterative solver leaves a small approach velocity within the tolerance, which counts as another \
 impact.) *claims*: problems that the solver reports as solved. \
 *accepted*: answers that the judge accepts. *worst residual*: the largest scaled residual over all problems, \
 claimed or not; – if there was none. *energy change*: from the start to the end; *largest energy change*: from \
 the start to any instant; ✗ or red: besides the work of friction, impacts and motors, the energy changed by more than 1 % of the largest \
 kinetic energy; this does not fail the check. \
 *support*: the average upward component of the forces of contacts, joints and springs; \
 100 % of the weight at rest, 0 in free fall.";

/// One scene's runs as a table that explains its columns.
pub fn table(comparison: &Comparison) -> Table {
    scene_table(comparison, MEASURES.into())
}

/// One scene's runs as a table with this explanation.
fn scene_table(comparison: &Comparison, how_to_read: String) -> Table {
    let Comparison { scene, steps, dt, .. } = comparison;
    let mut columns = Column::list(
        "level | solver | #steps | #problems | #claims | #accepted | #iterations per problem | \
         #worst residual | #energy change (J) | #largest energy change (J) | #drift (m) | \
         #penetration (m) | #support (% of the weight)",
    );
    let left_out = &comparison.left_out;
    let trouble =
        !left_out.is_empty() || comparison.runs.iter().any(|run| run.tally.trouble.is_some());
    if trouble {
        columns.insert(TROUBLE, Column::words("reason"));
    }
    let mut rows: Vec<Vec<Cell>> =
        comparison.runs.iter().map(|run| cells(run, comparison.steps)).collect();
    if trouble {
        for (row, run) in rows.iter_mut().zip(&comparison.runs) {
            row.insert(TROUBLE, Cell::text(run.tally.trouble.clone().unwrap_or_default()));
        }
    }
    for LeftOut { solver, reason } in left_out {
        let mut row = vec![Cell::text("–"); columns.len()];
        row[1] = Cell::text(solver);
        row[TROUBLE] = Cell::text(format!("not run: {reason}"));
        rows.push(row);
    }
    Table {
        title: format!("{scene}: {} of {dt} s", counted(*steps, "step")),
        how_to_read,
        columns,
        rows,
        ..Table::default()
    }
}

fn cells(run: &Run, steps: usize) -> Vec<Cell> {
    let mark = |good: bool| if good { Mark::Plain } else { Mark::Bad };
    vec![
        Cell::text(&run.scheme),
        Cell::text(&run.solver),
        Cell::count(run.steps).marked(mark(run.steps == steps)),
        Cell::count(run.tally.solves),
        Cell::count(run.tally.claimed).marked(mark(run.tally.claimed == run.tally.solves)),
        Cell::count(run.tally.accepted).marked(mark(run.tally.accepted == run.tally.solves)),
        Cell::number(run.tally.iterations as f64 / run.tally.solves.max(1) as f64, 3),
        match run.tally.solves {
            0 => Cell::text("–"),
            _ => Cell::number(run.tally.worst_residual, 2),
        },
        Cell::number(run.energy_at_end(), 2),
        Cell::number(run.energy_change(), 2).marked(mark(run.laws.keeps_energy())),
        Cell::number(run.worst(|sample| sample.drift), 2),
        Cell::number(run.worst(|sample| sample.penetration), 2),
        run.carried.map_or(Cell::text("–"), |part| Cell::number((1e4 * part).round() / 100.0, 4)),
    ]
}

/// A separate page for one scene: the animation, the table, and the motion by solver and level.
pub fn document(comparison: &Comparison, animation: Animation) -> ReportPage {
    let page = Page {
        title: comparison.title.clone(),
        lead: format!(
            "{}\n\n{}",
            markup::literal(&answer(comparison)),
            markup::literal(comparison.teaches.trim())
        ),
        ..Page::default()
    };
    let mut document = ReportPage { page, figures: Vec::new(), tables: Vec::new() };
    document.animation(&animation, "The same scene by several solvers, at the same instants.");
    document.open("comparison", "Solvers and levels");
    document.table(&format!("comparison_{}", stem(&comparison.scene)), table(comparison));
    document.figure(motion_figure(comparison));
    document
}

/// Energy, drift and penetration over time; runs that move alike share a curve.
fn motion_figure(comparison: &Comparison) -> Lines {
    let alike = alike(&comparison.runs);
    let panel = |label: &str, unit: &str, measure: fn(&Run, &Sample) -> f64| {
        let curve = |(name, run): &(String, &Run)| {
            let point = |sample: &Sample| (sample.time, measure(run, sample));
            let points = run.motion.iter().map(point).collect();
            Series::measured(name.clone(), points).labeled(name)
        };
        let series: Vec<Series> = alike.iter().map(curve).collect();
        Panel { y: Axis::fitting(label, unit, series.iter().map(Series::size)), series }
    };
    let mut panels =
        vec![panel("energy change", "J", |run, sample| sample.energy - start_energy(run))];
    let any = |measure: fn(&Sample) -> f64| {
        comparison.runs.iter().any(|run| run.motion.iter().any(|sample| measure(sample) > 0.0))
    };
    if any(|sample| sample.drift) {
        panels.push(panel("constraint drift", "m", |_, sample| sample.drift));
    }
    if any(|sample| sample.penetration) {
        panels.push(panel("penetration", "m", |_, sample| sample.penetration));
    }
    Lines {
        id: format!("motion_{}", stem(&comparison.scene)),
        title: motion_title(comparison),
        caption:
            "Solvers share a curve if their motions agree to within a thousandth of the largest \
                  energy change and of the largest error; the motion then depends only on the level."
                .into(),
        x: Axis::linear("time", "s"),
        panels,
    }
    .with_scales_explained()
}

/// The finding: the largest change of energy over the runs, and the least.
fn motion_title(comparison: &Comparison) -> String {
    let change = |run: &&Run| run.energy_change().abs();
    let by_change = |a: &&Run, b: &&Run| change(a).total_cmp(&change(b));
    let named =
        |run: &Run| format!("{} J ({})", readable(run.energy_change().abs(), 2), run.scheme);
    match (comparison.runs.iter().min_by(by_change), comparison.runs.iter().max_by(by_change)) {
        (Some(least), Some(most)) => format!(
            "{}: the energy changes by {} to {}",
            comparison.title,
            named(least),
            named(most)
        ),
        _ => comparison.title.clone(),
    }
}

fn start_energy(run: &Run) -> f64 {
    run.motion.first().map_or(0.0, |first| first.energy)
}

/// One run for each group of runs that move alike at one level, with a name for the group: that of
/// the level, unless it has more groups.
pub(crate) fn alike(runs: &[Run]) -> Vec<(String, &Run)> {
    let measures: [fn(&Sample) -> f64; 3] = [|s| s.energy, |s| s.drift, |s| s.penetration];
    let apart = |a: &Run, b: &Run, measure: fn(&Sample) -> f64| {
        let pairs = a.motion.iter().zip(&b.motion);
        pairs.map(|(a, b)| (measure(a) - measure(b)).abs()).fold(0.0, f64::max)
    };
    let size = |k: usize| {
        let over =
            |run: &Run| if k == 0 { run.energy_change().abs() } else { run.worst(measures[k]) };
        runs.iter().map(over).fold(0.0, f64::max)
    };
    let sizes = [size(0), size(1), size(2)];
    let same = |a: &Run, b: &Run| {
        a.scheme == b.scheme
            && a.motion.len() == b.motion.len()
            && (0..3).all(|k| apart(a, b, measures[k]) <= 1e-3 * sizes[k])
    };
    let mut groups: Vec<Vec<&Run>> = Vec::new();
    for run in runs {
        match groups.iter_mut().find(|group| same(group[0], run)) {
            Some(group) => group.push(run),
            None => groups.push(vec![run]),
        }
    }
    let is_one_of_scheme =
        |run: &Run| groups.iter().filter(|group| group[0].scheme == run.scheme).count() == 1;
    let name = |group: &Vec<&Run>| match is_one_of_scheme(group[0]) {
        true => group[0].scheme.clone(),
        false => name(group),
    };
    groups.iter().map(|group| (name(group), group[0])).collect()
}

/// The first solver of a group, and how many more there are.
fn name(group: &[&Run]) -> String {
    match group {
        [only] => format!("{}, {}", only.solver, only.scheme),
        [first, ..] => {
            let others = group.len() - 1;
            format!("{}: {} and {others} more", first.scheme, first.solver)
        }
        [] => String::new(),
    }
}
