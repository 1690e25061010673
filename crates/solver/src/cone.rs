//! Methods for circular friction cones, behind a trait of their own.
//!
//! They differ from the others in the feasible set alone: the nearest point of a cone takes the place
//! of the nearest point of an interval. Under [`Law::Associated`] both are descent methods for the same
//! convex problem, under [`Law::Coulomb`] one freezes the De Saxcé shift and one carries it along.
//!

use super::{Apgd, Class, ConePgs, MatrixClass, Observer, Settings, Solution, Start};
use lcplab_problem::error::{Error, Result};
use lcplab_problem::friction::{ConeProblem, Law};

/// A method that solves friction problems with circular cones.
pub trait ConeSolver: Send + Sync {
    /// The name in the list [`CONES`].
    fn name(&self) -> &'static str;

    /// Solves the problem from a start, telling the observer of each iterate. `Solved` is claimed
    /// for a scaled residual
    /// ([`Complementarity::scaled_residual`](lcplab_problem::Complementarity::scaled_residual)) within
    /// the tolerance.
    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution;
}

/// A cone solver in the list.
#[derive(Debug, Clone, Copy)]
pub struct ConeEntry {
    /// The name to choose it by.
    pub name: &'static str,
    /// The method in one line.
    pub method: &'static str,
    /// For which A it is made.
    pub class: Class,
    /// Under which laws.
    pub laws: &'static [Law],
    /// Where it comes from.
    pub source: &'static str,
    /// Makes one.
    pub build: fn(&Settings) -> Box<dyn ConeSolver>,
}

/// Both laws.
const BOTH: &[Law] = &[Law::Associated, Law::Coulomb];

/// All cone solvers.
pub const CONES: &[ConeEntry] = &[
    ConeEntry {
        name: "cone-pgs",
        method: "projected Gauss-Seidel by contacts, iterative",
        class: Class::of(MatrixClass::Semidefinite),
        laws: BOTH,
        source: "De Saxcé & Feng 1991; Tasora & Anitescu 2011",
        build: |settings| Box::new(ConePgs { settings: settings.clone() }),
    },
    ConeEntry {
        name: "apgd",
        method: "accelerated projected gradients with restart, shift frozen, iterative",
        class: Class::of(MatrixClass::Semidefinite).with_positive_diagonal(),
        laws: BOTH,
        source: "Mazhar, Heyn, Negrut & Tasora 2015; Acary, Cadoux, Lemaréchal & Malick 2011",
        build: |settings| Box::new(Apgd { settings: settings.clone() }),
    },
];

/// The cone solver of this name.
///
/// # Errors
/// If there is none, or a setting cannot be used.
pub fn cone_by_name(name: &str, settings: &Settings) -> Result<Box<dyn ConeSolver>> {
    settings.validate()?;
    let entry = CONES.iter().find(|entry| entry.name == name).ok_or_else(|| Error::Unknown {
        kind: "cone solver",
        name: name.to_string(),
        known: CONES.iter().map(|entry| entry.name.to_string()).collect(),
    })?;
    Ok((entry.build)(settings))
}
