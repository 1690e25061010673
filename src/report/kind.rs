//! The kinds of studies that a report file can ask for, and a study of any kind.

use serde::Deserialize;
use serde_json::Value;

use super::study::{self, Study};
use super::view::{Document, Outcome, View};
use crate::error::{Error, Result};

/// A kind of study.
pub struct Kind {
    /// Its name in report files.
    pub name: &'static str,
    /// The heading of its section, unless the file states another one.
    pub title: &'static str,
    /// A study of this kind from its settings.
    pub read: fn(&Value) -> serde_json::Result<Box<dyn AnyStudy>>,
}

/// All kinds.
pub const KINDS: &[Kind] = &[
    kind::<study::verification::Plan>(),
    kind::<study::comparison::Plan>(),
    kind::<study::cross_check::Plan>(),
    kind::<study::convergence::Plan>(),
    kind::<study::rates::Plan>(),
    kind::<study::worst_cases::Plan>(),
    kind::<study::sliding::Plan>(),
    kind::<study::merits::Plan>(),
    kind::<study::sparsity::Plan>(),
    kind::<study::drift::Plan>(),
    kind::<study::storage::Plan>(),
    kind::<study::profiles::Plan>(),
    kind::<study::ratio::Plan>(),
    kind::<study::relaxation::Plan>(),
    kind::<study::scaling::Plan>(),
    kind::<study::warm_start::Plan>(),
    kind::<study::residual_map::Plan>(),
    kind::<study::plane::Plan>(),
    kind::<study::race::Plan>(),
    kind::<study::schemes::Plan>(),
    kind::<study::sinking::Plan>(),
    kind::<study::force_path::Plan>(),
    kind::<study::order::Plan>(),
    kind::<study::ledger::Plan>(),
    kind::<study::footage::Plan>(),
    kind::<study::ramp::Plan>(),
    kind::<study::creep::Plan>(),
    kind::<study::painleve::Plan>(),
    kind::<study::friction_solvers::Plan>(),
    kind::<study::published::Plan>(),
    kind::<study::singular::Plan>(),
    kind::<study::sweep_speed::Plan>(),
    kind::<study::direct_speed::Plan>(),
    kind::<study::peers::Plan>(),
    kind::<study::sparse_speed::Plan>(),
    kind::<study::step_speed::Plan>(),
    kind::<study::warm_factor::Plan>(),
];

const fn kind<S: View + 'static>() -> Kind {
    Kind {
        name: S::NAME,
        title: S::TITLE,
        read: |settings| Ok(Box::new(S::deserialize(settings)?)),
    }
}

/// The kind of this name.
///
/// # Errors
/// If there is none.
pub fn by_name(name: &str) -> Result<&'static Kind> {
    KINDS.iter().find(|kind| kind.name == name).ok_or_else(|| Error::Unknown {
        kind: "study",
        name: name.into(),
        known: KINDS.iter().map(|kind| kind.name.into()).collect(),
    })
}

/// A study with its settings, whatever its kind; what it finds out is JSON.
pub trait AnyStudy: Send + Sync {
    /// The kind's name.
    fn name(&self) -> &'static str;

    /// Whether its tasks run beside nothing else.
    fn alone(&self) -> bool;

    /// The settings as a report file states them.
    fn settings(&self) -> Value;

    /// What tells the tasks apart; no two are alike.
    fn tasks(&self) -> Vec<String>;

    /// Carries out a task: the finding, and what differs from machine to machine.
    ///
    /// # Errors
    /// What it cannot do, with the reason.
    fn run(&self, task: usize) -> Result<(Value, Value)>;

    /// Adds the findings to the document.
    ///
    /// # Errors
    /// If they are not of this kind.
    fn show(&self, findings: &[Value], document: &mut Document) -> Result<()>;

    /// Adds what differs from machine to machine.
    ///
    /// # Errors
    /// If it is not of this kind.
    fn show_times(&self, times: &[Value], document: &mut Document) -> Result<()>;

    /// Whether all came out as it should.
    ///
    /// # Errors
    /// If the findings are not of this kind.
    fn outcome(&self, findings: &[Value]) -> Result<Outcome>;
}

impl<S: View> AnyStudy for S {
    fn name(&self) -> &'static str {
        S::NAME
    }

    fn alone(&self) -> bool {
        S::ALONE
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

    fn run(&self, task: usize) -> Result<(Value, Value)> {
        let (finding, times) = Study::run(self, task)?;
        let finding = json::<S, _>(&finding)?;
        read::<S, S::Finding>(std::slice::from_ref(&finding))?;
        Ok((finding, json::<S, _>(&times)?))
    }

    fn show(&self, findings: &[Value], document: &mut Document) -> Result<()> {
        View::show(self, &read::<S, _>(findings)?, document);
        Ok(())
    }

    fn show_times(&self, times: &[Value], document: &mut Document) -> Result<()> {
        View::show_times(self, &read::<S, _>(times)?, document);
        Ok(())
    }

    fn outcome(&self, findings: &[Value]) -> Result<Outcome> {
        Ok(View::outcome(self, &read::<S, _>(findings)?))
    }
}

fn json<S: Study, T: serde::Serialize>(found: &T) -> Result<Value> {
    serde_json::to_value(found)
        .map_err(|cause| Error::invalid(S::NAME, "finding", cause.to_string()))
}

/// Findings from JSON: in particular none of them may hold a number that JSON cannot write.
fn read<S: Study, T: for<'de> Deserialize<'de>>(found: &[Value]) -> Result<Vec<T>> {
    let one = |value: &Value| {
        T::deserialize(value).map_err(|cause| Error::invalid(S::NAME, "finding", cause.to_string()))
    };
    found.iter().map(one).collect()
}
