//! Code 7: the whole step of all bodies: gather, build J, solve, write back.
//!
//! ```text
//! printed     A x = J u* + β e,                u⁺ = u* − M⁻¹ Jᵀ x
//! corrected   w = A x + J u* + β/dt e,         u⁺ = u* + M⁻¹ Jᵀ x,   lo ≤ x ≤ hi
//! ```
//!
//! Six things in it need correction, and each can be chosen separately: it returns before the step
//! if there is no body or no constraint (E32); it adds the penalty e once for each body of a
//! constraint (E33); β lacks 1/dt (E34); there are no bounds (E31); x starts from 0 in each frame
//! (E12); and x has a different sign than the comment above it says (E29, E30). It also lacks the
//! gyroscopic torque (E26). In print dt is used but never declared (E36).
#![allow(non_snake_case)]

use nalgebra::{DMatrix, DVector, Quaternion, Vector3};

use super::code01_unconstrained_step::Blocks;
use super::code05_rigid_body::{self, RigidBody, Vectors};
use super::constraint_class::Constraint;
use super::{Form, Listing, code02_constrained_step, code04_drift_correction, code06_solver};
use crate::error::Result;

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 7",
    title: "the whole step",
    printed: "Return if there is nothing to constrain; else J, A x = J u* + β e with e added up over \
              bodies, no bounds, x from 0, and u⁺ = u* − M⁻¹ Jᵀ x.",
    corrected: "Always step; e once per constraint, β/dt, each row's bounds, x from the last frame, and \
                u⁺ = u* + M⁻¹ Jᵀ x.",
    errata: &[
        "E12", "E26", "E28", "E29", "E30", "E31", "E32", "E33", "E34", "E35", "E36", "E37", "E59",
    ],
};

/// Bodies, their constraints, and the x of the last step.
#[derive(Debug, Default)]
pub struct World {
    /// The bodies.
    pub bodies: Vec<RigidBody>,
    /// The constraints.
    pub constraints: Vec<Box<dyn Constraint>>,
    /// x of the last step, in the sign of the form that computed it; one entry per row.
    pub x: Vec<f64>,
}

/// The bounds on x.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limits {
    /// None, as printed.
    Absent,
    /// x ≥ 0 unless the constraint declares itself an equation: the advice next to the class.
    ByIsEquality,
    /// The bounds of each row, as corrected.
    OfEachRow,
}

/// A step with each of its parts in one of two forms.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeStep {
    /// Whether it returns early.
    pub early_return: Form,
    /// How often a penalty is added.
    pub penalty: Form,
    /// Whether β is divided by dt.
    pub beta: Form,
    /// The bounds.
    pub limits: Limits,
    /// Whether x starts from 0 or from the last step's x.
    pub start: Form,
    /// The sign of x.
    pub sign: Form,
    /// Whether the gyroscopic torque is included.
    pub gyroscopic: Form,
    /// β.
    pub feedback: f64,
    /// The number of sweeps.
    pub sweeps: usize,
}

impl WholeStep {
    /// The listing.
    pub const PRINTED: WholeStep = WholeStep {
        early_return: Form::Printed,
        penalty: Form::Printed,
        beta: Form::Printed,
        limits: Limits::Absent,
        start: Form::Printed,
        sign: Form::Printed,
        gyroscopic: Form::Printed,
        feedback: code04_drift_correction::BETA,
        sweeps: code06_solver::SWEEPS,
    };

    /// The corrected step, for constraints whose J is ∂c/∂s.
    pub const CORRECTED: WholeStep = WholeStep {
        early_return: Form::Corrected,
        penalty: Form::Corrected,
        beta: Form::Corrected,
        limits: Limits::OfEachRow,
        start: Form::Corrected,
        sign: Form::Corrected,
        gyroscopic: Form::Corrected,
        ..WholeStep::PRINTED
    };

    /// Takes a step of dt (s) and clears the forces.
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn take(&self, world: &mut World, dt: f64) -> Result<()> {
        let nothing_to_do = world.bodies.is_empty() || world.constraints.is_empty();
        if self.early_return == Form::Printed && nothing_to_do {
            return Ok(());
        }
        let blocks = gathered(&world.bodies, self.gyroscopic);
        let (J, e) = self.constraints(world);
        let x = self.solved(&blocks, &J, &e, world, dt)?;
        let (u, s) = match self.sign {
            Form::Printed => code02_constrained_step::printed(&blocks, &J, &x, dt),
            Form::Corrected => code02_constrained_step::corrected(&blocks, &J, &x, dt),
        };
        scatter(&mut world.bodies, &u, &s);
        world.x = x.as_slice().to_vec();
        Ok(())
    }

