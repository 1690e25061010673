//! Finds the known mistakes that give exactly this x.
//!
//! Most wrong answers of solvers come from a few mistakes. Each known mistake is applied to the
//! same problem, and its answer is compared with the given x, as is the exact solution nearest to
//! x: an x near a solution is near everything that converges to it. A mistake is reported only if
//! it explains x at least a hundred times better than the solution does, in more numbers than were
//! fitted to x; all mistakes that explain it equally well are reported.
//!
//! ```
//! use lcplab_lcp::friction::ProblemForm;
//! use lcplab_lcp::{Lcp, Matrix};
//! use lcplab_analysis::diagnosis::find_mistakes;
//!
//! // Three balls on each other; after two sweeps x = (2, 1.5, 0.25).
//! let a = Matrix::dense(3, &[1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0]);
//! let lcp = Lcp::new(a, vec![-1.0, -1.0, 1.0], vec![0.0; 3], vec![f64::INFINITY; 3])?;
//! let problem = ProblemForm::Boxed(lcp);
//! let found = find_mistakes(&problem, &[2.0, 1.5, 0.25], None);
//! assert_eq!(found.mistakes[0].what, "projected Gauss-Seidel, stopped after 2 sweeps");
//! assert_eq!(found.mistakes[0].distance, 0.0);
//! // The solution (4, 3, 1) but for a thousandth in one entry: no known mistake.
//! assert!(find_mistakes(&problem, &[4.001, 3.0, 1.0], None).mistakes.is_empty());
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod active_set;
mod attempts;
mod changed;
mod comparison;
mod contact_attempts;
mod contact_sweeps;
mod flawed_sweep;
mod friction_law;
mod kind;
mod moved_answer;
mod nearest;
mod precision;
mod sweeps;

pub use kind::MistakeKind;
pub use precision::Precision;
pub use sweeps::SweepLimits;

use std::collections::HashSet;

use lcplab_judge::regularity::regularity;
use lcplab_judge::{Demand, Verdict, judge_friction};
use lcplab_lcp::friction::ProblemForm;
use lcplab_lcp::{Lcp, merit};

use attempts::Attempts;
use comparison::{Agreement, Comparison};
use contact_sweeps::ContactSweeps;
use friction_law::rows;
use nearest::{distance, nearest_solution, on_active_set, solution};

/// Maximum number of rows for which mistakes are searched.
const LARGEST: usize = 500;
/// The residuals of x may differ from those of the mistake's answer by this part of the largest.
const MOST_DIFFERENCE: f64 = 0.5;
/// The same where rows are redundant, and x is one of many answers with its motion.
const MOST_DIFFERENCE_OF_MOTION: f64 = 0.01;
/// Maximum number of rows that a mistake names.
const LARGEST_LIST: usize = 6;

/// A mistake whose answer is this x.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// The kind of mistake.
    pub kind: MistakeKind,
    /// What was computed, with numbers.
    pub what: String,
    /// max |x − y| for the mistake's answer y, relative to the largest entry of x and of the
    /// solution.
    pub distance: f64,
    /// Whether x has too few digits to exclude that it agrees by chance.
    pub may_be_chance: bool,
}

/// The result of a search for the mistakes behind an answer.
#[derive(Debug, Clone, PartialEq)]
pub struct MistakeSearch {
    /// The judge's verdict on x.
    pub verdict: Verdict,
    /// The precision of x.
    pub precision: Precision,
    /// How the search ended.
    pub conclusion: Conclusion,
    /// The mistakes that give this x equally well within its digits; the nearest first, at equal
    /// distance the simplest.
    pub mistakes: Vec<Mistake>,
    /// The number of sweeps that were compared with x; 0 if nothing was compared.
    pub limits: SweepLimits,
    /// The number of rows of A that depend on others; with any, x need not be unique.
    pub redundant_rows: usize,
}

