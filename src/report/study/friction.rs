//! One friction problem under all models, each by the solver that fits, each answer judged.
//!
//! ```
//! use lcplab::lcp::friction::{Contact, FrictionProblem};
//! use lcplab::lcp::{Lcp, Matrix};
//! use lcplab::report::study::friction::{Model, compare};
//! use lcplab::solver::Settings;
//!
//! // A unit mass, pressed with 2 N s, pushed at 45° to the tangents with 3 N s; μ = ½.
//! let a = Matrix::dense(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
//! let push = 3.0 * 0.5f64.sqrt();
//! let (lo, hi) = (vec![0.0, -f64::INFINITY, -f64::INFINITY], vec![f64::INFINITY; 3]);
//! let lcp = Lcp::new(a, vec![-2.0, -push, -push], lo, hi)?;
//! let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
//!
//! let models = [Model::CoupledBox, Model::CoulombCone];
//! let answers = compare(&problem, &models, &Settings::default())?;
//! let strength = |k: usize| answers[k].contacts[0].strength.unwrap();
//! assert!((strength(0) - 2f64.sqrt()).abs() < 1e-7); // 41 % too much
//! assert!((strength(1) - 1.0).abs() < 1e-7);
//! # Ok::<(), lcplab::error::Error>(())
//! ```

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::certificate::{Demand, Verdict, judge, judge_cone};
use crate::error::Result;
use crate::lcp::Lcp;
use crate::lcp::friction::{ConeProblem, Contact, FrictionProblem, Law, Polyhedral};
use crate::lcp::merit::RowTerms;
use crate::solver::{Options, Settings, Solution, Start, by_name, cone_by_name};

/// A contact slides if |w_t| is above this part of the terms it is the sum of.
const SLIP: f64 = 1e-6;

/// A model of friction, see [`lcp::friction`](crate::lcp::friction).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Model {
    /// 1: a box frozen at the normal impulses that there would be without friction.
    FrozenBox,
    /// 2: a box of half-width μ x_n.
    CoupledBox,
    /// 3: a polygon.
    Polyhedral {
        /// Its corners.
        directions: usize,
    },
    /// 4a: the disc, as a convex problem.
    AssociatedCone,
    /// 4b: the disc, Coulomb's law.
    CoulombCone,
}

impl Model {
    /// All models, polygons with 4, 8 and 16 corners.
    pub const ALL: [Model; 7] = [
        Model::FrozenBox,
        Model::CoupledBox,
        Model::Polyhedral { directions: 4 },
        Model::Polyhedral { directions: 8 },
        Model::Polyhedral { directions: 16 },
        Model::AssociatedCone,
        Model::CoulombCone,
    ];
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Model::FrozenBox => write!(f, "frozen box"),
            Model::CoupledBox => write!(f, "coupled box"),
            Model::Polyhedral { directions } => write!(f, "polygon of {directions}"),
            Model::AssociatedCone => write!(f, "cone, associated"),
            Model::CoulombCone => write!(f, "cone, Coulomb"),
        }
    }
}

/// What a model makes of a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The model.
    pub model: Model,
    /// The solver.
    pub solver: String,
    /// Its claim.
    pub status: String,
    /// Its iterations or pivots.
    pub iterations: usize,
    /// The impulses x, an entry a row of the friction problem.
    pub x: Vec<f64>,
    /// The contacts one by one.
    pub contacts: Vec<ContactAnswer>,
    /// The judge's word on x as a solution of the model's own problem.
    pub verdict: String,
    /// The scaled residual it is based on.
    pub scaled_residual: f64,
    /// The scaled residual of x in Coulomb's law: what the model gives up.
    pub coulomb_residual: f64,
}

/// One contact in an answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactAnswer {
    /// x_n, x_t1, x_t2.
    pub impulse: [f64; 3],
    /// w_n, w_t1, w_t2: while it slides, (w_t1, w_t2) is the slip.
    pub velocity: [f64; 3],
    /// |x_t| / (μ x_n): at most 1 in the disc; `None` if μ x_n = 0.
    pub strength: Option<f64>,
    /// The angle (degrees) between friction and the direction opposite to the slip; `None` if the
    /// contact does not slide, or has no friction.
    pub misalignment: Option<f64>,
}

