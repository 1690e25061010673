//! A rope around a post, pulled at both ends. The scene `capstan`.
//!
//! Points on the post's circle, with an angle δ per link; c = cos(δ/2), s = sin(δ/2). A link's
//! tension T has the component c along the post and s into it. A point between two links, with
//! friction μ N against its motion and the acceleration a along the post, therefore has
//!
//! ```text
//! N = (T + T⁺) s,   T⁺ c − T c − μ N = m a   ⇒   T⁺ = (T (c + μ s) + m a)/(c − μ s)
//! ```
//!
//! and each end, which is pulled along the post itself, has one of the two factors once. At the
//! limit of sliding from rest (a = 0) the ratio of the tensions is ((1 + μ tan δ/2)/(1 − μ tan
//! δ/2))^n, Euler's e^(μ n δ) for short links.

use std::iter;

use crate::scene::Contacts;
use crate::scene::description::{Body, Capsule, Constraint, Description, Rotation, Shape};

/// The rope.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::scene::catalogue::capstan::Capstan;
///
/// // Half a turn of 1000 short links: Euler's e^(μ π), nearly.
/// let rope =
///     Capstan { links: 1000, angle: std::f64::consts::PI, friction: 0.5, mass: 1e-3 };
/// let euler = (0.5 * std::f64::consts::PI).exp();
/// assert!((rope.ratio() / euler - 1.0).abs() < 1e-5);
/// // At the limit nothing accelerates.
/// assert!(rope.acceleration(1.0, rope.ratio()).abs() < 1e-9);
/// assert!(rope.acceleration(1.0, 2.0 * rope.ratio()) > 0.0);
/// let short = Capstan { links: 4, ..rope };
/// let scene = Scene::new("capstan", &short.description(1.0, 2.0))?;
/// assert_eq!((scene.bodies.len(), scene.constraints.len()), (6, 4)); // the post, five points
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capstan {
    /// The number of links n.
    pub links: u32,
    /// The wrap angle n δ (rad).
    pub angle: f64,
    /// μ.
    pub friction: f64,
    /// The mass (kg) of each of its n + 1 points.
    pub mass: f64,
}

impl Capstan {
    /// The largest ratio of the two pulls without sliding.
    pub fn ratio(&self) -> f64 {
        self.pull(1.0, 0.0)
    }

    /// The acceleration (m/s²) along the post, from rest, for the pulls (N) `weak` and `strong`, if
    /// the strong one wins.
    pub fn acceleration(&self, weak: f64, strong: f64) -> f64 {
        let [at_rest, slope] = [self.pull(weak, 0.0), self.pull(0.0, 1.0)];
        (strong - at_rest) / slope
    }

    /// The rope at rest around a post of radius 1 m along y, its first point at −x, pulled with
    /// these forces (N). Points do not collide with each other, so several turns can lie in one
    /// plane.
    pub fn description(&self, weak: f64, strong: f64) -> Description {
        let step = self.angle / f64::from(self.links);
        let name = |k: u32| format!("p{k}");
        let point = |k: u32| {
            let (sin, cos) = libm::sincos(step * f64::from(k));
            let pull = |force: f64| [-force * sin, 0.0, -force * cos];
            let force = match k {
                0 => pull(weak),
                k if k == self.links => pull(-strong),
                _ => [0.0; 3],
            };
            let position = [-cos, 0.0, sin];
            Body { name: name(k), mass: Some(self.mass), position, force, ..Body::default() }
        };
        let link = |k: u32| Constraint {
            kind: "distance".into(),
            bodies: vec![name(k), name(k + 1)],
            ..Constraint::default()
        };
        let post = Body {
            name: "post".into(),
            fixed: true,
            shape: Shape::Capsule(Capsule { length: 1.0, radius: 1.0 }),
            rotation: Some(Rotation::X(90.0)),
            ..Body::default()
        };
        Description {
            title: "A rope around a post, pulled at both ends".into(),
            gravity: [0.0; 3],
            contact: Contacts { friction: self.friction, ..Contacts::default() },
            bodies: iter::once(post).chain((0..=self.links).map(point)).collect(),
            constraints: (0..self.links).map(link).collect(),
            ..Description::default()
        }
    }

    /// The strong pull (N) for a weak pull and an acceleration (m/s²).
    fn pull(&self, weak: f64, acceleration: f64) -> f64 {
        let (sin, cos) = (0.5 * self.angle / f64::from(self.links)).sin_cos();
        let (gains, loses) = (cos + self.friction * sin, cos - self.friction * sin);
        let inertia = self.mass * acceleration;
        let first = (weak + inertia) / loses;
        let last = (1..self.links).fold(first, |pull, _| (pull * gains + inertia) / loses);
        last * gains + inertia
    }
}
