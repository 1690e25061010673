//! One trial: a method solves a problem with its settings, the judge examines the answer, and the
//! cost is measured. Every comparison, profile, grid and search runs its solvers by [`Trial::run`].

use std::ops::ControlFlow;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use lcplab_judge::{Demand, FrictionCertificate, Verdict, judge, judge_friction};
use lcplab_lcp::friction::ProblemForm;
use lcplab_lcp::{Complementarity, Lcp, merit};
use lcplab_solver::trace::Work;
use lcplab_solver::{Iterate, Method, Observer, Options, Solution, Status, StepDetail};

/// A method's answer to a problem, from x = 0, and its cost.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The answer.
    pub solution: Solution,
    /// Multiplications ([`Work`]); `None` if they are not counted, as for a plug-in or a cone.
    pub multiplications: Option<f64>,
    /// Wall time of the solve (s).
    pub seconds: f64,
}

impl Trial {
    /// Solves a problem; the observer receives every iterate, and may stop the solve.
    ///
    /// ```
    /// use lcplab_judge::Demand;
    /// use lcplab_lcp::friction::ProblemForm;
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_solver::{Method, Options, Registry};
    /// use lcplab_analysis::trial::Trial;
    ///
    /// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// let pgs = Method::Boxed(Registry::standard().entry("pgs")?.clone());
    /// let problem = ProblemForm::Boxed(lcp);
    /// let trial = Trial::run(&pgs, &problem, &Options::default(), &mut ());
    /// assert_eq!(trial.solution.x, [0.5, 0.0]);
    /// assert_eq!(trial.multiplications, Some(6.0));
    /// assert!(trial.judged(&problem, &Demand::default()).verdict.is_solution());
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn run(
        method: &Method,
        problem: &ProblemForm,
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Trial {
        let work = match method {
            Method::Boxed(entry) => Some(Work::of(entry, solved_rows(problem))),
            Method::Cone(_) => None,
        };
        let mut costed = Costed { work, observer };
        let start = Instant::now();
        let solution = method.solve(problem, options, &mut costed);
        let seconds = start.elapsed().as_secs_f64();
        let multiplications = costed.work.map(|work| work.multiplications);
        Trial {
            solution,
            multiplications: multiplications.filter(|work| work.is_finite()),
            seconds,
        }
    }

    /// The trial on this LCP as it is stored, a claim judged by this tolerance.
    pub fn attempt(&self, solver: &str, lcp: &Lcp, tolerance: f64) -> Attempt {
        Attempt {
            solver: solver.into(),
            outcome: Outcome::of(&self.solution, lcp, tolerance),
            iterations: self.solution.iterations,
            work: self.multiplications.unwrap_or(f64::NAN),
        }
    }

    /// The judge's verdict on the answer.
    pub fn judged(&self, problem: &ProblemForm, demand: &Demand) -> FrictionCertificate {
        judge_friction(problem, &self.solution.x, demand)
    }
}

/// The rows of the problem in the form that a method solves.
pub(crate) fn solved_rows(problem: &ProblemForm) -> &Lcp {
    match problem {
        ProblemForm::Boxed(lcp) => lcp,
        ProblemForm::Polyhedral(polyhedral) => polyhedral.lcp(),
        ProblemForm::Cone(cone) => cone.lcp(),
    }
}

/// Counts multiplications and passes every iterate on.
struct Costed<'a> {
    work: Option<Work<'a>>,
    observer: &'a mut dyn Observer,
}

impl Observer for Costed<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if let Some(work) = &mut self.work {
            work.observe(iterate)?;
        }
        self.observer.observe(iterate)
    }

    fn wants_details(&self) -> bool {
        self.observer.wants_details()
    }

    fn part(&mut self, detail: &StepDetail<'_>) {
        self.observer.part(detail);
    }
}

