//! Parses the grid file; every defect is reported with its line.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;
use toml::Value;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use super::measure::{MEASURES, Measure};
use super::theory::Theory;
use crate::error::{Defects, Error, Result};
use crate::file;
use crate::plot::Scale;
use crate::plugin::Declaration;

/// The grids that lcplab ships, by name.
const SHIPPED: [(&str, &str); 5] = [
    ("column", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/grids/column.toml"))),
    ("load", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/grids/load.toml"))),
    ("omega", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/grids/omega.toml"))),
    ("ratio", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/grids/ratio.toml"))),
    ("schemes", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/grids/schemes.toml"))),
];

const KEYS: [&str; 16] = [
    "title", "text", "plugins", "scene", "family", "steps", "measure", "scale", "limit", "theory",
    "seed", "repeat", "set", "axes", "zip", "labels",
];

/// Maximum number of points on an axis.
const MOST_POINTS: usize = 100_000;

/// A grid as its file describes it; see the [module](super) for the format.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The file's name without its extension; also the folder of its results.
    pub name: String,
    /// The heading.
    pub title: String,
    /// The text above the figures on the page.
    pub text: String,
    /// The settings that are the same in all tasks: paths and values.
    pub settings: Vec<(String, Value)>,
    /// The axes, the slowest first.
    pub axes: Vec<Axis>,
    /// The measures that are drawn.
    pub measures: Vec<&'static Measure>,
    /// The scale of their axis; chosen from the values by default.
    pub scale: Option<Scale>,
    /// The largest value of the first measure that is good enough.
    pub limit: Option<f64>,
    /// The closed form to draw for comparison.
    pub theory: Option<Theory>,
    /// The seed from which those of the tasks are derived.
    pub seed: u64,
    /// The labels of settings on the page.
    pub labels: Vec<(String, String)>,
    /// External programs that may be named as solvers; the caller has to start them.
    pub plugins: BTreeMap<String, Declaration>,
    /// The text of the file.
    pub(super) source: String,
}

/// Settings that vary together: one, or those of `zip`.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Their paths.
    pub paths: Vec<String>,
    /// Their values, point by point, one per path.
    pub points: Vec<Vec<Value>>,
}

impl Grid {
    /// The name of a setting: its label, or the last part of its path if no other axis has the
    /// same.
    pub(crate) fn label(&self, path: &str) -> String {
        let last = |path: &str| path.rsplit('.').next().unwrap_or(path).replace('_', " ");
        let paths = || self.axes.iter().flat_map(|axis| &axis.paths);
        let label = self.labels.iter().find(|(other, _)| other == path).map(|(_, label)| label);
        match label {
            Some(label) => label.clone(),
            None if paths().filter(|other| last(other) == last(path)).count() > 1 => path.into(),
            None => last(path),
        }
    }

    /// The text of its file.
    pub(crate) fn source(&self) -> &str {
        &self.source
    }

    /// Reads a grid file, or a shipped grid by its name.
    ///
    /// # Errors
    /// If the name is neither a file nor a shipped grid, or the file has defects, which are listed
    /// with their lines.
    pub fn load(path_or_name: &str) -> Result<Self> {
        let path = Path::new(path_or_name);
        if file::is_there(path) {
            let text = file::read(path, file::WRITTEN_BY_HAND)?;
            return Self::from_toml(path_or_name, &text);
        }
        let shipped = SHIPPED.iter().find(|(name, _)| *name == path_or_name);
        let (_, text) = shipped.ok_or_else(|| Error::Unknown {
            kind: "grid file or shipped grid",
            name: path_or_name.into(),
            known: SHIPPED.iter().map(|(name, _)| (*name).into()).collect(),
        })?;
        Self::from_toml(path_or_name, text)
    }

    /// Parses a grid; `path` is used in messages and gives the name.
    ///
    /// # Errors
    /// A single error that lists every defect with its line.
    pub fn from_toml(path: &str, text: &str) -> Result<Self> {
        let table = DeTable::parse(text).map_err(|error| {
            let line = error.span().map_or(1, |span| line_at(text, span.start));
            Error::invalid(path, format!("line {line}"), error.message())
        })?;
        let mut reader = Reader { text, root: table.get_ref(), defects: Defects::default() };
        let grid = reader.grid(path);
        if reader.defects.is_empty() {
            super::subject::check(&grid, |setting, reason| reader.fault(setting, reason))?;
        }
        reader.defects.into_result(path)?;
        Ok(grid)
    }
}

/// A file that is being parsed; parsing continues after a defect.
struct Reader<'a> {
    text: &'a str,
    root: &'a DeTable<'a>,
    defects: Defects,
}

/// A value with the path of its keys and the position of the last one.
struct Entry<'a> {
    path: String,
    at: usize,
    value: &'a Spanned<DeValue<'a>>,
}

impl<'a> Reader<'a> {
    fn grid(&mut self, path: &str) -> Grid {
        for (key, _) in self.root.iter().filter(|(key, _)| !KEYS.contains(&key.get_ref().as_ref()))
        {
            let reason = format!(
                "{:?} is not a key of a grid file; the keys are {}",
                key.get_ref(),
                KEYS.join(", ")
            );
            self.add(key.span().start, reason);
        }
        let name = Path::new(path).file_stem();
        let name = name.map_or("grid".into(), |name| name.to_string_lossy().into_owned());
        let measures: Vec<String> = self.one_or_many("measure");
        let measures = measures.iter().filter_map(|name| {
            self.named(
                "measure",
                name,
                |name| MEASURES.iter().find(|measure| measure.name == name),
                &MEASURES.map(|measure| measure.name),
            )
        });
        let measures: Vec<&'static Measure> = measures.collect();
        let theory: Option<String> = self.key("theory");
        let theory = theory.and_then(|name| {
            self.named("theory", &name, Theory::by_name, &Theory::ALL.map(Theory::name))
        });
        let axes = self.axes();
        let settings = self.settings(&axes);
        let labels = self.labels(&axes);
        let scale: Option<Spacing> = self.key("scale");
        Grid {
            title: self.key("title").unwrap_or_else(|| name.clone()),
            name,
            text: self.key("text").unwrap_or_default(),
            settings,
            axes,
            measures: if measures.is_empty() { vec![&MEASURES[0]] } else { measures },
            scale: scale.map(|scale| match scale {
                Spacing::Linear => Scale::Linear,
                Spacing::Log => Scale::Log,
            }),
            limit: self.key("limit"),
            theory,
            labels,
            seed: self.key("seed").unwrap_or(1),
            plugins: self.key("plugins").unwrap_or_default(),
            source: self.text.into(),
        }
    }

    /// The axes, followed by that of `zip` and that of the repetitions.
    fn axes(&mut self) -> Vec<Axis> {
        let mut axes = Vec::new();
        for entry in self.entries("axes", is_axis) {
            if let Some(values) = self.values(&entry) {
                let points = values.into_iter().map(|value| vec![value]).collect();
                axes.push(Axis { paths: vec![entry.path], points });
            }
        }
        axes.extend(self.zip());
        let repeat: usize = self.key("repeat").unwrap_or(1);
        if !(1..=MOST_POINTS).contains(&repeat) {
            self.fault("repeat", format!("must lie between 1 and {MOST_POINTS}, is {repeat}"));
        } else if repeat > 1 {
            let points = (1..=repeat as i64).map(|k| vec![Value::Integer(k)]).collect();
            axes.push(Axis { paths: vec![REPEAT.into()], points });
        }
        axes
    }

    fn zip(&mut self) -> Option<Axis> {
        let mut zip: Option<Axis> = None;
        for entry in self.entries("zip", is_axis) {
            let Some(values) = self.values(&entry) else { continue };
            let axis = zip.get_or_insert_with(|| Axis {
                paths: Vec::new(),
                points: vec![Vec::new(); values.len()],
            });
            if axis.points.len() != values.len() {
                let (first, length) = (&axis.paths[0], axis.points.len());
                let reason = format!(
                    "zip.{}: has {} values, {first} has {length}",
                    entry.path,
                    values.len()
                );
                self.add(entry.at, reason);
                continue;
            }
            axis.paths.push(entry.path);
            axis.points.iter_mut().zip(values).for_each(|(point, value)| point.push(value));
        }
        zip
    }

    /// `scene`, `family`, `steps` and the content of `set`; nothing may be set twice.
    fn settings(&mut self, axes: &[Axis]) -> Vec<(String, Value)> {
        let outer = SUBJECT.iter().filter_map(|name| {
            let (key, value) = self.root.get_key_value(*name)?;
            Some(Entry { path: (*name).into(), at: key.span().start, value })
        });
        let mut entries: Vec<Entry> = outer.collect();
        entries.extend(self.entries("set", |value| !value.is_table()));
        let mut settings: Vec<(String, Value)> = Vec::new();
        for Entry { path, at, value } in entries {
            let varies = axes.iter().any(|axis| axis.paths.contains(&path));
            if varies || settings.iter().any(|(other, _)| *other == path) {
                self.add(at, format!("{path}: is set twice"));
            }
            settings.extend(plain(value).map(|value| (path, value)));
        }
        let twice = |(k, path): (usize, &String)| {
            let before = axes.iter().flat_map(|axis| &axis.paths).take(k);
            before.into_iter().any(|other| other == path).then(|| path.clone())
        };
        let paths = axes.iter().flat_map(|axis| &axis.paths).enumerate();
        for path in paths.filter_map(twice).collect::<Vec<_>>() {
            self.fault(&path, "is an axis twice".into());
        }
        settings
    }

    /// The labels of settings; only those that vary need one.
    fn labels(&mut self, axes: &[Axis]) -> Vec<(String, String)> {
        let mut labels = Vec::new();
        for Entry { path, at, value } in self.entries("labels", |value| !value.is_table()) {
            match plain(value) {
                Some(Value::String(label))
                    if axes.iter().any(|axis| axis.paths.contains(&path)) =>
                {
                    labels.push((path, label));
                }
                _ => self.add(at, format!("{path}: needs a text, and must be an axis")),
            }
        }
        labels
    }

    /// The values of an axis: a list, or a number of values between two limits.
    fn values(&mut self, entry: &Entry) -> Option<Vec<Value>> {
        let values = match plain(entry.value) {
            Some(Value::Array(values)) => Ok(values),
            Some(table @ Value::Table(_)) => Range::read(table).and_then(|range| range.values()),
            _ => Err("needs a list of values, or { from, to, count }".into()),
        };
        match values {
            Ok(values) if values.is_empty() => {
                self.add(entry.at, format!("{}: is empty", entry.path))
            }
            Ok(values) => return Some(values),
            Err(reason) => self.add(entry.at, format!("{}: {reason}", entry.path)),
        }
        None
    }

    /// The leaves of a table in the file, in the order of the text.
    fn entries(&mut self, key: &str, is_leaf: fn(&DeValue) -> bool) -> Vec<Entry<'a>> {
        let mut entries = Vec::new();
        match self.root.get_key_value(key).map(|(key, value)| (key, value.get_ref())) {
            Some((_, DeValue::Table(table))) => flatten("", table, is_leaf, &mut entries),
            Some((at, _)) => self.add(at.span().start, format!("{key}: must be a table")),
            None => {}
        }
        entries.sort_by_key(|entry| entry.at);
        entries
    }

    /// The value of a key in the file, if it exists.
    fn key<T: serde::de::DeserializeOwned>(&mut self, key: &str) -> Option<T> {
        let (at, value) = self.root.get_key_value(key)?;
        let read = T::deserialize(ValueDeserializer::from(value.clone()));
        read.map_err(|error| self.add(at.span().start, format!("{key}: {}", error.message()))).ok()
    }

    fn one_or_many(&mut self, key: &str) -> Vec<String> {
        match self.root.get(key).map(|value| value.get_ref()) {
            Some(DeValue::Array(_)) => self.key(key).unwrap_or_default(),
            _ => self.key(key).into_iter().collect(),
        }
    }

    fn named<T>(
        &mut self,
        key: &str,
        name: &str,
        find: impl Fn(&str) -> Option<T>,
        known: &[&str],
    ) -> Option<T> {
        let found = find(name);
        if found.is_none() {
            self.fault(key, format!("there is no {name:?}; there are {}", known.join(", ")));
        }
        found
    }

    /// Adds a defect of a key or a setting, wherever it is.
    fn fault(&mut self, path: &str, reason: String) {
        let own = self.root.get_key_value(path).map(|(key, _)| key.span().start);
        let tables = [
            ("axes", is_axis as fn(&DeValue) -> bool),
            ("zip", is_axis),
            ("set", |value| !value.is_table()),
        ];
        let leaves =
            tables.iter().flat_map(|(key, leaf)| self.entries(key, *leaf)).collect::<Vec<_>>();
        let inner = leaves.iter().rev().find(|entry| entry.path == path).map(|entry| entry.at);
        self.add(inner.or(own).unwrap_or(0), format!("{path}: {reason}"));
    }

    fn add(&mut self, at: usize, reason: String) {
        self.defects.add(format!("line {}", line_at(self.text, at)), reason);
    }
}

