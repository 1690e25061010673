//! Where A has entries, for every shipped scene: the chapter's Figure 13 for all of them.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{Pictures as Task, problem};
use crate::error::Result;
use crate::plot::Raster;
use crate::report::study::settings::AtStep;
use crate::scene::catalogue::SHIPPED;

/// Cells along the side of a picture.
const CELLS: usize = 64;

/// The pattern of a scene's A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// The scene.
    pub scene: String,
    /// The number of the step, from 1.
    pub step: usize,
    /// The pattern; empty where the step has no rows.
    pub raster: Raster,
}

/// Every shipped scene in its first step, or in the step that is named for it.
pub(super) fn run(task: &Option<Task>) -> Result<Vec<Picture>> {
    let Some(task) = task else { return Ok(Vec::new()) };
    let step = |scene: &str| {
        task.later.iter().find(|later| later.scene == scene).map_or(1, |later| later.step)
    };
    let all = SHIPPED.par_iter().filter(|shipped| {
        task.only.is_empty() || task.only.iter().any(|name| name == shipped.name)
    });
    all.map(|shipped| {
        let task = AtStep { scene: shipped.name.into(), step: step(shipped.name) };
        let pattern =
            problem(&task)?.map(|problem| (problem.lcp.len(), problem.lcp.matrix().pattern()));
        let (n, places) = pattern.unwrap_or_default();
        let raster = Raster::new((n, n), CELLS, |mark| {
            places.iter().for_each(|&(i, j)| mark(i, j));
        });
        Ok(Picture { scene: task.scene, step: task.step, raster })
    })
    .collect()
}
