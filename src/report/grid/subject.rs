//! The subject of a task: a scene, or a problem of a family, with the task's settings.

use toml::Value;

use super::file::{Grid, REPEAT, SUBJECT};
use super::plan::Task;
use crate::error::{Error, Result};
use crate::lcp::file::Problem;
use crate::lcp::library::{self, Family};
use crate::report::methods::with_reference;
use crate::scene::{self, Description, Scene};
use crate::solver::Choice;

/// Maximum number of tasks, so that a typing error does not fill the disk.
const MOST_TASKS: usize = 100_000;

/// The subject of a task.
pub(super) enum Subject {
    /// A scene, and the number of steps.
    Scene(Box<Scene>, usize),
    /// A problem, and a scene without bodies that has the solver's settings.
    Problem(Box<Problem>, Box<Scene>),
}

impl Subject {
    /// The subject of a task.
    ///
    /// # Errors
    /// If its settings give none; the reason is that of the scene or of the family.
    pub(crate) fn of(task: &Task) -> Result<Self> {
        match (task.text("scene"), task.text("family")) {
            (Some(name), _) => of_scene(name, task),
            (None, Some(name)) => of_family(library::by_name(name)?, task),
            (None, None) => Err(Error::invalid("task", "scene", "is not a name")),
        }
    }
}

fn of_scene(name: &str, task: &Task) -> Result<Subject> {
    let settings = task.settings.iter().filter(|(path, _)| is_setting(path));
    let changes: Vec<_> = settings.map(|(path, value)| change(path, value)).collect();
    let scene = seeded(Scene::load_with(name, &changes)?, task);
    let steps = match task.settings.get("steps") {
        None => scene.step.count,
        Some(steps) => {
            steps.as_integer().and_then(|steps| usize::try_from(steps).ok()).ok_or_else(|| {
                Error::invalid(name, "steps", format!("{steps} is not a number of steps"))
            })?
        }
    };
    Ok(Subject::Scene(Box::new(scene), steps))
}

fn of_family(family: &dyn Family, task: &Task) -> Result<Subject> {
    let (name, mut changes, mut parameters) = (family.name(), Vec::new(), Vec::new());
    for (path, value) in task.settings.iter().filter(|(path, _)| is_setting(path)) {
        if of_solver(path).is_some() {
            changes.push(change(path, value));
            continue;
        }
        let number = task.number(path).ok_or_else(|| {
            Error::invalid(name, path.as_str(), format!("needs a number, is {value}"))
        })?;
        parameters.push((path.as_str(), number));
    }
    let has_seed = family.parameters().iter().any(|parameter| parameter.name == "seed");
    if has_seed && !task.settings.contains_key("seed") {
        parameters.push(("seed", task.seed.into()));
    }
    let settings = Scene::new(name, &Description::changed(name, "", &changes)?)?;
    let problem = family.generate(&parameters)?;
    Ok(Subject::Problem(Box::new(problem), Box::new(seeded(settings, task))))
}

/// The scene, whose solver has the task's seed unless the grid sets another one.
fn seeded(mut scene: Scene, task: &Task) -> Scene {
    if !task.settings.contains_key("solver.seed") {
        scene.solver.seed = task.seed.into();
    }
    scene
}

fn change(path: &str, value: &Value) -> (String, String) {
    (path.to_string(), value.to_string())
}

fn is_setting(path: &str) -> bool {
    path != REPEAT && !SUBJECT.contains(&path)
}

/// The name of a solver's option.
fn of_solver(path: &str) -> Option<&str> {
    path.strip_prefix("solver.")
}

