//! The list of solvers: one entry each, kept by the group that it belongs to. Command line,
//! comparison, report and tests read it, so that a new solver is its file and its entry.

use std::sync::{PoisonError, RwLock};

pub use super::sweep::SPECIMENS;
use super::{CONES, Class, Cost, Damping, Order, Settings, Solver, gradient, newton, pivot, sweep};
use lcplab_problem::Lcp;
use lcplab_problem::error::{Defects, Error, Result};

/// A solver in the registry.
#[derive(Clone, Copy)]
pub struct Entry {
    /// The name to choose it by.
    pub name: &'static str,
    /// The method in one line.
    pub method: &'static str,
    /// For which problems it is made.
    pub class: Class,
    /// What kind of method it is.
    pub group: Group,
    /// What its iterations cost.
    pub cost: Cost,
    /// Where it comes from.
    pub source: &'static str,
    /// Which of the options it looks at, beside the common settings.
    pub uses: &'static [Choice],
    /// Makes one.
    pub build: &'static Build,
}

/// Makes a solver with these options.
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

/// The groups of methods; the [crate](crate) page says what tells them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Group {
    /// Row by row.
    Sweeps,
    /// Products with A and nothing else.
    FirstOrder,
    /// A linear system a step.
    Newton,
    /// From one active set to the next.
    Pivoting,
    /// Someone else's program.
    Plugin,
}

impl Group {
    /// Those of the solvers here.
    pub const ALL: [Group; 4] = [Group::Sweeps, Group::FirstOrder, Group::Newton, Group::Pivoting];

    /// The group of a registered solver.
    pub fn of(solver: &str) -> Option<Group> {
        ALL.iter().find(|entry| entry.name == solver).map(|entry| entry.group)
    }

    /// What its methods are called.
    pub fn name(self) -> &'static str {
        match self {
            Group::Sweeps => "Sweeps",
            Group::FirstOrder => "First-order methods",
            Group::Newton => "Newton and interior point",
            Group::Pivoting => "Pivoting",
            Group::Plugin => "Plug-ins",
        }
    }

    /// What an iteration of its methods is.
    pub fn unit(self) -> &'static str {
        match self {
            Group::Sweeps => "sweeps",
            Group::FirstOrder | Group::Newton => "steps",
            Group::Pivoting => "pivots",
            Group::Plugin => "iterations",
        }
    }
}

/// An option that means something to some solvers only.
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

/// What a user can choose about a solver.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The common settings.
    pub settings: Settings,
    /// The relaxation factor ω of SOR.
    pub omega: f64,
    /// The order of the rows in a sweep of PGS and SOR.
    pub order: Order,
    /// How long the steps of Jacobi are.
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
    /// Whether the options can be used.
    ///
    /// # Errors
    /// Names the option that cannot.
    pub fn validate(&self) -> Result<()> {
        self.settings.validate()?;
        let mut defects = Defects::default();
        let damping = match self.damping {
            Damping::Safe => 1.0,
            Damping::Factor(theta) => theta, // 2/λ and above diverges, and λ ≥ 1
        };
        for (choice, value) in [(Choice::Omega, self.omega), (Choice::Damping, damping)] {
            if !(value > 0.0 && value < 2.0) {
                defects.add(choice.name(), format!("must lie between 0 and 2, is {value}"));
            }
        }
        defects.into_result("settings")
    }
}

/// All solvers, group by group; the [`SPECIMENS`] are not among them.
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

/// The solver or specimen of this name.
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
/// If there is none of this name, or an option cannot be used.
pub fn by_name(name: &str, options: &Options) -> Result<Box<dyn Solver>> {
    options.validate()?;
    Ok((entry(name)?.build)(options))
}

/// What was added to the registry while the program ran.
static ADDED: RwLock<Vec<&'static Entry>> = RwLock::new(Vec::new());

/// Adds a solver to the registry, so that it can be named wherever a solver is; it stays until the
/// program ends.
///
/// # Errors
/// If there is one of this name.
pub fn add(entry: Entry) -> Result<&'static Entry> {
    let mut added = ADDED.write().unwrap_or_else(PoisonError::into_inner);
    let known = ALL.iter().chain(SPECIMENS).chain(added.iter().copied()).map(|known| known.name);
    let reserved = CONES.iter().map(|known| known.name).chain(["clarabel"]); // the reference
    if known.chain(reserved).any(|known| known == entry.name) {
        let reason = format!("there is a solver named {:?} already", entry.name);
        return Err(Error::invalid("solvers", "name", reason));
    }
    let entry = &*Box::leak(Box::new(entry));
    added.push(entry);
    Ok(entry)
}

/// The solvers that were added.
pub fn added() -> Vec<&'static Entry> {
    ADDED.read().unwrap_or_else(PoisonError::into_inner).clone()
}

/// The entry of this name, among the solvers, the specimens and what was added.
///
/// # Errors
/// If there is none.
pub fn entry(name: &str) -> Result<&'static Entry> {
    let added = added();
    let entries = || ALL.iter().chain(SPECIMENS).chain(added.iter().copied());
    entries().find(|entry| entry.name == name).ok_or_else(|| Error::Unknown {
        kind: "solver",
        name: name.to_string(),
        known: entries().map(|entry| entry.name.to_string()).collect(),
    })
}

/// The solver to take where none is named: Dantzig's for A symmetric but for rounding, Lemke's for
/// any other.
pub fn default_for(lcp: &Lcp) -> &'static str {
    if lcp.matrix().is_nearly_symmetric() { "dantzig" } else { "lemke" }
}
