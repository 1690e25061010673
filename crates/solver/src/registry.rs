//! The solvers by name. The command line, comparisons, reports and tests read a [`Registry`], so a
//! new solver needs only a file and an entry.
//!
//! [`Registry::standard`] has the solvers of this crate and never changes. A program that adds
//! solvers of its own makes a copy, adds them, and passes the copy on:
//!
//! ```
//! use lcplab_lcp::Lcp;
//! use lcplab_solver::{Dantzig, Entry, Method, Observer, Registry, Settings, Solution, Solver, Start};
//!
//! struct Mine(Settings);
//!
//! impl Solver for Mine {
//!     fn name(&self) -> &str {
//!         "mine"
//!     }
//!
//!     fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
//!         Dantzig { settings: self.0.clone() }.solve(lcp, start, observer)
//!     }
//! }
//!
//! let mut registry = Registry::default();
//! let mine = Entry::new("mine", |options| Box::new(Mine(options.settings.clone())));
//! registry.add(Method::Boxed(mine))?;
//! assert_eq!(registry.entry("mine")?.name, "mine");
//! assert!(Registry::standard().entry("mine").is_err());
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

use std::sync::{Arc, LazyLock};

use super::cone::CONES;
use super::sweep::KNOWN_WRONG;
use super::{ConeEntry, Dantzig, Entry, Lemke, Method, gradient, method, newton, pivot, sweep};
use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::friction::Model;

/// Solvers by name: those that a comparison runs if none is named, and others that must be named.
/// A copy shares its entries with the original until one of the two is changed.
///
/// ```
/// use lcplab_solver::{Dantzig, Entry, Method, Registry};
///
/// let standard = Registry::standard();
/// assert!(standard.entries().any(|entry| entry.name == "pgs"));
/// let cones: Vec<_> = standard.cone_entries().map(|entry| entry.name.as_ref()).collect();
/// assert_eq!(cones, ["cone-pgs", "apgd"]);
/// assert_eq!(standard.methods().count(), standard.entries().count() + cones.len());
/// let error = standard.unknown("psg").to_string();
/// assert!(error.starts_with("there is no solver named \"psg\"; there are pgs, "));
///
/// let mut own = standard.clone();
/// let build = |options: &lcplab_solver::Options| -> Box<dyn lcplab_solver::Solver> {
///     Box::new(Dantzig { settings: options.settings.clone() })
/// };
/// own.add_listed(Method::Boxed(Entry::new("mine", build)))?;
/// assert!(own.entries().any(|entry| entry.name == "mine")); // a comparison now runs it, too
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Registry {
    listed: Arc<Vec<Method>>,
    named: Arc<Vec<Method>>,
}

/// The solvers of this crate.
impl Default for Registry {
    fn default() -> Self {
        Registry::standard().clone()
    }
}

