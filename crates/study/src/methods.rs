//! All methods that can be named and compared: the registered solvers and the reference.

#[cfg(feature = "clarabel")]
use super::clarabel;
use lcplab_problem::error::{Error, Result};
use lcplab_problem::friction::{Form, Model};
use lcplab_solver::{ALL, Entry, KNOWN_WRONG, Method, added, methods};

/// One method of each kind: sweeps, Newton, gradients, an interior point, two pivoting methods,
/// sweeps for cones, and the reference.
pub const USUAL: [&str; 8] =
    ["pgs", "newton", "apgd", "interior-point", "dantzig", "lemke", "cone-pgs", "clarabel"];

/// clarabel for boxes and for cones.
#[cfg(feature = "clarabel")]
const REFERENCE: [Method; 2] = [Method::Boxed(clarabel::BOX_QP), Method::Cone(clarabel::CONE_QP)];
#[cfg(not(feature = "clarabel"))]
const REFERENCE: [Method; 0] = [];

/// The registered methods, then clarabel for boxes and for cones; methods added at run time must be
/// named.
pub fn all() -> Vec<Method> {
    methods().into_iter().chain(REFERENCE).collect()
}

/// All methods that have a name.
fn nameable() -> impl Iterator<Item = Method> {
    lcplab_solver::nameable().into_iter().chain(REFERENCE)
}

/// The solver with this name for plain LCPs, including known-wrong variants and those added at run
/// time.
///
/// # Errors
/// If no solver has this name.
pub fn entry(name: &str) -> Result<Entry> {
    let added = added();
    let reference: Vec<Entry> = REFERENCE.into_iter().filter_map(boxed).collect();
    let entries = || ALL.iter().chain(&reference).chain(KNOWN_WRONG).chain(added.iter().copied());
    if let Some(found) = entries().find(|entry| entry.name == name) {
        return Ok(*found);
    }
    Err(match refusal(name, None) {
        Some(reason) => Error::invalid(format!("solver {name}"), "model", reason),
        None => unknown("solver", name, entries().map(|entry| entry.name)),
    })
}

/// The solvers with these names for plain LCPs; all registered ones if the list is empty.
///
/// # Errors
/// If no solver has one of the names.
pub fn entries(names: &[String]) -> Result<Vec<Entry>> {
    if names.is_empty() {
        return Ok(ALL.to_vec());
    }
    names.iter().map(|name| lcplab_solver::entry(name).copied()).collect()
}

/// The method with this name for a friction model.
///
/// # Errors
/// If no method has this name, or it is not made for the model; the error gives the reason.
pub fn by_name(name: &str, model: Model) -> Result<Method> {
    let taking = || nameable().filter(|method| method.takes(Some(model)));
    if let Some(found) = taking().find(|method| method.name() == name) {
        return Ok(found);
    }
    let names = distinct(taking().map(|method| method.name()));
    Err(match refusal(name, Some(model)) {
        Some(reason) => {
            let reason = format!("{reason}; these solve it: {}", names.join(", "));
            Error::invalid(format!("solver {name}"), "model", reason)
        }
        None => {
            let kind = "solver for this friction model";
            Error::Unknown { kind, name: name.to_string(), known: names }
        }
    })
}

/// Why the methods with this name are not made for a model; `None` if there is no such name, or one
/// of them is.
fn refusal(name: &str, model: Option<Model>) -> Option<String> {
    let known_wrong = KNOWN_WRONG.iter().copied().map(Method::Boxed);
    let named: Vec<Method> =
        nameable().chain(known_wrong).filter(|method| method.name() == name).collect();
    why_none_takes(&named, model)
}

/// Why none of these methods is made for a model; `None` if one of them is.
pub fn why_none_takes(methods: &[Method], model: Option<Model>) -> Option<String> {
    let refusals: Vec<String> = methods.iter().map_while(|method| method.refusal(model)).collect();
    let all_refuse = !methods.is_empty() && refusals.len() == methods.len();
    all_refuse.then(|| refusals.into_iter().next()).flatten()
}

/// The default method.
pub fn default_for(model: Model) -> &'static str {
    match model.form() {
        Form::Box => "dantzig",
        Form::Polygon { .. } => "lemke",
        Form::Cone(_) => "apgd",
    }
}

/// The methods with this name, for boxes and for cones.
///
/// # Errors
/// If no method has this name.
pub fn named(name: &str) -> Result<Vec<Method>> {
    let known = || nameable().chain(KNOWN_WRONG.iter().copied().map(Method::Boxed));
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
    Error::Unknown { kind, name: name.to_string(), known: distinct(known) }
}

fn distinct(names: impl Iterator<Item = &'static str>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for name in names.map(str::to_string) {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}
