//! The kinds of studies in report files, and a study of any kind.

use schemars::{Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;
use toml::Spanned;
use toml::de::DeValue;

use super::study::{self, Study};
use super::view::{Headline, Outcome, ReportPage, View};
use crate::error::{Defects, Error, Result};
use crate::scene::source::Source;
use crate::solver::Registry;

/// A kind of study.
pub struct Kind {
    /// Its name in report files.
    pub name: &'static str,
    /// The default heading of its section.
    pub title: &'static str,
    /// Builds a study of this kind from its settings.
    pub read: fn(&Value) -> serde_json::Result<Box<dyn AnyStudy>>,
    /// The same from a file; `None` with every defect if there are any.
    pub parse: Parse,
    /// The schema of its settings.
    pub schema: fn(&mut SchemaGenerator) -> Schema,
}

/// All kinds.
pub const KINDS: &[Kind] = &[
    Kind::of::<study::verification::Plan>(),
    Kind::of::<study::comparison::Plan>(),
    Kind::of::<study::cross_check::Plan>(),
    Kind::of::<study::convergence::Plan>(),
    Kind::of::<study::sliding::Plan>(),
    Kind::of::<study::sparsity::Plan>(),
    Kind::of::<study::drift::Plan>(),
    Kind::of::<study::profiles::Plan>(),
    Kind::of::<study::animation::Plan>(),
    Kind::of::<study::scenes::Plan>(),
    Kind::of::<study::solved::Plan>(),
    Kind::of::<study::solver_times::Plan>(),
    Kind::of::<study::cards::Plan>(),
    Kind::of::<study::defects::Plan>(),
    Kind::of::<study::grid::Plan>(),
];

/// Kinds of studies that only show something, and why nothing in them can fail. Their sections
/// count as good unless a task fails; all other kinds decide by their measurements.
pub const UNDECIDED: [(&str, &str); 2] = [
    ("animation", "some animations show motions that end early or go wrong"),
    ("sparsity", "a picture of the nonzero entries of matrices"),
];

/// Reads the settings of a study from a file.
pub type Parse = fn(&Source<'_>, Spanned<DeValue<'_>>, &mut Defects) -> Option<Box<dyn AnyStudy>>;

impl Kind {
    /// The kind of a study that can be shown.
    pub(crate) const fn of<S: View + 'static>() -> Kind {
        Kind {
            name: S::NAME,
            title: S::TITLE,
            read: |settings| Ok(Box::new(S::deserialize(settings)?)),
            parse: |source, settings, defects| {
                source
                    .read::<S>(settings, defects)
                    .map(|study| Box::new(study) as Box<dyn AnyStudy>)
            },
            schema: S::json_schema,
        }
    }
}

/// The kind with this name.
///
/// # Errors
/// If there is no such kind.
pub(crate) fn by_name(name: &str) -> Result<&'static Kind> {
    KINDS.iter().find(|kind| kind.name == name).ok_or_else(|| Error::Unknown {
        kind: "study",
        name: name.into(),
        known: KINDS.iter().map(|kind| kind.name.into()).collect(),
    })
}

/// A study with its settings, of any kind; its findings are JSON.
pub trait AnyStudy: Send + Sync {
    /// The kind's name.
    fn name(&self) -> &'static str;

    /// Whether a task must run alone.
    fn alone(&self, task: usize) -> bool;

    /// Its own name and heading, if it has them.
    fn named(&self) -> Option<(String, String)>;

    /// The settings as a report file states them.
    fn settings(&self) -> Value;

    /// The names of the tasks, which are unique.
    fn tasks(&self) -> Vec<String>;

    /// Runs a task with solvers of this registry: returns the finding, and the machine-dependent
    /// data.
    ///
    /// # Errors
    /// If it cannot be done, with the reason.
    fn run(&self, task: usize, solvers: &Registry) -> Result<(Value, Value)>;

    /// Adds the findings to the page.
    ///
    /// # Errors
    /// If they are not of this kind.
    fn show(&self, findings: &[Value], document: &mut ReportPage) -> Result<()>;

    /// Adds the machine-dependent data.
    ///
    /// # Errors
    /// If it is not of this kind.
    fn show_times(&self, times: &[Value], document: &mut ReportPage) -> Result<()>;

    /// What it adds to the top of the page.
    ///
    /// # Errors
    /// If the findings are not of this kind.
    fn headline(&self, findings: &[Value]) -> Result<Headline>;

    /// Whether all results are as expected.
    ///
    /// # Errors
    /// If the findings are not of this kind.
    fn outcome(&self, findings: &[Value]) -> Result<Outcome>;
}

impl<S: View> AnyStudy for S {
    fn name(&self) -> &'static str {
        S::NAME
    }

    fn alone(&self, task: usize) -> bool {
        Study::alone(self, task)
    }

    fn named(&self) -> Option<(String, String)> {
        Study::named(self)
    }

    fn settings(&self) -> Value {
        json::<S, _>(self).unwrap_or_default()
    }

    fn tasks(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for name in Study::tasks(self) {
            let same = names.iter().filter(|other| other.split(" #").next() == Some(&name)).count();
            names.push(if same == 0 { name } else { format!("{name} #{}", same + 1) });
        }
        names
    }

    fn run(&self, task: usize, solvers: &Registry) -> Result<(Value, Value)> {
        let (finding, times) = Study::run(self, task, solvers)?;
        let finding = json::<S, _>(&finding)?;
        read::<S, S::Finding>(std::slice::from_ref(&finding))?;
        Ok((finding, json::<S, _>(&times)?))
    }

    fn show(&self, findings: &[Value], document: &mut ReportPage) -> Result<()> {
        View::show(self, &read::<S, _>(findings)?, document);
        Ok(())
    }

    fn show_times(&self, times: &[Value], document: &mut ReportPage) -> Result<()> {
        View::show_times(self, &read::<S, _>(times)?, document);
        Ok(())
    }

    fn headline(&self, findings: &[Value]) -> Result<Headline> {
        Ok(View::headline(self, &read::<S, _>(findings)?))
    }

    fn outcome(&self, findings: &[Value]) -> Result<Outcome> {
        Ok(View::outcome(self, &read::<S, _>(findings)?))
    }
}

fn json<S: Study, T: serde::Serialize>(found: &T) -> Result<Value> {
    serde_json::to_value(found)
        .map_err(|cause| Error::invalid(S::NAME, "finding", cause.to_string()))
}

/// Findings from JSON; none of them may contain a number that JSON cannot represent.
fn read<S: Study, T: for<'de> Deserialize<'de>>(found: &[Value]) -> Result<Vec<T>> {
    let one = |value: &Value| {
        T::deserialize(value).map_err(|cause| Error::invalid(S::NAME, "finding", cause.to_string()))
    };
    found.iter().map(one).collect()
}
