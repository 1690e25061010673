//! Friction and restitution of two touching bodies: the values of the pair, otherwise the geometric
//! mean of both bodies' values.
//!
//! Static friction above kinetic friction is decided by the answer of a step, so it requires a
//! scheme that computes one: see [`held`](crate::formulation::Problem::held).

use std::collections::HashMap;

use super::settings::within_one;
use super::{Contacts, Scene, Scheme, anisotropy, description, range};
use crate::body::{Anisotropy, Pose};
use crate::constraint::Bodies;
use lcplab_lcp::error::Defects;
use lcplab_lcp::friction::Model;

/// The values given for a pair of bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surface {
    /// The coefficient of friction.
    pub friction: Option<f64>,
    /// The coefficient of static friction.
    pub static_friction: Option<f64>,
    /// The body (of the scene) with the direction along which `friction` holds, if friction across
    /// it differs.
    pub anisotropy: Option<(usize, Anisotropy)>,
    /// The coefficient of restitution.
    pub restitution: Option<f64>,
    /// Whether the bodies never touch.
    pub without_contact: bool,
}

impl Scene {
    /// The coefficient of kinetic friction of two bodies.
    pub fn friction(&self, bodies: [usize; 2]) -> f64 {
        self.stated(bodies).friction.unwrap_or_else(|| {
            let [a, b] = bodies.map(|k| self.bodies[k].friction);
            (a * b).sqrt()
        })
    }

    /// The coefficient of static friction of two bodies, not below that of kinetic friction.
    pub fn static_friction(&self, bodies: [usize; 2]) -> f64 {
        let stated = self.stated(bodies);
        stated.static_friction.or(stated.friction).unwrap_or_else(|| {
            let own = |k: usize| self.bodies[k].static_friction.unwrap_or(self.bodies[k].friction);
            let [a, b] = bodies.map(own);
            (a * b).sqrt()
        })
    }

    /// The direction along which two bodies have their friction, if it differs across, and the body
    /// (of the scene) on which it is.
    ///
    /// ```
    /// use lcplab_mechanics::scene::Scene;
    ///
    /// let text = "
    ///     bodies = [
    ///         { name = 'ice', shape = { plane = [0, 0, 1] }, fixed = true, friction = 1 },
    ///         { name = 'ski', shape = { box = [1.7, 0.1, 0.02] }, mass = 5, friction = 0.04,
    ///           friction_direction = [1, 0, 0], friction_across = 0.36 },
    ///     ]";
    /// let scene = Scene::from_toml("ski", text)?;
    /// // Geometric means with the ice: 0.2 along the ski, 0.6 across it.
    /// let (body, surface) = scene.anisotropy([0, 1]).unwrap();
    /// assert_eq!((body, scene.friction([0, 1])), (1, 0.2));
    /// assert!((surface.ratio - 3.0).abs() < 1e-15);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn anisotropy(&self, [a, b]: [usize; 2]) -> Option<(usize, Anisotropy)> {
        let stated = self.stated([a, b]);
        if stated.friction.is_some() {
            return stated.anisotropy;
        }
        // The geometric means along and across the direction have the root of its ratio.
        let of = |k: usize| self.bodies[k].anisotropy.map(|own| (k, own));
        let (body, own) = of(a).or(of(b))?;
        Some((body, Anisotropy { ratio: own.ratio.sqrt(), ..own }))
    }

    /// Whether static friction is above friction anywhere.
    pub(crate) fn has_static_friction(&self) -> bool {
        let of_body = self
            .bodies
            .iter()
            .any(|body| body.static_friction.is_some_and(|own| own > body.friction));
        of_body || self.pairs.keys().any(|&pair| self.static_friction(pair) > self.friction(pair))
    }

    /// The coefficient of restitution of a pair; the world has no value of its own.
    pub fn restitution(&self, bodies: Bodies) -> f64 {
        let stated = match bodies {
            [Some(a), Some(b)] => self.stated([a, b]).restitution,
            _ => None,
        };
        let of = |body: Option<usize>| body.and_then(|k| self.bodies[k].restitution);
        match (stated, bodies.map(of)) {
            (Some(stated), _) => stated,
            (None, [None, None]) => self.contact.restitution,
            (None, pair) => {
                let [a, b] = pair.map(|own| own.unwrap_or(self.contact.restitution));
                (a * b).sqrt()
            }
        }
    }

    /// The values given for a pair, in either order.
    fn stated(&self, [a, b]: [usize; 2]) -> Surface {
        self.pairs.get(&[a.min(b), a.max(b)]).copied().unwrap_or_default()
    }
}

