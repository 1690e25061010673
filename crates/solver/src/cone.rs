//! Methods for circular friction cones, with their own trait.
//!
//! They differ from box solvers only in the feasible set: they project onto a cone instead of an
//! interval. Under [`Law::Associated`] both are descent methods for the same convex problem. Under
//! [`Law::Coulomb`] one freezes the De Saxcé shift, the other updates it in every sweep.

use std::sync::{PoisonError, RwLock};

use super::{Apgd, Class, ConePgs, Group, MatrixClass, Observer, Settings, Solution, Start};
use lcplab_problem::error::{Error, Result};
use lcplab_problem::friction::{ConeProblem, Law};

/// A method that solves friction problems with circular cones.
pub trait ConeSolver: Send + Sync {
    /// The name in the list [`CONES`].
    fn name(&self) -> &'static str;

    /// Solves the problem from a start and reports each iterate to the observer. Returns `Solved`
    /// only if the scaled residual
    /// ([`Complementarity::scaled_residual`](lcplab_problem::Complementarity::scaled_residual)) is
    /// within the tolerance.
    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution;
}

/// A cone solver in the list.
#[derive(Clone, Copy)]
pub struct ConeEntry {
    /// The name that selects it.
    pub name: &'static str,
    /// A one-line description of the method.
    pub method: &'static str,
    /// The class of A that it is made for.
    pub class: Class,
    /// The friction laws that it supports.
    pub laws: &'static [Law],
    /// What kind of method it is.
    pub group: Group,
    /// The source of the method.
    pub source: &'static str,
    /// Builds the solver.
    pub build: &'static ConeBuild,
}

/// A function that builds a cone solver with these settings.
pub type ConeBuild = dyn Fn(&Settings) -> Box<dyn ConeSolver> + Send + Sync;

impl std::fmt::Debug for ConeEntry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ConeEntry { name, class, laws, .. } = self;
        f.debug_struct("ConeEntry")
            .field("name", name)
            .field("class", class)
            .field("laws", laws)
            .finish()
    }
}

/// Both laws.
const BOTH: &[Law] = &[Law::Associated, Law::Coulomb];

/// All built-in cone solvers.
pub const CONES: &[ConeEntry] = &[
    ConeEntry {
        name: "cone-pgs",
        method: "projected Gauss-Seidel by contacts, iterative",
        class: Class::of(MatrixClass::Semidefinite),
        laws: BOTH,
        group: Group::Sweeps,
        source: "De Saxcé & Feng 1991; Tasora & Anitescu 2011",
        build: &|settings| Box::new(ConePgs { settings: settings.clone() }),
    },
    ConeEntry {
        name: "apgd",
        method: "accelerated projected gradients with restart, De Saxcé's shift updated between solves, iterative",
        class: Class::of(MatrixClass::Semidefinite).with_positive_diagonal(),
        laws: BOTH,
        group: Group::FirstOrder,
        source: "Mazhar, Heyn, Negrut & Tasora 2015; Acary, Cadoux, Lemaréchal & Malick 2011",
        build: &|settings| Box::new(Apgd { settings: settings.clone() }),
    },
];

/// Cone solvers that were added at run time.
static ADDED: RwLock<Vec<ConeEntry>> = RwLock::new(Vec::new());

/// Adds a cone solver, which can then be selected by name until the program ends.
///
/// # Errors
/// If a cone solver already has this name.
pub fn add_cone(entry: ConeEntry) -> Result<()> {
    let mut added = ADDED.write().unwrap_or_else(PoisonError::into_inner);
    if CONES.iter().chain(&*added).any(|known| known.name == entry.name) {
        let reason = format!("there is a cone solver named {:?} already", entry.name);
        return Err(Error::invalid("solvers", "name", reason));
    }
    added.push(entry);
    Ok(())
}

/// The cone solvers that were added at run time.
pub fn added_cones() -> Vec<ConeEntry> {
    ADDED.read().unwrap_or_else(PoisonError::into_inner).clone()
}

/// The cone solver with this name.
///
/// # Errors
/// If no cone solver has this name, or a setting is invalid.
pub fn cone_by_name(name: &str, settings: &Settings) -> Result<Box<dyn ConeSolver>> {
    settings.validate()?;
    let entry = CONES.iter().find(|entry| entry.name == name).ok_or_else(|| Error::Unknown {
        kind: "cone solver",
        name: name.to_string(),
        known: CONES.iter().map(|entry| entry.name.to_string()).collect(),
    })?;
    Ok((entry.build)(settings))
}
