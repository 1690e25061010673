//! Matrices of a scene at one instant: M and M⁻¹, F, u, and the rows with J, J'u and c.
//!
//! Only moving bodies have columns: a fixed one has M⁻¹ = 0, so its part of J has no effect.
//! Constraints come first, in the order of the scene, then contacts, each as normal, first and
//! second tangent.

mod degrees_of_freedom;
mod mass;
mod rows;

pub use mass::Block;
pub use rows::{ConstraintFilter, Part, Row, RowId, Source};

use std::fmt;

use nalgebra::Vector6;

use crate::body::{Gyroscopic, State};
use crate::constraint::{Bodies, Degenerate};
use crate::scene::{DetectedContact, Scene};

/// The matrices of a scene at one instant.
///
/// ```
/// use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
/// use lcplab_mechanics::body::stack;
/// use lcplab_mechanics::scene::Scene;
/// use nalgebra::{Vector3, dmatrix};
///
/// // A bob of 1 kg at (1, 0, 0) on a rod from the origin: J = (1, 0, 0), F = (0, 0, −9.81) N.
/// let scene = Scene::load("pendulum")?;
/// let filter = ConstraintFilter::Near;
/// let assembly = Assembly::new(&scene, &scene.states, &[], filter).expect("a direction");
/// assert_eq!((assembly.columns(), assembly.jacobian()), (3, dmatrix![1.0, 0.0, 0.0]));
/// assert_eq!(assembly.jacobian_row(0), [(0, 1.0)]);
/// assert_eq!(assembly.jacobian_pattern(), [(0, 0)]);
/// assert_eq!(assembly.accelerate(&assembly.force), [0.0, 0.0, -9.81]); // M⁻¹ F
/// assert_eq!(assembly.pull_back(&[2.0]), [2.0, 0.0, 0.0]); // Jᵀ x
/// assert_eq!(assembly.push_forward(&[3.0, 0.0, 1.0]), [3.0]); // J u
///
/// // The same for the only moving body and the only row.
/// let (block, row) = (&assembly.blocks[0], &assembly.rows[0]);
/// let weight = block.gather(&assembly.force);
/// assert_eq!(weight, stack(-9.81 * Vector3::z(), Vector3::zeros()));
/// assert_eq!(block.accelerate(&weight), weight); // 1 kg
/// assert_eq!((row.parts().count(), row.movers().count()), (1, 1)); // the world does not move
/// assert_eq!(row.direction(), Some(Vector3::x()));
/// assert_eq!(row.names(&scene), ["world", "bob"]);
/// assert_eq!(row.label(&scene), "distance world bob 0");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Assembly {
    /// The diagonal blocks of M and M⁻¹, one per moving body.
    pub blocks: Vec<Block>,
    /// The velocities u (m/s, rad/s), one entry per column.
    pub u: Vec<f64>,
    /// External forces and torques and the gyroscopic torque F (N, N m), one entry per column.
    pub force: Vec<f64>,
    /// The rows.
    pub rows: Vec<Row>,
    gyroscopic: Gyroscopic,
}

impl Assembly {
    /// Assembles a scene with these states and contacts.
    ///
    /// # Errors
    /// [`Undefined`] if a constraint has no defined direction.
    pub fn new(
        scene: &Scene,
        states: &[State],
        contacts: &[DetectedContact],
        entering: ConstraintFilter,
    ) -> Result<Self, Undefined> {
        let blocks = mass::blocks(scene, states);
        let moving = |values: Vec<Vector6<f64>>| -> Vec<f64> {
            let entries = blocks.iter().zip(values);
            entries.flat_map(|(block, value)| value.as_slice()[..block.dof].to_vec()).collect()
        };
        let u = moving(blocks.iter().map(|block| states[block.body].velocity()).collect());
        let force = moving(mass::forces(scene, states, &blocks));
        let rows = rows::rows(scene, states, contacts, entering, &blocks)?;
        Ok(Assembly { blocks, u, force, rows, gyroscopic: scene.step.gyroscopic() })
    }

    /// The number of velocity components of moving bodies, k.
    pub fn columns(&self) -> usize {
        self.u.len()
    }

    /// M⁻¹ times a vector with one entry per column.
    pub fn accelerate(&self, force: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; force.len()];
        for block in &self.blocks {
            block.scatter(&block.accelerate(&block.gather(force)), &mut out);
        }
        out
    }

    /// Jᵀ x: the forces (or impulses) on each column from x (one entry per row).
    pub fn pull_back(&self, x: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.columns()];
        for (row, x) in self.rows.iter().zip(x) {
            for part in row.parts() {
                let block = &self.blocks[part.block];
                for (k, j) in part.jacobian.iter().take(block.dof).enumerate() {
                    out[block.offset + k] += j * x;
                }
            }
        }
        out
    }

    /// The stored entries (column, value) of row i of J, in ascending order of columns.
    pub fn jacobian_row(&self, i: usize) -> Vec<(usize, f64)> {
        let mut entries: Vec<(usize, f64)> = Vec::new();
        for part in self.rows[i].parts() {
            let block = &self.blocks[part.block];
            let values = part.jacobian.iter().take(block.dof).enumerate();
            entries.extend(values.map(|(k, &j)| (block.offset + k, j)).filter(|&(_, j)| j != 0.0));
        }
        entries.sort_by_key(|&(column, _)| column);
        entries
    }

    /// The positions (row, column) of the nonzero entries of J.
    pub fn jacobian_pattern(&self) -> Vec<(usize, usize)> {
        let row = |i| self.jacobian_row(i).into_iter().map(move |(column, _)| (i, column));
        (0..self.rows.len()).flat_map(row).collect()
    }

    /// J times a vector with one entry per column.
    pub fn push_forward(&self, u: &[f64]) -> Vec<f64> {
        let row = |row: &Row| {
            row.parts().map(|part| part.jacobian.dot(&self.blocks[part.block].gather(u))).sum()
        };
        self.rows.iter().map(row).collect()
    }

    /// The states with the velocities of moving bodies replaced by u (one entry per column).
    pub(crate) fn with_velocities(&self, states: &[State], u: &[f64]) -> Vec<State> {
        let mut states = states.to_vec();
        for block in &self.blocks {
            states[block.body] = states[block.body].with_velocity(&block.gather(u));
        }
        states
    }

    /// The states after h (s) with their velocities, s + h S u. Moving bodies rotate as the scene's
    /// setting `gyroscopic` says; bodies whose axis a joint holds rotate about that axis.
    pub(crate) fn advanced(&self, states: &[State], h: f64) -> Vec<State> {
        let mut moved: Vec<State> = states.iter().map(|state| state.advanced(h)).collect();
        let mut held = vec![false; self.blocks.len()];
        for part in self.rows.iter().filter(|row| row.holds_axis()).flat_map(Row::parts) {
            held[part.block] = true;
        }
        for (block, held) in self.blocks.iter().zip(held) {
            moved[block.body] = block.advanced(self.gyroscopic, held, &states[block.body], h);
        }
        moved
    }
}

/// A constraint whose direction is undefined at this instant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Undefined {
    /// The constraint.
    pub source: Source,
    /// Its bodies.
    pub bodies: Bodies,
    /// The reason.
    pub cause: Degenerate,
}

impl std::error::Error for Undefined {}

impl fmt::Display for Undefined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.source, self.cause)
    }
}
