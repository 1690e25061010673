//! Small LCPs from the literature, whose solutions are known as fractions, by every solver.

use dashu_ratio::RBig;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::families::{self, Row};
use crate::error::Result;
use crate::lcp::file::Expected;
use crate::lcp::library;
use crate::report::methods;
use crate::solver::{Method, Options, Stop};

/// Published problems.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The problems by their names in the library; all published ones without it.
    #[serde(default = "all_problems")]
    pub problems: Vec<String>,
}

/// The published problems, with the pieces of Lemke's path, the covering vector being ones, and
/// whether it ends on a ray. Counted in exact arithmetic, the first step included.
const PUBLISHED: [(&str, Option<(usize, bool)>); 15] = [
    ("cps-1", Some((2, false))),
    ("cps-2", Some((5, false))),
    ("cps-3", Some((1, true))),
    ("cps-4", Some((5, false))),
    ("cps-4bis", Some((5, false))),
    ("cps-5", Some((2, false))),
    ("kostreva-1", Some((4, false))),
    ("kostreva-2", None),
    ("pang-isolated", Some((3, false))),
    ("pang-perturbed", Some((4, true))),
    ("pang-other", Some((5, false))),
    ("deudeu", Some((3, false))),
    ("ortiz", Some((3, false))),
    ("trivial", Some((10, false))),
    ("path", Some((4, false))),
];

fn all_problems() -> Vec<String> {
    PUBLISHED.iter().map(|(name, _)| (*name).into()).collect()
}

/// One problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Its name in the library.
    pub problem: String,
    /// What it teaches.
    pub about: String,
    /// Where it comes from.
    pub source: String,
    /// The number of rows.
    pub rows: usize,
    /// Its solutions, or corners of the set of solutions, as fractions; none if there is none.
    pub solutions: Vec<Vec<String>>,
    /// The published length of Lemke's path, and whether it ends on a ray.
    pub lemke: Option<(usize, bool)>,
    /// What each solver made of it.
    pub solvers: Vec<Row>,
}

impl Finding {
    /// The length of Lemke's path here, and whether it ended without a solution.
    pub fn path(&self) -> Option<(usize, bool)> {
        let row = self.solvers.iter().find(|row| row.solver == "lemke")?;
        Some((row.iterations, row.claimed == 0))
    }
}

impl Study for Plan {
    const NAME: &'static str = "published";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.problems.clone()
    }

    fn run(&self, task: usize) -> Result<(Finding, ())> {
        let family = library::by_name(&self.problems[task])?;
        let problem = family.generate(&[])?;
        let boxed: Vec<Method> = methods::all()
            .into_iter()
            .filter(|method| matches!(method, Method::Boxed(_)))
            .collect();
        let mut solvers =
            families::run(&[family], &[], &boxed, &Options::default(), 1, &Stop::default());
        solvers.iter_mut().for_each(|row| row.seconds = 0.0);
        let expected = Expected::of(&problem).map_or(Vec::new(), |expected| expected.solutions);
        let fractions = |x: &Vec<RBig>| x.iter().map(ToString::to_string).collect();
        let solutions = expected.iter().map(fractions).collect();
        let lemke = PUBLISHED.iter().find(|(name, _)| *name == family.name());
        let finding = Finding {
            problem: family.name().into(),
            about: family.about().into(),
            source: family.source().into(),
            rows: problem.lcp.len(),
            solutions,
            lemke: lemke.and_then(|(_, path)| *path),
            solvers,
        };
        Ok((finding, ()))
    }
}
