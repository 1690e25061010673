//! All findings of a report, as plain data: the content of `results.json`.
//!
//! Everything except `machine` is the same in every run on the same kind of processor.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::experiment::{Experiment, Section, Shown};
use super::hash::fnv;
use super::study::Study;
use super::study::settings::file_name;
use crate::error::{Error, Result};
use crate::plugin::Declaration;

/// The results of a report, complete or partial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// The version of lcplab.
    pub version: String,
    /// The versions of the numerical libraries, as `name version`.
    pub libraries: Vec<String>,
    /// The report's name.
    pub name: String,
    /// Its heading.
    pub title: String,
    /// What it is about.
    pub lead: String,
    /// The external programs that its studies name as solvers.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub plugins: BTreeMap<String, Declaration>,
    /// Its sections.
    pub sections: Vec<Part>,
    /// The machine-dependent data.
    pub machine: Machine,
}

/// A section with its findings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// The anchor on the page, and the prefix of its file names.
    #[serde(deserialize_with = "file_name")]
    pub id: String,
    /// The heading.
    pub title: String,
    /// Text before the results of the study.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub text: String,
    /// Other content of the section, and how it is shown.
    #[serde(flatten)]
    pub shown: Shown,
    /// The kind of study; `None` in a section of text only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub study: Option<String>,
    /// The study's settings.
    #[serde(default, skip_serializing_if = "Value::is_null")]
    pub settings: Value,
    /// The study's tasks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tasks: Vec<Task>,
    /// The checksum of the findings so far, while a later run may continue from them: see
    /// `Results::sealed`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checksum: Option<String>,
}

/// A task of a study: pending, done, or failed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Task {
    /// Its name, unique in its study.
    pub name: String,
    /// Its finding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub finding: Option<Value>,
    /// Why it has no finding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
}

/// The machine-dependent data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Operating system and processor family.
    pub platform: String,
    /// The number of threads that ran the studies; they share the processor, so times are upper
    /// bounds.
    pub threads: usize,
    /// Wall time of the whole report (s).
    pub seconds: f64,
    /// The times of the tasks.
    pub times: Vec<Timed>,
    /// The command that ran the report, if there was one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
}

/// Times of one task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Timed {
    /// The section's id.
    pub section: String,
    /// The task's name.
    pub task: String,
    /// The times, in the format of the kind of study.
    pub times: Value,
}

impl Results {
    /// The results of a report before its first task.
    #[doc(hidden)] // for the fuzz targets
    pub fn empty(experiment: &Experiment) -> Self {
        Results {
            version: env!("CARGO_PKG_VERSION").to_string(),
            libraries: libraries(),
            name: experiment.name.clone(),
            title: experiment.title.clone(),
            lead: experiment.lead.clone(),
            plugins: experiment.plugins.clone(),
            sections: experiment.sections.iter().map(Part::empty).collect(),
            machine: Machine {
                platform: format!("{} on {}", std::env::consts::OS, std::env::consts::ARCH),
                threads: rayon::current_num_threads(),
                seconds: 0.0,
                times: Vec::new(),
                command: experiment.command.clone(),
            },
        }
    }

    /// The same for writing: with a checksum per section while a later run may continue from it.
    pub(crate) fn sealed(&self) -> Self {
        let checksums: Vec<_> = self.sections.iter().map(|part| self.checksum(part)).collect();
        let mut sealed = self.clone();
        for (part, checksum) in sealed.sections.iter_mut().zip(checksums) {
            part.checksum = (!self.is_complete() && part.study.is_some()).then_some(checksum);
        }
        sealed
    }

    /// The results that were read, without the findings of sections that were changed since they
    /// were written; also returns the ids of those sections.
    pub(crate) fn unedited(mut self) -> (Self, Vec<String>) {
        let is_edited = |part: &Part| {
            part.tasks.iter().any(Task::is_over)
                && part.checksum.as_ref() != Some(&self.checksum(part))
        };
        let edited: Vec<bool> = self.sections.iter().map(is_edited).collect();
        let mut ids = Vec::new();
        for (part, _) in self.sections.iter_mut().zip(edited).filter(|(_, edited)| *edited) {
            for task in &mut part.tasks {
                (task.finding, task.failure) = (None, None);
            }
            self.machine.times.retain(|timed| timed.section != part.id);
            ids.push(part.id.clone());
        }
        (self, ids)
    }

    /// The checksum of a section's findings with their times, settings and version.
    fn checksum(&self, part: &Part) -> String {
        let times = self.machine.times.iter().filter(|timed| timed.section == part.id);
        let times: Vec<&Timed> = times.collect();
        let made_by = (&self.version, &self.libraries);
        let all = (made_by, &part.study, &part.settings, &part.tasks, times);
        let text = serde_json::to_string(&all).unwrap_or_default();
        format!("{:016x}", fnv(&text))
    }

    /// Whether every task is done or has failed.
    pub fn is_complete(&self) -> bool {
        self.tasks().all(Task::is_over)
    }

    /// The progress, if it is not complete.
    pub(super) fn progress(&self) -> Option<String> {
        let (over, all) =
            (self.tasks().filter(|task| task.is_over()).count(), self.tasks().count());
        (over < all)
            .then(|| format!("{over} of {all} tasks done; run the same command again to continue"))
    }

