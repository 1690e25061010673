//! What a search looks for, as a number that grows towards it.

use std::fmt;
use std::str::FromStr;

use lcplab_judge::regularity::least_eigenvalue;
use lcplab_judge::{Demand, Evidence, Verdict, judge};
use lcplab_problem::error::{Error, Result};
use lcplab_problem::exact::all_solutions;
use lcplab_problem::number::readable;
use lcplab_problem::{Lcp, merit};
use lcplab_solver::{Choice, Entry, MatrixClass, Options, Solution, Start, Status};

use super::truth::{Claim, Lie, Truth};
use crate::card::class_of;

/// Up to so many rows a claim that the judge accepts is held against all pieces of the problem.
const TRUTH_ROWS: usize = 5;
/// Values of 2 − ω that are tried for the best one: 1, 1/√2, …, 2⁻¹².
const OMEGAS: i32 = 24;

/// What breaks a solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// It claims what is not true.
    Lie,
    /// It finds no solution of a problem of its class that has one.
    Failure,
    /// It takes many iterations.
    Iterations,
    /// Its answer is accepted and lies far from the exact solution, in parts of max |x|.
    Error,
    /// It takes many times the iterations of another one.
    Ratio,
}

impl FromStr for Measure {
    type Err = String;

    fn from_str(word: &str) -> std::result::Result<Self, String> {
        match word {
            "lie" => Ok(Measure::Lie),
            "failure" => Ok(Measure::Failure),
            "iterations" => Ok(Measure::Iterations),
            "error" => Ok(Measure::Error),
            "ratio" => Ok(Measure::Ratio),
            _ => Err("must be lie, failure, iterations, error or ratio".into()),
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Measure::Lie => "lie",
            Measure::Failure => "failure",
            Measure::Iterations => "iterations",
            Measure::Error => "error",
            Measure::Ratio => "ratio",
        })
    }
}

impl Measure {
    /// Whether it is there: where that is a question of yes or no, by this answer.
    pub(super) fn is_found(self, answer: bool) -> bool {
        answer || !self.is_yes_or_no()
    }

    /// Whether there is nothing more to climb once it is found.
    pub(super) fn is_yes_or_no(self) -> bool {
        matches!(self, Measure::Lie | Measure::Failure)
    }
}

/// A solver, and what is looked for in it.
#[derive(Debug, Clone)]
pub struct Trial {
    /// What is looked for.
    pub measure: Measure,
    /// The solver.
    pub solver: Entry,
    /// The one that it is compared with, for [`Measure::Ratio`].
    pub rival: Option<Entry>,
    /// The options of both.
    pub options: Options,
    /// The class that the matrix must belong to, whatever the solver is made for.
    pub within: MatrixClass,
    /// Whether only problems with friction are looked at.
    pub with_friction: bool,
    /// Whether a rival that has an ω is given the best one for each problem.
    pub best_omega: bool,
}

/// How a solver does on a problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// What the measure measures; 0 where it says nothing.
    pub value: f64,
    /// Whether a [lie](Measure::Lie) or a [failure](Measure::Failure) was found.
    pub is_found: bool,
    /// What it took.
    pub iterations: usize,
}

impl Trial {
    /// The class to keep to where problems are given: semidefinite if they are, any otherwise.
    pub fn class_of(given: &[Lcp]) -> MatrixClass {
        match given.iter().all(|lcp| is_of(MatrixClass::Semidefinite, lcp)) {
            true => MatrixClass::Semidefinite,
            false => MatrixClass::General,
        }
    }

    /// Checks that the measure has what it needs.
    ///
    /// # Errors
    /// If it lacks a rival, or has one that it does not need.
    pub fn validate(&self) -> Result<()> {
        match (self.measure, &self.rival) {
            (Measure::Ratio, None) => {
                Err(Error::invalid("options", "--measure", "ratio needs a rival: ratio A:B"))
            }
            (Measure::Ratio, Some(_)) | (_, None) => Ok(()),
            _ => Err(Error::invalid("options", "--measure", "only ratio has a rival")),
        }
    }

