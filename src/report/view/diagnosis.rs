//! A diagnosis as a page: the animation, the slowest mode, and the sweeps.

use nalgebra::{UnitQuaternion, Vector3};

use super::ReportPage;
use super::animation::{HOW, animation_block};
use crate::animation::{Animation, Frame, Recording, Sample, Strip, instants};
use crate::diagnosis::unsupported::{
    ErrorHistory, Examination, Frame as Problem, OVERLAP, ReferenceSolution, Slowest, UserSolver,
    error_histories, exact, main_solve, percent,
};
use crate::document;
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};
use crate::report::page::{Block, Page, Picture};
use crate::scene::Scene;
use crate::simulation::{Simulation, Step};
use crate::solver::Registry;

/// The displacement of the body that moves most in a mode, relative to the thinnest body.
const SWING: f64 = 0.5;

/// The caption of the animation.
const ANIMATION: &str = "First with exact answers, then with this solver. The redder a body, the larger the \
 error of the forces on it; it is fully red if the error is its whole weight or more, too little or too much.";

/// The page of a scene's diagnosis.
///
/// # Errors
/// If the scene cannot be stepped.
pub(crate) fn diagnosis_page(
    words: &document::Document,
    found: &Examination,
    user_solver: &UserSolver,
    scene: Option<&Scene>,
    problems: &[(String, String)],
) -> Result<Page> {
    let page = Page {
        title: words.title.clone(),
        lead: document::lead(&words.lead),
        facts: vec![("lcplab".into(), env!("CARGO_PKG_VERSION").into())],
        ..Page::default()
    };
    let mut page = ReportPage { page, figures: Vec::new(), tables: Vec::new() };
    if let Some(scene) = scene.filter(|_| !found.notes.is_empty()) {
        let mut animation = animation(scene, found.notes.len())?;
        let deepest = found.worst().into_iter().find(|(measure, _)| *measure == OVERLAP);
        animation.start = deepest.map(|(_, place)| place + 1);
        let drawn = animation.drawn();
        page.page.opening.push(animation_block(drawn, format!("{ANIMATION} {HOW}")));
    }
    for (k, section) in words.sections.iter().enumerate() {
        page.open(&format!("part-{}", k + 1), &section.title);
        section.blocks.iter().for_each(|block| page.add(block.on_page()));
        if k == 0
            && let Some(frame) = &found.frame
        {
            pictures(&mut page, frame, found, user_solver, scene)?;
        }
    }
    if !problems.is_empty() {
        page.open("problems", "Problem files");
        let link = |(name, why): &(String, String)| format!("- [{name}]({name}): {why}\n");
        page.aside("One file for each worst step", problems.iter().map(link).collect::<String>());
    }
    Ok(page.page)
}

/// The slowest mode and the errors by sweep of the examined frame, if its error is not negligible.
fn pictures(
    page: &mut ReportPage,
    frame: &Problem,
    found: &Examination,
    user_solver: &UserSolver,
    scene: Option<&Scene>,
) -> Result<()> {
    let Some(unsupported) = found.unsupported.as_ref().filter(|own| own.is_short()) else {
        return Ok(());
    };
    if let (Some(slowest), Some(scene)) = (&unsupported.slowest, scene) {
        let strip = pattern(scene, frame, slowest, found.place)?;
        page.add(Block::Figure(Picture::inline(&strip)));
    }
    let error_histories = error_histories(frame, user_solver);
    if !error_histories.is_empty() {
        page.add(Block::Figure(Picture::inline(&convergence(&error_histories))));
    }
    Ok(())
}

/// The scene as it is solved next to the exact one; bodies with an error are red.
fn animation(scene: &Scene, steps: usize) -> Result<Animation> {
    let recordings = [
        recording("exact answers", &exact(scene), steps, &|_| vec![0.0; scene.bodies.len()])?,
        recording(&scene.solver.name, scene, steps, &|step| unsupported(scene, step))?,
    ];
    Ok(Animation::new("animation", scene, recordings.into()))
}

fn recording(
    name: &str,
    scene: &Scene,
    steps: usize,
    heat: &dyn Fn(&Step) -> Vec<f64>,
) -> Result<Recording> {
    let mut simulation = Simulation::of(scene)?;
    let samples = instants(steps, Animation::samples_each(2));
    let mut recording = Recording::start(name, &simulation);
    recording.samples[0].frame.heat = vec![0.0; scene.bodies.len()];
    for _ in 0..steps {
        let step = match simulation.step() {
            Ok(step) => step,
            Err(failure) => {
                recording.end(Some(&failure));
                break;
            }
        };
        if samples.binary_search(&step.number).is_ok() {
            let frame = Frame::after(scene, &step).heated(heat(&step));
            recording.samples.push(Sample { frame, motion: step.motion });
        }
    }
    Ok(recording)
}

