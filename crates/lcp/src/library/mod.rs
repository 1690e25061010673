//! The problem library: LCPs for testing solvers, most of them with exact solutions.
//!
//! A [`Family`] makes a problem from a few parameters; the same parameters always give a bitwise
//! identical problem. The key `expected` of the problem file stores known solutions ([`Expected`]).
//! Families with friction are stated as model 2, the coupled box; their expected solutions hold
//! under every model except the associated one.
//!
//! ```
//! use lcplab_lcp::file::Expected;
//! use lcplab_lcp::library;
//!
//! let problem = library::by_name("murty")?.generate(&[("n", 4.0)])?;
//! assert_eq!(problem.lcp.matrix().row_dot(0, &[1.0; 4]), 7.0);
//! let [x] = &Expected::of(&problem).unwrap().solutions[..] else { panic!() };
//! assert_eq!(x.iter().map(ToString::to_string).collect::<Vec<_>>(), ["0", "0", "0", "1"]);
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod boxes;
mod contact;
mod friction;
mod games;
mod hard;
mod manufactured;
mod painleve;
mod published;
mod random;

use dashu_ratio::RBig;

use super::file::{Expected, Problem};
use super::{Lcp, Matrix};
use crate::error::{Defects, Error, Result};

/// A family of problems.
///
/// ```
/// use lcplab_lcp::library::by_name;
///
/// let family = by_name("murty")?;
/// println!("{}: {}; {}", family.name(), family.about(), family.source());
/// let parameter = family.parameters()[0];
/// assert_eq!((parameter.name, parameter.is_whole), ("n", true));
/// assert_eq!(family.generate(&[("n", 4.0)])?.lcp.len(), 4);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub trait Family: Sync {
    /// The name to select it by.
    fn name(&self) -> &'static str;

    /// What it is and what it tests, in one line.
    fn about(&self) -> &'static str;

    /// Its source.
    fn source(&self) -> &'static str;

    /// Its parameters.
    fn parameters(&self) -> &'static [Parameter];

    /// The problem with these values, one for each parameter and each within its range.
    #[doc(hidden)] // only `generate` can make checked values
    fn make(&self, values: &Values) -> Problem;

    /// The problem with the given values, and the defaults for the other parameters.
    ///
    /// # Errors
    /// Lists each value that is out of range or belongs to no parameter.
    fn generate(&self, given: &[(&str, f64)]) -> Result<Problem> {
        let values = Values::new(self.parameters(), given).map_err(|e| e.within(self.name()))?;
        let mut problem = self.make(&values);
        problem.name = values.title(self.name());
        problem.extra.insert("source".into(), self.source().into());
        Ok(problem)
    }
}

/// A parameter of a family.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What it means.
    pub about: &'static str,
    /// Its default value.
    pub default: f64,
    /// The smallest allowed value.
    pub least: f64,
    /// The largest allowed value.
    pub most: f64,
    /// Whether only integers are allowed.
    pub is_whole: bool,
}

impl Parameter {
    const fn whole(name: &'static str, about: &'static str, default: u32, range: [u32; 2]) -> Self {
        let [least, most] = [range[0] as f64, range[1] as f64];
        Parameter { name, about, default: default as f64, least, most, is_whole: true }
    }

    const fn real(name: &'static str, about: &'static str, default: f64, range: [f64; 2]) -> Self {
        Parameter { name, about, default, least: range[0], most: range[1], is_whole: false }
    }

    const fn seed() -> Self {
        Self::whole("seed", "seed of the random numbers", 1, [0, u32::MAX])
    }
}

/// A value for each parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Values(Vec<(&'static str, f64)>);

impl Values {
    fn new(parameters: &'static [Parameter], given: &[(&str, f64)]) -> Result<Self> {
        let mut defects = Defects::default();
        for (name, _) in given.iter().filter(|(n, _)| parameters.iter().all(|p| p.name != *n)) {
            let known: Vec<&str> = parameters.iter().map(|p| p.name).collect();
            let known = if known.is_empty() { "none".to_string() } else { known.join(", ") };
            defects.add(*name, format!("is no parameter of this family; there are {known}"));
        }
        let value = |p: &Parameter| {
            given.iter().rev().find(|(name, _)| *name == p.name).map_or(p.default, |(_, v)| *v)
        };
        for p in parameters {
            let value = value(p);
            if !(p.least <= value && value <= p.most) {
                defects.add(p.name, format!("must lie in {} … {}, is {value}", p.least, p.most));
            } else if p.is_whole && value.fract() != 0.0 {
                defects.add(p.name, format!("must be a whole number, is {value}"));
            }
        }
        defects.into_result("problem")?;
        Ok(Values(parameters.iter().map(|p| (p.name, value(p))).collect()))
    }

