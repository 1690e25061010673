//! Dantzig's answer compared with two independent ones: the box QP and Gauss's principle.

use crate::simulation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::settings::AtStep;
use crate::assembly::Block;
use crate::error::Result;
use crate::formulation::Problem;
use crate::judge::cross_check::{cross_check, max_difference};
use crate::judge::motion_bound::motion_bound;
use crate::judge::{Demand, judge, uniqueness};
use crate::reference;
use crate::scene::{Scene, Scheme};
use crate::solver::{Dantzig, Registry, Solver, Start};

/// LCPs solved in three ways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The LCPs.
    pub scenes: Vec<AtStep>,
}

impl Study for Plan {
    const NAME: &'static str = "cross-check";
    type Finding = Vec<CrossCheck>;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.scenes.iter().map(|task| task.scene.clone()).collect()
    }

    fn run(&self, task: usize, _: &Registry) -> Result<(Self::Finding, ())> {
        let task = &self.scenes[task];
        Ok((run(&Scene::load(&task.scene)?, task.step), ()))
    }
}

/// One LCP of a scene, solved in three ways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrossCheck {
    /// The stage of the step that the LCP belongs to.
    pub scene: String,
    /// What the LCP decides: the stage of the step.
    pub stage: String,
    /// The unit of x: N s for impulses, N for forces.
    pub unit: String,
    /// The number of the step, from 1.
    pub step: usize,
    /// The number of rows of the LCP.
    pub rows: usize,
    /// The number of rows that are free at the solution; x is unique if it equals the rank of A
    /// there.
    pub free: usize,
    /// The rank of A_FF.
    pub rank: usize,
    /// The verdict on our answer.
    pub verdict: String,
    /// The distance of an exact solution from our x, if proved.
    pub distance: Option<f64>,
    /// The verdict on the QP's answer.
    pub reference_verdict: String,
    /// Why the QP's answer is rejected, if it is.
    pub reference_failure: Option<String>,
    /// max |x − x_QP|.
    pub x_difference: f64,
    /// max |w − w_QP|.
    pub w_difference: f64,
    /// max |u − u_Gauss| of the motion: velocities, or accelerations at acceleration level.
    pub u_difference: f64,
    /// A verified bound on max |u − û| with the exact motion û; `None` if there is none.
    pub u_bound: Option<f64>,
    /// Why there is no such bound.
    pub u_unproved: Option<String>,
    /// If x is not unique: the resulting force and torque on each moving body.
    pub wrenches: Vec<Wrench>,
    /// ½ xᵀAx + bᵀx of our answer.
    pub objective: f64,
    /// The optimal value of the QP, which should be equal.
    pub dual_objective: f64,
    /// Minus the optimal value of Gauss's principle, which should be equal.
    pub primal_objective: f64,
}

/// The total effect of all rows on one body: its part of Jᵀx, about its center of mass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Wrench {
    /// The body.
    pub body: String,
    /// Force, then torque, from our x (N, N m; N s, N m s for impulses).
    pub ours: Vec<f64>,
    /// The same from the QP's x.
    pub reference: Vec<f64>,
}

/// Solves the last LCP of a step in three ways at each level.
///
/// A level whose simulation fails before that step gives no entry; the comparison of the scene
/// reports why.
pub fn run(scene: &Scene, step: usize) -> Vec<CrossCheck> {
    Scheme::LEVELS.into_iter().filter_map(|level| one(&scene.at_level(level), step)).collect()
}

/// The last LCP of a step at a level, and our answer.
fn answered(scene: &Scene, step: usize) -> Option<(Problem, Vec<f64>)> {
    let problem = simulation::problem_of(scene, step).ok()?;
    let mut options = simulation::options(scene);
    options.settings.tolerance = 1e-12;
    let solver = Dantzig { settings: options.settings };
    let x = solver.solve(&problem.lcp, &Start::default(), &mut ()).x;
    Some((problem, x))
}

fn one(scene: &Scene, step: usize) -> Option<CrossCheck> {
    let (problem, x) = answered(scene, step)?;
    let lcp = &problem.lcp;
    let certificate = judge(lcp, &x, &Demand::default());
    let check = cross_check(lcp, &x)?;
    let primal = problem.gauss(&x);
    let gauss = reference::gauss(&primal);
    let bound = motion_bound(&primal, &x);
    let (free, rank) = uniqueness::free_rank(lcp, &x);
    let wrenches = if free == rank { Vec::new() } else { wrenches(scene, &problem, &x, &check.x) };
    Some(CrossCheck {
        scene: scene.name.clone(),
        stage: problem.stage.name().to_string(),
        unit: problem.stage.unit(false).to_string(),
        step,
        rows: lcp.len(),
        free,
        rank,
        verdict: certificate.verdict.word().to_string(),
        distance: certificate.verdict.distance(),
        reference_verdict: check.certificate.verdict.word().to_string(),
        reference_failure: check.failure,
        x_difference: check.x_difference,
        w_difference: check.w_difference,
        u_difference: max_difference(&problem.motion(&x), &gauss.point),
        u_bound: bound.as_ref().ok().map(|bound| bound.largest_entry),
        u_unproved: bound.err().map(|why| why.to_string()),
        wrenches,
        objective: certificate.objective,
        dual_objective: check.objective,
        primal_objective: -gauss.objective,
    })
}

fn wrenches(scene: &Scene, problem: &Problem, x: &[f64], reference: &[f64]) -> Vec<Wrench> {
    let [ours, theirs] = [x, reference].map(|x| problem.assembly.pull_back(x));
    let wrench = |block: &Block| {
        let part = block.offset..block.offset + block.dof;
        Wrench {
            body: scene.bodies[block.body].name.clone(),
            ours: ours[part.clone()].to_vec(),
            reference: theirs[part].to_vec(),
        }
    };
    problem.assembly.blocks.iter().map(wrench).collect()
}
