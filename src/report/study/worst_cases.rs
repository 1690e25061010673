//! One LCP, five costs: what the methods pay for Murty's and Fathi's matrices, and what theory says.
//!
//! Murty's U has 1 on the diagonal and 2 above it, Fathi's F = U Uᵀ is symmetric positive definite;
//! b = −1. The solution is e_n, or e_1 if the rows are numbered backwards. The numbering decides
//! whether a method that looks at row 1 first is lucky.

use std::fmt;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::certificate::{Demand, judge};
use crate::error::Result;
use crate::lcp::{Lcp, library};
use crate::solver::{Options, Settings, Solver, Start, Status, by_name};

/// Murty's and Fathi's matrices.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The numbers of rows.
    pub sizes: Vec<u32>,
}

impl Study for Plan {
    const NAME: &'static str = "worst-cases";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec!["all".into()]
    }

    fn run(&self, _: usize) -> Result<(Finding, ())> {
        Ok((run(&self.sizes)?, ()))
    }
}

/// The costs of all methods.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The numbers of rows n.
    pub sizes: Vec<u32>,
    /// A method, matrix and numbering each.
    pub cases: Vec<Case>,
}

/// A method on one matrix in one numbering.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// The solver.
    pub solver: String,
    /// The family in the problem library.
    pub matrix: String,
    /// Whether the rows are numbered backwards, so that e_1 is the solution.
    pub reversed: bool,
    /// Whether this is the numbering that suits the method.
    pub favourable: bool,
    /// What theory says.
    pub law: Law,
    /// Sweeps, pivots or active sets for each n; `None` unless claimed solved and accepted by the
    /// judge.
    pub costs: Vec<Option<usize>>,
}

/// A cost as a function of n.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Law {
    /// 1.
    One,
    /// 2.
    Two,
    /// n² − n + 1.
    Quadratic,
    /// 2ⁿ⁻¹ + 1: the place of {n} in the list of active sets, row 1 fastest.
    PlaceOfLast,
    /// 2ⁿ − 1.
    AllButOne,
    /// 2ⁿ.
    All,
}

impl Law {
    /// The cost for n rows.
    pub fn cost(self, n: u32) -> usize {
        match self {
            Law::One => 1,
            Law::Two => 2,
            Law::Quadratic => (n * n + 1 - n) as usize,
            Law::PlaceOfLast => (1 << (n - 1)) + 1,
            Law::AllButOne => (1 << n) - 1,
            Law::All => 1 << n,
        }
    }
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Law::One => "1",
            Law::Two => "2",
            Law::Quadratic => "n² − n + 1",
            Law::PlaceOfLast => "2ⁿ⁻¹ + 1",
            Law::AllButOne => "2ⁿ − 1",
            Law::All => "2ⁿ",
        })
    }
}

impl Case {
    /// Whether every cost is the one that theory says.
    pub fn agrees(&self, sizes: &[u32]) -> bool {
        sizes.iter().zip(&self.costs).all(|(&n, &cost)| cost == Some(self.law.cost(n)))
    }
}

/// Solver, matrix, its laws in the favourable and the unfavourable numbering, and whether the
/// favourable one is the reversed one.
const CASES: [(&str, &str, [Law; 2], bool); 7] = [
    ("pgs", "fathi", [Law::One, Law::Two], true),
    ("dantzig", "fathi", [Law::One, Law::Quadratic], true),
    ("murty", "fathi", [Law::One, Law::AllButOne], true),
    ("lemke", "fathi", [Law::Two, Law::All], false),
    ("enumeration", "fathi", [Law::Two, Law::PlaceOfLast], true),
    ("murty", "murty", [Law::One, Law::AllButOne], true),
    ("lemke", "murty", [Law::Two, Law::All], false),
];

/// Runs every method in both numberings for these n.
///
/// # Errors
/// If the library has no problem of such a size.
pub fn run(sizes: &[u32]) -> Result<Finding> {
    let paired = CASES.iter().flat_map(|&(solver, matrix, laws, reversed)| {
        [(0, reversed), (1, !reversed)].map(|(k, reversed)| (solver, matrix, reversed, k, laws[k]))
    });
    // Without a tie, so that no rule for ties is to blame: b_i = 2^i − 2^(n+1).
    let alone = [("lemke", "murty-exponential", false, 1, Law::All)];
    let all: Vec<_> = paired.chain(alone).collect();
    let case = |&(solver, matrix, reversed, k, law): &(&str, &str, bool, usize, Law)| {
        let costs = sizes.par_iter().map(|&n| cost(solver, &problem(matrix, n, reversed)?));
        Ok(Case {
            solver: solver.to_string(),
            matrix: matrix.to_string(),
            reversed,
            favourable: k == 0,
            law,
            costs: costs.collect::<Result<_>>()?,
        })
    };
    let cases = all.par_iter().map(case).collect::<Result<_>>()?;
    Ok(Finding { sizes: sizes.to_vec(), cases })
}

fn problem(matrix: &str, n: u32, reversed: bool) -> Result<Lcp> {
    let n = ("n", f64::from(n));
    let numbering = ("reversed", 1.0);
    let given = if reversed { vec![n, numbering] } else { vec![n] };
    Ok(library::by_name(matrix)?.generate(&given)?.lcp)
}

fn cost(solver: &str, lcp: &Lcp) -> Result<Option<usize>> {
    let settings = Settings { max_iterations: 1 << 16, ..Settings::default() };
    let solver: Box<dyn Solver> = by_name(solver, &Options { settings, ..Options::default() })?;
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    let accepted = judge(lcp, &solution.x, &Demand::default()).verdict.is_solution();
    Ok((solution.status == Status::Solved && accepted).then_some(solution.iterations))
}
