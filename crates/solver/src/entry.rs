//! An entry of the registry: what a solver is made for, and how it is built.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use super::{Choice, Class, Cost, MatrixClass, Options, Solver};
use lcplab_lcp::error::Result;

/// A solver in the registry.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Entry, Options, Pgs, Start, Status};
///
/// // PGS with ten sweeps at most, whatever the options say.
/// let ten = Entry::new("ten", |options| {
///     let settings = options.settings.clone().with_max_iterations(10);
///     Box::new(Pgs { settings, ..Pgs::default() })
/// });
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let solution = ten.build(&Options::default()).solve(&lcp, &Start::default(), &mut ());
/// // A sweep reduces the error to a quarter: to 4⁻¹⁰ of it, not yet to 10⁻⁸.
/// assert_eq!((solution.status, solution.iterations), (Status::IterationLimit, 10));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Clone)]
#[non_exhaustive]
pub struct Entry {
    /// The name that selects it.
    pub name: Cow<'static, str>,
    /// A one-line description of the method.
    pub method: &'static str,
    /// The problem class it is made for.
    pub class: Class,
    /// What kind of method it is.
    pub group: Group,
    /// The cost of its iterations.
    pub cost: Cost,
    /// The source of the method.
    pub source: &'static str,
    /// The options that it uses in addition to the common settings.
    pub uses: &'static [Choice],
    /// Builds the solver.
    pub(crate) build: Build<Options, dyn Solver>,
}

impl Entry {
    /// A solver for any boxed LCP that is no method of this crate. Change the other fields as
    /// needed.
    pub fn new(
        name: impl Into<Cow<'static, str>>,
        build: impl Fn(&Options) -> Box<dyn Solver> + Send + Sync + 'static,
    ) -> Self {
        Entry {
            name: name.into(),
            method: "a user's solver",
            class: Class::of(MatrixClass::General),
            group: Group::Plugin,
            cost: Cost::UNKNOWN,
            source: "the user",
            uses: &[],
            build: Build::of(build),
        }
    }

    /// Builds the solver with these options, which [`Options::validate`] accepts.
    pub fn build(&self, options: &Options) -> Box<dyn Solver> {
        self.build.call(options)
    }

    /// Builds the solver with these options.
    ///
    /// ```
    /// use lcplab_solver::{Options, Registry};
    ///
    /// let entry = Registry::standard().entry("pgs")?;
    /// let mut options = Options::default();
    /// assert_eq!(entry.solver(&options)?.name(), "pgs");
    /// options.settings.tolerance = -1.0;
    /// assert!(entry.solver(&options).is_err());
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If an option is invalid.
    pub fn solver(&self, options: &Options) -> Result<Box<dyn Solver>> {
        options.validate()?;
        Ok(self.build(options))
    }
}

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Entry { name, class, group, .. } = self;
        f.debug_struct("Entry")
            .field("name", name)
            .field("class", class)
            .field("group", group)
            .finish()
    }
}

type Closure<O, S> = Arc<dyn Fn(&O) -> Box<S> + Send + Sync>;

/// A function that builds a solver from its options: one of this crate, or one that owns data.
pub(crate) enum Build<O, S: ?Sized> {
    Function(fn(&O) -> Box<S>),
    Shared(Closure<O, S>),
}

impl<O, S: ?Sized> Build<O, S> {
    pub(crate) fn of(build: impl Fn(&O) -> Box<S> + Send + Sync + 'static) -> Self {
        Build::Shared(Arc::new(build))
    }

    pub(crate) fn call(&self, options: &O) -> Box<S> {
        match self {
            Build::Function(build) => build(options),
            Build::Shared(build) => build(options),
        }
    }
}

impl<O, S: ?Sized> Clone for Build<O, S> {
    fn clone(&self) -> Self {
        match self {
            Build::Function(build) => Build::Function(*build),
            Build::Shared(build) => Build::Shared(Arc::clone(build)),
        }
    }
}

/// The groups of methods; the [crate](crate) page compares them.
///
/// ```
/// use lcplab_solver::Group;
///
/// assert_eq!((Group::Sweeps.name(), Group::Sweeps.unit()), ("Sweeps", "sweeps"));
/// assert_eq!((Group::Pivoting.name(), Group::Pivoting.unit()), ("Pivoting", "pivots"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Group {
    /// Row by row.
    Sweeps,
    /// Uses only products with A.
    FirstOrder,
    /// Solves a linear system in each step.
    Newton,
    /// Moves from one active set to the next.
    Pivoting,
    /// An external program.
    Plugin,
}

impl Group {
    /// The groups of the built-in solvers.
    pub const ALL: [Group; 4] = [Group::Sweeps, Group::FirstOrder, Group::Newton, Group::Pivoting];

    /// The name of its methods.
    pub fn name(self) -> &'static str {
        match self {
            Group::Sweeps => "Sweeps",
            Group::FirstOrder => "First-order methods",
            Group::Newton => "Newton and interior point",
            Group::Pivoting => "Pivoting",
            Group::Plugin => "Plug-ins",
        }
    }

    /// The name of one iteration of its methods.
    pub fn unit(self) -> &'static str {
        match self {
            Group::Sweeps => "sweeps",
            Group::FirstOrder | Group::Newton => "steps",
            Group::Pivoting => "pivots",
            Group::Plugin => "iterations",
        }
    }
}
