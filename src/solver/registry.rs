//! The list of solvers: one entry each. Command line, comparison, report and tests read it.

use super::{Dantzig, Pgs, Settings, Solver};
use crate::error::{Error, Result};

/// A solver in the registry.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The name to choose it by.
    pub name: &'static str,
    /// The method in one line.
    pub method: &'static str,
    /// For which A it is made.
    pub class: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Makes one.
    pub build: fn(&Options) -> Box<dyn Solver>,
}

/// What a user can choose about a solver.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The common settings.
    pub settings: Settings,
    /// The relaxation factor ω of SOR.
    pub omega: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options { settings: Settings::default(), omega: 1.3 }
    }
}

/// All solvers.
pub const ALL: &[Entry] = &[
    Entry {
        name: "pgs",
        method: "projected Gauss-Seidel, iterative",
        class: "symmetric positive semidefinite, positive diagonal",
        source: "K&M (2), (3); Cryer 1971",
        build: |options| Box::new(Pgs { omega: 1.0, settings: options.settings.clone() }),
    },
    Entry {
        name: "sor",
        method: "projected successive over-relaxation, iterative",
        class: "symmetric positive semidefinite, positive diagonal, 0 < ω < 2",
        source: "Cryer 1971; Luo & Tseng 1991",
        build: |options| Box::new(Pgs { omega: options.omega, settings: options.settings.clone() }),
    },
    Entry {
        name: "dantzig",
        method: "Dantzig pivoting with updated LDLᵀ, finite",
        class: "symmetric positive semidefinite",
        source: "Cottle & Dantzig 1968; Baraff 1994",
        build: |options| Box::new(Dantzig { settings: options.settings.clone() }),
    },
];

/// The solver of this name.
///
/// ```
/// use lcplab::lcp::{Lcp, Matrix};
/// use lcplab::solver::{self, Options, Start, Status};
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let solution = solver::by_name("dantzig", &Options::default())?.solve(&lcp, &Start::default(), &mut ());
/// assert_eq!(solution.status, Status::Solved);
/// assert_eq!(solution.x, [0.5, 0.0]);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
///
/// # Errors
/// If there is none of this name, or an option cannot be used.
pub fn by_name(name: &str, options: &Options) -> Result<Box<dyn Solver>> {
    options.settings.validate()?;
    if !(options.omega > 0.0 && options.omega < 2.0) {
        let reason = format!("must lie between 0 and 2, is {}", options.omega);
        return Err(Error::invalid("settings", "omega", reason));
    }
    Ok((entry(name)?.build)(options))
}

/// The entry of this name.
///
/// # Errors
/// If there is none.
pub fn entry(name: &str) -> Result<&'static Entry> {
    ALL.iter().find(|entry| entry.name == name).ok_or_else(|| Error::Unknown {
        kind: "solver",
        name: name.to_string(),
        known: ALL.iter().map(|entry| entry.name.to_string()).collect(),
    })
}
