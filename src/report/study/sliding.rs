//! A block pushed from all sides and a rod on two feet, under each friction model.
//!
//! The block has unit mass and is pressed so that friction is at most μ x_n = 1 N s; its rows are
//! uncoupled, A = I. The friction is therefore the point allowed by the model that is nearest to
//! the push:
//!
//! ```text
//! box       the square |x_t1|, |x_t2| ≤ 1           corners at √2, 45° from the tangents
//! polygon   k corners on the circle, one at t1      edges at cos(π/k)
//! cone      the circle
//! ```
//!
//! The rod's rows are coupled: friction at one foot changes the load of both. The block of the
//! scene "sliding" takes a different path under each model, see [`slider`].

use std::f64::consts::{FRAC_PI_4, SQRT_2, TAU};

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::friction::{Answer, Model, compare};
use super::slider::{self, Path};
use crate::error::Result;
use crate::lcp::friction::{Contact, FrictionProblem};
use crate::lcp::{Lcp, Matrix};
use crate::solver::{Registry, Settings};

/// A block on the floor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The coefficient of friction, above 0.
    pub mu: f64,
    /// The push, in units of the friction limit; every model slides above √2.
    pub push: f64,
}

impl Study for Plan {
    const NAME: &'static str = "sliding";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec!["all".into()]
    }

    fn run(&self, _: usize, _: &Registry) -> Result<(Finding, ())> {
        Ok((run(self.mu, self.push)?, ()))
    }
}

/// The results for block and rod.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The coefficient of friction.
    pub mu: f64,
    /// The push on the sliding block, in N s; friction is at most 1 N s.
    pub push: f64,
    /// The sliding block, by model and direction of the push.
    pub slides: Vec<Slide>,
    /// The largest push without sliding, by model and direction.
    pub grips: Vec<Grip>,
    /// The rod, by model.
    pub rod: Vec<Answer>,
    /// The block of the scene "sliding", by model.
    pub paths: Vec<Path>,
}

/// The block, pushed hard enough to slide.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slide {
    /// Direction of the push from t1 (degrees).
    pub degrees: f64,
    /// The answer of the model's solver.
    pub answer: Answer,
    /// The expected answer.
    pub expected: Expected,
}

/// Friction on the sliding block from geometry alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Expected {
    /// |x_t| / (μ x_n).
    pub strength: f64,
    /// Angle between friction and the direction opposite to the slip (degrees).
    pub misalignment: f64,
    /// w_n (m/s): how fast the block rises.
    pub rise: f64,
}

/// The largest push that does not move the block.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Grip {
    /// The model.
    pub model: Model,
    /// Direction of the push from t1 (degrees).
    pub degrees: f64,
    /// Found by bisection (N s).
    pub measured: f64,
    /// The distance from the center to the edge of the model's figure in this direction (N s).
    pub expected: f64,
}

/// The models in the figures: on the block, all others coincide with one of these.
pub const SHOWN: [Model; 5] = [
    Model::CoupledBox,
    Model::Polyhedral { directions: 4 },
    Model::Polyhedral { directions: 8 },
    Model::Polyhedral { directions: 16 },
    Model::CoulombCone,
];

/// Number of bisections of [0, 2] N s in the search for a grip.
const HALVINGS: usize = 14;

/// The figure of allowed friction on the block: a regular polygon, or a disk.
#[derive(Debug, Clone, Copy)]
pub enum Figure {
    /// Corners at this distance from the center, the first at this angle from t1 (radians).
    Polygon {
        /// The number of corners.
        corners: usize,
        /// The distance of the corners.
        radius: f64,
        /// The angle of the first corner.
        first: f64,
    },
    /// The unit disk.
    Disc,
}

impl Figure {
    /// The figure of a model.
    pub fn of(model: Model) -> Self {
        match model {
            Model::FrozenBox | Model::CoupledBox => {
                Figure::Polygon { corners: 4, radius: SQRT_2, first: FRAC_PI_4 }
            }
            Model::Polyhedral { directions } => {
                Figure::Polygon { corners: directions, radius: 1.0, first: 0.0 }
            }
            Model::AssociatedCone | Model::CoulombCone => Figure::Disc,
        }
    }

    /// The distance from the center to the edge in this direction (radians).
    pub fn reach(self, angle: f64) -> f64 {
        match self {
            Figure::Polygon { corners, radius, first } => {
                let half = TAU / (2 * corners) as f64;
                let from_normal = (angle - first).rem_euclid(2.0 * half) - half;
                radius * half.cos() / from_normal.cos()
            }
            Figure::Disc => 1.0,
        }
    }

    /// The point of the figure nearest to a point outside.
    pub fn nearest(self, [p1, p2]: [f64; 2]) -> [f64; 2] {
        let Figure::Polygon { corners, radius, first } = self else {
            return [p1 / p1.hypot(p2), p2 / p1.hypot(p2)];
        };
        let corner = |k: usize| {
            let (sin, cos) = (first + TAU * k as f64 / corners as f64).sin_cos();
            [radius * cos, radius * sin]
        };
        let on_edge = |k: usize| {
            let ([a1, a2], [b1, b2]) = (corner(k), corner(k + 1));
            let (e1, e2) = (b1 - a1, b2 - a2);
            let along = ((p1 - a1) * e1 + (p2 - a2) * e2) / (e1 * e1 + e2 * e2);
            let along = along.clamp(0.0, 1.0);
            [a1 + along * e1, a2 + along * e2]
        };
        let distance = |x: &[f64; 2]| (p1 - x[0]).hypot(p2 - x[1]);
        let edges = (0..corners).map(on_edge);
        edges.min_by(|x, y| distance(x).total_cmp(&distance(y))).unwrap_or([0.0; 2])
    }
}

