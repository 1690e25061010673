//! What a solver claims of a problem, and what is true of it.

use crate::certificate::ray::refute;
use crate::certificate::{Demand, Verdict, judge};
use crate::lcp::Lcp;
use crate::solver::{Settings, Solution, Status, all_solutions};

/// What exact arithmetic knows of a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Truth {
    /// It has a solution.
    Solvable,
    /// It has none.
    Impossible,
    /// Neither was shown.
    Unknown,
}

/// What a solver says of a problem.
#[derive(Debug, Clone, PartialEq)]
pub enum Claim {
    /// A solution, and the judge proves that one has this active set.
    Proved,
    /// A solution, and the judge finds it within the tolerance.
    Within,
    /// The same, but the problem as it stands has none.
    Strained,
    /// No solution exists, proved by a Farkas vector or by enumeration.
    Impossible,
    /// No answer, for a reason that it gives.
    Unsolved,
    /// The problem is not of its class.
    Outside,
    /// Something that is not true.
    Lie(Lie),
}

/// A claim that is not true.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lie {
    /// *Solved*, and row `row` misses by `amount` of its terms.
    Refuted {
        /// The worst row.
        row: usize,
        /// Its scaled residual.
        amount: f64,
    },
    /// *Solved*, and x is not finite.
    NotFinite,
    /// *No solution*, and there is one.
    DeniedASolution,
}

impl std::fmt::Display for Lie {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Lie::Refuted { row, amount } => {
                write!(f, "solved, but row {row} misses by {amount:.1e} of its terms")
            }
            Lie::NotFinite => write!(f, "solved, but x is not finite"),
            Lie::DeniedASolution => write!(f, "no solution, but one exists"),
        }
    }
}

impl Truth {
    /// What the claims on a problem prove. Where none does and one depends on it, all active sets are
    /// tried.
    pub fn of<'a>(lcp: &Lcp, claims: impl Iterator<Item = &'a Claim> + Clone) -> Truth {
        let any = |wanted: Claim| claims.clone().any(|claim| *claim == wanted);
        if any(Claim::Proved) {
            return Truth::Solvable;
        }
        if !any(Claim::Within) && !any(Claim::Impossible) || lcp.coupling().is_some() {
            return Truth::Unknown;
        }
        // Not the solver: it takes a start that is within the tolerance.
        match all_solutions(lcp) {
            Some(solutions) if solutions.is_empty() => Truth::Impossible,
            Some(_) => Truth::Solvable,
            None => Truth::Unknown,
        }
    }
}

impl Claim {
    /// The claim of a solution, as far as the judge can see.
    pub fn of(lcp: &Lcp, solution: Solution) -> Claim {
        let demand = Demand { tolerance: Settings::default().tolerance, prove_up_to: lcp.len() };
        match &solution.status {
            Status::Solved if solution.x.iter().any(|x| !x.is_finite()) => {
                Claim::Lie(Lie::NotFinite)
            }
            Status::Solved => match judge(lcp, &solution.x, &demand).verdict {
                Verdict::Proved { .. } => Claim::Proved,
                Verdict::WithinTolerance => Claim::Within,
                Verdict::NotASolution { row, amount } => Claim::Lie(Lie::Refuted { row, amount }),
            },
            Status::NoSolution => Claim::Impossible,
            Status::Ray { row, direction } if refute(lcp, *row, direction).is_some() => {
                Claim::Impossible
            }
            Status::OutsideClass { .. } => Claim::Outside,
            _ => Claim::Unsolved,
        }
    }

    /// Holds a claim against the truth.
    pub(super) fn weigh(&mut self, truth: Truth) {
        match (truth, &self) {
            (Truth::Impossible, Claim::Within) => *self = Claim::Strained,
            (Truth::Solvable, Claim::Impossible) => *self = Claim::Lie(Lie::DeniedASolution),
            _ => {}
        }
    }
}