/// How a search for mistakes ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Conclusion {
    /// The judge accepts x, so there is no mistake to find.
    Accepted,
    /// An entry of x is not a finite number.
    NotFinite {
        /// Its row.
        row: usize,
    },
    /// The problem has more rows than the limit.
    TooManyRows {
        /// The maximum number of rows.
        limit: usize,
    },
    /// No solution of the problem is known, so the distance of x to one is unknown.
    NoSolutionKnown,
    /// x is an exact solution rounded to the digits of x.
    RoundedSolution {
        /// max |x − s| relative to the largest entry of both.
        distance: f64,
    },
    /// Every known mistake was compared with x.
    Compared {
        /// max |x − s| for the nearest known solution s, relative to the largest entry of both.
        solution_distance: f64,
    },
}

/// The known mistakes that give this x. `last` is the answer to the previous step, if it is known:
/// sweeps may start or should have started from it, and friction may still be limited by its normal
/// forces.
///
/// # Panics
/// If x or the last answer does not have one entry per row.
pub fn find_mistakes(problem: &ProblemForm, x: &[f64], last: Option<&[f64]>) -> MistakeSearch {
    let lcp = rows(problem);
    assert_eq!(x.len(), lcp.len(), "one entry per row");
    assert!(last.is_none_or(|last| last.len() == lcp.len()), "one entry per row");
    let mut search = MistakeSearch {
        verdict: judge_friction(problem, x, &Demand::default()).verdict,
        precision: Precision::of(x),
        conclusion: Conclusion::Accepted,
        mistakes: Vec::new(),
        limits: SweepLimits::default(),
        redundant_rows: 0,
    };
    if search.verdict.is_solution() {
        return search;
    }
    if let Some(row) = x.iter().position(|x| !x.is_finite()) {
        search.conclusion = Conclusion::NotFinite { row };
        return search;
    }
    if lcp.len() > LARGEST {
        search.conclusion = Conclusion::TooManyRows { limit: LARGEST };
        return search;
    }
    let limits = SweepLimits::of(lcp);
    search.redundant_rows = regularity(lcp.matrix()).map_or(0, |found| found.dependencies.len());
    let mut attempts = Attempts {
        lcp,
        x,
        limits,
        redundant_rows: search.redundant_rows,
        posed: problem,
        residuals: friction_law::residuals(problem, x),
        found: Vec::new(),
        last_iterates: Vec::new(),
    };
    let solution = match problem {
        ProblemForm::Boxed(_) => {
            attempts.unchanged(last);
            nearest_solution(lcp, x, &attempts.last_iterates)
        }
        ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => {
            attempts.unchanged_contacts(last);
            attempts.nearest_known()
        }
    };
    let Some(solution) = solution else {
        search.conclusion = Conclusion::NoSolutionKnown;
        return search;
    };
    let comparison = Comparison::new(x, &solution, search.precision);
    let solution_distance = comparison.solution_distance();
    if comparison.is_rounded_solution() {
        search.conclusion = Conclusion::RoundedSolution { distance: solution_distance };
        return search;
    }
    if let ProblemForm::Boxed(_) = problem {
        attempts.changed(last);
        attempts.fitted(&solution);
        attempts.flawed();
    }
    attempts.of_any_law(&solution);
    attempts.changed_contacts(last);
    search.conclusion = Conclusion::Compared { solution_distance };
    search.limits = limits;
    let posed =
        PosedProblem { problem, residuals: &attempts.residuals, redundant: search.redundant_rows };
    search.mistakes = explanations(&comparison, &posed, attempts.found);
    if search.mistakes.is_empty() {
        let own = wrong_active_set(problem, x);
        search.mistakes = explanations(&comparison, &posed, own);
    }
    search
}

/// The accuracy of single precision: the scaled residuals of x and of the solution, both rounded to
/// it, if a solver finds one.
///
/// ```
/// use lcplab_analysis::diagnosis::single_precision;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = 3 x − 1: ⅓ has an error of 1e-8 in 32 bits.
/// let lcp = Lcp::new(Matrix::from([[3.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let [own, rounded] = single_precision(&lcp, &[1.0 / 3.0]).unwrap();
/// assert!(own < 1e-15 && 1e-9 < rounded && rounded < 1e-7);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn single_precision(lcp: &Lcp, x: &[f64]) -> Option<[f64; 2]> {
    let rounded: Vec<f64> = solution(lcp)?.iter().map(|&x| f64::from(x as f32)).collect();
    Some([merit::scaled_residual(lcp, x), merit::scaled_residual(lcp, &rounded)])
}