/// Keys that select the subject of a task, as opposed to settings within it.
pub(super) const SUBJECT: [&str; 3] = ["scene", "family", "steps"];
/// The axis of repetitions.
pub(super) const REPEAT: &str = "repeat";

fn is_axis(value: &DeValue) -> bool {
    value.as_table().is_none_or(|table| table.contains_key("from"))
}

fn flatten<'a>(
    prefix: &str,
    table: &'a DeTable<'a>,
    is_leaf: fn(&DeValue) -> bool,
    entries: &mut Vec<Entry<'a>>,
) {
    for (key, value) in table.iter() {
        let path = format!("{prefix}{}", key.get_ref());
        match value.get_ref() {
            DeValue::Table(inner) if !is_leaf(value.get_ref()) => {
                flatten(&format!("{path}."), inner, is_leaf, entries);
            }
            _ => entries.push(Entry { path, at: key.span().start, value }),
        }
    }
}

fn plain(value: &Spanned<DeValue<'_>>) -> Option<Value> {
    Value::deserialize(ValueDeserializer::from(value.clone())).ok()
}

/// A number of values between two limits.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Range {
    from: f64,
    to: f64,
    count: usize,
    #[serde(default)]
    spacing: Spacing,
}

/// What is constant between neighbors: the difference or the ratio.
#[derive(Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Spacing {
    #[default]
    Linear,
    Log,
}

