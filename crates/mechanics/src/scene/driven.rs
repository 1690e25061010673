//! Bodies with time-dependent forces or motions.
//!
//! A step of h (s) from t uses the mean force over [t, t + h], so that its impulse is exact;
//! integrators with stages use the force at the time of each stage. A support moves with the mean
//! velocity over the step, so that its position at the end of each step is exact.

use std::borrow::Cow;

use nalgebra::Vector3;

use super::{Scene, Scheme, TimeFunction, description};
use crate::body::State;
use lcplab_lcp::error::Defects;

/// The time-dependent force and motion of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Driven {
    /// The body.
    pub body: usize,
    /// The constant force on it (N, world), and the time-dependent force added to it.
    pub force: Option<(Vector3<f64>, TimeFunction)>,
    /// Its position (m, world) at displacement 0, and its displacement.
    pub displacement: Option<(Vector3<f64>, TimeFunction)>,
}

impl Scene {
    /// The scene with the forces that act at a time (s), or their mean over the next `h` (s) if
    /// that is not 0.
    pub(crate) fn forced(&self, time: f64, h: f64) -> Cow<'_, Scene> {
        if self.driven.iter().all(|driven| driven.force.is_none()) {
            return Cow::Borrowed(self);
        }
        let mut scene = self.clone();
        for driven in &self.driven {
            if let Some((constant, function)) = &driven.force {
                let added = if h == 0.0 { function.at(time) } else { function.mean(time, h) };
                scene.bodies[driven.body].force = constant + added;
            }
        }
        Cow::Owned(scene)
    }

    /// The states with the supports at their positions at a time (s), moving for a step of h (s).
    pub fn supported<'s>(&self, states: &'s [State], time: f64, h: f64) -> Cow<'s, [State]> {
        let mut states = Cow::Borrowed(states);
        for driven in &self.driven {
            if let Some((rest, function)) = &driven.displacement {
                let (now, then) = (function.at(time), function.at(time + h));
                let state = &mut states.to_mut()[driven.body];
                state.pose.p = rest + now;
                state.v = (then - now) / h;
            }
        }
        states
    }
}

/// The time-dependent force and motion of a body, if there are any.
pub(super) fn of_body(
    defects: &mut Defects,
    place: &str,
    written: &description::Body,
    scene: &Scene,
    body: usize,
) -> Option<Driven> {
    let description::Body { force_over_time, displacement_over_time, fixed, .. } = written;
    if let Some(function) = force_over_time {
        let place = format!("{place}.force_over_time");
        function.check(defects, &place);
        if *fixed {
            defects.add(place, "a fixed body has none");
        }
    }
    if let Some(function) = displacement_over_time {
        let place = format!("{place}.displacement_over_time");
        function.check(defects, &place);
        if !fixed {
            defects.add(place, "needs fixed = true, because forces move all other bodies");
        } else if written.velocity != [0.0; 3] {
            defects.add(place, "there is a velocity too, give one of them");
        }
    }
    let with = |at: Vector3<f64>, function: &Option<TimeFunction>| {
        function.clone().map(|function| (at, function))
    };
    let driven = Driven {
        body,
        force: with(scene.bodies[body].force, force_over_time),
        displacement: with(scene.states[body].pose.p, displacement_over_time),
    };
    (driven.force.is_some() || driven.displacement.is_some()).then_some(driven)
}

/// Checks that the scheme supports time-dependent forces and motions.
pub(super) fn check_scheme(defects: &mut Defects, scene: &Scene) {
    let moved = scene.driven.iter().find(|driven| driven.displacement.is_some());
    if let (Scheme::Acceleration, Some(driven)) = (scene.step.scheme, moved) {
        let place = format!("bodies[{}].displacement_over_time", driven.body);
        defects.add(place, "is not supported by the scheme acceleration; use another scheme");
    }
}
