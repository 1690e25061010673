//! How to keep a sparse matrix: the chapter's storages measured, and its claims about them checked.
//!
//! Bytes, allocations, looks and entries are counted and the same in every run; times are taken apart
//! from them ([`time`]).

pub mod claims;
pub mod factor;
pub mod memory;
pub mod pictures;
pub mod steps;
pub mod structure;
pub mod time;

use crate::simulation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::settings::{AtStep, Stepped};
use crate::error::Result;
use crate::formulation::Problem;
use crate::scene::{Scene, Scheme};
use crate::simulation::Simulation;
use crate::solver::{self, Options, by_name};
use crate::storage::Entry;

/// The seed of all random places.
const SEED: u64 = 42;

/// What is measured of storages.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Rows and columns of the matrix that is filled at random places.
    pub size: usize,
    /// How much of it is filled (%).
    pub fills: Vec<f64>,
    /// Stacks of so many cubes, assembled and swept.
    pub stacks: Vec<usize>,
    /// Scenes whose J, M⁻¹ and A are kept in every storage.
    #[serde(default)]
    pub structures: Vec<AtStep>,
    /// A scene whose steps are assembled over and over.
    #[serde(default)]
    pub steps: Option<Stepped>,
    /// Scenes whose A is factored.
    #[serde(default)]
    pub factors: Vec<AtStep>,
    /// The patterns of the shipped scenes.
    #[serde(default)]
    pub pictures: Option<Pictures>,
}

/// The shipped scenes' patterns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pictures {
    /// These scenes alone; all without it.
    #[serde(default)]
    pub only: Vec<String>,
    /// Scenes that are shown in a later step than the first.
    #[serde(default)]
    pub later: Vec<AtStep>,
}

impl Study for Plan {
    const NAME: &'static str = "storage";
    type Finding = Finding;
    type Times = time::Times;

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        vec!["all".into()]
    }

    fn run(&self, _: usize) -> Result<(Finding, time::Times)> {
        Ok((run(self)?, time::run(self)?))
    }
}

/// What was found out about storages.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Rows and columns of the matrix that is filled.
    pub size: usize,
    /// Its memory in each storage by fill.
    pub memory: Vec<memory::Memory>,
    /// What the matrices of scenes take.
    pub structures: Vec<structure::Structure>,
    /// How often a step asks for memory.
    pub steps: Option<steps::Steps>,
    /// Fill of the factor by ordering.
    pub factors: Vec<factor::Factor>,
    /// The chapter's claims.
    pub claims: Vec<claims::Claim>,
    /// The pattern of A of every scene.
    pub pictures: Vec<pictures::Picture>,
}

/// Runs all but the times.
///
/// # Errors
/// A scene that cannot be loaded, or numbers that make no matrix.
pub fn run(task: &Plan) -> Result<Finding> {
    let memory = memory::run(task.size, &task.fills)?;
    let structures = each(&task.structures, structure::run)?;
    let steps = task.steps.as_ref().map(steps::run).transpose()?;
    let factors = each(&task.factors, factor::run)?;
    let pictures = pictures::run(&task.pictures)?;
    let claims = claims::run(&memory, &structures)?;
    Ok(Finding { size: task.size, memory, structures, steps, factors, claims, pictures })
}

/// Runs a study on the problem of each scene's step.
fn each<R>(tasks: &[AtStep], study: impl Fn(&AtStep, &Problem) -> Result<R>) -> Result<Vec<R>> {
    let one = |task| problem(task).map(|problem| problem.map(|problem| study(task, &problem)));
    let found: Vec<_> = tasks.iter().map(one).collect::<Result<_>>()?;
    found.into_iter().flatten().collect()
}

/// The problem of a scene's step; `None` if the step has none. That of the first step needs no solution,
/// so it is left after a sweep.
fn problem(task: &AtStep) -> Result<Option<Problem>> {
    let mut scene = Scene::load(&task.scene)?;
    if !scene.step.scheme.solves_lcps() {
        scene = scene.at_level(Scheme::Velocity);
    }
    if task.step > 1 {
        return simulation::problem_of(&scene, task.step).map(Some);
    }
    first_problem(scene)
}

fn first_problem(scene: Scene) -> Result<Option<Problem>> {
    let settings = solver::Settings { max_iterations: 1, ..solver::Settings::default() };
    let solver = by_name("pgs", &Options { settings, ..Options::default() })?;
    let step = Simulation::new(scene, solver).step().ok();
    Ok(step.and_then(|mut step| step.solves.pop()).map(|solve| solve.problem))
}

/// The numbers 0..n in a random order.
fn shuffled(n: usize, seed: u64) -> Vec<usize> {
    let mut random = oorandom::Rand64::new(u128::from(seed));
    let mut order: Vec<usize> = (0..n).collect();
    for last in (1..n).rev() {
        order.swap(last, random.rand_range(0..last as u64 + 1) as usize);
    }
    order
}

/// So many entries of a square matrix, the first places of a random order, row by row.
fn scattered(size: usize, order: &[usize], entries: usize) -> Vec<Entry> {
    let mut places: Vec<usize> = order[..entries].to_vec();
    places.sort_unstable();
    places.into_iter().map(|k| (k / size, k % size, 1.0 + (k % 7) as f64)).collect()
}