    /// The measure of a problem, with at most so many iterations; cold starts.
    pub fn score(&self, lcp: &Lcp, most: usize) -> Score {
        let solution = self.solve(&self.solver, lcp, most);
        let iterations = solution.iterations;
        let (value, is_found) = match self.measure {
            Measure::Lie => self.lie(lcp, &solution),
            Measure::Failure => self.failure(lcp, &solution),
            _ if !self.is_solved(lcp, &solution) => (0.0, false),
            Measure::Iterations => (iterations as f64, false),
            Measure::Error => (self.error(lcp, &solution), false),
            Measure::Ratio => {
                let rival = self.rival_iterations(lcp, iterations).map(|k| k.max(1) as f64);
                (rival.map_or(0.0, |rival| iterations as f64 / rival), false)
            }
        };
        Score { value, is_found, iterations }
    }

    /// What the solver does on the problem, in a sentence.
    pub fn words(&self, lcp: &Lcp) -> String {
        let most = self.options.settings.max_iterations;
        let solution = self.solve(&self.solver, lcp, most);
        let name = self.solver.name;
        match self.measure {
            Measure::Lie => match self.claim(lcp, &solution) {
                Claim::Lie(lie) => format!("{name} says: {lie}"),
                _ => format!("{name}: {}", solution.status),
            },
            Measure::Failure => format!("{name} finds no solution: {}", solution.status),
            Measure::Iterations => format!("{name} takes {} iterations", solution.iterations),
            Measure::Error => {
                let error = self.error(lcp, &solution);
                format!(
                    "{name} is accepted, and {} of max |x| from an exact solution",
                    readable(error, 2)
                )
            }
            Measure::Ratio => {
                let rival = self.rival_iterations(lcp, most).unwrap_or_default();
                let other = self.rival.map_or("", |rival| rival.name);
                let omega = self.omega_words();
                format!("{name} takes {} iterations, {other}{omega} {rival}", solution.iterations)
            }
        }
    }

    fn omega_words(&self) -> String {
        match self.omegas().len() {
            1 => String::new(),
            count => format!(" with the best of {count} ω"),
        }
    }

    fn solve(&self, entry: &Entry, lcp: &Lcp, most: usize) -> Solution {
        self.solve_with(entry, lcp, most, self.options.omega)
    }

    fn solve_with(&self, entry: &Entry, lcp: &Lcp, most: usize, omega: f64) -> Solution {
        let mut options = Options { omega, ..self.options.clone() };
        options.settings.max_iterations = most;
        (entry.build)(&options).solve(lcp, &Start::default(), &mut ())
    }

    fn is_solved(&self, lcp: &Lcp, solution: &Solution) -> bool {
        let tolerance = self.options.settings.tolerance;
        solution.status == Status::Solved && merit::is_solution(lcp, &solution.x, tolerance)
    }

    /// The claim, held against the truth where that can be had quickly.
    fn claim(&self, lcp: &Lcp, solution: &Solution) -> Claim {
        let mut claim = Claim::of(lcp, solution, self.options.settings.tolerance);
        let is_proved = matches!(claim, Claim::Proved); // by a solution that was checked
        if lcp.len() <= TRUTH_ROWS && !is_proved {
            claim.weigh(Truth::of(lcp, std::iter::once(&claim)));
        }
        claim
    }

    fn lie(&self, lcp: &Lcp, solution: &Solution) -> (f64, bool) {
        match self.claim(lcp, solution) {
            Claim::Lie(Lie::Refuted { amount, .. }) => (amount, true),
            Claim::Lie(_) => (1.0, true),
            // As near to a lie as its residual: what climbs is what is nearly refused.
            Claim::Proved | Claim::Within => (merit::scaled_residual(lcp, &solution.x), false),
            _ => (0.0, false),
        }
    }

    fn failure(&self, lcp: &Lcp, solution: &Solution) -> (f64, bool) {
        if matches!(solution.status, Status::OutsideClass { .. }) {
            return (0.0, false);
        }
        let part = solution.iterations as f64 / self.options.settings.max_iterations.max(1) as f64;
        let fails = solution.status != Status::Solved
            && is_in_class(&self.solver, lcp)
            && all_solutions(lcp).is_some_and(|solutions| !solutions.is_empty());
        (if fails { 1.0 + part } else { part.min(1.0) }, fails)
    }