    /// The value of a parameter of the family.
    fn real(&self, name: &str) -> f64 {
        let of = |(n, v): &(&str, f64)| (*n == name).then_some(*v);
        self.0.iter().find_map(of).expect("a parameter of the family")
    }

    fn whole(&self, name: &str) -> usize {
        self.real(name) as usize
    }

    fn title(&self, family: &str) -> String {
        let values: Vec<String> = self.0.iter().map(|(name, v)| format!("{name} = {v}")).collect();
        if values.is_empty() { family.into() } else { format!("{family}, {}", values.join(", ")) }
    }
}

/// A family whose problems a function makes.
#[derive(Debug, Clone, Copy)]
struct Generated {
    name: &'static str,
    about: &'static str,
    source: &'static str,
    parameters: &'static [Parameter],
    make: fn(&Values) -> Problem,
}

impl Family for Generated {
    fn name(&self) -> &'static str {
        self.name
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn source(&self) -> &'static str {
        self.source
    }

    fn parameters(&self) -> &'static [Parameter] {
        self.parameters
    }

    fn make(&self, values: &Values) -> Problem {
        (self.make)(values)
    }
}

/// All families.
///
/// ```
/// use lcplab_lcp::library;
///
/// assert!(library::all().any(|family| family.name() == "fathi"));
/// ```
pub fn all() -> impl Iterator<Item = &'static dyn Family> {
    let generated = [
        manufactured::FAMILIES,
        hard::FAMILIES,
        contact::FAMILIES,
        boxes::FAMILIES,
        friction::FAMILIES,
        painleve::FAMILIES,
    ];
    let generated = generated.into_iter().flatten().map(|family| family as &dyn Family);
    let games = games::FAMILIES.iter().map(|family| family as &dyn Family);
    let published = published::ALL.iter().map(|problem| problem as &dyn Family);
    generated.chain(published).chain(games)
}

/// All families but games, whose size counts strategies and not rows.
///
/// ```
/// use lcplab_lcp::library;
///
/// assert!(library::without_games().any(|family| family.name() == "fathi"));
/// assert!(!library::without_games().any(|family| family.name() == "bimatrix-game"));
/// ```
pub fn without_games() -> impl Iterator<Item = &'static dyn Family> {
    let is_game = |name: &str| games::FAMILIES.iter().any(|game| game.name() == name);
    all().filter(move |family| !is_game(family.name()))
}

/// The family of this name.
///
/// ```
/// use lcplab_lcp::library;
///
/// let family = library::by_name("murty")?;
/// assert!(family.parameters().iter().any(|parameter| parameter.name == "n"));
/// assert!(library::by_name("marty").is_err());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Errors
/// If there is no such family.
pub fn by_name(name: &str) -> Result<&'static dyn Family> {
    all().find(|family| family.name() == name).ok_or_else(|| Error::Unknown {
        kind: "problem family",
        name: name.to_string(),
        known: all().map(|family| family.name().to_string()).collect(),
    })
}

/// A problem with bounds 0 and ∞; the numbers must be finite and the sizes must agree.
fn contacts(matrix: Matrix, b: Vec<f64>, expected: &Expected) -> Problem {
    let n = b.len();
    boxed(matrix, b, vec![0.0; n], vec![f64::INFINITY; n], expected)
}

fn boxed(matrix: Matrix, b: Vec<f64>, lo: Vec<f64>, hi: Vec<f64>, expected: &Expected) -> Problem {
    let lcp = Lcp::new(matrix, b, lo, hi).expect("a family makes valid problems");
    let mut problem = Problem::new("", lcp);
    problem.extra.insert("expected".into(), expected.json());
    problem
}

/// The exact rational value of a floating-point number.
fn rational(x: f64) -> RBig {
    RBig::try_from(x).expect("a finite number")
}

/// b = w − A x, so that x is a solution with this w. Exact if the sums are exact.
fn offset(matrix: &Matrix, x: &[f64], w: &[f64]) -> Vec<f64> {
    (0..x.len()).map(|i| w[i] - matrix.row_dot(i, x)).collect()
}