/// The answer of a mistake.
struct Attempt {
    kind: MistakeKind,
    what: String,
    y: Vec<f64>,
    /// The number of sweeps; 1 if none were done.
    sweeps: usize,
    /// The number of values that were fitted to x.
    fitted: usize,
    /// The scaled residual of each row in the changed problem, if y is x itself.
    residuals: Option<Vec<f64>>,
}

impl Attempt {
    fn new(kind: MistakeKind, what: String, y: Vec<f64>) -> Self {
        Attempt { kind, what, y, sweeps: 1, fitted: 0, residuals: None }
    }
}

/// The equations of the active set of x, in which the rows at a bound are as in x.
fn wrong_active_set(problem: &ProblemForm, x: &[f64]) -> Vec<Attempt> {
    let found = match problem {
        ProblemForm::Boxed(lcp) => on_active_set(lcp, x),
        ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => {
            ContactSweeps::of(problem).and_then(|own| active_set::on_active_set(&own, x))
        }
    };
    let attempt = |(y, fitted): (Vec<f64>, usize)| {
        let what = "the equations of its own active set, which is not that of a solution".into();
        Attempt { fitted, ..Attempt::new(MistakeKind::WrongActiveSet, what, y) }
    };
    found.map(attempt).into_iter().collect()
}

/// The problem as posed, with the scaled residual of each row at x.
struct PosedProblem<'a> {
    problem: &'a ProblemForm,
    residuals: &'a [f64],
    /// The number of rows that depend on others.
    redundant: usize,
}

impl PosedProblem<'_> {
    /// Whether y violates the problem as x does. If y is right, or nearly, the error of x is its
    /// own, however near y is: of many solutions, the answer of a mistake may be one.
    fn has_same_violation(&self, y: &[f64]) -> bool {
        let largest = self.residuals.iter().copied().fold(0.0, f64::max);
        let part = if self.redundant > 0 { MOST_DIFFERENCE_OF_MOTION } else { MOST_DIFFERENCE };
        let own = friction_law::residuals(self.problem, y);
        distance(self.residuals, &own) <= part * largest
            && !judge_friction(self.problem, y, &Demand::default()).verdict.is_solution()
    }
}

/// The attempts that explain x: the nearest first, then all that are as near, each once.
fn explanations(
    comparison: &Comparison<'_>,
    posed: &PosedProblem<'_>,
    attempts: Vec<Attempt>,
) -> Vec<Mistake> {
    let count = attempts.len();
    let agreement = |attempt: Attempt| {
        let agreement = match &attempt.residuals {
            Some(changed) => comparison.judged(posed.residuals, changed, attempt.fitted),
            None => comparison.agreement(&attempt.y, attempt.fitted)?,
        };
        let is_found = agreement.is_no_chance(count * attempt.sweeps);
        (is_found && posed.has_same_violation(&attempt.y)).then_some((attempt, agreement))
    };
    let mut found: Vec<(Attempt, Agreement)> = attempts.into_iter().filter_map(agreement).collect();
    // The sort is stable: the simplest first.
    found.sort_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance));
    let nearest = found.first().map(|(_, agreement)| *agreement);
    found.retain(|(_, own)| nearest.is_some_and(|nearest| own.is_as_near_as(&nearest)));
    let mut named = HashSet::new();
    found.retain(|(attempt, _)| named.insert(attempt.what.clone()));
    let mistake = |(attempt, agreement): (Attempt, Agreement)| Mistake {
        kind: attempt.kind,
        may_be_chance: agreement.may_be_chance(count * attempt.sweeps),
        what: attempt.what,
        distance: comparison.relative(agreement.distance),
    };
    found.into_iter().map(mistake).collect()
}
