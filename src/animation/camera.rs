//! The camera: orthographic, so that lengths can be compared and parallel lines stay parallel.

use nalgebra::{UnitQuaternion, Vector3};

use super::Frame;
use crate::body::{Mass, State};
use crate::scene::Scene;

/// The angle of the three-quarter view to the right of the front view.
const AZIMUTH_DEGREES: f64 = 32.0;
/// The downward angle of the three-quarter view.
const ELEVATION_DEGREES: f64 = 22.0;
/// The threshold for motion out of a plane, in m and in rad.
const FLAT: f64 = 1e-6;

/// The view of a scene; z is up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// Along y: x to the right.
    Front,
    /// From the front, the right and above.
    ThreeQuarter,
}

/// Three unit vectors of the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    right: Vector3<f64>,
    up: Vector3<f64>,
    eye: Vector3<f64>,
}

impl View {
    /// The front view if all moving bodies have their centers in one plane y = const, stay there
    /// and rotate only about y; otherwise three-quarter.
    pub fn of(scene: &Scene, frames: &[Frame]) -> View {
        let moving = |k: &usize| scene.bodies[*k].mass != Mass::Fixed;
        let bodies: Vec<usize> = (0..scene.bodies.len()).filter(moving).collect();
        let Some(&first) = bodies.first() else { return View::ThreeQuarter };
        let y = scene.states[first].pose.p.y;
        let flat = |state: &State, k: usize| {
            let turned = turn(&scene.states[k], state) * Vector3::y();
            (state.pose.p.y - y).abs() < FLAT && (turned - Vector3::y()).norm() < FLAT
        };
        let states = frames.iter().map(|frame| &frame.states).chain([&scene.states]);
        let all_flat = |states: &Vec<State>| bodies.iter().all(|&k| flat(&states[k], k));
        if states.into_iter().all(all_flat) { View::Front } else { View::ThreeQuarter }
    }

    /// The name in words.
    pub(crate) fn name(self) -> &'static str {
        match self {
            View::Front => "from the front",
            View::ThreeQuarter => "from the front, right and above",
        }
    }
}

/// The rotation from one state to another.
fn turn(from: &State, to: &State) -> UnitQuaternion<f64> {
    to.pose.q * from.pose.q.inverse()
}

impl Camera {
    /// The camera of a view.
    pub fn new(view: View) -> Self {
        let (azimuth, elevation) = match view {
            View::Front => (0.0, 0.0),
            View::ThreeQuarter => (AZIMUTH_DEGREES.to_radians(), ELEVATION_DEGREES.to_radians()),
        };
        let right = Vector3::new(azimuth.cos(), azimuth.sin(), 0.0);
        let toward = Vector3::new(azimuth.sin(), -azimuth.cos(), 0.0);
        let eye = toward * elevation.cos() + Vector3::z() * elevation.sin();
        Camera { right, up: eye.cross(&right), eye }
    }

    /// The view coordinates of a point (or a direction) of the world (m): to the right, up, and
    /// towards the viewer.
    ///
    /// ```
    /// use lcplab::animation::{Camera, View};
    /// use nalgebra::Vector3;
    ///
    /// let seen = Camera::new(View::Front).project(&Vector3::new(1.0, 2.0, 3.0));
    /// assert_eq!(seen, Vector3::new(1.0, 3.0, -2.0));
    /// ```
    pub fn project(&self, point: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(self.right.dot(point), self.up.dot(point), self.eye.dot(point))
    }

    /// The point of the world (m) with these view coordinates: to the right, up, and towards the
    /// viewer.
    pub(crate) fn world(&self, seen: &Vector3<f64>) -> Vector3<f64> {
        self.right * seen.x + self.up * seen.y + self.eye * seen.z
    }

    /// The unit vector towards the viewer.
    pub(crate) fn toward(&self) -> Vector3<f64> {
        self.eye
    }
}
