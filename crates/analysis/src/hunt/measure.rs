//! The measures that a search maximizes.

use std::fmt;
use std::str::FromStr;

use crate::trial::Trial;
use lcplab_judge::{Demand, Evidence, Verdict, judge, judge_friction};
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::friction::{Form, FrictionProblem, Model, ProblemForm};
use lcplab_lcp::number::{counted, readable};
use lcplab_lcp::{Lcp, merit};
use lcplab_solver::{Choice, MatrixClass, Method, Options, Solution, Status};

use super::membership::is_of;
use super::posing::pose;
use super::sweeps;
use super::truth::{Claim, FalseClaim, Truth};

/// Maximum number of rows for which an accepted claim is checked against all pieces of the problem.
const TRUTH_ROWS: usize = 5;
/// Number of values of 2 − ω that are tried to find the best: 1, 1/√2, …, 2⁻¹².
const OMEGAS: i32 = 24;

/// The kind of bad behavior that a search looks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// The solver makes a false claim.
    FalseClaim,
    /// The solver does not solve a solvable problem of its class.
    Failure,
    /// The solver needs many iterations.
    Iterations,
    /// The answer is accepted but far from the exact solution, relative to max |x|.
    Error,
    /// The solver needs many times the iterations of another one.
    Ratio,
}

impl FromStr for Measure {
    type Err = String;

    fn from_str(word: &str) -> std::result::Result<Self, String> {
        match word {
            "false-claim" => Ok(Measure::FalseClaim),
            "failure" => Ok(Measure::Failure),
            "iterations" => Ok(Measure::Iterations),
            "error" => Ok(Measure::Error),
            "ratio" => Ok(Measure::Ratio),
            _ => Err("must be false-claim, failure, iterations, error or ratio".into()),
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Measure::FalseClaim => "false-claim",
            Measure::Failure => "failure",
            Measure::Iterations => "iterations",
            Measure::Error => "error",
            Measure::Ratio => "ratio",
        })
    }
}

impl Measure {
    /// Whether it is found, for a yes-or-no measure with this answer.
    pub(super) fn is_found(self, answer: bool) -> bool {
        answer || !self.is_yes_or_no()
    }

    /// Whether there is nothing to improve once it is found.
    pub(super) fn is_yes_or_no(self) -> bool {
        matches!(self, Measure::FalseClaim | Measure::Failure)
    }
}

/// A solver, and the measure to search for.
#[derive(Debug, Clone)]
pub struct Target {
    /// The measure.
    pub measure: Measure,
    /// The solver.
    pub solver: Method,
    /// The baseline solver for [`Measure::Ratio`].
    pub baseline: Option<Method>,
    /// The options of both solvers.
    pub options: Options,
    /// The friction model for problems and answers; only problems with friction are then used.
    /// `None` means LCPs with friction rows as coupled rows.
    pub model: Option<Model>,
    /// The class that the matrix must belong to, whatever the solver is made for.
    pub within: MatrixClass,
    /// Whether problems with friction are included.
    pub friction: Friction,
    /// Whether friction rows may be other than the two tangents of a contact with one μ.
    pub allows_single_tangents: bool,
    /// Whether a baseline with a relaxation factor ω gets the best one for each problem.
    pub best_omega: bool,
}

/// Which problems a search includes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Friction {
    /// Problems with and without friction.
    #[default]
    Any,
    /// Only problems with friction.
    Only,
    /// Only problems without friction.
    Never,
}

/// The result of a solver on a problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// The value of the measure; 0 if it does not apply.
    pub value: f64,
    /// Whether a [false claim](Measure::FalseClaim) or a [failure](Measure::Failure) was found.
    pub is_found: bool,
    /// Whether the solver's claim is right: an accepted answer, or correctly that none exists.
    pub is_right: bool,
    /// Whether the solver answers at all, without a crash, a timeout or unreadable output.
    pub is_answered: bool,
    /// The number of iterations.
    pub iterations: usize,
}

impl Score {
    /// The score of a problem on which the solver was not run.
    pub(super) const NOTHING: Score =
        Score { value: 0.0, is_found: false, is_right: false, is_answered: true, iterations: 0 };
}

