//! The methods that can be explained line by line.

use lcplab_judge::Demand;
use lcplab_lcp::error::{Error, Result};
use lcplab_solver::{Dantzig, Lemke, Options, Pgs, Registry, Solver};

/// A method that reports step details, with its options.
///
/// ```
/// use lcplab_analysis::explain::{Method, steps};
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_solver::Options;
///
/// // Gauss-Seidel with at most three sweeps, in the second step.
/// let method = Method::with("pgs", Options::default().with_max_iterations(3))?;
/// assert_eq!(method.name(), "pgs");
/// let document = steps(&Scene::load("fig7")?, &method, 2..=2)?;
/// assert!(document.lead.contains("pgs ends without a solution (3 sweeps)"), "{}", document.lead);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Method {
    name: &'static str,
    options: Options,
}

impl Method {
    /// The names of these methods.
    pub const NAMES: [&'static str; 4] = [Pgs::NAME, Pgs::RELAXED, Dantzig::NAME, Lemke::NAME];

    /// The method with this name.
    ///
    /// # Errors
    /// If it is not one of [`Method::NAMES`].
    pub fn named(name: &str) -> Result<Self> {
        Self::with(name, Options::default())
    }

    /// The method with this name and these options.
    ///
    /// # Errors
    /// If no method has this name, or an option is invalid.
    pub fn with(name: &str, options: Options) -> Result<Self> {
        options.validate()?;
        let known = Self::NAMES.into_iter().find(|known| *known == name);
        let name = known.ok_or_else(|| Error::Unknown {
            kind: "solver with a derivation",
            name: name.into(),
            known: Self::NAMES.map(String::from).to_vec(),
        })?;
        Ok(Method { name, options })
    }

    /// Its name in the registry.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The solver.
    pub(super) fn solver(&self) -> Result<Box<dyn Solver>> {
        Registry::standard().entry(self.name)?.solver(&self.options)
    }

    /// The same options, for other solvers.
    pub(super) fn options(&self) -> &Options {
        &self.options
    }

    /// The judge's demand.
    pub(super) fn demand(&self) -> Demand {
        Demand { tolerance: self.options.settings.tolerance, ..Demand::default() }
    }

    /// Lemke's method instead of one for symmetric A.
    pub(super) fn for_any_matrix(&self) -> Self {
        Method { name: Lemke::NAME, options: self.options.clone() }
    }
}
