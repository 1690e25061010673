//! A solve as a problem file.

use lcplab_lcp::file::{Problem, number};
use serde_json::json;

use super::Solve;
use crate::formulation::Stage;
use crate::scene::Scene;

impl Solve {
    /// The problem of this solve in a scene's step of this number, with what its rows are.
    pub fn exported(&self, scene: &Scene, step: usize) -> Problem {
        let assembled = &self.problem;
        let mut problem = assembled.in_numbers(format!("{}, step {step}", scene.name));
        if let Some(posing) = &self.posing {
            (problem.model, problem.frozen_at) = (Some(posing.model), posing.frozen_at.clone());
        }
        let rows = assembled.assembly.rows.iter().map(|row| {
            let unit = assembled.stage.unit(row.kind.is_angular());
            json!({ "label": row.label(scene), "kind": row.kind.name(), "unit": unit, "bodies": row.names(scene) })
        });
        problem.extra.insert("rows".into(), rows.collect());
        let bodies = assembled.assembly.blocks.iter().map(|block| {
            json!({ "name": scene.bodies[block.body].name, "first": block.offset, "count": block.dof })
        });
        problem.extra.insert("bodies".into(), bodies.collect());
        let time = if assembled.stage == Stage::Acceleration { 1.0 } else { assembled.dt };
        let gravity = (scene.gravity * time).iter().map(|&part| number(part)).collect();
        problem.extra.insert("gravity".into(), gravity);
        problem.extra.insert("dt".into(), number(scene.step.dt));
        let source = format!("lcplab scene {}, {} level", scene.name, assembled.stage.name());
        problem.extra.insert("source".into(), source.into());
        problem
    }
}
