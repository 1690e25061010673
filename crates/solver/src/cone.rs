//! Methods for circular friction cones, behind a trait of their own.
//!
//! They differ from the others in the feasible set alone: the nearest point of a cone takes the
//! place of the nearest point of an interval. Under [`Law::Associated`] both are descent methods
//! for the same convex problem, under [`Law::Coulomb`] one freezes the De Saxcé shift and one
//! carries it along.

use std::sync::{PoisonError, RwLock};

use super::{Apgd, Class, ConePgs, Group, MatrixClass, Observer, Settings, Solution, Start};
use lcplab_problem::error::{Error, Result};
use lcplab_problem::friction::{ConeProblem, Law};

/// A method that solves friction problems with circular cones.
pub trait ConeSolver: Send + Sync {
    /// The name in the list [`CONES`].
    fn name(&self) -> &'static str;

    /// Solves the problem from a start, telling the observer of each iterate. `Solved` is claimed
    /// for a scaled residual
    /// ([`Complementarity::scaled_residual`](lcplab_problem::Complementarity::scaled_residual))
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
    /// The name to choose it by.
    pub name: &'static str,
    /// The method in one line.
    pub method: &'static str,
    /// For which A it is made.
    pub class: Class,
    /// Under which laws.
    pub laws: &'static [Law],
    /// What kind of method it is.
    pub group: Group,
    /// Where it comes from.
    pub source: &'static str,
    /// Makes one.
    pub build: &'static ConeBuild,
}

/// Makes a cone solver with these settings.
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

/// All cone solvers.
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
        method: "accelerated projected gradients with restart, shift frozen, iterative",
        class: Class::of(MatrixClass::Semidefinite).with_positive_diagonal(),
        laws: BOTH,
        group: Group::FirstOrder,
        source: "Mazhar, Heyn, Negrut & Tasora 2015; Acary, Cadoux, Lemaréchal & Malick 2011",
        build: &|settings| Box::new(Apgd { settings: settings.clone() }),
    },
];

/// What was added to the list while the program ran.
static ADDED: RwLock<Vec<ConeEntry>> = RwLock::new(Vec::new());

/// Adds a cone solver, so that it can be named wherever one is; it stays until the program ends.
///
/// # Errors
/// If there is one of this name.
pub fn add_cone(entry: ConeEntry) -> Result<()> {
    let mut added = ADDED.write().unwrap_or_else(PoisonError::into_inner);
    if CONES.iter().chain(&*added).any(|known| known.name == entry.name) {
        let reason = format!("there is a cone solver named {:?} already", entry.name);
        return Err(Error::invalid("solvers", "name", reason));
    }
    added.push(entry);
    Ok(())
}

/// The cone solvers that were added.
pub fn added_cones() -> Vec<ConeEntry> {
    ADDED.read().unwrap_or_else(PoisonError::into_inner).clone()
}

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
