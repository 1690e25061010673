//! The subject of a task: a scene, or a problem of a family, with the task's settings.

use serde_json::{Value as Json, json};
use toml::Value;

use super::file::{Grid, REPEAT, SUBJECT};
use super::plan::Task;
use crate::error::{Error, Result};
use crate::lcp::file::Problem;
use crate::lcp::library::{self, Family};
use crate::report::methods;
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
    pub fn of(task: &Task) -> Result<Self> {
        let mut form = match (task.text("scene"), task.text("family")) {
            (Some(name), _) => Form::scene(name)?,
            (None, Some(name)) => Form::family(name)?,
            (None, None) => return Err(Error::invalid("task", "scene", "is not a name")),
        };
        for (path, value) in task.settings.iter().filter(|(path, _)| is_setting(path)) {
            form.set(path, value.clone())?;
        }
        match form.family {
            None => form.into_scene(task),
            Some(family) => form.into_problem(family, task),
        }
    }
}

/// The fields of a scene or a family, with the current values.
struct Form {
    name: String,
    /// All fields, `null` for those without a value.
    fields: Json,
    values: Value,
    family: Option<&'static dyn Family>,
}

impl Form {
    fn scene(name: &str) -> Result<Self> {
        let (path, text) = scene::text(name)?;
        let description = Description::from_toml(&path, &text)?;
        let fault =
            |cause: &dyn std::fmt::Display| Error::invalid(name, "scene", cause.to_string());
        Ok(Form {
            name: name.into(),
            fields: serde_json::to_value(&description).map_err(|cause| fault(&cause))?,
            values: Value::try_from(&description).map_err(|cause| fault(&cause))?,
            family: None,
        })
    }

    fn family(name: &str) -> Result<Self> {
        let family = library::by_name(name)?;
        let solver = scene::Solver::default();
        let fault =
            |cause: &dyn std::fmt::Display| Error::invalid(name, "solver", cause.to_string());
        let mut fields =
            json!({ "solver": serde_json::to_value(&solver).map_err(|cause| fault(&cause))? });
        let mut values = toml::Table::new();
        values.insert("solver".into(), Value::try_from(&solver).map_err(|cause| fault(&cause))?);
        for parameter in family.parameters() {
            fields[parameter.name] = json!(parameter.default);
            values.insert(parameter.name.into(), Value::Float(parameter.default));
        }
        Ok(Form { name: name.into(), fields, values: Value::Table(values), family: Some(family) })
    }

    fn set(&mut self, path: &str, value: Value) -> Result<()> {
        let keys = self.place(path)?;
        let mut at = &mut self.values;
        for key in keys {
            let inner = match (key, at) {
                (Key::Item(k), Value::Array(items)) => items.get_mut(k),
                (Key::Field(name), Value::Table(table)) => {
                    Some(table.entry(name).or_insert(Value::Table(toml::Table::new())))
                }
                _ => None,
            };
            at = inner.ok_or_else(|| Error::invalid(&self.name, path, "is not allowed there"))?;
        }
        *at = value;
        self.check_types().map_err(|reason| Error::invalid(&self.name, path, reason))
    }

    /// Whether every value has the type of its field.
    fn check_types(&self) -> std::result::Result<(), String> {
        let checked = match (&self.family, &self.values) {
            (None, values) => values.clone().try_into().map(|_: Description| ()),
            (Some(_), values) => values["solver"].clone().try_into().map(|_: scene::Solver| ()),
        };
        checked.map_err(|cause| cause.message().replace('`', "\""))
    }

    /// The path to a setting, which may have no value yet.
    fn place(&self, path: &str) -> Result<Vec<Key>> {
        let mut at = &self.fields;
        let mut keys = Vec::new();
        let mut parts = path.split('.').peekable();
        while let Some(part) = parts.peek().copied() {
            let (key, inner) = match at {
                Json::Null => (Key::Field(part.into()), &Json::Null),
                Json::Object(fields) => match fields.get(part) {
                    Some(inner) => (Key::Field(part.into()), inner),
                    None => return Err(self.no_setting(path, part, fields.keys())),
                },
                Json::Array(items) => {
                    let named = || items.iter().position(|item| item["name"] == part);
                    let counted = part.parse().ok().filter(|k| *k < items.len());
                    match counted.or_else(named) {
                        Some(k) => (Key::Item(k), &items[k]),
                        None if items.len() == 1 => {
                            keys.push(Key::Item(0));
                            at = &items[0];
                            continue;
                        }
                        None => return Err(self.no_item(path, part, items)),
                    }
                }
                _ => {
                    return Err(Error::invalid(
                        &self.name,
                        path,
                        format!("nothing has a {part:?}"),
                    ));
                }
            };
            parts.next();
            keys.push(key);
            at = inner;
        }
        Ok(keys)
    }