impl Registry {
    /// The solvers of this crate: for boxes group by group, for cones, and the known-wrong
    /// variants, which must be named.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_solver::{Options, Registry, Start, Status};
    ///
    /// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// let solver = Registry::standard().entry("dantzig")?.solver(&Options::default())?;
    /// let solution = solver.solve(&lcp, &Start::default(), &mut ());
    /// assert_eq!(solution.status, Status::Solved);
    /// assert_eq!(solution.x, [0.5, 0.0]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn standard() -> &'static Registry {
        static STANDARD: LazyLock<Registry> = LazyLock::new(|| {
            let groups = [sweep::ENTRIES, gradient::ENTRIES, newton::ENTRIES, pivot::ENTRIES];
            let boxed = groups.into_iter().flatten().cloned().map(Method::Boxed);
            let cones = CONES.iter().cloned().map(Method::Cone);
            Registry {
                listed: Arc::new(boxed.chain(cones).collect()),
                named: Arc::new(KNOWN_WRONG.iter().cloned().map(Method::Boxed).collect()),
            }
        });
        &STANDARD
    }

    /// Adds a method that comparisons run only if it is named.
    ///
    /// # Errors
    /// If the name is taken: for a boxed solver by any method, for a cone solver by another one.
    pub fn add(&mut self, method: Method) -> Result<()> {
        self.check_is_new(&method)?;
        Arc::make_mut(&mut self.named).push(method);
        Ok(())
    }

    /// Adds a method that comparisons also run if none is named.
    ///
    /// # Errors
    /// As [`Registry::add`].
    pub fn add_listed(&mut self, method: Method) -> Result<()> {
        self.check_is_new(&method)?;
        Arc::make_mut(&mut self.listed).push(method);
        Ok(())
    }

    fn check_is_new(&self, method: &Method) -> Result<()> {
        let is_boxed = matches!(method, Method::Boxed(_));
        let is_same = |known: &Method| {
            known.name() == method.name() && (is_boxed || matches!(known, Method::Cone(_)))
        };
        if self.all().any(is_same) {
            let kind = if is_boxed { "solver" } else { "cone solver" };
            let reason = format!("there is a {kind} named {:?} already", method.name());
            return Err(Error::invalid("solvers", "name", reason));
        }
        Ok(())
    }

    /// The methods that a comparison runs if none is named.
    pub fn methods(&self) -> impl Iterator<Item = &Method> {
        self.listed.iter()
    }

    /// All methods, including those that must be named.
    pub fn all(&self) -> impl Iterator<Item = &Method> {
        self.listed.iter().chain(self.named.iter())
    }

    /// The solvers of boxed LCPs among [`Registry::methods`].
    pub fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.methods().filter_map(Method::boxed)
    }

    /// The solvers of friction cones among [`Registry::methods`].
    pub fn cone_entries(&self) -> impl Iterator<Item = &ConeEntry> {
        self.methods().filter_map(|method| match method {
            Method::Cone(entry) => Some(entry),
            Method::Boxed(_) => None,
        })
    }

    /// The solver with this name for LCPs without friction cones.
    ///
    /// # Errors
    /// If no solver has this name; the error lists the names.
    pub fn entry(&self, name: &str) -> Result<&Entry> {
        let found = self.all().filter_map(Method::boxed).find(|entry| entry.name == name);
        found.ok_or_else(|| self.none_named(name, None))
    }

    /// The method with this name for a friction model, or for LCPs without friction.
    ///
    /// ```
    /// use lcplab_lcp::friction::Model;
    /// use lcplab_solver::{Method, Registry};
    ///
    /// let solvers = Registry::standard();
    /// assert!(matches!(solvers.method("apgd", None)?, Method::Boxed(_)));
    /// assert!(matches!(solvers.method("apgd", Some(Model::CoulombCone))?, Method::Cone(_)));
    /// assert_eq!(
    ///     solvers.method("pgs", Some(Model::CoulombCone)).unwrap_err().to_string(),
    ///     "solver pgs: model: it supports boxes, not coulomb-cone; these solve it: cone-pgs, apgd"
    /// );
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If no method has this name, or it is not made for the model; the error gives the reason.
    pub fn method(&self, name: &str, model: Option<Model>) -> Result<&Method> {
        let found = self.all().find(|method| method.name() == name && method.takes(model));
        found.ok_or_else(|| self.none_named(name, model))
    }

    /// The error for a name that no method has; it lists the names of all.
    pub fn unknown(&self, name: &str) -> Error {
        let known = distinct(self.all().map(Method::name));
        Error::Unknown { kind: "solver", name: name.into(), known }
    }

    /// Why no method of this name is made for the model.
    fn none_named(&self, name: &str, model: Option<Model>) -> Error {
        let taking = self.all().filter(|method| method.takes(model));
        let known = distinct(taking.map(Method::name));
        let named = self.all().filter(|method| method.name() == name);
        let refused = |reason: String| Error::invalid(format!("solver {name}"), "model", reason);
        match (method::why_none_takes(named, model), model) {
            (Some(reason), None) => refused(reason),
            (Some(reason), Some(_)) => {
                refused(format!("{reason}; these solve it: {}", known.join(", ")))
            }
            (None, None) => Error::Unknown { kind: "solver", name: name.into(), known },
            (None, Some(_)) => {
                let kind = "solver for this friction model";
                Error::Unknown { kind, name: name.into(), known }
            }
        }
    }
}

/// The names, each once.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for name in names {
        if !found.iter().any(|other| other == name) {
            found.push(name.to_string());
        }
    }
    found
}

/// The name of the default solver: Dantzig's method if A is symmetric up to rounding, otherwise
/// Lemke's.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::default_for;
///
/// let lcp = |a| Lcp::new(Matrix::from(a), vec![-1.0; 2], vec![0.0; 2], vec![9.0; 2]);
/// assert_eq!(default_for(&lcp([[2.0, 1.0], [1.0, 2.0]])?), "dantzig");
/// assert_eq!(default_for(&lcp([[2.0, 1.0], [0.0, 2.0]])?), "lemke");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn default_for(lcp: &Lcp) -> &'static str {
    if lcp.matrix().is_nearly_symmetric() { Dantzig::NAME } else { Lemke::NAME }
}
