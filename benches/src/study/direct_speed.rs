//! Direct and Newton-like solvers by the number of rows: random problems with a definite A, one-sided and
//! two-sided bounds, beside clarabel's interior point.
//!
//! The answer is chosen first, so the share of active rows is the same at each size: half of them
//! where bounds are one-sided, two thirds at one of the two bounds where they are two-sided.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::yardstick::{Finding, Terms, Times, measure};
use lcplab::error::Result;
use lcplab::lcp::{Lcp, library};
use lcplab::report::study::Study;

/// Which sizes and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Numbers of rows with x ≥ 0.
    pub one_sided: Vec<usize>,
    /// Numbers of rows with two finite bounds.
    pub two_sided: Vec<usize>,
    /// About the largest eigenvalue of A over the least.
    pub condition: f64,
    /// The solvers.
    pub solvers: Vec<String>,
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// Seconds to spend on a problem.
    pub seconds: f64,
    /// What is asked of the times.
    pub goal: Goal,
}

/// What is asked of the times: clarabel's over a solver's, one-sided.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Goal {
    /// The solver.
    pub solver: String,
    /// At least so many times as fast as clarabel.
    pub faster: f64,
    /// From this number of rows on.
    pub from: usize,
}

impl Default for Goal {
    fn default() -> Self {
        Goal { solver: "block-pivoting".into(), faster: 20.0, from: 500 }
    }
}

impl Default for Plan {
    fn default() -> Self {
        let solvers = ["dantzig", "block-pivoting", "lemke", "newton", "interior-point"];
        Plan {
            one_sided: vec![50, 100, 200, 500, 1000],
            two_sided: vec![50, 100, 200, 500],
            condition: 400.0,
            solvers: solvers.map(String::from).to_vec(),
            tolerance: 1e-9,
            seconds: 0.5,
            goal: Goal::default(),
        }
    }
}

/// What the bounds of a problem are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bounds {
    /// 0 ≤ x.
    OneSided,
    /// 0 ≤ x ≤ hi, hi finite.
    TwoSided,
}

impl Bounds {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Bounds::OneSided => "one-sided",
            Bounds::TwoSided => "two-sided",
        }
    }

    /// The name of the problem with n rows.
    pub fn problem(self, n: usize) -> String {
        format!("{}, n = {n}", self.name())
    }

    /// The problem with n rows and about this condition of A; n is the seed too.
    ///
    /// # Errors
    /// If a number is not in its range.
    pub fn lcp(self, n: usize, condition: f64) -> Result<Lcp> {
        let shares = match self {
            Bounds::OneSided => [("active", 0.5), ("boxed", 0.0)],
            Bounds::TwoSided => [("active", 2.0 / 3.0), ("boxed", 1.0)],
        };
        let size = [("n", n as f64), ("condition", condition), ("seed", n as f64)];
        let given: Vec<_> = size.into_iter().chain(shares).collect();
        Ok(library::by_name("manufactured")?.generate(&given)?.lcp)
    }
}

impl Plan {
    /// The problems: their bounds and numbers of rows.
    pub fn problems(&self) -> impl Iterator<Item = (Bounds, usize)> {
        let one_sided = self.one_sided.iter().map(|&n| (Bounds::OneSided, n));
        one_sided.chain(self.two_sided.iter().map(|&n| (Bounds::TwoSided, n)))
    }
}

impl Study for Plan {
    const NAME: &'static str = "direct-speed";
    type Finding = Finding;
    type Times = Times;

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        self.problems().map(|(bounds, n)| bounds.problem(n)).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let (bounds, n) = self.problems().collect::<Vec<_>>()[task];
        let Plan { solvers, tolerance, seconds, .. } = self;
        let terms = Terms { solvers, tolerance: *tolerance, seconds: *seconds };
        measure(bounds.problem(n), &bounds.lcp(n, self.condition)?, &terms)
    }
}
