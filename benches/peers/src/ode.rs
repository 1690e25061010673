//! Open Dynamics Engine.

use crate::contender::Contender;
use crate::raw::{Raw, solvers_in_c};
use crate::world::Engine;
use crate::world::foreign::{Calls, Foreign, engine_in_c};

/// Its Dantzig solver.
pub fn solvers(raw: &Raw) -> Vec<Contender<'_>> {
    vec![raw.contender("ODE Dantzig", peers_ode_dantzig, "it said that s <= 0")]
}

/// QuickStep.
pub const ENGINE: Engine = Engine {
    name: "ODE, QuickStep",
    ours: false,
    build: |setting, iterations| Foreign::boxed(CALLS, setting, iterations),
};

const CALLS: Calls = Calls {
    world: peers_ode_world,
    step: peers_ode_step,
    poses: peers_ode_poses,
    free: peers_ode_free,
};

solvers_in_c!(peers_ode_dantzig);
engine_in_c!(peers_ode_world peers_ode_step peers_ode_poses peers_ode_free);
