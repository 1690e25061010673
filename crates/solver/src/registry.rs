//! The list of solvers: one entry each. Command line, comparison, report and tests read it.

use super::{
    Admm, Apgd, BlockPgs, BlockPivoting, Class, Code6, Damping, Dantzig, Enumeration, Equations,
    InteriorPoint, Jacobi, Lemke, MatrixClass, Mprgp, Murty, Newton, Nncg, Order, Pgs, Settings,
    Solver, Spectral,
};
use lcplab_problem::Lcp;
use lcplab_problem::error::{Defects, Error, Result};

/// A solver in the registry.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// The name to choose it by.
    pub name: &'static str,
    /// The method in one line.
    pub method: &'static str,
    /// For which problems it is made.
    pub class: Class,
    /// Where it comes from.
    pub source: &'static str,
    /// Which of the options it looks at, beside the common settings.
    pub uses: &'static [Choice],
    /// Makes one.
    pub build: fn(&Options) -> Box<dyn Solver>,
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

/// What the methods ask for that sweep over the rows.
const SWEEPS: Class = Class::of(MatrixClass::Semidefinite).with_positive_diagonal();

/// All solvers; the [`SPECIMENS`] are not among them.
pub const ALL: &[Entry] = &[
    Entry {
        name: "pgs",
        method: "projected Gauss-Seidel, iterative",
        class: SWEEPS,
        source: "K&M (2), (3); Cryer 1971",
        uses: &[Choice::Order],
        build: |options| relaxation(1.0, options.order, options),
    },
    Entry {
        name: "sor",
        method: "projected successive over-relaxation, 0 < ω < 2, iterative",
        class: SWEEPS,
        source: "Cryer 1971; Luo & Tseng 1991",
        uses: &[Choice::Omega, Choice::Order],
        build: |options| relaxation(options.omega, options.order, options),
    },
    Entry {
        name: "ssor",
        method: "projected symmetric SOR, a sweep there and back, 0 < ω < 2, iterative",
        class: SWEEPS,
        source: "Sheldon 1955; Mangasarian 1977",
        uses: &[Choice::Omega],
        build: |options| relaxation(options.omega, Order::Symmetric, options),
    },
    Entry {
        name: "red-black",
        method: "projected Gauss-Seidel, colour by colour, iterative",
        class: SWEEPS,
        source: "Young 1950",
        uses: &[],
        build: |options| relaxation(1.0, Order::Coloured, options),
    },
    Entry {
        name: "jacobi",
        method: "projected Jacobi, damped safely unless told otherwise, iterative",
        class: SWEEPS,
        source: "Goldstein 1964; Mangasarian 1977",
        uses: &[Choice::Damping],
        build: |options| {
            Box::new(Jacobi { damping: options.damping, settings: options.settings.clone() })
        },
    },
    Entry {
        name: "block-pgs",
        method: "projected Gauss-Seidel by contacts and joints, iterative",
        class: Class::of(MatrixClass::Semidefinite),
        source: "Luo & Tseng 1992",
        uses: &[],
        build: |options| {
            Box::new(BlockPgs { settings: options.settings.clone(), ..BlockPgs::default() })
        },
    },
    Entry {
        name: "nncg",
        method: "nonsmooth nonlinear conjugate gradients around PGS, iterative",
        class: SWEEPS,
        source: "Silcowitz, Niebe & Erleben 2010",
        uses: &[],
        build: |options| Box::new(Nncg { settings: options.settings.clone() }),
    },
    Entry {
        name: "newton",
        method: "Newton on the minimum map with line search, iterative",
        class: SWEEPS,
        source: "Pang 1990; Qi & Sun 1993",
        uses: &[],
        build: |options| newton(Equations::MinimumMap, options),
    },
    Entry {
        name: "fischer-newton",
        method: "Newton on Fischer-Burmeister's equations with line search, iterative",
        class: Class::of(MatrixClass::P0).with_positive_diagonal(),
        source: "Fischer 1992; De Luca, Facchinei & Kanzow 1996",
        uses: &[],
        build: |options| newton(Equations::FischerBurmeister, options),
    },
    Entry {
        name: "mprgp",
        method: "projected conjugate gradients with proportioning, iterative",
        class: SWEEPS,
        source: "Dostál & Schöberl 2005",
        uses: &[],
        build: |options| Box::new(Mprgp { settings: options.settings.clone() }),
    },
    Entry {
        name: "apgd",
        method: "accelerated projected gradients with restart, iterative",
        class: SWEEPS,
        source: "Nesterov 1983; Mazhar, Heyn, Negrut & Tasora 2015",
        uses: &[],
        build: |options| Box::new(Apgd { settings: options.settings.clone() }),
    },
    Entry {
        name: "spectral",
        method: "projected gradients with Barzilai-Borwein steps, iterative",
        class: SWEEPS,
        source: "Barzilai & Borwein 1988; Birgin, Martínez & Raydan 2000",
        uses: &[],
        build: |options| Box::new(Spectral { settings: options.settings.clone() }),
    },
    Entry {
        name: "admm",
        method: "alternating direction method of multipliers, iterative",
        class: SWEEPS,
        source: "Stellato, Banjac, Goulart, Bemporad & Boyd 2020",
        uses: &[],
        build: |options| Box::new(Admm { settings: options.settings.clone(), ..Admm::default() }),
    },
    Entry {
        name: "interior-point",
        method: "primal-dual interior point, predictor-corrector, iterative",
        class: SWEEPS,
        source: "Mehrotra 1992",
        uses: &[],
        build: |options| Box::new(InteriorPoint { settings: options.settings.clone() }),
    },
    Entry {
        name: "dantzig",
        method: "Dantzig pivoting with updated LDLᵀ, finite",
        class: Class::of(MatrixClass::Semidefinite),
        source: "Cottle & Dantzig 1968; Baraff 1994",
        uses: &[],
        build: |options| Box::new(Dantzig { settings: options.settings.clone() }),
    },
    Entry {
        name: "lemke",
        method: "Lemke's complementary pivoting, lexicographic ties, finite",
        class: Class::of(MatrixClass::CopositivePlus),
        source: "Lemke 1965; Cottle, Pang & Stone 1992",
        uses: &[],
        build: |options| Box::new(Lemke { settings: options.settings.clone() }),
    },
    Entry {
        name: "murty",
        method: "least-index principal pivoting, finite",
        class: Class::of(MatrixClass::P),
        source: "Murty 1974",
        uses: &[],
        build: |options| Box::new(Murty { settings: options.settings.clone() }),
    },
    Entry {
        name: "block-pivoting",
        method: "block principal pivoting, then Murty's rule (finite) or proximal steps",
        class: Class::of(MatrixClass::POrSemidefinite),
        source: "Kostreva 1978; Júdice & Pires 1994",
        uses: &[],
        build: |options| {
            let settings = options.settings.clone();
            Box::new(BlockPivoting { settings, ..BlockPivoting::default() })
        },
    },
    Entry {
        name: "enumeration",
        method: "up to 65536 active sets in exact arithmetic, finite",
        class: Class::of(MatrixClass::General),
        source: "the definition of a solution",
        uses: &[],
        build: |options| Box::new(Enumeration { settings: options.settings.clone() }),
    },
];

