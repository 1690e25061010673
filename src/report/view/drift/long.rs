//! Energy and constraint errors over many periods.

use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::study::drift::long::{Curve, LongRun};
use crate::report::view::attempt::section_id;
use crate::report::view::{Outcome, ReportPage};

/// Halving the step must divide an error by at least this much: by 2 if the method is of first
/// order and the step is short, by somewhat less otherwise.
const LEAST_GAIN: f64 = 1.5;
/// Errors up to this are rounding: relative to the largest kinetic energy, or in meters.
const ROUNDING: f64 = 1e-9;

pub(super) fn show(runs: &[&LongRun], document: &mut ReportPage) {
    document.text(
        "Without friction the energy is constant, and so is the length of a rod. In a step the rod turns, so its \
         impulse, computed for the old direction, does work. The energy error that results grows with the number \
         of periods under every method; the order of the method decides how fast. Error feedback limits the error of the length: each \
         step adds $(v\\,dt)^2/2l$ and removes a fraction of the error, $\\beta$ at velocity level and $\\alpha\\,dt$ \
         at acceleration level ($\\alpha$ is the rate of feedback). The error settles where both are equal, at \
         $(v\\,dt)^2/(2 l \\beta)$, which is of *second* order in dt, or at $v^2 dt/(2 l \\alpha)$, of *first* order. \
         Midpoint and RK4 follow the parabola of a ball exactly, and lcplab computes the time of the impact within the \
         step.",
    );
    document.figure(figure(section_id(document) + "_long", runs));
}

pub(super) fn outcome(runs: &[&LongRun]) -> Outcome {
    let errors: Vec<bool> = runs.iter().flat_map(|run| halvings(run)).collect();
    let fall = errors.iter().filter(|falls| **falls).count();
    let curves = runs.iter().flat_map(|run| &run.curves);
    let ended = curves.filter(|curve| curve.failure.is_some()).count();
    let says = format!(
        "{fall} of {} errors in the first period decrease as the step is halved; {ended} runs ended early",
        errors.len()
    );
    Outcome { good: fall == errors.len() && ended == 0, says }
}

/// The runs of each method with dt and dt/2.
fn pairs(run: &LongRun) -> impl Iterator<Item = (&Curve, &Curve)> {
    run.curves.chunks(2).filter_map(|pair| Some((pair.first()?, pair.get(1)?)))
}

/// Whether each error in the first period decreases when the step is halved: of energy, then of
/// constraints.
fn halvings(run: &LongRun) -> Vec<bool> {
    let first = |errors: &[f64]| errors.first().copied().unwrap_or(f64::NAN);
    let falls = |coarse: &[f64], fine: &[f64]| {
        first(fine) <= ROUNDING || first(coarse) >= LEAST_GAIN * first(fine)
    };
    let both = |(coarse, fine): (&Curve, &Curve)| {
        [falls(&coarse.energy, &fine.energy), falls(&coarse.drift, &fine.drift)]
    };
    pairs(run).flat_map(both).collect()
}

fn figure(id: String, runs: &[&LongRun]) -> Lines {
    let energy = |run: &&LongRun| panel(run, "|ΔE|/E", "%", |curve| &curve.energy);
    let drift = |run: &&LongRun| panel(run, "constraint error", "m", |curve| &curve.drift);
    let drifts = |run: &&LongRun| {
        run.curves.iter().flat_map(|curve| &curve.drift).any(|error| *error > ROUNDING)
    };
    let panels = runs.iter().flat_map(|run| {
        let drift = drifts(run).then(|| drift(run));
        [energy(run)].into_iter().chain(drift)
    });
    let steps: Vec<String> = runs.iter().filter_map(step).collect();
    Lines {
        id,
        title: title(runs),
        caption: format!(
            "The largest error in each period; E is the largest kinetic energy. Pale: the step dt ({}). Full color: \
             dt/2. *velocity* and *acceleration* are the semi-implicit integrator at the two levels.",
            steps.join("; ")
        ),
        x: Axis::linear("period", ""),
        panels: panels.collect(),
    }
}

fn step(run: &&LongRun) -> Option<String> {
    let dt = readable(run.curves.first()?.dt, 3);
    Some(format!("{}: {dt} s", run.scene.title))
}

/// The finding: the energy error in the last period, by integrator.
fn title(runs: &[&LongRun]) -> String {
    let Some(run) = runs.first() else { return String::new() };
    let fine = pairs(run).map(|(_, fine)| fine);
    let mut errors: Vec<_> =
        fine.filter_map(|fine| Some((*fine.energy.last()?, fine.method.as_str()))).collect();
    errors.sort_by(|a, b| b.0.total_cmp(&a.0));
    let ends = errors.first().into_iter().chain(errors.get(1..).and_then(<[_]>::last));
    let ends: Vec<String> =
        ends.map(|(error, name)| format!("{} % with {name}", readable(100.0 * error, 2))).collect();
    let periods = run.scene.periods;
    let what = run.scene.title.to_lowercase();
    format!("After {periods} periods the energy of the {what} is off by {}", ends.join(", "))
}

fn panel(run: &LongRun, what: &str, unit: &str, errors: fn(&Curve) -> &Vec<f64>) -> Panel {
    let scale = if unit == "%" { 100.0 } else { 1.0 };
    let points = |curve: &Curve| -> Vec<(f64, f64)> {
        let errors = errors(curve).iter().enumerate();
        errors.map(|(k, error)| (k as f64 + 1.0, scale * error)).collect()
    };
    let both = |(coarse, fine): (&Curve, &Curve)| {
        [
            Series::measured(format!("{}, dt", coarse.method), points(coarse)).labeled(""),
            Series::measured(fine.method.clone(), points(fine)).labeled(&fine.method),
        ]
    };
    Panel {
        y: Axis::log(format!("{}: {what}", run.scene.title), unit),
        series: pairs(run).flat_map(both).collect(),
    }
}