    /// J, one block per constraint and body, and the penalties e.
    fn constraints(&self, world: &World) -> (DMatrix<f64>, DVector<f64>) {
        let rows = world.constraints.iter().map(|constraint| constraint.dimension()).sum();
        let mut J = DMatrix::zeros(rows, 6 * world.bodies.len());
        let mut e = DVector::zeros(rows);
        let mut first = 0;
        for constraint in &world.constraints {
            let dimension = constraint.dimension();
            let mut add_penalty = || {
                let mut own = e.rows_mut(first, dimension);
                own += constraint.penalty(&world.bodies);
            };
            for body in 0..world.bodies.len() {
                let Some(block) = constraint.jacobian(&world.bodies, body) else { continue };
                J.view_mut((first, 6 * body), (dimension, 6)).copy_from(&block);
                if self.penalty == Form::Printed {
                    add_penalty();
                }
            }
            if self.penalty == Form::Corrected {
                add_penalty();
            }
            first += dimension;
        }
        (J, e)
    }

    /// x of the step, in the sign of its form.
    fn solved(
        &self,
        blocks: &Blocks,
        J: &DMatrix<f64>,
        e: &DVector<f64>,
        world: &World,
        dt: f64,
    ) -> Result<DVector<f64>> {
        let beta = match self.beta {
            Form::Printed => self.feedback,
            Form::Corrected => self.feedback / dt,
        };
        let rate = J * blocks.unconstrained(dt) + e * beta;
        let b = match self.sign {
            Form::Printed => -rate, // A x = rate
            Form::Corrected => rate,
        };
        let start = match self.start {
            Form::Corrected if world.x.len() == b.len() => Some(world.x.as_slice()),
            _ => None,
        };
        let (lo, hi): (Vec<f64>, Vec<f64>) = self.bounds(world).into_iter().unzip();
        let A = code04_drift_correction::matrix(blocks, J);
        let solver = match self.limits {
            Limits::Absent => Form::Printed,
            Limits::ByIsEquality | Limits::OfEachRow => Form::Corrected,
        };
        code06_solver::swept(solver, &A, &b, Some(&lo), Some(&hi), start, self.sweeps)
    }

    /// The bounds on x in each row, in the sign of its form.
    fn bounds(&self, world: &World) -> Vec<(f64, f64)> {
        let free = (f64::NEG_INFINITY, f64::INFINITY);
        let of = |constraint: &dyn Constraint| match self.limits {
            Limits::Absent => vec![free; constraint.dimension()],
            Limits::ByIsEquality if constraint.is_equality() => vec![free; constraint.dimension()],
            Limits::ByIsEquality => vec![(0.0, f64::INFINITY); constraint.dimension()],
            Limits::OfEachRow => constraint.bounds(),
        };
        world.constraints.iter().flat_map(|constraint| of(constraint.as_ref())).collect()
    }
}

/// The first part of the listing: the bodies as block matrices, with or without gyroscopic torques.
pub fn gathered(bodies: &[RigidBody], gyroscopic: Form) -> Blocks {
    let m = bodies.len();
    let mut blocks = Blocks {
        u: DVector::zeros(6 * m),
        s: DVector::zeros(7 * m),
        S: DMatrix::zeros(7 * m, 6 * m),
        M_inv: DMatrix::zeros(6 * m, 6 * m),
        F: DVector::zeros(6 * m),
    };
    for (i, body) in bodies.iter().enumerate() {
        let (row, column) = (7 * i, 6 * i);
        let q = body.orientation;
        blocks.s.rows_mut(row, 3).copy_from(&body.position);
        blocks.s.rows_mut(row + 3, 4).copy_from_slice(&[q.w, q.i, q.j, q.k]);
        blocks.u.rows_mut(column, 3).copy_from(&body.linear_velocity);
        blocks.u.rows_mut(column + 3, 3).copy_from(&body.angular_velocity);
        blocks.S.view_mut((row, column), (3, 3)).fill_with_identity();
        blocks.S.view_mut((row + 3, column + 3), (4, 3)).copy_from(&body.quaternion_rate());
        blocks.M_inv.view_mut((column, column), (3, 3)).fill_diagonal(body.inverse_mass);
        let inertia = code05_rigid_body::printed(body, Vectors::Rows);
        blocks.M_inv.view_mut((column + 3, column + 3), (3, 3)).copy_from(&inertia);
        let torque = match gyroscopic {
            Form::Printed => body.torque,
            Form::Corrected => body.torque + body.gyroscopic_torque(),
        };
        blocks.F.rows_mut(column, 3).copy_from(&body.force);
        blocks.F.rows_mut(column + 3, 3).copy_from(&torque);
    }
    blocks
}

/// The last part: copies velocities and positions back into the bodies, normalizes quaternions, and
/// clears forces.
fn scatter(bodies: &mut [RigidBody], u: &DVector<f64>, s: &DVector<f64>) {
    let three = |from: &DVector<f64>, k: usize| Vector3::new(from[k], from[k + 1], from[k + 2]);
    for (i, body) in bodies.iter_mut().enumerate() {
        let (row, column) = (7 * i, 6 * i);
        body.position = three(s, row);
        let q = Quaternion::new(s[row + 3], s[row + 4], s[row + 5], s[row + 6]);
        body.orientation = q.normalize();
        body.linear_velocity = three(u, column);
        body.angular_velocity = three(u, column + 3);
        body.force = Vector3::zeros();
        body.torque = Vector3::zeros();
    }
}
