//! lcplab: the velocity level, solved by projected Gauss-Seidel from the last step's impulses.

use lcplab::body::Pose;
use lcplab::simulation::Simulation;
use lcplab::solver::{Pgs, Settings};

use super::{Engine, Setting, World};

/// A simulation, which writes a ledger of every step too.
pub const ENGINE: Engine = Engine {
    name: "lcplab, Simulation with pgs",
    ours: true,
    build: |setting, iterations| Box::new(Ours(simulation(setting, iterations))),
};

struct Ours(Simulation);

fn simulation(setting: &Setting, iterations: usize) -> Simulation {
    // So many sweeps, and no look at the residual between them.
    let settings = Settings { tolerance: 0.0, max_iterations: iterations, check_every: iterations };
    Simulation::new(setting.scene.clone(), Box::new(Pgs { settings, ..Pgs::default() }))
}

impl World for Ours {
    fn step(&mut self) {
        // Where it stops the bodies stay; a scene that fails has drifted or shows it in its overlap.
        let _ = self.0.step();
    }

    fn poses(&self) -> Vec<Pose> {
        let moving = self.0.states().iter().zip(&self.0.scene().bodies);
        moving.filter(|(_, body)| body.mass.dof() > 0).map(|(state, _)| state.pose).collect()
    }
}
