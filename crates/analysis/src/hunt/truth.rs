//! A solver's claim on a problem, the judge's verdict, and the truth.

use lcplab_judge::{Demand, Refusal, Verdict, judge, judge_friction, refutation};
use lcplab_lcp::Lcp;
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::friction::ProblemForm;
use lcplab_lcp::number::readable;
use lcplab_solver::{Solution, Status};

use super::sweeps::residual_left;

/// The truth about a problem, from exact arithmetic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Truth {
    /// It has a solution.
    Solvable,
    /// It has none.
    Impossible,
    /// Unknown: neither was shown.
    Unknown,
}

/// A solver's claim on a problem, with the judge's verdict.
#[derive(Debug, Clone, PartialEq)]
pub enum Claim {
    /// A solution, and the judge proves that an exact one is near it.
    Proved,
    /// A solution, and the judge finds it within the tolerance.
    Within,
    /// A solution within the tolerance, but the judge proves that the problem has none.
    Refused,
    /// No solution exists, and the judge proves it.
    Impossible,
    /// No answer, with a reason.
    Unsolved,
    /// The problem is outside its class.
    Outside,
    /// A false claim or verdict.
    FalseClaim(FalseClaim),
}

/// A claim, or a verdict, that is not true.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FalseClaim {
    /// *Solved*, but row `row` has the relative residual `amount`.
    Rejected {
        /// The worst row.
        row: usize,
        /// Its scaled residual.
        amount: f64,
    },
    /// *Solved*, but x is no nearer to a solution than Π(0).
    Worthless,
    /// *Solved*, but x is not finite.
    NotFinite,
    /// *No solution*, but there is one.
    DeniedASolution,
    /// The judge says *proved* or *within tolerance*, but there is no solution.
    Accepted,
    /// The judge says that there is no solution, but there is one.
    WronglyRefused,
}

impl std::fmt::Display for FalseClaim {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            FalseClaim::Rejected { row, amount } => {
                write!(
                    f,
                    "solved, but the scaled residual is {} in row {row}",
                    readable(*amount, 2)
                )
            }
            FalseClaim::Worthless => {
                write!(f, "solved, but x is no closer to a solution than x = 0")
            }
            FalseClaim::NotFinite => write!(f, "solved, but x is not finite"),
            FalseClaim::DeniedASolution => write!(f, "no solution, but one exists"),
            FalseClaim::Accepted => write!(f, "accepted by the judge, but no solution exists"),
            FalseClaim::WronglyRefused => write!(f, "no solution by the judge, but one exists"),
        }
    }
}

impl Truth {
    /// The truth from all pieces of a problem, including coupled rows, if a claim depends on it.
    pub(crate) fn of<'a>(lcp: &Lcp, mut claims: impl Iterator<Item = &'a Claim>) -> Truth {
        let depends = |claim: &Claim| {
            matches!(claim, Claim::Proved | Claim::Within | Claim::Refused | Claim::Impossible)
        };
        if !claims.any(depends) {
            return Truth::Unknown;
        }
        match all_solutions(lcp) {
            // A contradiction can be below the tolerance times the scale, and then does not count.
            Some(solutions) if solutions.is_empty() && lcp.scale() > 0.0 => Truth::Unknown,
            Some(solutions) if solutions.is_empty() => Truth::Impossible,
            Some(_) => Truth::Solvable,
            None => Truth::Unknown,
        }
    }
}

impl Claim {
    /// The claim of a solution to an LCP, as far as the judge can decide.
    pub(crate) fn of(lcp: &Lcp, solution: &Solution, tolerance: f64) -> Claim {
        Claim::under(&ProblemForm::Boxed(lcp.clone()), solution, tolerance)
    }

