//! Bodies that move although the forces at the start keep them at rest.
//!
//! Where nothing moves and nothing is driven, one exact step under Coulomb's law (scheme velocity,
//! model coulomb-cone) shows whether contacts and joints hold all bodies. If that step also stops a
//! small push of every body and withstands a small change of the load, the rest is stable, and
//! whatever moves later moves by an error of the scheme, of the friction model or of the solver: a
//! column that leans within its base falls, a block below the threshold of friction creeps. A
//! column at its very limit may fall.

use nalgebra::Vector3;

use super::{Motion, Simulation, options};
use crate::body::State;
use crate::scene::{Scene, Scheme, resting};
use lcplab_lcp::friction::Model;
use lcplab_solver::{Dantzig, Status};

/// Larger scenes are not examined: a step under cones would take too long.
const MOST_BODIES: usize = 60;
/// A push (m/s) is this part of what weight and forces give a body in a step, and a change of the
/// load is the same part of it.
const PUSH: f64 = 1e-4;
/// A push, or what a changed load gives a body in a step, is stopped if less than this part of it
/// is left.
const STOPPED: f64 = 0.1;
/// The tolerance of the step that shows it.
const TOLERANCE: f64 = 1e-9;
/// Joints that fit less well at the start, or deeper overlaps, relative to the thinnest body, may
/// move the bodies by their correction.
const FITTING: f64 = 1e-6;
/// Motion counts from this part of the body's thickness on, and from this angle (rad) on.
const NOTABLE_DISTANCE: f64 = 0.05;
const NOTABLE_ANGLE: f64 = 0.05;

/// The body that moved farthest from a rest that is stable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departure {
    /// The body.
    pub body: usize,
    /// How far its center of mass is from its place at the start (m).
    pub distance: f64,
    /// By how much it is turned (rad), at most π.
    pub angle: f64,
}

impl Departure {
    /// That of a scene whose bodies are in these states; `None` if nothing moved notably, or not
    /// from a stable rest.
    ///
    /// ```
    /// use lcplab_mechanics::scene::Scene;
    /// use lcplab_mechanics::simulation::Departure;
    ///
    /// let text = "bodies = [\
    ///     { name = 'ground', fixed = true, shape = { plane = [0, 0, 1] } }, \
    ///     { name = 'crate', shape = { box = [1, 1, 1] }, mass = 1, position = [0, 0, 0.5] }]\n\
    ///     [contact]\nfriction = 0.5";
    /// let scene = Scene::from_toml("crate", text)?;
    /// let mut states = scene.states.clone();
    /// assert_eq!(Departure::of(&scene, &states), None);
    /// states[1].pose.p.x += 0.2;
    /// assert!((Departure::of(&scene, &states).unwrap().distance - 0.2).abs() < 1e-12);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn of(scene: &Scene, states: &[State]) -> Option<Departure> {
        let is_still = |state: &State| state.velocity().norm() == 0.0;
        if scene.bodies.len() > MOST_BODIES
            || !scene.driven.is_empty()
            || !scene.states.iter().all(is_still)
        {
            return None;
        }
        let Motion { drift, penetration, .. } = Motion::of(scene, &scene.states, 0);
        if drift.max(penetration) > FITTING * scene.thinnest().unwrap_or(1.0) {
            return None;
        }
        let pairs = scene.states.iter().zip(states).enumerate();
        let moved = pairs.map(|(body, (start, now))| Departure {
            body,
            distance: (now.pose.p - start.pose.p).norm(),
            angle: now.pose.q.angle_to(&start.pose.q),
        });
        let size = |own: &Departure| {
            let distance = own.distance / (NOTABLE_DISTANCE * thickness_of(scene, own.body));
            distance.max(own.angle / NOTABLE_ANGLE)
        };
        let farthest = moved.max_by(|a, b| size(a).total_cmp(&size(b)))?;
        (size(&farthest) > 1.0 && is_held(scene)).then_some(farthest)
    }
}

/// The thickness (m) of a body; 1 of one without.
fn thickness_of(scene: &Scene, body: usize) -> f64 {
    resting::size(&scene.bodies[body].shape).unwrap_or(1.0)
}

/// Whether a step under Coulomb's law stops small pushes of all bodies, and their opposites, and
/// withstands small changes of the load in all directions.
fn is_held(scene: &Scene) -> bool {
    let mut exact = scene.clone();
    (exact.step.scheme, exact.step.baumgarte) = (Scheme::Velocity, 0.0);
    exact.contact.model = Model::CoulombCone;
    exact.solver.tolerance = TOLERANCE;
    exact.solver.fixed_sweeps = false;
    if exact.validate().is_err() {
        return false;
    }
    let push = PUSH * 2.0 * scene.resting().bounce;
    let load = push / scene.step.dt;
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let loads = axes.into_iter().flat_map(|axis| [load * axis, -load * axis]);
    [push, -push].into_iter().all(|push| stays(pushed(&exact, push), push.abs()))
        && loads.into_iter().all(|load| {
            let mut loaded = exact.clone();
            loaded.gravity += load;
            stays(loaded, push)
        })
}

/// The scene with a push (m/s) of every body, each in a direction of its own.
fn pushed(scene: &Scene, push: f64) -> Scene {
    let mut pushed = scene.clone();
    for (body, state) in pushed.states.iter_mut().enumerate() {
        if scene.bodies[body].mass.dof() > 0 {
            let k = body as f64;
            let aside = Vector3::new(libm::cos(k + 1.0), libm::sin(2.0 * k + 1.0), 0.5);
            state.v = push * aside.normalize();
            state.omega = push / thickness_of(scene, body) * aside.yzx().normalize();
        }
    }
    pushed
}

/// Whether a step leaves next to nothing of this speed (m/s).
fn stays(scene: Scene, speed: f64) -> bool {
    let solver = Dantzig { settings: options(&scene).settings };
    let Ok(step) = Simulation::new(scene.clone(), Box::new(solver)).step() else { return false };
    let is_solved = step.solves.iter().all(|solve| solve.solution.status == Status::Solved);
    let size = |(body, state): (usize, &State)| {
        state.v.norm().max(thickness_of(&scene, body) * state.omega.norm())
    };
    let left = step.states.iter().enumerate().map(size).fold(0.0, f64::max);
    is_solved && left <= STOPPED * speed
}