/// Methods that are wrong, kept to be looked at beside the right ones.
pub const SPECIMENS: &[Entry] = &[Entry {
    name: "code6",
    method: "the chapter's Code 6: Gauss-Seidel, clamped after the whole sweep",
    class: Class { bounds: false, coupling: false, ..SWEEPS },
    source: "K&M Code 6, E06",
    uses: &[],
    build: |options| Box::new(Code6 { settings: options.settings.clone() }),
}];

fn newton(equations: Equations, options: &Options) -> Box<dyn Solver> {
    Box::new(Newton { equations, settings: options.settings.clone() })
}

fn relaxation(omega: f64, order: Order, options: &Options) -> Box<dyn Solver> {
    Box::new(Pgs { omega, order, settings: options.settings.clone() })
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

/// The entry of this name, among the solvers and the specimens.
///
/// # Errors
/// If there is none.
pub fn entry(name: &str) -> Result<&'static Entry> {
    let entries = || ALL.iter().chain(SPECIMENS);
    entries().find(|entry| entry.name == name).ok_or_else(|| Error::Unknown {
        kind: "solver",
        name: name.to_string(),
        known: entries().map(|entry| entry.name.to_string()).collect(),
    })
}

/// The solver to take where none is named: Dantzig's for symmetric A, Lemke's for any other.
pub fn default_for(lcp: &Lcp) -> &'static str {
    if lcp.matrix().is_symmetric() { "dantzig" } else { "lemke" }
}
