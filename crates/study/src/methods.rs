//! All methods that can be named and compared: the registered solvers and the reference.

#[cfg(feature = "clarabel")]
use super::clarabel;
use lcplab_problem::error::{Error, Result};
use lcplab_problem::friction::Model;
use lcplab_solver::{ALL, Entry, Method, SPECIMENS, added, methods};

/// One of each kind: sweeps, Newton, gradients, an interior point, two pivoting methods, sweeps for cones, and the
/// reference.
pub const USUAL: [&str; 8] =
    ["pgs", "newton", "apgd", "interior-point", "dantzig", "lemke", "cone-pgs", "clarabel"];

/// clarabel for boxes and for cones.
#[cfg(feature = "clarabel")]
const REFERENCE: [Method; 2] = [Method::Boxed(clarabel::BOX_QP), Method::Cone(clarabel::CONE_QP)];
#[cfg(not(feature = "clarabel"))]
const REFERENCE: [Method; 0] = [];

/// The registered methods, then clarabel for boxes and for cones; what was added is asked for by name.
pub fn all() -> Vec<Method> {
    methods().into_iter().chain(REFERENCE).collect()
}

/// All methods that have a name.
fn nameable() -> impl Iterator<Item = Method> {
    all().into_iter().chain(added().into_iter().copied().map(Method::Boxed))
}

/// The solver of this name for LCPs as they stand; the specimens and what was added count too.
///
/// # Errors
/// If there is none.
pub fn entry(name: &str) -> Result<Entry> {
    let added = added();
    let reference: Vec<Entry> = REFERENCE.into_iter().filter_map(boxed).collect();
    let entries = || ALL.iter().chain(&reference).chain(SPECIMENS).chain(added.iter().copied());
    let found = entries().find(|entry| entry.name == name).copied();
    found.ok_or_else(|| unknown("solver", name, entries().map(|entry| entry.name)))
}

/// The method of this name for a model of friction.
///
/// # Errors
/// If there is none.
pub fn by_name(name: &str, model: Model) -> Result<Method> {
    let taking = || nameable().filter(|method| method.takes(Some(model)));
    let found = taking().find(|method| method.name() == name);
    let kind = "solver for this model of friction";
    found.ok_or_else(|| unknown(kind, name, taking().map(|method| method.name())))
}

/// The method to take where none is named.
pub fn default_for(model: Model) -> &'static str {
    match model {
        Model::FrozenBox | Model::CoupledBox => "dantzig",
        Model::Polyhedral { .. } => "lemke",
        Model::AssociatedCone | Model::CoulombCone => "apgd",
    }
}

/// The methods of this name, for boxes and for cones.
///
/// # Errors
/// If there is none.
pub fn named(name: &str) -> Result<Vec<Method>> {
    let known = || nameable().chain(SPECIMENS.iter().copied().map(Method::Boxed));
    let found: Vec<Method> = known().filter(|method| method.name() == name).collect();
    if found.is_empty() {
        return Err(unknown("solver", name, known().map(|method| method.name())));
    }
    Ok(found)
}

fn boxed(method: Method) -> Option<Entry> {
    match method {
        Method::Boxed(entry) => Some(entry),
        Method::Cone(_) => None,
    }
}

fn unknown(kind: &'static str, name: &str, known: impl Iterator<Item = &'static str>) -> Error {
    let mut names: Vec<String> = Vec::new();
    for known in known.map(str::to_string) {
        if !names.contains(&known) {
            names.push(known);
        }
    }
    Error::Unknown { kind, name: name.to_string(), known: names }
}