    /// The claim of a solution under a friction model, as far as the judge can decide.
    ///
    /// An x without a status that the judge rejects is not a claim if it may be the last iterate of
    /// a solver that ran out of sweeps: if plain projected Gauss-Seidel does not come twice as near
    /// in the same number of sweeps either.
    pub(crate) fn under(posed: &ProblemForm, solution: &Solution, tolerance: f64) -> Claim {
        match Claim::stated(posed, solution, tolerance) {
            Claim::FalseClaim(FalseClaim::Rejected { amount, .. })
                if solution.is_claim_implied
                    && amount <= residual_left(posed, solution, tolerance) =>
            {
                Claim::Unsolved
            }
            claim => claim,
        }
    }

    /// The claim, taken literally.
    fn stated(posed: &ProblemForm, solution: &Solution, tolerance: f64) -> Claim {
        match &solution.status {
            Status::Solved if solution.x.iter().any(|x| !x.is_finite()) => {
                Claim::FalseClaim(FalseClaim::NotFinite)
            }
            Status::Solved => {
                let demand = Demand { tolerance, prove_up_to: posed_rows(posed) };
                Claim::judged(match posed {
                    ProblemForm::Boxed(lcp) => judge(lcp, &solution.x, &demand).verdict,
                    _ => judge_friction(posed, &solution.x, &demand).verdict,
                })
            }
            Status::NoSolution => match refuted(posed, &[]) {
                Some(true) => Claim::Impossible,
                Some(false) => Claim::FalseClaim(FalseClaim::DeniedASolution),
                None => Claim::Unsolved,
            },
            Status::Ray { direction, .. } if refuted(posed, &[direction]) == Some(true) => {
                Claim::Impossible
            }
            Status::OutsideClass { .. } => Claim::Outside,
            _ => Claim::Unsolved,
        }
    }

    /// The claim *solved*, with the judge's verdict on it.
    fn judged(verdict: Verdict) -> Claim {
        match verdict {
            Verdict::Proved { .. } => Claim::Proved,
            Verdict::WithinTolerance => Claim::Within,
            Verdict::NotASolution { why: Refusal::Impossible, .. } => Claim::Refused,
            Verdict::NotASolution { why: Refusal::NoBetterThanZero, .. } => {
                Claim::FalseClaim(FalseClaim::Worthless)
            }
            Verdict::NotASolution { row, amount, why: Refusal::Residual { .. } } => {
                Claim::FalseClaim(FalseClaim::Rejected { row, amount })
            }
            // A verdict of a later judge neither confirms nor refutes the claim.
            _ => Claim::Unsolved,
        }
    }

    /// Whether the solver answered the problem: with a solution, or correctly that there is none.
    pub(crate) fn is_right(&self) -> bool {
        matches!(self, Claim::Proved | Claim::Within | Claim::Refused | Claim::Impossible)
    }

    /// Compares a claim, and the judge's verdict on it, with the truth.
    pub(super) fn weigh(&mut self, truth: Truth) {
        match (truth, &self) {
            (Truth::Impossible, Claim::Proved | Claim::Within) => {
                *self = Claim::FalseClaim(FalseClaim::Accepted)
            }
            (Truth::Solvable, Claim::Refused) => {
                *self = Claim::FalseClaim(FalseClaim::WronglyRefused)
            }
            (Truth::Solvable, Claim::Impossible) => {
                *self = Claim::FalseClaim(FalseClaim::DeniedASolution)
            }
            _ => {}
        }
    }
}

/// Whether the judge proves that there is no solution; `None` for cones and rounded polygons, for
/// which no proof is possible.
fn refuted(posed: &ProblemForm, hints: &[&[f64]]) -> Option<bool> {
    match posed {
        ProblemForm::Boxed(lcp) => Some(refutation(lcp, hints, 0.0).is_some()),
        ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => None,
    }
}

fn posed_rows(posed: &ProblemForm) -> usize {
    match posed {
        ProblemForm::Boxed(lcp) => lcp.len(),
        ProblemForm::Polyhedral(polygon) => polygon.lcp().len(),
        ProblemForm::Cone(cone) => cone.friction().lcp().len(),
    }
}
