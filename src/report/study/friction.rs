//! One friction problem under all models, each with a suitable solver; each answer is judged.
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

use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::judge::Demand;
use crate::lcp::friction::FrictionProblem;
use crate::report::friction::JudgedAnswer;
use crate::report::methods::{default_for, with_reference};
use crate::report::study::trial::Trial;
use crate::solver::{Options, Settings};

pub use crate::lcp::friction::Model;
pub use crate::report::friction::ContactAnswer;

/// A solver's answer to a problem under a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The model.
    pub model: Model,
    /// The solver.
    pub solver: String,
    /// Its claim.
    pub status: String,
    /// The number of iterations or pivots.
    pub iterations: usize,
    /// The impulses x, one entry per row of the friction problem.
    pub x: Vec<f64>,
    /// The contacts one by one.
    pub contacts: Vec<ContactAnswer>,
    /// The judge's verdict on x as a solution of the model's own problem.
    pub verdict: String,
    /// The scaled residual that it is based on.
    pub scaled_residual: f64,
    /// The scaled residual of x in Coulomb's law: the error of the model.
    pub coulomb_residual: f64,
}

/// Solves a friction problem under each of these models. Model 1 freezes its boxes at the normal
/// impulses without friction.
///
/// # Errors
/// If the settings or a model's number of directions are invalid.
pub fn compare(
    problem: &FrictionProblem,
    models: &[Model],
    settings: &Settings,
) -> Result<Vec<Answer>> {
    let options = Options::default().with_settings(settings.clone());
    options.validate()?;
    models.iter().map(|&model| answer(problem, model, &options)).collect()
}

fn answer(problem: &FrictionProblem, model: Model, options: &Options) -> Result<Answer> {
    let method = with_reference().method(default_for(model), Some(model))?;
    let frozen_at = match model {
        Model::FrozenBox => {
            let unbraked = model.pose(problem, Some(&vec![0.0; problem.lcp().len()]))?;
            Some(Trial::run(method, &unbraked, options, &mut ()).solution.x)
        }
        _ => None,
    };
    let posed = model.pose(problem, frozen_at.as_deref())?;
    let solution = Trial::run(method, &posed, options, &mut ()).solution;
    let judged = JudgedAnswer::at_contacts(problem, &posed, &solution.x, &Demand::default());
    Ok(Answer {
        model,
        solver: method.name().to_string(),
        status: solution.status.to_string(),
        iterations: solution.iterations,
        contacts: judged.contacts,
        verdict: judged.certificate.verdict.word().to_string(),
        scaled_residual: judged.certificate.scaled_residual,
        coulomb_residual: judged.coulomb_residual,
        x: solution.x,
    })
}