impl Range {
    fn read(table: Value) -> std::result::Result<Self, String> {
        table.try_into().map_err(|error: toml::de::Error| error.message().replace('`', "\""))
    }

    /// The values, rounded to twelve digits for readability; integers if all are.
    fn values(&self) -> std::result::Result<Vec<Value>, String> {
        let Range { from, to, count, spacing } = *self;
        if !(from.is_finite() && to.is_finite() && (2..=MOST_POINTS).contains(&count)) {
            return Err(format!("needs finite numbers and a count from 2 to {MOST_POINTS}"));
        }
        if matches!(spacing, Spacing::Log) && !(from > 0.0 && to > 0.0) {
            return Err("needs positive numbers for a spacing by ratios".into());
        }
        let at = |k: usize| {
            let part = k as f64 / (count - 1) as f64;
            match spacing {
                Spacing::Linear => from + (to - from) * part,
                Spacing::Log => from * libm::pow(to / from, part),
            }
        };
        let rounded = |x: f64| format!("{x:.11e}").parse().unwrap_or(x);
        let numbers: Vec<f64> = (0..count).map(at).map(rounded).collect();
        let whole = numbers.iter().all(|x: &f64| x.fract() == 0.0 && x.abs() < 1e15);
        let value = |x: f64| if whole { Value::Integer(x as i64) } else { Value::Float(x) };
        Ok(numbers.into_iter().map(value).collect())
    }
}

/// The line, from 1, of a byte in the text.
fn line_at(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|&byte| byte == b'\n').count() + 1
}
