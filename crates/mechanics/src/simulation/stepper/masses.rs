//! The moving bodies in units where all masses are 1.
//!
//! ```text
//! M⁻¹ = L Lᵀ,   L = diag(1/√m, R diag(1/√I)),   v = L⁻¹ u,   Ĵ = J L
//! ```
//!
//! I are the principal moments, so the last three components of v are along the body's own axes.
//! Any other L with the same L Lᵀ would do as well: A is the same.

use nalgebra::{Matrix3, Vector3, Vector6};

use crate::body::{Mass, State, angular, linear, stack};
use crate::constraint::Row;
use crate::scene::Scene;
use lcplab_solver::kernel::impulses::Velocity;

/// All moving bodies of a scene.
pub(super) struct Masses {
    bodies: Vec<Moving>,
    /// The place of each body among those that move.
    places: Vec<Option<usize>>,
    /// v at the beginning of the step, and v without constraints at its end.
    pub before: Vec<Velocity>,
    pub free: Vec<Velocity>,
}

/// The bodies whose axis a joint holds.
fn held(scene: &Scene) -> Vec<usize> {
    let mut held = Vec::new();
    for constraint in &scene.constraints {
        let bodies = constraint.bodies();
        let states = bodies.map(|body| body.map_or(&State::WORLD, |b| &scene.states[b]));
        if constraint.rows(states).is_ok_and(|rows| rows.iter().any(Row::holds_axis)) {
            held.extend(bodies.into_iter().flatten());
        }
    }
    held
}

/// L of a body.
struct Moving {
    /// Its index in the scene.
    body: usize,
    /// √m.
    mass: f64,
    /// √I and 1/√I along the body's axes; 0 for a point mass, which does not turn.
    moments: Vector3<f64>,
    inverse: Vector3<f64>,
    /// R.
    rotation: Matrix3<f64>,
    /// Whether a joint holds its axis.
    is_held: bool,
}

impl Masses {
    pub fn new(scene: &Scene) -> Self {
        let held = held(scene);
        let mut places = vec![None; scene.bodies.len()];
        let mut bodies = Vec::new();
        for (body, mass) in scene.bodies.iter().map(|body| body.mass).enumerate() {
            let moments = match mass {
                Mass::Fixed => continue,
                Mass::Point { .. } => None,
                Mass::Rigid { moments, .. } => Some(moments.map(f64::sqrt)),
            };
            places[body] = Some(bodies.len());
            bodies.push(Moving {
                body,
                mass: mass.mass().sqrt(),
                moments: moments.unwrap_or_default(),
                inverse: moments.map(|root| root.map(f64::recip)).unwrap_or_default(),
                rotation: Matrix3::identity(),
                is_held: held.contains(&body),
            });
        }
        let (before, free) = (vec![[0.0; 6]; bodies.len()], vec![[0.0; 6]; bodies.len()]);
        Masses { bodies, places, before, free }
    }

    /// The number of moving bodies.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// The place of a body of the scene among those that move.
    pub fn place(&self, body: Option<usize>) -> Option<usize> {
        self.places[body?]
    }

    /// Turns L to these states, and sets v = L⁻¹u and v* = L⁻¹(u + dt M⁻¹F) = v + dt LᵀF.
    pub fn turn(&mut self, scene: &Scene, states: &[State]) {
        let dt = scene.step.dt;
        let velocities = self.before.iter_mut().zip(&mut self.free);
        for (moving, (before, free)) in self.bodies.iter_mut().zip(velocities) {
            let (body, state) = (&scene.bodies[moving.body], &states[moving.body]);
            moving.rotation = state.pose.q.to_rotation_matrix().into_inner();
            let torque = scene.step.gyroscopic().torque(&body.mass, state, dt);
            let force = stack(scene.gravity * body.mass.mass(), torque) + body.wrench(&state.pose);
            *before = moving.scaled_velocity(&state.velocity());
            let change = moving.scaled_row(&force);
            *free = std::array::from_fn(|k| before[k] + dt * change[k]);
        }
    }

    /// Lᵀ j of the body at this place: its part of a row of Ĵ.
    pub(crate) fn scaled_row(&self, place: usize, j: &Vector6<f64>) -> Velocity {
        self.bodies[place].scaled_row(j)
    }

    /// Moves the bodies with u = L v for a step.
    pub fn advance(&self, scene: &Scene, v: &[Velocity], states: &[State], next: &mut [State]) {
        let dt = scene.step.dt;
        let gyroscopic = scene.step.gyroscopic();
        next.iter_mut().zip(states).for_each(|(next, state)| *next = state.advanced(dt));
        for (moving, v) in self.bodies.iter().zip(v) {
            let state = states[moving.body].with_velocity(&moving.velocity(v));
            let mass = &scene.bodies[moving.body].mass;
            next[moving.body] = match moving.is_held {
                true => gyroscopic.turned(mass, &state, dt),
                false => gyroscopic.advanced(mass, &state, dt),
            };
        }
    }
}

impl Moving {
    /// Lᵀ j = [j_v/√m, (Rᵀ j_ω)/√I].
    fn scaled_row(&self, j: &Vector6<f64>) -> Velocity {
        let turning = self.rotation.tr_mul(&angular(j)).component_mul(&self.inverse);
        stack(linear(j) / self.mass, turning).into()
    }

    /// L⁻¹ u = [√m v, √I Rᵀω].
    fn scaled_velocity(&self, u: &Vector6<f64>) -> Velocity {
        let turning = self.rotation.tr_mul(&angular(u)).component_mul(&self.moments);
        stack(linear(u) * self.mass, turning).into()
    }

    /// L v.
    fn velocity(&self, v: &Velocity) -> Vector6<f64> {
        let v = Vector6::from(*v);
        let turning = self.rotation * angular(&v).component_mul(&self.inverse);
        stack(linear(&v) / self.mass, turning)
    }
}