    /// Takes over the findings of an earlier run of the same version with the same settings and
    /// plug-ins.
    pub(crate) fn resume(&mut self, earlier: &Results) {
        let by = |results: &Results| {
            (results.version.clone(), results.libraries.clone(), results.plugins.clone())
        };
        if by(earlier) != by(self) {
            return;
        }
        for part in &mut self.sections {
            let same = |old: &&Part| old.study == part.study && old.settings == part.settings;
            let Some(old) = earlier.sections.iter().find(same) else { continue };
            for task in &mut part.tasks {
                let done = old.tasks.iter().find(|done| done.name == task.name);
                task.finding = done.and_then(|done| done.finding.clone());
                let of_task = |t: &&Timed| t.section == old.id && t.task == task.name;
                let times = earlier.machine.times.iter().filter(of_task);
                self.machine
                    .times
                    .extend(times.map(|timed| Timed { section: part.id.clone(), ..timed.clone() }));
            }
        }
    }

    /// Records how a task ended.
    pub(crate) fn note(&mut self, section: usize, task: usize, ended: Result<(Value, Value)>) {
        let part = &mut self.sections[section];
        let (id, task) = (part.id.clone(), &mut part.tasks[task]);
        match ended {
            Ok((finding, times)) => {
                task.finding = Some(finding);
                if !times.is_null() {
                    let task = task.name.clone();
                    self.machine.times.push(Timed { section: id, task, times });
                }
            }
            Err(failure) => task.failure = Some(failure.to_string()),
        }
    }

    /// All findings of one kind of study.
    ///
    /// # Errors
    /// If a finding does not have the format of this version.
    pub fn findings<S: Study>(&self) -> Result<Vec<S::Finding>> {
        let parts = self.sections.iter().filter(|part| part.study.as_deref() == Some(S::NAME));
        let found = parts.flat_map(|part| part.findings());
        let read = |value| {
            serde_json::from_value(value)
                .map_err(|cause| Error::invalid("results.json", S::NAME, cause.to_string()))
        };
        found.map(read).collect()
    }

    /// Whether no task failed, and the results of every study are as expected.
    ///
    /// # Errors
    /// If a finding does not have the format of this version.
    pub fn is_good(&self) -> Result<bool> {
        let failed = self.tasks().any(|task| task.failure.is_some());
        Ok(!failed && self.outcomes()?.iter().all(|(_, outcome)| outcome.good))
    }

    /// The outcome in a few lines.
    ///
    /// # Errors
    /// If a finding does not have the format of this version.
    pub fn summary(&self) -> Result<String> {
        let outcomes = self.outcomes()?;
        let mut lines: Vec<String> = outcomes
            .iter()
            .filter(|(_, outcome)| !outcome.says.is_empty())
            .map(|(id, outcome)| format!("{id:<14} {}", outcome.says))
            .collect();
        for part in &self.sections {
            let failed = part.tasks.iter().filter_map(|task| Some((task, task.failure.as_ref()?)));
            lines.extend(
                failed.map(|(task, why)| format!("{}, {}: failed: {why}", part.id, task.name)),
            );
        }
        lines.extend(self.progress().map(|progress| format!("{:<14} {progress}", "stopped")));
        Ok(lines.join("\n"))
    }

    /// The outcome of each study, by the id of its section.
    pub(super) fn outcomes(&self) -> Result<Vec<(String, super::view::Outcome)>> {
        let experiment = Experiment::of(self)?;
        let studied = experiment.sections.iter().zip(&self.sections);
        let outcomes = studied.filter_map(|(section, part)| {
            let study = section.study.as_ref()?;
            let findings: Vec<Value> = part.findings().collect();
            Some(study.outcome(&findings).map(|outcome| (part.id.clone(), outcome)))
        });
        outcomes.collect()
    }

    fn tasks(&self) -> impl Iterator<Item = &Task> {
        self.sections.iter().flat_map(|part| &part.tasks)
    }
}

impl Part {
    fn empty(section: &Section) -> Self {
        let task = |name| Task { name, finding: None, failure: None };
        let study = section.study.as_ref();
        Part {
            id: section.id.clone(),
            title: section.title.clone(),
            text: section.text.clone(),
            shown: section.shown,
            study: study.map(|study| study.name().to_string()),
            settings: study.map(|study| study.settings()).unwrap_or_default(),
            tasks: study
                .map(|study| study.tasks().into_iter().map(task).collect())
                .unwrap_or_default(),
            checksum: None,
        }
    }

    /// The findings of its finished tasks.
    pub fn findings(&self) -> impl Iterator<Item = Value> + '_ {
        self.tasks.iter().filter_map(|task| task.finding.clone())
    }
}

impl Task {
    /// Whether it is done or has failed.
    pub(crate) fn is_over(&self) -> bool {
        self.finding.is_some() || self.failure.is_some()
    }
}

/// The versions of the numerical libraries, from the lock file of this build.
pub(crate) fn libraries() -> Vec<String> {
    const LOCK: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.lock"));
    let version = |name: &&str| {
        let entry =
            LOCK.split("[[package]]").find(|e| e.contains(&format!("name = \"{name}\"\n")))?;
        let version = entry.split("version = \"").nth(1)?.split('"').next()?;
        Some(format!("{name} {version}"))
    };
    ["nalgebra", "faer", "clarabel", "parry3d-f64", "dashu-ratio", "plotters"]
        .iter()
        .filter_map(version)
        .collect()
}
