//! How to keep a sparse matrix: the chapter's storages measured, and its claims about them checked.
//!
//! Bytes, allocations, looks and entries are counted and the same in every run; times are taken apart
//! from them ([`time`]).

pub mod claims;
pub mod factor;
pub mod memory;
pub mod pictures;
pub mod search;
pub mod steps;
pub mod structure;
pub mod time;

use serde::{Deserialize, Serialize};

use super::{at_level, problem_of};
use crate::error::Result;
use crate::formulation::Problem;
use crate::report::experiment::{AtStep, Storage as Task};
use crate::scene::{Formulation, Scene};
use crate::simulation::Simulation;
use crate::solver::{Options, Settings, by_name};
use crate::storage::Entry;

/// The seed of all random places.
const SEED: u64 = 42;

/// What was found out about storages.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// Rows and columns of the matrix that is filled.
    pub size: usize,
    /// Its memory in each storage by fill.
    pub memory: Vec<memory::Memory>,
    /// What a search looks at.
    pub search: Vec<search::Search>,
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
pub fn run(task: &Task) -> Result<Study> {
    let memory = memory::run(task.size, &task.fills)?;
    let search = search::run(&task.entries)?;
    let structures = each(&task.structures, structure::run)?;
    let steps = task.steps.as_ref().map(steps::run).transpose()?;
    let factors = each(&task.factors, factor::run)?;
    let pictures = pictures::run(&task.pictures)?;
    let claims = claims::run(&memory, &search, &structures)?;
    Ok(Study { size: task.size, memory, search, structures, steps, factors, claims, pictures })
}

impl Study {
    /// Whether the storages agreed on every matrix that was assembled in them.
    pub fn agrees(&self) -> bool {
        self.structures.iter().all(|structure| structure.agree != Some(false))
    }
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
    if !scene.step.formulation.solves_lcps() {
        scene = at_level(&scene, Formulation::Velocity);
    }
    if task.step > 1 {
        return Ok(problem_of(&scene, task.step));
    }
    first_problem(scene)
}

fn first_problem(scene: Scene) -> Result<Option<Problem>> {
    let settings = Settings { max_iterations: 1, ..Settings::default() };
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