/// Why a problem is excluded from a search.
#[derive(Debug, Clone, PartialEq)]
pub enum Exclusion {
    /// It has friction, or has none, contrary to the request.
    Friction(Friction),
    /// Its friction rows are not the two tangents of contacts, for this reason.
    NoPairs(String),
    /// A is not shown to be in the class.
    Class(MatrixClass),
    /// This solver is not made for it.
    Solver(String),
}

impl fmt::Display for Exclusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Exclusion::Friction(Friction::Never) => write!(f, "it has friction rows"),
            Exclusion::Friction(_) => write!(f, "it has no friction rows"),
            Exclusion::NoPairs(reason) => write!(f, "{reason}"),
            Exclusion::Class(class) => write!(f, "A is not shown to be {class}"),
            Exclusion::Solver(name) => write!(f, "{name} does not support such a problem"),
        }
    }
}

impl Target {
    /// Checks that it is complete.
    ///
    /// # Errors
    /// If it lacks a baseline, has one that it does not need, needs exact solutions that the
    /// friction model does not have, or a solver is not made for the model.
    pub fn validate(&self) -> Result<()> {
        let wrong = |reason: String| Err(Error::invalid("search", "measure", reason));
        match (self.measure, &self.baseline) {
            (Measure::Ratio, None) => {
                return wrong("ratio needs a second solver: ratio A:B".into());
            }
            (Measure::Ratio, Some(_)) | (_, None) => {}
            _ => return wrong("only ratio compares with a second solver".into()),
        }
        match self.model {
            Some(model) if self.measure == Measure::Error && model.form() != Form::Box => {
                wrong(format!("error needs the exact solution, which {model} does not have"))
            }
            model => self
                .methods()
                .find_map(|method| Some((method, method.refusal(model)?)))
                .map_or(Ok(()), |(method, reason)| {
                    Err(Error::invalid(format!("solver {}", method.name()), "model", reason))
                }),
        }
    }

    /// The solver and its baseline.
    fn methods(&self) -> impl Iterator<Item = &Method> {
        std::iter::once(&self.solver).chain(&self.baseline)
    }

    /// Whether only problems with friction are included.
    pub(super) fn needs_friction(&self) -> bool {
        self.friction == Friction::Only || self.model.is_some()
    }

    /// The score on a problem, with this iteration limit and cold starts.
    pub fn score(&self, lcp: &Lcp, most: usize) -> Score {
        let Ok(posed) = pose(lcp, self.model) else {
            return Score::NOTHING;
        };
        let solution = self.solve(&self.solver, &posed, most);
        let iterations = solution.iterations;
        let claim = match self.measure {
            Measure::FalseClaim => Some(self.claim(&posed, &solution)),
            _ => None,
        };
        let is_right = match &claim {
            Some(claim) => claim.is_right(),
            None => self.is_solved(&posed, &solution),
        };
        let (value, is_found) = match (self.measure, &claim) {
            (Measure::FalseClaim, claim) => {
                claim.as_ref().map_or((0.0, false), |claim| false_claim(&posed, claim, &solution))
            }
            (Measure::Failure, _) => self.failure(lcp, &posed, &solution, is_right),
            _ if !is_right => (0.0, false),
            (Measure::Iterations, _) => (iterations as f64, false),
            (Measure::Error, _) => (self.error(&posed, &solution), false),
            (Measure::Ratio, _) => {
                let baseline =
                    self.baseline_iterations(&posed, iterations).map(|k| k.max(1) as f64);
                (baseline.map_or(0.0, |baseline| iterations as f64 / baseline), false)
            }
        };
        let is_answered = !matches!(solution.status, Status::NoAnswer { .. });
        Score { value, is_found, is_right, is_answered, iterations }
    }

    /// The solver's answer to a problem.
    ///
    /// # Errors
    /// If the problem cannot be formulated under the model.
    pub fn answer(&self, lcp: &Lcp) -> Result<Solution> {
        let posed = pose(lcp, self.model)?;
        Ok(self.solve(&self.solver, &posed, self.options.settings.max_iterations))
    }

