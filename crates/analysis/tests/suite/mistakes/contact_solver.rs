//! Textbook sweeps contact by contact under boxes, polygons and cones, right or with mistakes; they
//! share nothing with the diagnosis.

use lcplab_lcp::friction::{ConeProblem, FrictionProblem, Law, Polyhedral, ProblemForm};

use super::plain::Plain;

/// The set that contains the friction of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    Box,
    Polygon,
    Disk,
}

pub const POLYGON: usize = 8;

impl Shape {
    pub const ALL: [Shape; 3] = [Shape::Box, Shape::Polygon, Shape::Disk];

    pub fn posed(self, problem: &Plain) -> ProblemForm {
        let lcp = problem.lcp();
        let friction = || FrictionProblem::of(&lcp).unwrap();
        match self {
            Shape::Box => ProblemForm::Boxed(lcp.clone()),
            Shape::Polygon => {
                ProblemForm::Polyhedral(Polyhedral::new(&friction(), POLYGON).unwrap())
            }
            Shape::Disk => ProblemForm::Cone(ConeProblem::new(friction(), Law::Coulomb)),
        }
    }

    /// The point of the set of this radius nearest to p.
    pub fn nearest(self, radius: f64, p: [f64; 2]) -> [f64; 2] {
        let radius = radius.max(0.0);
        let length = p[0].hypot(p[1]);
        match self {
            Shape::Box => p.map(|t| t.clamp(-radius, radius)),
            Shape::Disk if length <= radius => p,
            Shape::Disk => p.map(|t| radius / length * t),
            Shape::Polygon => {
                // The normal of edge k points to angle (k + 1/2) 2π/8.
                let turn = std::f64::consts::TAU / POLYGON as f64;
                let edge = (0..POLYGON).map(|k| {
                    let angle = (k as f64 + 0.5) * turn;
                    [angle.cos(), angle.sin()]
                });
                let (reach, half) = (radius * (turn / 2.0).cos(), radius * (turn / 2.0).sin());
                let out = |n: &[f64; 2]| n[0] * p[0] + n[1] * p[1] - reach;
                let Some(n) =
                    edge.filter(|n| out(n) > 0.0).max_by(|a, b| out(a).total_cmp(&out(b)))
                else {
                    return p;
                };
                let along = (n[0] * p[1] - n[1] * p[0]).clamp(-half, half);
                [reach * n[0] - along * n[1], reach * n[1] + along * n[0]]
            }
        }
    }
}

/// Where the radius of a contact's friction comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    Own,
    Next,
    FirstSweep,
    SweepBefore,
}

/// Gauss-Seidel, contact by contact, with the mistakes that are switched on.
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    pub shape: Shape,
    pub limit: Limit,
    pub clamps_increments: bool,
    pub clamps_at_end: bool,
    pub clamps_normals: bool,
    pub clamps_friction: bool,
    /// The step of both tangents: 1 / (a11 + a22), or one over the larger one.
    pub has_long_steps: bool,
}

impl Sweep {
    pub fn right(shape: Shape) -> Self {
        Sweep {
            shape,
            limit: Limit::Own,
            clamps_increments: false,
            clamps_at_end: false,
            clamps_normals: true,
            clamps_friction: true,
            has_long_steps: false,
        }
    }

    pub fn once(&self, problem: &Plain, x: &mut [f64], limits: Option<&[f64]>) {
        let count = x.len();
        let (free_normals, free_friction) = match self.clamps_at_end {
            true => (true, true),
            false => (!self.clamps_normals, !self.clamps_friction),
        };
        for n in (0..count).step_by(3) {
            let change = -problem.w(x, n) / problem.a[n][n];
            x[n] = match self.clamps_increments {
                _ if free_normals => x[n] + change,
                true => x[n] + change.max(0.0),
                false => (x[n] + change).max(0.0),
            };
            let mu = problem.friction[n + 1].map_or(0.0, |(_, mu)| mu);
            let of = if self.limit == Limit::Next { (n + 3) % count } else { n };
            let radius = mu * limits.map_or(x[of], |limits| limits[of]);
            let diagonal = [n + 1, n + 2].map(|i| problem.a[i][i]);
            if self.shape == Shape::Box {
                // Row by row.
                for t in [0, 1] {
                    let i = n + 1 + t;
                    let change = -problem.w(x, i) / diagonal[t];
                    let clamp = |value: f64| value.clamp(-radius.max(0.0), radius.max(0.0));
                    x[i] = match self.clamps_increments {
                        _ if free_friction => x[i] + change,
                        true => x[i] + clamp(change),
                        false => clamp(x[i] + change),
                    };
                }
                continue;
            }
            let step = match self.has_long_steps {
                true => diagonal[0].max(diagonal[1]),
                false => diagonal[0] + diagonal[1],
            };
            let change = [n + 1, n + 2].map(|i| -problem.w(x, i) / step);
            let sum = [x[n + 1] + change[0], x[n + 2] + change[1]];
            let new = match self.clamps_increments {
                _ if free_friction => sum,
                true => {
                    let clamped = self.shape.nearest(radius, change);
                    [x[n + 1] + clamped[0], x[n + 2] + clamped[1]]
                }
                false => self.shape.nearest(radius, sum),
            };
            (x[n + 1], x[n + 2]) = (new[0], new[1]);
        }
    }

    pub fn sweeps(&self, problem: &Plain, mut x: Vec<f64>, sweeps: usize) -> Option<Vec<f64>> {
        let mut limits = None;
        for sweep in 0..sweeps {
            let before = x.clone();
            if self.limit == Limit::SweepBefore {
                limits = Some(before.clone());
            }
            self.once(problem, &mut x, limits.as_deref());
            if self.limit == Limit::FirstSweep && sweep == 0 {
                limits = Some(x.clone());
            }
            let size = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let moved = x.iter().zip(&before).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            if moved <= 1e-16 * size {
                break;
            }
            if !size.is_finite() || sweep + 1 == CONVERGED {
                return None;
            }
        }
        if self.clamps_at_end {
            for n in (0..x.len()).step_by(3) {
                x[n] = x[n].max(0.0);
                let mu = problem.friction[n + 1].map_or(0.0, |(_, mu)| mu);
                let new = self.shape.nearest(mu * x[n], [x[n + 1], x[n + 2]]);
                (x[n + 1], x[n + 2]) = (new[0], new[1]);
            }
        }
        Some(x)
    }

    pub fn solved(&self, problem: &Plain) -> Option<Vec<f64>> {
        self.sweeps(problem, vec![0.0; problem.len()], CONVERGED)
    }
}

/// Sweeps after which an answer must not change any more.
pub const CONVERGED: usize = 40_000;

/// The largest entry of x.
pub fn size(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |most, x| most.max(x.abs()))
}
