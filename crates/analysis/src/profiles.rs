//! Performance profiles of solvers on families of problems.
//!
//! A performance profile (Dolan & Moré 2002) compares costs problem by problem. For solver s and
//! problem p let t_ps be the cost if s solved p, ∞ otherwise; then
//!
//! ```text
//! r_ps = t_ps / min_s t_ps,   ρ_s(τ) = |{p attempted by s : r_ps ≤ τ}| / |{p attempted by s}|
//! ```
//!
//! so ρ_s(1) is the share of its problems on which s is the cheapest, and ρ_s(∞) the share that it
//! solves. *Solved* means claimed and accepted by the judge. A problem outside a solver's class is
//! not an attempt; whether it counts against the solver is shown both ways ([`of_all`]), and each
//! curve states its number of problems.
//!
//! ```
//! use lcplab_analysis::profiles::Cost::{Failed, NotTried, Solved};
//! use lcplab_analysis::profiles::{FamilyAttempts, ProblemAttempts, costs, of_all};
//! use lcplab_analysis::trial::{Attempt, Outcome};
//!
//! // Two solvers on one problem of 3 rows: a sweep method that solves it, and another one that is
//! // not made for it.
//! let attempt = |solver: &str, outcome: Outcome| Attempt {
//!     solver: solver.into(),
//!     outcome,
//!     iterations: 7,
//!     work: 84.0,
//! };
//! let attempts = vec![attempt("a", Outcome::Proved), attempt("b", Outcome::Outside("…".into()))];
//! let problem = ProblemAttempts { rows: 3, impossible: false, semidefinite: true, attempts: vec![attempts] };
//! let tried = [FamilyAttempts { family: "mine".into(), problems: vec![problem] }];
//! assert_eq!(costs(&tried, 0), [[Solved(84.0), NotTried]]);
//! // A problem that was not tried counts as failed, if the solver tried any.
//! let costs = [vec![Solved(1.0), NotTried], vec![Solved(1.0), Solved(2.0)]];
//! assert_eq!(of_all(&costs)[0], [Solved(1.0), Failed]);
//! ```

use serde::{Deserialize, Serialize};

use crate::trial::Attempt;

/// The attempts of the solvers on a family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FamilyAttempts {
    /// The family, or the scene's step.
    pub family: String,
    /// Its problems.
    pub problems: Vec<ProblemAttempts>,
}

/// A problem with all attempts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProblemAttempts {
    /// The number of rows.
    pub rows: usize,
    /// Whether it is known that no solution exists; a claim to have solved it is then false.
    pub impossible: bool,
    /// Whether A is symmetric and positive semidefinite.
    pub semidefinite: bool,
    /// By tolerance, in the order of the settings; for each by solver.
    pub attempts: Vec<Vec<Attempt>>,
}

/// The cost of a problem for a solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cost {
    /// The solver did not attempt it.
    NotTried,
    /// It failed.
    Failed,
    /// It solved the problem at this cost, above 0.
    Solved(f64),
}

/// A solver's performance profile.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// The number of problems it attempted, to which shares refer.
    pub attempted: usize,
    /// (τ, ρ(τ)) at each step of ρ, in ascending order of τ.
    pub steps: Vec<(f64, f64)>,
}

/// The profiles of all solvers, from their costs by problem and then by solver.
///
/// ```
/// use lcplab_analysis::profiles::{Cost::*, profiles};
///
/// let costs = [[Solved(2.0), Solved(1.0)], [Solved(3.0), Failed]];
/// let [a, b] = &profiles(&costs.map(Vec::from))[..] else { panic!() };
/// assert_eq!(a.steps, [(1.0, 0.5), (2.0, 1.0)]);
/// assert_eq!(b.steps, [(1.0, 0.5)]);
/// ```
pub fn profiles(costs: &[Vec<Cost>]) -> Vec<Profile> {
    let solvers = costs.first().map_or(0, Vec::len);
    let least = |row: &Vec<Cost>| {
        let solved = row.iter().filter_map(|cost| match cost {
            Cost::Solved(cost) => Some(*cost),
            _ => None,
        });
        solved.fold(f64::INFINITY, f64::min)
    };
    let best: Vec<f64> = costs.iter().map(least).collect();
    let profile = |solver: usize| {
        let attempted = costs.iter().filter(|row| row[solver] != Cost::NotTried).count();
        let ratio = |(row, best): (&Vec<Cost>, &f64)| match row[solver] {
            Cost::Solved(cost) => Some(cost / best),
            _ => None,
        };
        let mut ratios: Vec<f64> = costs.iter().zip(&best).filter_map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let mut steps: Vec<(f64, f64)> = Vec::new();
        for (k, tau) in ratios.into_iter().enumerate() {
            let share = (k + 1) as f64 / attempted as f64;
            match steps.last_mut() {
                Some(last) if last.0 == tau => last.1 = share,
                _ => steps.push((tau, share)),
            }
        }
        Profile { attempted, steps }
    };
    (0..solvers).map(profile).collect()
}

/// The multiplications, at least one per row, for the problems that have a solution, at the
/// tolerance with this index. A solver whose multiplications are not counted (NaN) counts as not
/// having attempted a problem.
pub fn costs(tried: &[FamilyAttempts], tolerance: usize) -> Vec<Vec<Cost>> {
    let solvable = tried.iter().flat_map(|family| &family.problems).filter(|p| !p.impossible);
    let cost = |rows: usize, attempt: &Attempt| match &attempt.outcome {
        _ if attempt.work.is_nan() => Cost::NotTried,
        outcome if outcome.is_solved() => Cost::Solved(attempt.work.max(rows as f64)),
        outcome if outcome.is_attempt() => Cost::Failed,
        _ => Cost::NotTried,
    };
    let costs = |problem: &ProblemAttempts| {
        problem.attempts[tolerance].iter().map(|attempt| cost(problem.rows, attempt)).collect()
    };
    solvable.map(costs).collect()
}

/// The same costs with problems that a solver did not attempt counted as failed: the share then
/// refers to all problems. A solver that attempted none is left out.
pub fn of_all(costs: &[Vec<Cost>]) -> Vec<Vec<Cost>> {
    let has_tried = |solver: usize| costs.iter().any(|row| row[solver] != Cost::NotTried);
    let strict = |(solver, cost): (usize, &Cost)| match cost {
        Cost::NotTried if has_tried(solver) => Cost::Failed,
        cost => *cost,
    };
    costs.iter().map(|row| row.iter().enumerate().map(strict).collect()).collect()
}