/// Checks that the grid has a subject, and that each setting exists in it.
///
/// # Errors
/// If a scene has defects. Other defects are passed to `fault`, by setting.
pub(super) fn check(grid: &Grid, mut fault: impl FnMut(&str, String)) -> Result<()> {
    let names = |kind| grid.values_of(kind).into_iter().filter_map(Value::as_str);
    let (mut scenes, mut families) = (Vec::new(), Vec::new());
    for name in names("scene") {
        match Description::load_with(name, &[]) {
            Ok(description) => scenes.push((name, description)),
            Err(unknown @ Error::Unknown { .. }) => {
                fault("scene", unknown.to_string());
                return Ok(());
            }
            Err(error) => return Err(error),
        }
    }
    for name in names("family") {
        match library::by_name(name) {
            Ok(family) => families.push(family),
            Err(unknown) => {
                fault("family", unknown.to_string());
                return Ok(());
            }
        }
    }
    match (scenes.is_empty(), families.is_empty()) {
        (true, true) => fault("scene", "is missing: name a scene or a family".into()),
        (false, false) => fault("family", "there is a scene too, name one of them".into()),
        (true, false) if !grid.values_of("steps").is_empty() => {
            fault("steps", "a problem of a family is solved once".into());
        }
        _ => {}
    }
    for path in grid.paths().filter(|path| is_setting(path)) {
        let Some(value) = grid.values_of(path).first().copied() else { continue };
        let of_scenes = scenes.iter().map(|(name, _)| in_scene(name, path, value));
        let of_families = families.iter().map(|family| in_family(*family, path, value));
        let mut reasons = of_scenes.chain(of_families).map(|found| found.err());
        if let Some(Some(Error::Invalid { defects, .. })) = reasons.next()
            && reasons.all(|reason| reason.is_some())
        {
            fault(path, defects[0].reason.clone());
        }
    }
    let usual = match scenes.as_slice() {
        [] => vec![scene::Solver::default().name],
        scenes => scenes.iter().map(|(_, scene)| scene.solver.name.clone()).collect(),
    };
    for (path, names) in unused(grid, usual) {
        fault(path, format!("has no effect: {names} does not use it"));
    }
    let tasks = grid.axes.iter().try_fold(1_usize, |n, axis| n.checked_mul(axis.points.len()));
    if tasks.is_none_or(|tasks| tasks > MOST_TASKS) {
        fault("axes", format!("make more than {MOST_TASKS} tasks"));
    }
    Ok(())
}

/// Whether a scene has this setting.
fn in_scene(name: &str, path: &str, value: &Value) -> Result<()> {
    Description::load_with(name, &[change(path, value)]).map(drop)
}

/// Whether a family has this parameter, or its solver this option.
fn in_family(family: &dyn Family, path: &str, value: &Value) -> Result<()> {
    if of_solver(path).is_some() {
        return Description::changed(family.name(), "", &[change(path, value)]).map(drop);
    }
    let known: Vec<&str> = family.parameters().iter().map(|parameter| parameter.name).collect();
    match known.contains(&path) {
        true => Ok(()),
        false => {
            let reason = format!("is no parameter; there are {}", known.join(", "));
            Err(Error::invalid(family.name(), path, reason))
        }
    }
}

/// The axes of options that no solver of the grid uses, with the solvers' names; `usual` are those
/// if the grid names none.
fn unused(grid: &Grid, usual: Vec<String>) -> Vec<(&str, String)> {
    let named = grid.values_of("solver.name").into_iter().filter_map(|value| value.as_str());
    let named: Vec<String> = named.map(String::from).collect();
    let names = if named.is_empty() { usual } else { named };
    let ignored = |choice: Choice| {
        let uses =
            |name: &String| with_reference().entry(name).map(|entry| entry.uses.contains(&choice));
        names.iter().all(|name| uses(name) == Ok(false))
    };
    [Choice::Omega, Choice::Order, Choice::Damping]
        .into_iter()
        .filter(|choice| ignored(*choice))
        .filter_map(|choice| {
            let is_it = |path: &&String| of_solver(path) == Some(choice.name());
            let path = grid.axes.iter().flat_map(|axis| &axis.paths).find(is_it)?;
            Some((path.as_str(), names.join(", ")))
        })
        .collect()
}
