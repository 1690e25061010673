//! Bullet, in double precision.

use crate::contender::Contender;
use crate::raw::{Raw, solvers_in_c};
use crate::world::Engine;
use crate::world::foreign::{Calls, Foreign, engine_in_c};

/// Beyond this many rows its Lemke solver takes seconds.
const LEMKE: usize = 200;

/// Its Dantzig solver, and Lemke's method where it is not hopeless: it has no free rows.
pub fn solvers(raw: &Raw) -> Vec<Contender<'_>> {
    let failed = "it returned false";
    let mut solvers = vec![raw.contender("Bullet Dantzig", peers_bullet_dantzig, failed)];
    if raw.rows() <= LEMKE && !raw.is_unbounded() {
        solvers.push(raw.contender("Bullet Lemke", peers_bullet_lemke, failed));
    }
    solvers
}

/// Sequential impulses.
pub const ENGINE: Engine = Engine {
    name: "Bullet, sequential impulses",
    ours: false,
    build: |setting, iterations| Foreign::boxed(CALLS, setting, iterations),
};

const CALLS: Calls = Calls {
    world: peers_bullet_world,
    step: peers_bullet_step,
    poses: peers_bullet_poses,
    free: peers_bullet_free,
};

solvers_in_c!(peers_bullet_dantzig peers_bullet_lemke);
engine_in_c!(peers_bullet_world peers_bullet_step peers_bullet_poses peers_bullet_free);