    /// Whether the problem may be laid to the solver: it is of the class that was asked for, and where a long way is
    /// looked for the solver, and its rival, are made for it.
    pub(super) fn is_fair(&self, lcp: &Lcp) -> bool {
        let all = || std::iter::once(&self.solver).chain(&self.rival);
        let must_suit = matches!(self.measure, Measure::Iterations | Measure::Ratio);
        let has_friction = lcp.coupling().is_some();
        (has_friction || !self.with_friction)
            && is_of(self.within, lcp)
            && (!must_suit || all().all(|entry| is_in_class(entry, lcp)))
    }

    /// How far the accepted answer is from the exact solution beside it, in parts of max |x|.
    fn error(&self, lcp: &Lcp, solution: &Solution) -> f64 {
        let tolerance = self.options.settings.tolerance;
        let certificate = judge(lcp, &solution.x, &Demand { tolerance, prove_up_to: lcp.len() });
        let distance = match (&certificate.verdict, &certificate.evidence) {
            (Verdict::Proved { distance }, None) => *distance, // the only one with these active rows
            (Verdict::WithinTolerance, Some(Evidence::FarSolution { distance })) => *distance,
            _ => return 0.0,
        };
        let size = solution.x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if size > 0.0 { distance / size } else { 0.0 }
    }

    /// The least iterations of the rival, if it solves the problem within so many.
    fn rival_iterations(&self, lcp: &Lcp, most: usize) -> Option<usize> {
        let rival = self.rival.as_ref()?;
        let mut best = None;
        for omega in self.omegas() {
            let most = best.unwrap_or(most);
            let solution = self.solve_with(rival, lcp, most, omega);
            if self.is_solved(lcp, &solution) && solution.iterations <= most {
                best = Some(solution.iterations);
            }
        }
        best
    }

    /// The relaxation factors that the rival is tried with, the slowest to grow beyond its best first.
    fn omegas(&self) -> Vec<f64> {
        let has_omega = self.rival.is_some_and(|rival| rival.uses.contains(&Choice::Omega));
        if self.best_omega && has_omega {
            (0..=OMEGAS).rev().map(|k| 2.0 - libm::exp2(-0.5 * f64::from(k))).collect()
        } else {
            vec![self.options.omega]
        }
    }
}

/// Whether A is semidefinite but for rounding, as J M⁻¹ Jᵀ of an engine.
fn is_nearly_semidefinite(lcp: &Lcp) -> bool {
    const ROUNDING: f64 = 1e-12;
    least_eigenvalue(lcp).is_some_and(|least| least >= -ROUNDING)
}

/// Whether the solver is made for the problem, as far as that can be decided. Every problem has bounds: one that
/// does not heed them fails.
fn is_in_class(entry: &Entry, lcp: &Lcp) -> bool {
    let class = entry.class;
    let has_diagonal = || (0..lcp.len()).all(|i| lcp.matrix().diagonal(i) > 0.0);
    let is_free = |i: usize| lcp.lo()[i].is_infinite() && lcp.hi()[i].is_infinite();
    let rows = class.coupling || lcp.coupling().is_none();
    let free = class.free_rows || !(0..lcp.len()).any(|i| is_free(i) && !lcp.is_coupled(i));
    let diagonal = !class.divides_by_diagonal || has_diagonal();
    rows && free && diagonal && is_of(class.matrix, lcp)
}

/// Whether A is of a class, as far as that can be decided.
fn is_of(class: MatrixClass, lcp: &Lcp) -> bool {
    use MatrixClass::{CopositivePlus, Definite, General, P, P0, POrSemidefinite, Semidefinite};
    let of = || class_of(lcp.matrix());
    match class {
        General => true,
        Definite => of() == Some(Definite),
        P => matches!(of(), Some(P | Definite)),
        Semidefinite | CopositivePlus => {
            matches!(of(), Some(Definite | Semidefinite)) || is_nearly_semidefinite(lcp)
        }
        P0 | POrSemidefinite => matches!(of(), Some(P | Definite | Semidefinite)),
    }
}
