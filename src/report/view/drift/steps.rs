//! Energy and constraint errors, level by level, for decreasing step lengths.

use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Table};
use crate::report::study::comparison::Sample;
use crate::report::study::drift::steps::{Curve, Levels};
use crate::report::view::attempt::stem;
use crate::report::view::{Document, Outcome};

/// Halving the step must divide an error by at least this much: by 2 if the method is of first
/// order and the step is short, by somewhat less otherwise.
const LEAST_GAIN: f64 = 1.5;
/// Errors up to this are rounding: relative to the largest kinetic energy, or in meters.
const ROUNDING: f64 = 1e-9;

pub(super) fn show(findings: &[&Levels], document: &mut Document) {
    document.text(
        "A real pendulum conserves its energy and its length. In a simulation, both have errors that depend on \
         the time step and the scheme. Below, the energy error is relative to the largest kinetic energy of \
         the motion, and the *drift* is the largest error of the length of a rod. Halving the step should \
         halve the errors of a first-order method.",
    );
    for study in findings {
        document.figure(figure(study));
    }
    document.table("drift", table(findings));
}

pub(super) fn outcome(findings: &[&Levels]) -> Outcome {
    let errors: Vec<bool> = findings.iter().flat_map(|study| halvings(study)).collect();
    let fall = errors.iter().filter(|falls| **falls).count();
    let ended = findings.iter().flat_map(|study| &study.curves);
    let ended = ended.filter(|curve| curve.failure.is_some()).count();
    let says = format!(
        "{fall} of {} errors decrease as the step is halved; {ended} runs ended early",
        errors.len()
    );
    Outcome { good: fall == errors.len() && ended == 0, says }
}

/// Whether each error decreases when the step is halved: of energy, then of length.
fn halvings(study: &Levels) -> Vec<bool> {
    let falls =
        |coarse: f64, fine: f64, rounding: f64| fine <= rounding || coarse >= LEAST_GAIN * fine;
    let pairs = study.curves.windows(2).filter(|pair| pair[0].scheme == pair[1].scheme);
    let both = |pair: &[Curve]| {
        let [coarse, fine] = [&pair[0], &pair[1]];
        [
            falls(coarse.energy_error(), fine.energy_error(), ROUNDING * study.scale),
            falls(coarse.drift(), fine.drift(), ROUNDING),
        ]
    };
    pairs.flat_map(both).collect()
}

fn name(curve: &Curve) -> String {
    match curve.division {
        1 => format!("{}, dt", curve.scheme),
        division => format!("{}, dt/{division}", curve.scheme),
    }
}

fn figure(study: &Levels) -> Lines {
    let series = |measure: &dyn Fn(&Curve, &Sample) -> f64| -> Vec<Series> {
        let one = |curve: &Curve| {
            let points = curve.samples.iter().map(|s| (s.time, measure(curve, s))).collect();
            Series::measured(name(curve), points)
        };
        study.curves.iter().map(one).collect()
    };
    let start = |curve: &Curve| curve.samples.first().map_or(0.0, |sample| sample.energy);
    let energy = series(&|curve, sample| 100.0 * (sample.energy - start(curve)) / study.scale);
    let drift = series(&|_, sample| 1e3 * sample.drift);
    let dt = study.curves.first().map_or(0.0, |curve| curve.dt);
    Lines {
        id: format!("drift_{}", stem(&study.scene)),
        title: study.title.clone(),
        caption: format!(
            "dt = {dt} s. Above: energy error in percent of the largest kinetic energy. Below: the \
             error of the worst rod's length.",
        ),
        x: Axis::linear("time", "s"),
        panels: vec![
            Panel { y: Axis::linear("energy error", "%"), series: energy },
            Panel { y: Axis::linear("drift", "mm"), series: drift },
        ],
    }
}

fn table(studies: &[&Levels]) -> Table {
    let cells = |study: &Levels, k: usize| {
        let curve = &study.curves[k];
        let coarser = k.checked_sub(1).map(|k| &study.curves[k]);
        let coarser = coarser.filter(|coarser| coarser.scheme == curve.scheme);
        let ratio = |measure: fn(&Curve) -> f64| {
            coarser.map_or(Cell::text("–"), |coarser| {
                Cell::number(measure(coarser) / measure(curve), 3)
            })
        };
        vec![
            Cell::text(&study.scene),
            Cell::text(&curve.scheme),
            Cell::number(curve.dt, 3),
            Cell::number(100.0 * curve.energy_error() / study.scale, 3),
            ratio(Curve::energy_error),
            Cell::number(1e3 * curve.drift(), 3),
            ratio(Curve::drift),
            Cell::text(curve.failure.clone().unwrap_or_default()),
        ]
    };
    let rows =
        studies.iter().flat_map(|study| (0..study.curves.len()).map(move |k| cells(study, k)));
    Table::new(
        "Largest errors over the run",
        "*gain*: the error with twice this step, divided by the error with this step; 2 for a \
         first-order method, 4 for a second-order method.",
        "scene | level | #dt (s) | #energy error (%) | #gain | #drift (mm) | #gain | reason",
        rows.collect(),
    )
}
