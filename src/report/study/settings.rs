//! References to scenes and problems in report files.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, de::Error};

use crate::error::Result as Found;
use crate::file;
use crate::files;
use crate::lcp::Lcp;
use crate::lcp::file::Problem;
use crate::scene::Scene;
use crate::simulation;

/// A name that is used as a file name.
///
/// # Errors
/// If it is not a valid file name.
pub(crate) fn file_name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let name = String::deserialize(deserializer)?;
    file::check_name(&name).map_err(D::Error::custom)?;
    Ok(name)
}

/// An LCP: the last one of a scene's step, or a problem file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AtStep {
    /// A shipped scene, or the file of a scene or a problem; `problem` is an alias of this key.
    #[serde(alias = "problem")]
    pub scene: String,
    /// The number of the step, from 1; not used for a problem file.
    #[serde(default = "first")]
    pub step: usize,
}

/// The default step.
pub(crate) fn first() -> usize {
    1
}

/// An LCP with its name.
pub struct Given {
    /// The scene's or the file's name.
    pub name: String,
    /// A description.
    pub title: String,
    /// The problem.
    pub lcp: Lcp,
}

impl AtStep {
    /// The problem.
    ///
    /// # Errors
    /// If the file cannot be read, the scene does not exist, or the simulation does not reach this
    /// step.
    pub(crate) fn given(&self) -> Found<Given> {
        if let Some(problem) = self.problem() {
            return problem;
        }
        let scene = Scene::load(&self.scene)?;
        let lcp = simulation::problem_of(&scene, self.step)?.lcp;
        Ok(Given { name: scene.name, title: scene.title, lcp })
    }

    /// The problem of a file that contains one.
    pub(crate) fn problem(&self) -> Option<Found<Given>> {
        let path = Path::new(&self.scene);
        let given = |problem: Problem| {
            let title = if problem.name.is_empty() { &self.scene } else { &problem.name };
            Given { name: self.scene.clone(), title: title.clone(), lcp: problem.lcp }
        };
        files::is_problem(path).then(|| files::read(path, None).map(given))
    }

    /// Its name and its step, if it has one.
    pub(crate) fn name(&self) -> String {
        match files::is_problem(Path::new(&self.scene)) {
            true => self.scene.clone(),
            false => format!("{}, step {}", self.scene, self.step),
        }
    }
}
