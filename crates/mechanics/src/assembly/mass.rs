//! The diagonal blocks of M and M⁻¹, and the forces F.

use nalgebra::{Matrix3, Vector6};

use crate::body::{Gyroscopic, Mass, Pose, State, stack};
use crate::scene::Scene;

/// A moving body's columns and its blocks of M and M⁻¹.
#[derive(Debug, Clone)]
pub struct Block {
    /// The body's index in the scene.
    pub body: usize,
    /// Its first column.
    pub offset: usize,
    /// The number of its columns: 3 for a point mass, 6 for a rigid body.
    pub dof: usize,
    /// Mass (kg).
    pub mass: f64,
    /// Inertia (kg m², world axes); 0 for a point mass.
    pub inertia: Matrix3<f64>,
    kind: Mass,
    pose: Pose,
}

impl Block {
    /// M⁻¹ times this body's [f; τ].
    pub fn accelerate(&self, wrench: &Vector6<f64>) -> Vector6<f64> {
        self.kind.accelerate(&self.pose, wrench)
    }

    /// The pose of the body for which the blocks were computed.
    pub(crate) fn pose(&self) -> &Pose {
        &self.pose
    }

    /// This body's state after h (s) without forces; `held` is whether a joint holds its axis.
    pub(super) fn advanced(
        &self,
        gyroscopic: Gyroscopic,
        held: bool,
        state: &State,
        h: f64,
    ) -> State {
        match held {
            true => gyroscopic.turned(&self.kind, state, h),
            false => gyroscopic.advanced(&self.kind, state, h),
        }
    }

    /// This body's entries of a vector with one entry per column; 0 where a point mass has none.
    pub fn gather(&self, values: &[f64]) -> Vector6<f64> {
        let own = &values[self.offset..self.offset + self.dof];
        Vector6::from_fn(|k, _| own.get(k).copied().unwrap_or(0.0))
    }

    /// Writes this body's entries into a vector with one entry per column.
    pub(crate) fn scatter(&self, own: &Vector6<f64>, values: &mut [f64]) {
        values[self.offset..self.offset + self.dof].copy_from_slice(&own.as_slice()[..self.dof]);
    }

    /// The upper triangle of this body's block of M as (row, column, value).
    pub(crate) fn mass_entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let at = move |i: usize, j: usize, value| (self.offset + i, self.offset + j, value);
        let linear = (0..3).map(move |i| at(i, i, self.mass));
        let pairs = (3..self.dof).flat_map(move |i| (i..self.dof).map(move |j| (i, j)));
        linear.chain(pairs.map(move |(i, j)| at(i, j, self.inertia[(i - 3, j - 3)])))
    }
}

/// One block per moving body, in the order of the scene.
pub(super) fn blocks(scene: &Scene, states: &[State]) -> Vec<Block> {
    let mut offset = 0;
    let mut blocks = Vec::new();
    for (body, (kind, state)) in scene.bodies.iter().map(|b| b.mass).zip(states).enumerate() {
        if kind.dof() > 0 {
            let (mass, inertia) = (kind.mass(), kind.world_inertia(&state.pose));
            let (dof, pose) = (kind.dof(), state.pose);
            blocks.push(Block { body, offset, dof, mass, inertia, kind, pose });
            offset += dof;
        }
    }
    blocks
}

/// Gravity, the body's own force and the gyroscopic torque for each block, [f; τ] (N, N m).
pub(super) fn forces(scene: &Scene, states: &[State], blocks: &[Block]) -> Vec<Vector6<f64>> {
    let gyroscopic = scene.step.gyroscopic();
    let force = |block: &Block| {
        let state = &states[block.body];
        let torque = gyroscopic.torque(&block.kind, state, scene.step.dt);
        stack(scene.gravity * block.mass, torque) + scene.bodies[block.body].wrench(&state.pose)
    };
    blocks.iter().map(force).collect()
}