/// The angle between two directions in which the block is pushed (degrees).
pub const PUSH_ANGLE: f64 = 5.0;

/// Pushes the block, and drops the rod.
///
/// # Errors
/// If there is no problem with this μ, or the push is not finite.
pub fn run(mu: f64, push: f64) -> Result<Finding> {
    let settings = Settings::default().with_tolerance(1e-10);
    let pushes: Vec<(Model, f64)> = Model::ALL
        .iter()
        .flat_map(|&m| (0..=18).map(move |k| (m, PUSH_ANGLE * f64::from(k))))
        .collect();
    let slides = pushes.par_iter().map(|&(model, degrees)| {
        let answer = compare(&block(mu, push, degrees)?, &[model], &settings)?.remove(0);
        Ok(Slide { degrees, answer, expected: expected(model, mu, push, degrees) })
    });
    let directions: Vec<(Model, f64)> =
        SHOWN.iter().flat_map(|&m| (0..=12).map(move |k| (m, 7.5 * f64::from(k)))).collect();
    let grips = directions.par_iter().map(|&(model, degrees)| grip(model, mu, degrees, &settings));
    Ok(Finding {
        mu,
        push,
        slides: slides.collect::<Result<_>>()?,
        grips: grips.collect::<Result<_>>()?,
        rod: compare(&rod(mu)?, &Model::ALL, &settings)?,
        paths: slider::run(mu)?,
    })
}

/// A unit mass on the floor with μ x_n = 1 N s, pushed at an angle (degrees) to t1.
fn block(mu: f64, push: f64, degrees: f64) -> Result<FrictionProblem> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let a = Matrix::dense(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let lo = vec![0.0, f64::NEG_INFINITY, f64::NEG_INFINITY];
    let lcp = Lcp::new(a, vec![-1.0 / mu, -push * cos, -push * sin], lo, vec![f64::INFINITY; 3])?;
    FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu }])
}

fn expected(model: Model, mu: f64, push: f64, degrees: f64) -> Expected {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let p = [push * cos, push * sin];
    let x = Figure::of(model).nearest(p);
    let against_slip = [p[0] - x[0], p[1] - x[1]];
    let cross = x[0] * against_slip[1] - x[1] * against_slip[0];
    let dot = x[0] * against_slip[0] + x[1] * against_slip[1];
    // The associated law has a larger normal force: x_n − 1/μ = w_n = μ (push − μ x_n).
    let rise = match model {
        Model::AssociatedCone => mu * (push - 1.0) / (1.0 + mu * mu),
        _ => 0.0,
    };
    Expected { strength: x[0].hypot(x[1]), misalignment: cross.atan2(dot).abs().to_degrees(), rise }
}

fn grip(model: Model, mu: f64, degrees: f64, settings: &Settings) -> Result<Grip> {
    let (mut held, mut moved) = (0.0, 2.0);
    for _ in 0..HALVINGS {
        let push = (held + moved) / 2.0;
        let answer = compare(&block(mu, push, degrees)?, &[model], settings)?.remove(0);
        match answer.contacts[0].misalignment {
            None => held = push,
            Some(_) => moved = push,
        }
    }
    let expected = Figure::of(model).reach(degrees.to_radians());
    Ok(Grip { model, degrees, measured: (held + moved) / 2.0, expected })
}

/// A rod of mass 1 and radius of gyration ½ lies along t1 on its ends at ±1, its center ¼ above the
/// ground; it falls with 1 m/s, moves and rotates: two contacts, six rows, A = J M⁻¹ Jᵀ, b = J u.
fn rod(mu: f64) -> Result<FrictionProblem> {
    // Columns of J: v_n, v_t1, v_t2, and the rotations about t2 and n.
    let foot =
        |x: f64| [[1.0, 0.0, 0.0, -x, 0.0], [0.0, 1.0, 0.0, 0.25, 0.0], [0.0, 0.0, 1.0, 0.0, x]];
    let rows: Vec<[f64; 5]> = [foot(-1.0), foot(1.0)].concat();
    let inverse_mass = [1.0, 1.0, 1.0, 4.0, 4.0];
    let u = [-1.0, 0.7, 0.4, 0.3, 0.2];
    let entry =
        |r: &[f64; 5], s: &[f64; 5]| -> f64 { (0..5).map(|k| r[k] * inverse_mass[k] * s[k]).sum() };
    let a: Vec<f64> = rows.iter().flat_map(|r| rows.iter().map(|s| entry(r, s))).collect();
    let b = rows.iter().map(|r| (0..5).map(|k| r[k] * u[k]).sum()).collect();
    let lo = (0..6).map(|i| if i % 3 == 0 { 0.0 } else { f64::NEG_INFINITY }).collect();
    let lcp = Lcp::new(Matrix::dense(6, &a), b, lo, vec![f64::INFINITY; 6])?;
    let contact = |first| Contact { rows: [first, first + 1, first + 2], mu };
    FrictionProblem::new(lcp, vec![contact(0), contact(3)])
}
