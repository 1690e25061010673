//! A block that is pressed on the floor and pushed along it, under several friction models.

use lcplab_lcp::friction::{FrictionProblem, Model, ProblemForm};
use lcplab_lcp::{Coupling, Lcp, Matrix, hypot};
use lcplab_solver::{ConePgs, ConeSolver, Lemke, Pgs, Settings, Solver, Start, solve_polyhedral};
use serde::Deserialize;
use serde_json::{Value, json};

use super::Answer;
use super::trace::numbers;

/// Standard gravity (m/s²).
const G: f64 = 9.81;

/// A block of 1 kg, the impulse that presses it, and the friction that would hold it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PushedBlock {
    /// N s.
    press: f64,
    mu: f64,
    /// The friction that would hold it, along both tangents (N s).
    wanted: [f64; 2],
    /// Of the polygon.
    directions: usize,
}

impl PushedBlock {
    /// Under each model: x and w of the normal and both tangents.
    pub fn answer(&self) -> Answer {
        let problem = block(self.mu, self.press, self.wanted)?;
        let of = |model: Model| {
            let x = solved(model, &problem)?;
            let w = problem.lcp().w(&x);
            Ok(json!({ "model": model.to_string(), "x": numbers(&x), "w": numbers(&w) }))
        };
        let mut all = models(self.directions)?.to_vec();
        all.push(Model::AssociatedCone);
        let all: Result<Vec<Value>, String> = all.into_iter().map(of).collect();
        Ok(json!({ "models": all? }))
    }
}

/// The same block, sliding.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Slide {
    mu: f64,
    /// Along both tangents (m/s).
    speed: [f64; 2],
    directions: usize,
    /// s.
    dt: f64,
    steps: usize,
}

impl Slide {
    /// Under each model: the positions of the block (m), until it rests or the last step.
    pub fn answer(&self) -> Answer {
        if !(self.dt > 0.0 && self.dt.is_finite()) {
            return Err(format!("dt: must be positive, is {}", self.dt));
        }
        let path = |model: Model| {
            let (mut v, mut place, mut path) = (self.speed, [0.0; 2], vec![json!([0.0, 0.0])]);
            for _ in 0..self.steps.min(2_000) {
                let problem = block(self.mu, G * self.dt, v.map(|v| -v))?;
                let x = solved(model, &problem)?;
                v = [v[0] + x[1], v[1] + x[2]];
                if hypot(v[0], v[1]) < 1e-9 {
                    break;
                }
                place = [place[0] + self.dt * v[0], place[1] + self.dt * v[1]];
                path.push(numbers(&place));
            }
            Ok(json!({ "model": model.to_string(), "path": path }))
        };
        let paths: Result<Vec<Value>, String> =
            models(self.directions)?.into_iter().map(path).collect();
        Ok(json!({ "models": paths? }))
    }
}

fn models(directions: usize) -> Result<[Model; 3], String> {
    if directions == 0 || directions > 64 || !directions.is_multiple_of(4) {
        return Err(format!("directions: must be a multiple of 4, at most 64, is {directions}"));
    }
    Ok([Model::CoupledBox, Model::Polyhedral { directions }, Model::CoulombCone])
}

/// A = I, w = x − (press, wanted), |x_t| ≤ μ x_n.
fn block(mu: f64, press: f64, wanted: [f64; 2]) -> Result<FrictionProblem, String> {
    contact(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], mu, [-press, -wanted[0], -wanted[1]])
}

/// The problem of one contact.
pub fn contact(a: &[f64; 9], mu: f64, b: [f64; 3]) -> Result<FrictionProblem, String> {
    let no = f64::NEG_INFINITY;
    let posed =
        Lcp::new(Matrix::dense(3, a), b.to_vec(), vec![0.0, no, no], vec![f64::INFINITY; 3])
            .and_then(|lcp| {
                lcp.with_coupling(Coupling::new(vec![None, Some(0), Some(0)], vec![0.0, mu, mu])?)
            })
            .and_then(|lcp| FrictionProblem::of(&lcp));
    posed.map_err(|error| error.to_string())
}

/// x under a model, by a solver that supports it.
pub fn solved(model: Model, problem: &FrictionProblem) -> Result<Vec<f64>, String> {
    let settings = Settings::default().with_tolerance(1e-12);
    let start = Start::default();
    Ok(match model.pose(problem, None).map_err(|error| error.to_string())? {
        ProblemForm::Boxed(lcp) => {
            Pgs { omega: 1.0, order: Default::default(), settings }.solve(&lcp, &start, &mut ()).x
        }
        ProblemForm::Polyhedral(polygon) => {
            let tolerance = settings.tolerance;
            solve_polyhedral(&Lemke { settings }, &polygon, &start, tolerance, &mut ()).x
        }
        ProblemForm::Cone(cone) => ConePgs { settings }.solve(&cone, &start, &mut ()).x,
    })
}
