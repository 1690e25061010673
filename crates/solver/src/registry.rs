//! The list of solvers, with one entry for each. The command line, comparison, report and tests
//! read this list, so a new solver needs only a file and an entry.

use std::sync::{PoisonError, RwLock};

pub use super::sweep::KNOWN_WRONG;
use super::{CONES, Class, Cost, Damping, Order, Settings, Solver, gradient, newton, pivot, sweep};
use lcplab_problem::Lcp;
use lcplab_problem::error::{Defects, Error, Result};

/// A solver in the registry.
#[derive(Clone, Copy)]
pub struct Entry {
    /// The name that selects it.
    pub name: &'static str,
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
    pub build: &'static Build,
}

/// A function that builds a solver with these options.
pub type Build = dyn Fn(&Options) -> Box<dyn Solver> + Send + Sync;

impl std::fmt::Debug for Entry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Entry { name, class, group, .. } = self;
        f.debug_struct("Entry")
            .field("name", name)
            .field("class", class)
            .field("group", group)
            .finish()
    }
}

/// The groups of methods; the [crate](crate) page compares them.
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

    /// The group of a registered solver.
    pub fn of(solver: &str) -> Option<Group> {
        ALL.iter().find(|entry| entry.name == solver).map(|entry| entry.group)
    }

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

/// An option that only some solvers use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// [`Options::omega`].
    Omega,
    /// [`Options::order`].
    Order,
    /// [`Options::damping`].
    Damping,
}

impl Choice {
    /// The option's name.
    pub fn name(self) -> &'static str {
        match self {
            Choice::Omega => "omega",
            Choice::Order => "order",
            Choice::Damping => "damping",
        }
    }
}

/// The options of a solver that a user can choose.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The common settings.
    pub settings: Settings,
    /// The relaxation factor ω of PGS and SOR.
    pub omega: f64,
    /// The order of the rows in a sweep of PGS and SOR.
    pub order: Order,
    /// The step length of Jacobi's method.
    pub damping: Damping,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            settings: Settings::default(),
            omega: 1.3,
            order: Order::default(),
            damping: Damping::default(),
        }
    }
}

impl Options {
    /// Checks that the options are valid.
    ///
    /// # Errors
    /// Names the invalid option.
    pub fn validate(&self) -> Result<()> {
        self.settings.validate()?;
        let mut defects = Defects::default();
        let damping = match self.damping {
            Damping::Safe => 1.0,
            // Values from 2/λ on diverge, and λ ≥ 1.
            Damping::Factor(theta) => theta,
        };
        for (choice, value) in [(Choice::Omega, self.omega), (Choice::Damping, damping)] {
            if !(value > 0.0 && value < 2.0) {
                defects.add(choice.name(), format!("must lie between 0 and 2, is {value}"));
            }
        }
        defects.into_result("settings")
    }
}

/// All solvers, group by group, without the known-wrong variants [`KNOWN_WRONG`].
pub const ALL: &[Entry] = &joined::<COUNT>();

const GROUPS: [&[Entry]; 4] = [sweep::ENTRIES, gradient::ENTRIES, newton::ENTRIES, pivot::ENTRIES];
const COUNT: usize = GROUPS[0].len() + GROUPS[1].len() + GROUPS[2].len() + GROUPS[3].len();

const fn joined<const N: usize>() -> [Entry; N] {
    let mut all = [GROUPS[0][0]; N];
    let (mut group, mut k) = (0, 0);
    while group < GROUPS.len() {
        let mut own = 0;
        while own < GROUPS[group].len() {
            all[k] = GROUPS[group][own];
            (own, k) = (own + 1, k + 1);
        }
        group += 1;
    }
    all
}

/// The solver or known-wrong variant with this name.
///
/// ```
/// use lcplab_problem::{Lcp, Matrix};
/// use lcplab_solver::{by_name, Options, Start, Status};
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let solution = by_name("dantzig", &Options::default())?.solve(&lcp, &Start::default(), &mut ());
/// assert_eq!(solution.status, Status::Solved);
/// assert_eq!(solution.x, [0.5, 0.0]);
/// # Ok::<(), lcplab_problem::error::Error>(())
/// ```
///
/// # Errors
/// If none has this name, or an option is invalid.
pub fn by_name(name: &str, options: &Options) -> Result<Box<dyn Solver>> {
    options.validate()?;
    Ok((entry(name)?.build)(options))
}

/// Solvers that were added at run time.
static ADDED: RwLock<Vec<&'static Entry>> = RwLock::new(Vec::new());

/// Adds a solver to the registry, where it can be selected by name until the program ends.
///
/// # Errors
/// If an entry already has this name.
pub fn add(entry: Entry) -> Result<&'static Entry> {
    let mut added = ADDED.write().unwrap_or_else(PoisonError::into_inner);
    let known = ALL.iter().chain(KNOWN_WRONG).chain(added.iter().copied()).map(|known| known.name);
    // clarabel is the reference.
    let reserved = CONES.iter().map(|known| known.name).chain(["clarabel"]);
    if known.chain(reserved).any(|known| known == entry.name) {
        let reason = format!("there is a solver named {:?} already", entry.name);
        return Err(Error::invalid("solvers", "name", reason));
    }
    let entry = &*Box::leak(Box::new(entry));
    added.push(entry);
    Ok(entry)
}

/// The solvers that were added at run time.
pub fn added() -> Vec<&'static Entry> {
    ADDED.read().unwrap_or_else(PoisonError::into_inner).clone()
}

/// The entry with this name, among the solvers, the known-wrong variants and those added at run
/// time.
///
/// # Errors
/// If no entry has this name.
pub fn entry(name: &str) -> Result<&'static Entry> {
    let added = added();
    let entries = || ALL.iter().chain(KNOWN_WRONG).chain(added.iter().copied());
    entries().find(|entry| entry.name == name).ok_or_else(|| Error::Unknown {
        kind: "solver",
        name: name.to_string(),
        known: entries().map(|entry| entry.name.to_string()).collect(),
    })
}

/// The default solver: Dantzig's method if A is symmetric up to rounding, otherwise Lemke's.
pub fn default_for(lcp: &Lcp) -> &'static str {
    if lcp.matrix().is_nearly_symmetric() { "dantzig" } else { "lemke" }
}
