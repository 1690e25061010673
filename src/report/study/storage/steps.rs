//! How often a step asks for memory: matrices made anew, and matrices that are kept.

use crate::simulation::Simulation;
use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::report::study::settings::Stepped;
use crate::scene::Scene;
use crate::storage::Factors;
use crate::storage::{ALL, Kind, Storage, Workspace, triple_product};

/// A scene's steps assembled over and over.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Steps {
    /// The scene.
    pub scene: String,
    /// Rows in each step.
    pub rows: Vec<usize>,
    /// Each storage.
    pub counts: Vec<Count>,
}

/// Allocations a step, the mean: of J, A and the buffers of the product.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Count {
    /// The storage's name.
    pub storage: String,
    /// Everything made anew in each step.
    pub anew: f64,
    /// Everything kept, in the first pass over the steps.
    pub first: f64,
    /// Everything kept, in the second pass.
    pub warm: f64,
}

/// Steps a scene with its own solver, then assembles A of each step in every storage.
pub(super) fn run(task: &Stepped) -> Result<Steps> {
    let mut simulation = Simulation::of(&Scene::load(&task.scene)?)?;
    let mut steps = Vec::new();
    for _ in 0..task.steps {
        let Ok(step) = simulation.step() else { break };
        steps.extend(step.solves.last().map(|solve| Factors::of(&solve.problem.assembly)));
    }
    let counts = ALL.iter().map(|kind| count(kind, &steps)).collect::<Result<_>>()?;
    let rows = steps.iter().map(|factors| factors.rows).collect();
    Ok(Steps { scene: task.scene.clone(), rows, counts })
}

/// J, M⁻¹ and A, and the buffers of their product.
struct Matrices {
    j: Box<dyn Storage>,
    m_inv: Box<dyn Storage>,
    a: Box<dyn Storage>,
    workspace: Workspace,
}

impl Matrices {
    fn new(kind: &Kind) -> Self {
        let new = || (kind.new)(0, 0);
        Matrices { j: new(), m_inv: new(), a: new(), workspace: Workspace::default() }
    }

    /// Assembles A of a step; returns how often memory was asked for so far.
    fn assemble(&mut self, factors: &Factors) -> Result<usize> {
        self.j.reset(factors.rows, factors.columns)?;
        self.j.load(&factors.jacobian)?;
        self.m_inv.reset(factors.columns, factors.columns)?;
        self.m_inv.load(&factors.inverse_mass)?;
        triple_product(self.j.as_ref(), self.m_inv.as_ref(), self.a.as_mut(), &mut self.workspace)?;
        let matrices = [&self.j, &self.m_inv, &self.a];
        let own: usize = matrices.iter().map(|matrix| matrix.allocations()).sum();
        Ok(own + self.workspace.allocations())
    }
}

fn count(kind: &Kind, steps: &[Factors]) -> Result<Count> {
    let mut anew = 0;
    for factors in steps {
        anew += Matrices::new(kind).assemble(factors)?;
    }
    let mut kept = Matrices::new(kind);
    let mut so_far = [0; 2];
    for pass in &mut so_far {
        for factors in steps {
            *pass = kept.assemble(factors)?;
        }
    }
    let mean = |count: usize| count as f64 / steps.len().max(1) as f64;
    let [first, both] = so_far;
    let storage = kind.name.to_string();
    Ok(Count { storage, anew: mean(anew), first: mean(first), warm: mean(both - first) })
}
