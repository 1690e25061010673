//! The pattern of A for every shipped scene: the chapter's Figure 13 for all of them.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::problem;
use crate::error::Result;
use crate::plot::Raster;
use crate::report::study::settings::AtStep;
use crate::scene::catalogue::SHIPPED;

/// The shipped scenes' patterns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gallery {
    /// Only these scenes; by default all.
    #[serde(default)]
    pub only: Vec<String>,
    /// Scenes that are shown in a later step than the first.
    #[serde(default)]
    pub later: Vec<AtStep>,
}

/// The number of cells along the side of a picture.
const CELLS: usize = 64;

/// The pattern of a scene's A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// The scene.
    pub scene: String,
    /// The number of the step, from 1.
    pub step: usize,
    /// The pattern; empty if the step has no rows.
    pub raster: Raster,
}

impl Gallery {
    /// The patterns, each in the first step or in the step named for the scene.
    ///
    /// # Errors
    /// If the simulation of a scene does not reach this step.
    pub(crate) fn run(&self) -> Result<Vec<Picture>> {
        let is_asked = |name: &str| self.only.is_empty() || self.only.iter().any(|own| own == name);
        let shipped = SHIPPED.par_iter().filter(|shipped| is_asked(shipped.name));
        shipped.map(|shipped| self.picture(shipped.name)).collect()
    }

    fn picture(&self, scene: &str) -> Result<Picture> {
        let later = self.later.iter().find(|later| later.scene == scene);
        let task = AtStep { scene: scene.into(), step: later.map_or(1, |later| later.step) };
        let pattern =
            problem(&task)?.map(|problem| (problem.lcp.len(), problem.lcp.matrix().pattern()));
        let (n, places) = pattern.unwrap_or_default();
        let raster = Raster::new((n, n), CELLS, |mark| {
            places.iter().for_each(|&(i, j)| mark(i, j));
        });
        Ok(Picture { scene: task.scene, step: task.step, raster })
    }
}