/// The coefficients of kinetic and static friction of a body, the latter if given.
pub(super) fn of_body(
    defects: &mut Defects,
    place: &str,
    body: &description::Body,
    usual: &Contacts,
) -> (f64, Option<f64>) {
    let friction = body.friction.unwrap_or(usual.friction);
    if body.friction.is_some() {
        range::coefficient(defects, format!("{place}.friction"), friction);
    }
    let stated = body.static_friction;
    if let Some(stated) = stated {
        check_static(defects, place, stated, friction);
    }
    let of_contacts = usual.static_friction.filter(|_| body.friction.is_none());
    (friction, stated.or(of_contacts))
}

/// Adds the values that the scene gives for a pair; a frame is a body's own, in the axes in which
/// its shape is given.
pub(super) fn add_pair(
    defects: &mut Defects,
    place: &str,
    pair: &description::Pair,
    names: &HashMap<&str, usize>,
    frames: &[Pose],
    scene: &mut Scene,
) {
    let mut index = |k: usize| {
        let name = pair.bodies[k].as_str();
        let found = names.get(name).copied();
        if found.is_none() {
            let reason = format!("there is no body named {name:?}");
            defects.add(format!("{place}.bodies[{k}]"), reason);
        }
        found
    };
    let (Some(a), Some(b)) = (index(0), index(1)) else { return };
    let key = [a.min(b), a.max(b)];
    if a == b {
        defects.add(format!("{place}.bodies"), "names one body twice");
    } else if scene.pairs.contains_key(&key) {
        defects.add(format!("{place}.bodies"), "has been stated before");
    }
    if let Some(friction) = pair.friction {
        range::coefficient(defects, format!("{place}.friction"), friction);
    }
    let fields = anisotropy::Fields {
        friction: pair.friction,
        across: pair.friction_across,
        direction: pair.friction_direction,
    };
    let anisotropy = fields.read(defects, place, &frames[a]).map(|own| (a, own));
    if let Some(restitution) = pair.restitution {
        within_one(defects, &format!("{place}.restitution"), restitution);
    }
    let description::Pair { friction, static_friction, restitution, without_contact, .. } = *pair;
    let surface = Surface { friction, static_friction, anisotropy, restitution, without_contact };
    scene.pairs.insert(key, surface);
    if let Some(stated) = static_friction {
        check_static(defects, place, stated, scene.friction(key));
    }
}

/// Marks the pairs of each body that touches nothing.
pub(super) fn separate(bodies: &[description::Body], scene: &mut Scene) {
    for (k, _) in bodies.iter().enumerate().filter(|(_, body)| body.without_contact) {
        for other in (0..bodies.len()).filter(|&other| other != k) {
            let key = [k.min(other), k.max(other)];
            scene.pairs.entry(key).or_default().without_contact = true;
        }
    }
}

/// Checks that static friction is not below friction, and that friction is above 0.
pub(super) fn check_static(defects: &mut Defects, place: &str, stated: f64, friction: f64) {
    let place = format!("{place}.static_friction");
    if !(stated.is_finite() && stated >= friction) {
        defects.add(place, format!("must be at least friction, {friction}, is {stated}"));
    } else if stated > 0.0 && friction == 0.0 {
        defects.add(place, "needs a friction above 0 for sliding contacts");
    } else {
        range::coefficient(defects, place, stated);
    }
}

/// Checks that the scheme and the friction model can distinguish sticking from sliding.
pub(super) fn check_scheme(defects: &mut Defects, scene: &Scene) {
    if !scene.has_static_friction() {
        return;
    }
    let scheme = scene.step.scheme;
    if scene.contact.model == Model::FrozenBox {
        let reason = "a frozen box is empty in the first step of a contact, so every contact would slide: static \
         friction is not supported";
        defects.add("contact.model", reason);
    }
    if !scheme.solves_lcps() && scheme != Scheme::SequentialImpulses {
        let reason = format!(
            "the scheme {} cannot decide which contacts stick, so it supports only one coefficient of friction",
            scheme.name()
        );
        defects.add("contact.static_friction", reason);
    }
}
