//! Sequential impulses: the velocity level without a matrix, row by row on the bodies' velocities.
//!
//! ```text
//! u = u* + M⁻¹Jᵀx,   then `sweeps` times for each row   x_i ← Π_i(x_i − w_i/a_i),   u follows x_i
//! ```
//!
//! In exact arithmetic its sweeps are those of `pgs` on the LCP of the velocity level. It stops
//! after a number of sweeps, not at a tolerance, as a game must; the LCP is written down beside it,
//! so that the residual of what it reached is known. Restitution: the same again with the bouncing
//! rows' aim. Catto, GDC 2005; K&M, the third of the chapter's schemes.

use super::moved;
use crate::assembly::ConstraintFilter;
use crate::body::State;
use crate::formulation::Problem;
use crate::scene::DetectedContact;
use crate::simulation::Cause;
use crate::simulation::solving::Solving;
use crate::simulation::sweep::{RowTarget, Sweeper};
use lcplab_lcp::Complementarity;
use lcplab_solver::{Event, Iterate, Observer, Solution, Status};

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let assembly = solving.assemble(states, found, ConstraintFilter::Near)?;
    let problem = Problem::velocity(solving.scene, assembly)?;
    let (dt, sweeps) = (solving.scene.step.dt, solving.scene.step.sweeps);
    let tolerance = solving.scene.solver.tolerance;
    let method = |problem: &Problem, x: &[f64], observer: &mut dyn Observer| {
        impulses(problem, x, dt, sweeps, tolerance, observer)
    };
    solving.solve_by(problem, &method)?;
    if let Some(second) = solving.bounce()? {
        solving.replace_last();
        solving.solve_by(second, &method)?;
    }
    Ok(moved(solving, states, dt))
}

fn impulses(
    problem: &Problem,
    start: &[f64],
    dt: f64,
    sweeps: usize,
    tolerance: f64,
    observer: &mut dyn Observer,
) -> Solution {
    let aim = |(&bias, &compliance): (&f64, &f64)| RowTarget { bias, compliance };
    let aims: Vec<RowTarget> = problem.bias.iter().zip(&problem.compliance).map(aim).collect();
    let sweeper = Sweeper::new(&problem.assembly, dt);
    let mut x = start.to_vec();
    problem.lcp.project_all(&mut x);
    let mut u = problem.motion(&x);
    let mut status = Status::IterationLimit;
    let mut done = 0;
    let mut stops =
        |iteration, x: &[f64], event| observer.observe(&Iterate { iteration, x, event }).is_break();
    if stops(0, &x, Event::Start) {
        return Solution::new(&problem.lcp, x, Status::Stopped, 0);
    }
    while done < sweeps && status == Status::IterationLimit {
        sweeper.sweep(&aims, &mut x, &mut u);
        done += 1;
        if stops(done, &x, Event::Sweep) {
            status = Status::Stopped;
        }
    }
    if problem.lcp.scaled_residual(&x) <= tolerance {
        status = Status::Solved;
    }
    Solution::new(&problem.lcp, x, status, done)
}