    fn no_setting<'a>(
        &self,
        path: &str,
        part: &str,
        known: impl Iterator<Item = &'a String>,
    ) -> Error {
        let known: Vec<&str> = known.map(String::as_str).collect();
        let reason = format!("{} has no {part:?} there; it has {}", self.name, known.join(", "));
        Error::invalid(&self.name, path, reason)
    }

    fn no_item(&self, path: &str, part: &str, items: &[Json]) -> Error {
        let names: Vec<&str> = items.iter().filter_map(|item| item["name"].as_str()).collect();
        let named =
            if names.is_empty() { String::new() } else { format!(": {}", names.join(", ")) };
        let reason = format!("{part:?} is none of the {} items{named}", items.len());
        Error::invalid(&self.name, path, reason)
    }

    fn into_scene(self, task: &Task) -> Result<Subject> {
        let description: Description =
            self.values.try_into().map_err(|cause| unreadable(&self.name, &cause))?;
        let mut scene = Scene::new(&self.name, &description)?;
        if !task.settings.contains_key("solver.seed") {
            scene.solver.seed = task.seed.into();
        }
        let steps = match task.settings.get("steps") {
            None => scene.step.count,
            Some(steps) => steps
                .as_integer()
                .and_then(|steps| usize::try_from(steps).ok())
                .ok_or_else(|| {
                    Error::invalid(&self.name, "steps", format!("{steps} is not a number of steps"))
                })?,
        };
        Ok(Subject::Scene(Box::new(scene), steps))
    }

    fn into_problem(self, family: &dyn Family, task: &Task) -> Result<Subject> {
        let Value::Table(mut values) = self.values else {
            return Err(Error::invalid(&self.name, "settings", "are no table"));
        };
        let solver = values.remove("solver").unwrap_or(Value::Table(toml::Table::new()));
        let mut solver: scene::Solver =
            solver.try_into().map_err(|cause| unreadable(&self.name, &cause))?;
        if values.contains_key("seed") && !task.settings.contains_key("seed") {
            values.insert("seed".into(), Value::Integer(task.seed.into()));
        }
        if !task.settings.contains_key("solver.seed") {
            solver.seed = task.seed.into();
        }
        let mut parameters = Vec::new();
        for (name, value) in &values {
            let number = value.as_float().or(value.as_integer().map(|value| value as f64));
            let number = number.ok_or_else(|| {
                Error::invalid(&self.name, name.as_str(), format!("needs a number, is {value}"))
            })?;
            parameters.push((name.as_str(), number));
        }
        let settings = Scene::new(&self.name, &Description { solver, ..Description::default() })?;
        Ok(Subject::Problem(Box::new(family.generate(&parameters)?), Box::new(settings)))
    }
}

/// A step into a value.
enum Key {
    Field(String),
    Item(usize),
}

fn unreadable(name: &str, cause: &toml::de::Error) -> Error {
    Error::invalid(name, "settings", cause.message().replace('`', "\""))
}

fn is_setting(path: &str) -> bool {
    path != REPEAT && !SUBJECT.contains(&path)
}

/// The scenes or families that a grid names, or the kind and the error of the first that fails.
fn forms(
    grid: &Grid,
    kind: &'static str,
    read: fn(&str) -> Result<Form>,
) -> std::result::Result<Vec<Form>, (&'static str, Error)> {
    let names = grid.values_of(kind).into_iter().filter_map(|value| value.as_str());
    names.map(|name| read(name).map_err(|error| (kind, error))).collect()
}

/// Checks that the grid has a subject, and that each setting exists in it.
///
/// # Errors
/// If a scene has defects. Other defects are passed to `fault`, by setting.
pub(super) fn check(grid: &Grid, mut fault: impl FnMut(&str, String)) -> Result<()> {
    let read = || Ok((forms(grid, "scene", Form::scene)?, forms(grid, "family", Form::family)?));
    let (scenes, families) = match read() {
        Ok(forms) => forms,
        Err((kind, unknown @ Error::Unknown { .. })) => {
            fault(kind, unknown.to_string());
            return Ok(());
        }
        Err((_, error)) => return Err(error),
    };
    match (scenes.is_empty(), families.is_empty()) {
        (true, true) => fault("scene", "is missing: name a scene or a family".into()),
        (false, false) => fault("family", "there is a scene too, name one of them".into()),
        (true, false) if !grid.values_of("steps").is_empty() => {
            fault("steps", "a problem of a family is solved once".into());
        }
        _ => {}
    }
    let forms: Vec<&Form> = scenes.iter().chain(&families).collect();
    for path in grid.paths().filter(|path| is_setting(path)) {
        let mut reasons = forms.iter().map(|form| form.place(path).err());
        if let Some(Some(Error::Invalid { defects, .. })) = reasons.next()
            && reasons.all(|reason| reason.is_some())
        {
            fault(path, defects[0].reason.clone());
        }
    }
    for (path, names) in unused(grid, &forms) {
        fault(path, format!("has no effect: {names} does not use it"));
    }
    let tasks = grid.axes.iter().try_fold(1_usize, |n, axis| n.checked_mul(axis.points.len()));
    if tasks.is_none_or(|tasks| tasks > MOST_TASKS) {
        fault("axes", format!("make more than {MOST_TASKS} tasks"));
    }
    Ok(())
}

/// The axes of options that no solver of the grid uses, with the solvers' names.
fn unused<'a>(grid: &'a Grid, forms: &[&Form]) -> Vec<(&'a str, String)> {
    let named = grid.values_of("solver.name").into_iter().filter_map(|value| value.as_str());
    let mut names: Vec<String> = named.map(String::from).collect();
    if names.is_empty() {
        let usual = |form: &&Form| form.fields["solver"]["name"].as_str().map(String::from);
        names = forms.iter().filter_map(usual).collect();
    }
    let ignored = |choice: Choice| {
        let uses = |name: &String| methods::entry(name).map(|entry| entry.uses.contains(&choice));
        names.iter().all(|name| uses(name) == Ok(false))
    };
    [Choice::Omega, Choice::Order, Choice::Damping]
        .into_iter()
        .filter(|choice| ignored(*choice))
        .filter_map(|choice| {
            let is_it = |path: &&String| path.strip_prefix("solver.") == Some(choice.name());
            let path = grid.axes.iter().flat_map(|axis| &axis.paths).find(is_it)?;
            Some((path.as_str(), names.join(", ")))
        })
        .collect()
}