    /// The solver's behavior on the problem, in a sentence; `solution` is its
    /// [answer](Target::answer).
    pub(crate) fn words(&self, lcp: &Lcp, solution: &Solution) -> String {
        let name = self.solver.name();
        let Ok(posed) = pose(lcp, self.model) else { return format!("{name} is not tried") };
        match self.measure {
            Measure::FalseClaim => match self.claim(&posed, solution) {
                Claim::FalseClaim(claim) if solution.is_claim_implied => format!(
                    "{name} says: {claim} (it returns x without a status, which counts as \"solved\" if plain \
                     projected Gauss-Seidel has less than half the residual after the same number of sweeps)"
                ),
                Claim::FalseClaim(claim) => format!("{name} says: {claim}"),
                _ => format!("{name}: {}", solution.status),
            },
            Measure::Failure if solution.status == Status::Solved => {
                format!("{name} finds no solution: the judge rejects its x")
            }
            Measure::Failure => format!("{name} finds no solution: {}", solution.status),
            Measure::Iterations => {
                format!("{name} needs {}", counted(solution.iterations, "iteration"))
            }
            Measure::Error => {
                let error = readable(self.error(&posed, solution), 2);
                format!("the answer of {name} is accepted, but its error is {error} of max |x|")
            }
            Measure::Ratio => {
                let most = self.options.settings.max_iterations;
                let baseline = self.baseline_iterations(&posed, most).unwrap_or_default();
                let other = self.baseline.as_ref().map_or("", |baseline| baseline.name());
                let omega = self.omega_words();
                let iterations = counted(solution.iterations, "iteration");
                format!("{name} needs {iterations}, {other}{omega} {baseline}")
            }
        }
    }

    fn omega_words(&self) -> String {
        match self.omegas().len() {
            1 => String::new(),
            count => format!(" with the best of {count} values of ω"),
        }
    }

    fn solve(&self, method: &Method, posed: &ProblemForm, most: usize) -> Solution {
        self.solve_with(method, posed, most, self.options.omega)
    }

    fn solve_with(
        &self,
        method: &Method,
        posed: &ProblemForm,
        most: usize,
        omega: f64,
    ) -> Solution {
        let mut options = self.options.clone().with_omega(omega);
        options.settings.max_iterations = most;
        Trial::run(method, posed, &options, &mut ()).solution
    }

    fn is_solved(&self, posed: &ProblemForm, solution: &Solution) -> bool {
        let tolerance = self.options.settings.tolerance;
        solution.status == Status::Solved
            && match posed {
                ProblemForm::Boxed(lcp) => merit::is_solution(lcp, &solution.x, tolerance),
                _ => {
                    let demand = Demand { tolerance, prove_up_to: 0 };
                    judge_friction(posed, &solution.x, &demand).verdict.is_solution()
                }
            }
    }

    /// The claim, compared with the true solutions if they can be computed quickly.
    fn claim(&self, posed: &ProblemForm, solution: &Solution) -> Claim {
        let mut claim = Claim::under(posed, solution, self.options.settings.tolerance);
        // Proved by a solution that was checked.
        let is_proved = matches!(claim, Claim::Proved);
        if let ProblemForm::Boxed(lcp) = posed
            && lcp.len() <= TRUTH_ROWS
            && !is_proved
        {
            claim.weigh(Truth::of(lcp, std::iter::once(&claim)));
        }
        claim
    }

    fn failure(
        &self,
        lcp: &Lcp,
        posed: &ProblemForm,
        solution: &Solution,
        is_solved: bool,
    ) -> (f64, bool) {
        if matches!(solution.status, Status::OutsideClass { .. }) {
            return (0.0, false);
        }
        let part = solution.iterations as f64 / self.options.settings.max_iterations.max(1) as f64;
        let is_claim = solution.status == Status::Solved && !solution.is_claim_implied;
        let fails =
            !is_solved && !is_claim && is_in_class(&self.solver, lcp) && has_solution(lcp, posed);
        (if fails { 1.0 + part } else { part.min(1.0) }, fails)
    }

    /// Whether a search for this target may use the problem.
    pub(super) fn is_fair(&self, lcp: &Lcp) -> bool {
        self.unfair(lcp).is_none()
    }

