//! lcplab: the velocity level, swept by projected Gauss-Seidel from the last step's impulses.

use lcplab::body::Pose;
use lcplab::simulation::stepper::{Kernel, Stepper};

use super::{Engine, Setting, World};

pub const ROW_BY_ROW: Engine = Engine {
    name: "lcplab, row by row",
    ours: true,
    build: |setting, iterations| stepper(setting, iterations, Kernel::RowByRow),
};

/// From the ground up, or by colors in a single stack; on one thread like all others.
pub const EIGHT_PAIRS: Engine = Engine {
    name: "lcplab, eight pairs at a time",
    ours: true,
    build: |setting, iterations| stepper(setting, iterations, Kernel::SimdPairs { threads: 1 }),
};

struct Ours(Stepper);

fn stepper(setting: &Setting, sweeps: usize, kernel: Kernel) -> Box<dyn World> {
    let stepper = Stepper::new(setting.scene.clone(), sweeps, kernel);
    Box::new(Ours(stepper.expect("the stepper knows cubes on the ground")))
}

impl World for Ours {
    fn step(&mut self) {
        self.0.step().expect("cubes that rest do not diverge");
    }

    fn poses(&self) -> Vec<Pose> {
        let moving = self.0.states().iter().zip(&self.0.scene().bodies);
        moving.filter(|(_, body)| body.mass.dof() > 0).map(|(state, _)| state.pose).collect()
    }
}