/// Solves a friction problem under each of these models.
///
/// # Errors
/// If the settings cannot be used, or a model's number of directions.
pub fn compare(
    problem: &FrictionProblem,
    models: &[Model],
    settings: &Settings,
) -> Result<Vec<Answer>> {
    models.iter().map(|&model| answer(problem, model, settings)).collect()
}

/// A model's solution for the unknowns of the friction problem.
struct Judged {
    solver: &'static str,
    solution: Solution,
    verdict: Verdict,
    scaled_residual: f64,
}

fn answer(problem: &FrictionProblem, model: Model, settings: &Settings) -> Result<Answer> {
    let judged = match model {
        Model::FrozenBox => {
            let unbraked = problem.frozen_box(&vec![0.0; problem.contacts().len()]);
            let x = by_lcp(&unbraked, "dantzig", settings)?.solution.x;
            let normal: Vec<f64> = problem.contacts().iter().map(|c| x[c.rows[0]]).collect();
            by_lcp(&problem.frozen_box(&normal), "dantzig", settings)?
        }
        Model::CoupledBox => by_lcp(&problem.coupled_box(), "dantzig", settings)?,
        Model::Polyhedral { directions } => {
            let polyhedral = Polyhedral::new(problem, directions)?;
            let mut judged = by_lcp(polyhedral.lcp(), "lemke", settings)?;
            judged.solution.x = polyhedral.x(&judged.solution.x);
            judged
        }
        Model::AssociatedCone => by_cone(problem, Law::Associated, settings)?,
        Model::CoulombCone => by_cone(problem, Law::Coulomb, settings)?,
    };
    let Judged { solver, solution: Solution { x, status, iterations, .. }, .. } = judged;
    let coulomb = ConeProblem::new(problem.clone(), Law::Coulomb);
    Ok(Answer {
        model,
        solver: solver.to_string(),
        status: status.to_string(),
        iterations,
        contacts: problem.contacts().iter().map(|c| contact(problem.lcp(), c, &x)).collect(),
        verdict: judged.verdict.word().to_string(),
        scaled_residual: judged.scaled_residual,
        coulomb_residual: judge_cone(&coulomb, &x, &Demand::default()).scaled_residual,
        x,
    })
}

fn by_lcp(lcp: &Lcp, solver: &'static str, settings: &Settings) -> Result<Judged> {
    let options = Options { settings: settings.clone(), ..Options::default() };
    let solution = by_name(solver, &options)?.solve(lcp, &Start::default(), &mut ());
    let certificate = judge(lcp, &solution.x, &Demand::default());
    let (verdict, scaled_residual) = (certificate.verdict, certificate.scaled_residual);
    Ok(Judged { solver, solution, verdict, scaled_residual })
}

fn by_cone(problem: &FrictionProblem, law: Law, settings: &Settings) -> Result<Judged> {
    let (problem, solver) = (ConeProblem::new(problem.clone(), law), "apgd");
    let solution = cone_by_name(solver, settings)?.solve(&problem, &Start::default(), &mut ());
    let certificate = judge_cone(&problem, &solution.x, &Demand::default());
    let (verdict, scaled_residual) = (certificate.verdict, certificate.scaled_residual);
    Ok(Judged { solver, solution, verdict, scaled_residual })
}

fn contact(lcp: &Lcp, contact: &Contact, x: &[f64]) -> ContactAnswer {
    let terms = contact.rows.map(|i| RowTerms::at(lcp, i, x));
    let (impulse, velocity) = (contact.of(x), terms.map(|row| row.w));
    let [x_n, x1, x2] = impulse;
    let [_, w1, w2] = velocity;
    let limit = contact.mu * x_n;
    let slides = w1.hypot(w2) > SLIP * terms[1].magnitude.hypot(terms[2].magnitude);
    let angle = f64::atan2(x1 * w2 - x2 * w1, -(x1 * w1 + x2 * w2)).abs().to_degrees();
    ContactAnswer {
        impulse,
        velocity,
        strength: (limit > 0.0).then(|| x1.hypot(x2) / limit),
        misalignment: (slides && x1.hypot(x2) > 0.0).then_some(angle),
    }
}