/// The unsupported fraction of each body's weight in a step; 0 if unknown.
fn unsupported(scene: &Scene, step: &Step) -> Vec<f64> {
    let mut heat = vec![0.0; scene.bodies.len()];
    let Some(solve) = main_solve(step).filter(|solve| solve.posing.is_none()) else { return heat };
    let frame = Problem::of(&solve.exported(scene, step.number));
    let Some(reference) = ReferenceSolution::new(&frame.lcp, 0.0) else { return heat };
    let left = frame.left(&solve.solution.x, &reference.exact);
    for (body, left) in frame.bodies.iter().zip(left) {
        if let Some(k) = scene.bodies.iter().position(|own| own.name == body.name) {
            heat[k] = left;
        }
    }
    heat
}

/// The bodies at rest, and moved by the forces of the slowest mode, magnified.
fn pattern(scene: &Scene, frame: &Problem, slowest: &Slowest, place: usize) -> Result<Strip> {
    let mut simulation = Simulation::of(scene)?;
    for _ in 0..place {
        if simulation.step().is_err() {
            break;
        }
    }
    let moved = frame.response(&slowest.forces);
    let speeds = frame.speeds(&slowest.forces);
    let fastest = speeds.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let swing = SWING * scene.thinnest().unwrap_or(1.0) / fastest;
    let rest = Frame::now(&simulation).heated(vec![0.0; scene.bodies.len()]);
    let mut moving = rest.clone();
    for (body, speed) in frame.bodies.iter().zip(&speeds) {
        let Some(k) = scene.bodies.iter().position(|one| one.name == body.name) else {
            continue;
        };
        let part = |first: usize| match &moved[body.columns.clone()] {
            u if u.len() >= first + 3 => Vector3::new(u[first], u[first + 1], u[first + 2]),
            _ => Vector3::zeros(),
        };
        let pose = &mut moving.states[k].pose;
        pose.p += part(0) * swing;
        pose.q = UnitQuaternion::from_scaled_axis(part(3) * swing) * pose.q;
        moving.heat[k] = speed / fastest;
    }
    let mut strip = Strip::new(scene, vec![rest, moving]).named("pattern");
    strip.labels = ["the bodies in this step", "the error, much enlarged"].map(String::from).into();
    strip.title = format!(
        "A sweep of Gauss-Seidel removes {} of the slowest error pattern",
        percent(1.0 - slowest.rate)
    );
    Ok(strip.with_caption(
        "This error of the positions decays most slowly. The redder a body, the more it moves.",
    ))
}

/// The error after each sweep.
fn convergence(error_histories: &[ErrorHistory]) -> Lines {
    let points = |missing: &mut dyn Iterator<Item = Option<f64>>| {
        let placed = |(k, missing): (usize, Option<f64>)| Some((k as f64, 100.0 * missing?));
        missing.enumerate().filter_map(placed).collect::<Vec<_>>()
    };
    let mut series = Vec::new();
    for error_history in error_histories {
        let measured = points(&mut error_history.missing.iter().map(|missing| Some(*missing)));
        series.push(Series::measured(&error_history.name, measured).labeled(&error_history.name));
        let theory = points(&mut error_history.theory.iter().copied());
        if !theory.is_empty() {
            series.push(
                Series::theory(format!("theory, {}", error_history.name), theory).labeled(""),
            );
        }
    }
    // What the names stand for; those of relaxation factors say it themselves.
    let methods = error_histories.iter().filter_map(|own| {
        let entry = Registry::standard().entry(&own.name).ok()?;
        Some(format!("{}: {}. ", entry.name, entry.method.trim_end_matches(", iterative")))
    });
    Lines::new(
        "convergence",
        left(error_histories).unwrap_or_else(|| "Error after each sweep".into()),
        methods.collect::<String>()
            + "All start from x = 0. The theory (pale) assumes a fixed active set and is not drawn where \
               the active set would change.",
        Axis::linear("sweeps", ""),
        Axis::log("error", "%"),
        series,
    )
}

/// What is left of the error after the last sweep: with the first method, and with the best one.
fn left(error_histories: &[ErrorHistory]) -> Option<String> {
    let last = |own: &ErrorHistory| own.missing.last().copied().unwrap_or(f64::INFINITY);
    let first = error_histories.first()?;
    let best = error_histories.iter().min_by(|a, b| last(a).total_cmp(&last(b)))?;
    let sweeps = first.missing.len() - 1;
    let own = format!(
        "After {sweeps} sweeps {} of the error is left with {}",
        percent(last(first)),
        first.name
    );
    Some(match best.name == first.name {
        true => own,
        false => format!("{own}, {} with {}", percent(last(best)), best.name),
    })
}