/// The outcome of a trial.
///
/// ```
/// use lcplab_analysis::trial::{Outcome, Trial};
/// use lcplab_lcp::friction::ProblemForm;
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Options, Registry};
///
/// // The sweeps of PGS reduce the error to a quarter each: ten are not enough for 10⁻⁸.
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let problem = ProblemForm::Boxed(lcp.clone());
/// let outcome = |sweeps: usize| {
///     let options = Options::default().with_max_iterations(sweeps);
///     let pgs = Registry::standard().method("pgs", None)?;
///     let trial = Trial::run(pgs, &problem, &options, &mut ());
///     let attempt = trial.attempt("pgs", &lcp, 1e-8); // as it is stored
///     assert_eq!(attempt.outcome, Outcome::of(&trial.solution, &lcp, 1e-8));
///     lcplab_lcp::error::Result::Ok(attempt.outcome)
/// };
/// let (early, late) = (outcome(10)?, outcome(100)?);
/// assert_eq!((early.words(), late.words()), ("iteration limit", "proved"));
/// assert!(early.is_attempt() && !early.is_claim() && !early.is_solved());
/// assert!(late.is_claim() && late.is_solved());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Claimed, and the judge proves that an exact solution has this active set.
    Proved,
    /// Claimed, and the judge finds x within the tolerance.
    Accepted,
    /// Claimed, but the judge rejects it: this must not happen.
    Rejected,
    /// The residual is within the tolerance, but the answer is hardly better than x = 0: the solver
    /// withdraws its claim. A loose tolerance can cause this if masses are very different.
    Withdrawn,
    /// Not claimed, for this reason.
    Failed(String),
    /// The solver reports that it is not made for the problem: this does not count as an attempt.
    Outside(String),
}

impl Outcome {
    /// The outcome of a solve, with a claim judged by this tolerance.
    pub fn of(solution: &Solution, lcp: &Lcp, tolerance: f64) -> Outcome {
        let demand = Demand { tolerance, prove_up_to: Demand::EXACT_ROWS };
        let is_within = || merit::scaled_residual(lcp, &solution.x) <= tolerance;
        match &solution.status {
            Status::Solved => match judge(lcp, &solution.x, &demand).verdict {
                Verdict::Proved { .. } => Outcome::Proved,
                Verdict::WithinTolerance => Outcome::Accepted,
                // Also a verdict of a later judge: only the two above accept.
                _ => Outcome::Rejected,
            },
            Status::Diverged if is_within() => Outcome::Withdrawn,
            Status::OutsideClass { reason } => Outcome::Outside((*reason).to_string()),
            status => Outcome::Failed(status.to_string()),
        }
    }

    /// Whether the solver claims a solution and the judge agrees.
    pub fn is_solved(&self) -> bool {
        matches!(self, Outcome::Proved | Outcome::Accepted)
    }

    /// Whether the solver attempted the problem.
    pub fn is_attempt(&self) -> bool {
        !matches!(self, Outcome::Outside(_))
    }

    /// Whether the solver claims a solution.
    pub fn is_claim(&self) -> bool {
        matches!(self, Outcome::Proved | Outcome::Accepted | Outcome::Rejected)
    }

    /// The outcome in one or two words, or the reason.
    pub fn words(&self) -> &str {
        match self {
            Outcome::Proved => "proved",
            Outcome::Accepted => "within tolerance",
            Outcome::Rejected => "claimed, rejected",
            Outcome::Withdrawn => "within tolerance, but hardly better than x = 0: no claim",
            Outcome::Failed(reason) | Outcome::Outside(reason) => reason,
        }
    }
}

/// A trial as it is stored.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    /// The solver.
    pub solver: String,
    /// Its outcome.
    pub outcome: Outcome,
    /// The number of sweeps, steps or pivots.
    pub iterations: usize,
    /// Multiplications ([`Work`]); NaN if they are not counted, as for a plug-in.
    #[serde(with = "crate::number::always")]
    pub work: f64,
}
