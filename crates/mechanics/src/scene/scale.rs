//! The force scale of a scene, below which a row counts as at rest.
//!
//! A residual is measured relative to the terms of its row. If all of them are rounding, as in an
//! unloaded joint, the residual would be large relative to them. The terms of a row therefore count
//! as at least those of a significant force in the scene.

use super::Scene;
use crate::body::{Mass, State};
use crate::constraint::{Bounds, Row};

/// A shift relative to the distance from the origin or the radius of gyration. Even multiplied by
/// the tolerance of a solver, 1e-8, it is above the rounding of positions, 1e-16.
const SHIFT: f64 = 1e-6;

impl Scene {
    /// The force (N) below which a row counts as at rest: `solver.scale`, or the weight of the
    /// lightest body. If nothing has a weight, the least force given for a body; if none is given,
    /// the least force that moves a body: by stopping it or its rotation, or by a motor within a
    /// step, or by a spring. If nothing acts and nothing moves, only positions and their rounding
    /// are left: then the least force that moves a body within a step by a millionth of its
    /// distance from the origin or of its radius of gyration.
    pub fn scale(&self) -> f64 {
        let stated = self.solver.scale;
        stated
            .or_else(|| least(self.masses().map(|(_, mass)| mass * self.gravity.norm())))
            .or_else(|| least(self.masses().map(|(k, _)| self.bodies[k].force.norm())))
            .or_else(|| least(self.moving_forces().into_iter()))
            .or_else(|| least(self.masses().map(|(k, mass)| mass * self.shift(k))))
            .unwrap_or(0.0)
    }

    /// The bodies with a mass (kg).
    fn masses(&self) -> impl Iterator<Item = (usize, f64)> {
        let masses = self.bodies.iter().map(|body| body.mass.mass()).enumerate();
        masses.filter(|(_, mass)| *mass > 0.0)
    }

    /// The acceleration (m/s²) of this shift of a body within a step.
    fn shift(&self, body: usize) -> f64 {
        let reach = self.states[body].pose.p.norm().max(self.gyration(body));
        SHIFT * reach / self.step.dt.powi(2)
    }

    /// The largest radius of gyration of a body (m).
    fn gyration(&self, body: usize) -> f64 {
        match self.bodies[body].mass {
            Mass::Rigid { mass, moments } => (moments.max() / mass).sqrt(),
            Mass::Fixed | Mass::Point { .. } => 0.0,
        }
    }

    /// The largest force (N) that moves each body at the beginning, or its torque (N m).
    fn moving_forces(&self) -> Vec<f64> {
        let mut largest = vec![0.0_f64; self.bodies.len()];
        for (k, mass) in self.masses() {
            let State { v, omega, .. } = self.states[k];
            let speed = v.norm().max(self.gyration(k) * omega.norm());
            largest[k] = mass * speed / self.step.dt;
        }
        for constraint in &self.constraints {
            let bodies = constraint.bodies();
            let states = bodies.map(|body| body.map_or(&State::WORLD, |k| &self.states[k]));
            // The step reports the reason.
            let Ok(rows) = constraint.rows(states) else { continue };
            for body in bodies.into_iter().flatten() {
                let forces = rows.iter().map(|row| self.force_on(body, row));
                largest[body] = forces.fold(largest[body], f64::max);
            }
        }
        largest
    }

    /// The force of a row's spring, or the force with which its motor brings a body to its speed in
    /// a step.
    fn force_on(&self, body: usize, row: &Row) -> f64 {
        let inertia = match self.bodies[body].mass {
            Mass::Fixed => return 0.0,
            Mass::Rigid { moments, .. } if row.kind.is_angular() => moments.min(),
            Mass::Point { mass } | Mass::Rigid { mass, .. } => mass,
        };
        let drive = inertia * row.speed.abs() / self.step.dt;
        let drive = match row.bounds {
            Bounds::Effort(effort) => drive.min(effort),
            _ => drive,
        };
        drive.max(row.spring.map_or(0.0, |spring| spring.stiffness * row.c.abs()))
    }
}

/// The least nonzero value.
fn least(forces: impl Iterator<Item = f64>) -> Option<f64> {
    forces.filter(|force| *force > 0.0).reduce(f64::min)
}