    /// Why a search may not use the problem: it is not of the requested class or kind or,
    /// for measures of cost, the solver or its baseline is not made for it.
    pub(crate) fn unfair(&self, lcp: &Lcp) -> Option<Exclusion> {
        let has_friction = lcp.coupling().is_some_and(|coupling| !coupling.is_empty());
        let is_barred = has_friction && self.friction == Friction::Never;
        if is_barred || self.needs_friction() && !has_friction {
            return Some(Exclusion::Friction(self.friction));
        }
        if has_friction
            && !self.allows_single_tangents
            && let Err(error) = FrictionProblem::of(lcp)
        {
            return Some(Exclusion::NoPairs(error.to_string()));
        }
        if !is_of(self.within, lcp) {
            return Some(Exclusion::Class(self.within));
        }
        let must_suit = matches!(self.measure, Measure::Iterations | Measure::Ratio);
        let unsuited = self.methods().find(|method| must_suit && !is_in_class(method, lcp));
        unsuited.map(|method| Exclusion::Solver(method.name().to_string()))
    }

    /// The distance of the accepted answer from the nearest exact solution, relative to max |x|.
    fn error(&self, posed: &ProblemForm, solution: &Solution) -> f64 {
        let ProblemForm::Boxed(lcp) = posed else { return 0.0 };
        let tolerance = self.options.settings.tolerance;
        let certificate = judge(lcp, &solution.x, &Demand { tolerance, prove_up_to: lcp.len() });
        let distance = match (&certificate.verdict, &certificate.evidence) {
            // It is the only solution with these active rows.
            (Verdict::Proved { distance }, None) => *distance,
            (Verdict::WithinTolerance, Some(Evidence::FarSolution { distance })) => *distance,
            _ => return 0.0,
        };
        let size = solution.x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if size > 0.0 { distance / size } else { 0.0 }
    }

    /// The least number of iterations of the baseline, if it solves the problem within this limit.
    fn baseline_iterations(&self, posed: &ProblemForm, most: usize) -> Option<usize> {
        let baseline = self.baseline.as_ref()?;
        let mut best = None;
        for omega in self.omegas() {
            let most = best.unwrap_or(most);
            let solution = self.solve_with(baseline, posed, most, omega);
            if self.is_solved(posed, &solution) && solution.iterations <= most {
                best = Some(solution.iterations);
            }
        }
        best
    }

    /// The relaxation factors tried for the baseline.
    fn omegas(&self) -> Vec<f64> {
        let has_omega =
            self.baseline.as_ref().is_some_and(|baseline| baseline.uses().contains(&Choice::Omega));
        if self.best_omega && has_omega {
            (0..=OMEGAS).rev().map(|k| 2.0 - libm::exp2(-0.5 * f64::from(k))).collect()
        } else {
            vec![self.options.omega]
        }
    }
}

/// The amount by which a claim is false, and whether it is.
fn false_claim(posed: &ProblemForm, claim: &Claim, solution: &Solution) -> (f64, bool) {
    match claim {
        Claim::FalseClaim(FalseClaim::Rejected { amount, .. }) => (*amount, true),
        Claim::FalseClaim(_) => (1.0, true),
        // Nearly rejected answers score by their residual, which gives the search a direction.
        Claim::Proved | Claim::Within => (sweeps::residual(posed, &solution.x), false),
        _ => (0.0, false),
    }
}

/// Whether the problem is known to have a solution: by exact arithmetic or, with friction, because
/// A is definite.
fn has_solution(lcp: &Lcp, posed: &ProblemForm) -> bool {
    match posed {
        ProblemForm::Boxed(lcp) => {
            all_solutions(lcp).is_some_and(|solutions| !solutions.is_empty())
        }
        // Acary, Cadoux, Lemaréchal & Malick 2011; Stewart & Trinkle 1996.
        ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => is_of(MatrixClass::Definite, lcp),
    }
}

/// Whether the method is made for the problem, as far as that can be decided. Every problem has
/// bounds: a method that ignores them fails.
fn is_in_class(method: &Method, lcp: &Lcp) -> bool {
    let class = match method {
        Method::Boxed(entry) => entry.class,
        Method::Cone(entry) => entry.class,
    };
    let has_diagonal = || (0..lcp.len()).all(|i| lcp.matrix().diagonal(i) > 0.0);
    let is_free = |i: usize| lcp.lo()[i].is_infinite() && lcp.hi()[i].is_infinite();
    let rows = class.coupling || lcp.coupling().is_none();
    let free = class.free_rows || !(0..lcp.len()).any(|i| is_free(i) && !lcp.is_coupled(i));
    let diagonal = !class.divides_by_diagonal || has_diagonal();
    rows && free && diagonal && is_of(class.matrix, lcp)
}
