//! Impacts that do not bounce because they are slower than `contact.bounce_speed`.
//!
//! The threshold is meant for contacts at rest and for the last bounces of a body that comes to
//! rest. An impact that is faster than what gravity alone makes of a rest, between bodies that
//! have not bounced before, is worth a note: its restitution has no effect at all.

use std::collections::BTreeSet;

use super::{Step, Touch};
use crate::scene::{Scene, Scheme};
use lcplab_lcp::number::readable;

/// A slower approach, in multiples of the speed that gravity adds in a step, belongs to a rest.
const FAST: f64 = 4.0;
/// The same without gravity, as a part of the speed below which nothing bounces.
const NOTABLE: f64 = 0.1;
/// Significant digits in words.
const DIGITS: usize = 3;

/// The impacts of a run that lost their bounce.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::{LostBounces, Simulation};
///
/// let text = "gravity = [0, 0, 0]\nbodies = [\
///     { name = 'wall', fixed = true, shape = { plane = [1, 0, 0] } }, \
///     { name = 'ball', shape = { sphere = 0.1 }, mass = 1, position = [0.11, 0, 0], velocity = [-0.9, 0, 0] }]\n\
///     [contact]\nrestitution = 0.8\nbounce_speed = 1";
/// let scene = Scene::from_toml("slow", text)?;
/// let (mut simulation, mut lost) = (Simulation::of(&scene)?, LostBounces::default());
/// for _ in 0..5 {
///     lost.add(&scene, &simulation.step().expect("a step that can be taken"));
/// }
/// assert!(lost.in_words(&scene).unwrap().starts_with("restitution 0.8 was not applied"));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct LostBounces {
    /// Their number.
    count: usize,
    /// The step of the fastest, from 1, and its bodies.
    fastest: Option<(usize, Touch)>,
    /// The pairs that touched in the last step, and those that have bounced.
    touching: BTreeSet<[usize; 2]>,
    bounced: BTreeSet<[usize; 2]>,
}

impl LostBounces {
    /// Takes a step into account.
    pub fn add(&mut self, scene: &Scene, step: &Step) {
        // The penalty method does not read the coefficient of restitution.
        if scene.step.scheme == Scheme::Penalty {
            return;
        }
        let falling = FAST * scene.gravity.norm() * scene.step.dt;
        let least = falling.max(NOTABLE * scene.contact.bounce_speed);
        for touch in &step.touches {
            if scene.contact.bounces(touch.approach) {
                self.bounced.insert(touch.bodies);
            }
            let is_lost = touch.approach > least
                && scene.restitution(touch.bodies.map(Some)) > 0.0
                && !self.bounced.contains(&touch.bodies)
                && !self.touching.contains(&touch.bodies);
            if is_lost {
                self.count += 1;
                if self.fastest.is_none_or(|(_, known)| touch.approach > known.approach) {
                    self.fastest = Some((step.number, *touch));
                }
            }
        }
        self.touching = step.touches.iter().map(|touch| touch.bodies).collect();
    }

    /// How many there were, and the fastest of them; `None` if there were none.
    pub fn in_words(&self, scene: &Scene) -> Option<String> {
        let (step, Touch { bodies, approach, .. }) = self.fastest?;
        let [first, second] = bodies.map(|body| &scene.bodies[body]);
        let [body, other] = if first.mass.dof() > 0 { [first, second] } else { [second, first] };
        let [e, speed, least] =
            [scene.restitution(bodies.map(Some)), approach, scene.contact.bounce_speed]
                .map(|value| readable(value, DIGITS));
        let (impacts, which) = match self.count {
            1 => ("an impact".to_string(), "it"),
            count => (format!("{count} impacts"), "the fastest"),
        };
        Some(format!(
            "restitution {e} was not applied to {impacts} below contact.bounce_speed = {least} m/s; {which} \
             had {speed} m/s ({:?} on {:?}, step {step})",
            body.name, other.name
        ))
    }
}
