//! Whether M is positive definite.

use super::finding::{Finding, Stage};
use super::step::{EngineStep, MassFactor};

/// What is not checked in a step without a positive definite M.
pub(crate) const REST: &str = "everything else, because M is not positive definite";

/// The body, or block of bodies, for which M is not positive definite; `step` has finite numbers.
pub(crate) fn first_not_definite(step: &EngineStep) -> Option<Finding> {
    let k = step.gauss.target.len();
    let mut diagonal = vec![0.0; k];
    let own = step.gauss.mass.iter().filter(|(i, j, _)| i == j);
    own.for_each(|&(i, _, value)| diagonal[i] = value);
    let of_diagonal = diagonal.iter().position(|&value| value <= 0.0).map(|dof| {
        let value = diagonal[dof];
        (dof, format!("M is not positive definite: mass[{dof}, {dof}] is {value}"))
    });
    let (dof, what) = of_diagonal.or_else(|| {
        let dof = MassFactor::first_not_definite(&step.gauss.mass, k)?;
        Some((dof, format!("M is not positive definite in the block of degree of freedom {dof}")))
    })?;
    let bodies = step.dof_bodies.get(dof).cloned().into_iter().collect();
    Some(Finding { bodies, ..Finding::new(Stage::Assembly, what, f64::INFINITY, 0.0) })
}
