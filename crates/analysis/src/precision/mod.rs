//! Whether single precision suffices for a problem, and which stage of its solution loses most.
//!
//! The motion is computed by the [textbook](lcplab_solver::textbook) versions of the solvers, each
//! stage in single or in double precision, and compared with the exact motion: with one stage
//! alone in single precision, with all but one, with all and with none.
//!
//! ```
//! use lcplab_analysis::precision::{Precision, Stage, TextbookSolver};
//! use lcplab_lcp::Question;
//! use lcplab_lcp::file::Problem;
//!
//! // 3 kg on 1 kg on the ground; gravity adds −0.0981 m/s in a step.
//! let text = r#"{"A": {"dense": [[1, -1], [-1, 1.3333333333333333]]}, "b": [-0.0981, 0],
//!                "motion": {"mass": [[0, 0, 1], [1, 1, 3]], "bias": [0, 0], "compliance": [0, 0],
//!                           "jacobian": [[0, 0, 1], [1, 0, -1], [1, 1, 1]],
//!                           "target": [-0.0981, -0.0981], "level": "velocity"}}"#;
//! let question = Question::new(&Problem::parse(text, "two.json")?, None, "two.json")?;
//! let precision = Precision::of(&question, Some(TextbookSolver::Dantzig), None, 1e-3)?;
//! assert!(precision.suffices() && precision.single.relative < 1e-6);
//! assert!(precision.double.relative < 1e-14); // nothing in single precision
//! // Masses that are rounded for all stages alike still leave the stack at rest.
//! assert_eq!(precision.stages[0].stage, Stage::Data);
//! assert!(precision.stages[0].alone.relative < 1e-14);
//! assert_eq!((precision.solver.name(), Stage::Sums.name()), ("dantzig", "sums"));
//! // Sums lose most, about 2⁻²⁴ times the load of 4 kg on 1 kg; assembly loses as much.
//! assert!(precision.finding().starts_with("single precision suffices: "));
//! assert!(precision.text().starts_with(&precision.finding()));
//! assert_eq!(precision.worst().unwrap().stage, Stage::Sums);
//! assert!(precision.best_mended().unwrap().mended.relative > 1e-8);
//! assert_eq!(precision.json()["suffices"], true);
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod pipeline;
mod prediction;
mod show;

use lcplab_judge::exact::prove;
use lcplab_judge::motion_bound::inconsistent_row;
use lcplab_judge::{Demand, Verdict, judge};
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::Problem;
use lcplab_lcp::{Lcp, Level, Matrix as Entries, Question};
use lcplab_solver::textbook::{Matrix, Vector};

use crate::answer::first_answer;
use pipeline::{Motion, Pipeline};

/// A run has converged if its relative error is below this part of the tolerance.
const CONVERGED: f64 = 1e-4;
/// The first number of sweeps.
const FEWEST_SWEEPS: usize = 250;
/// Limit of sweeps times n².
const MOST_TERMS: usize = 100_000_000;
/// A, scaled to the diagonal 1, is positive definite if no eigenvalue is smaller.
const DEFINITE: f64 = 1e-12;

/// The method whose textbook version computes x.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextbookSolver {
    /// Projected Gauss-Seidel; has no factor.
    Pgs,
    /// Dantzig's method; A must be positive definite.
    Dantzig,
    /// The semismooth Newton method; A must be positive definite.
    Newton,
    /// An interior-point method, for problems with the bounds 0 and ∞.
    InteriorPoint,
}

impl TextbookSolver {
    /// All methods.
    pub const ALL: [TextbookSolver; 4] = [
        TextbookSolver::Pgs,
        TextbookSolver::Dantzig,
        TextbookSolver::Newton,
        TextbookSolver::InteriorPoint,
    ];

    /// The name of the method.
    pub fn name(self) -> &'static str {
        match self {
            TextbookSolver::Pgs => "pgs",
            TextbookSolver::Dantzig => "dantzig",
            TextbookSolver::Newton => "newton",
            TextbookSolver::InteriorPoint => "interior-point",
        }
    }
}

/// A step from the data to the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// M, J, bias, γ, u* and bounds are rounded; without them A, b and bounds.
    Data,
    /// A = J M⁻¹Jᵀ + diag(γ) and b = J u* + bias.
    Assembly,
    /// The solution of linear equations.
    Factor,
    /// w = A x + b, and the changes of x and w.
    Sums,
    /// u = u* + M⁻¹Jᵀx.
    Velocity,
}

impl Stage {
    /// The name of the stage.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Data => "data",
            Stage::Assembly => "assembly",
            Stage::Factor => "factor",
            Stage::Sums => "sums",
            Stage::Velocity => "velocity",
        }
    }
}

/// The errors of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Loss {
    /// |u − û|_M, û the exact motion; without masses |x − x̂|_A. ∞ if the solver breaks down.
    pub error: f64,
    /// The error relative to |û − u*|_M, the effect of the constraints; without masses to |x̂|_A.
    pub relative: f64,
    /// The largest entry of |u − û|; without masses of |w − ŵ|.
    pub largest_entry: f64,
    /// The scaled residual of x, by the judge.
    pub scaled_residual: f64,
}

/// What single precision costs in a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct StageLoss {
    /// The stage.
    pub stage: Stage,
    /// With this stage alone in single precision.
    pub alone: Loss,
    /// With all stages but this one in single precision.
    pub mended: Loss,
    /// What this stage costs more in double precision.
    pub cost: String,
}

/// The errors of a problem's motion in single precision, by stages.
#[derive(Debug, Clone, PartialEq)]
pub struct Precision {
    /// The method.
    pub solver: TextbookSolver,
    /// The number of sweeps of [`TextbookSolver::Pgs`].
    pub sweeps: usize,
    /// The largest relative error that suffices.
    pub tolerance: f64,
    /// |û − u*|_M, or |û|_M if the constraints change nothing; without masses |x̂|_A.
    pub effect: f64,
    /// The exact solution, rounded to 53 bits; if it is not proved, an answer that the judge
    /// accepts.
    pub x: Vec<f64>,
    /// Whether `x` is proved; with coupled friction, for its own friction limits.
    pub is_proved: bool,
    /// Whether friction limits are frozen at lcplab's solution.
    pub is_frozen: bool,
    /// The exact motion û; `None` without masses.
    pub u: Option<Vec<f64>>,
    /// What u is, if known.
    pub level: Option<Level>,
    /// The predicted relative error with all stages in single precision; `None` for
    /// [`TextbookSolver::InteriorPoint`].
    pub predicted: Option<f64>,
    /// With all stages in double precision.
    pub double: Loss,
    /// With all stages in single precision.
    pub single: Loss,
    /// The stages in their order.
    pub stages: Vec<StageLoss>,
}

impl Precision {
    /// The errors of a problem; without a method, of [`TextbookSolver::Dantzig`] if A is positive
    /// definite, else of [`TextbookSolver::Pgs`]. Without a number of sweeps, they are doubled
    /// until the run in double precision has converged. Friction limits are those of the exact
    /// solution.
    ///
    /// # Errors
    /// If the problem has friction cones, more than 150 rows, a row with a_ii ≤ 0, no solution that
    /// the judge accepts, a motion that contradicts A and b, or is outside the class of the method.
    pub fn of(
        question: &Question,
        solver: Option<TextbookSolver>,
        sweeps: Option<usize>,
        tolerance: f64,
    ) -> Result<Self> {
        let given = question.require_boxed("errors by precision are", "problem")?;
        check(given)?;
        let gauss = question.problem().motion.as_ref();
        if let Some((i, _)) =
            gauss.and_then(|gauss| inconsistent_row(gauss, given, &first_answer(question)))
        {
            let reason = format!("row {i} of its J, M and bias contradicts A and b");
            return Err(Error::invalid("problem", "motion", reason));
        }
        let motion = gauss.map(Motion::new);
        let lcp = motion.as_ref().map_or_else(|| Ok(given.clone()), |own| assembled(given, own))?;
        let (frozen, x, is_proved) = reference(&lcp)?;
        let is_definite = least_scaled_eigenvalue(&lcp) > DEFINITE;
        let solver = solver.unwrap_or(if is_definite {
            TextbookSolver::Dantzig
        } else {
            TextbookSolver::Pgs
        });
        solver.check(&frozen, is_definite)?;
        let mut pipeline = Pipeline::new(motion, &frozen, solver, sweeps.unwrap_or(FEWEST_SWEEPS));
        let exact = Exact::new(&pipeline, frozen, x);
        let is_short = |pipeline: &Pipeline| {
            exact.loss(pipeline, &[]).relative > CONVERGED * tolerance
                && pipeline.sweeps * pipeline.b.len().pow(2) < MOST_TERMS
        };
        while solver == TextbookSolver::Pgs && sweeps.is_none() && is_short(&pipeline) {
            pipeline.sweeps *= 2;
        }
        let loss = |single: &[Stage]| exact.loss(&pipeline, single);
        let stages = pipeline.stages();
        let stage_loss = |&stage: &Stage| {
            let others: Vec<Stage> = stages.iter().copied().filter(|own| *own != stage).collect();
            let cost = pipeline.cost(stage);
            StageLoss { stage, alone: loss(&[stage]), mended: loss(&others), cost }
        };
        Ok(Precision {
            solver,
            sweeps: pipeline.sweeps,
            tolerance,
            effect: exact.effect,
            x: exact.x.as_slice().to_vec(),
            is_proved,
            is_frozen: given.coupling().is_some(),
            u: exact.u.as_ref().map(|u| u.as_slice().to_vec()),
            level: gauss.and_then(|gauss| gauss.level),
            predicted: exact.predicted(&pipeline),
            double: loss(&[]),
            single: loss(&stages),
            stages: stages.iter().map(stage_loss).collect(),
        })
    }

    /// Whether the motion error is within the tolerance in single precision, and not by chance: in
    /// double precision it is, too.
    pub fn suffices(&self) -> bool {
        self.single.relative.max(self.double.relative) <= self.tolerance
    }

    /// The stage that loses most; `None` if none loses anything.
    pub fn worst(&self) -> Option<&StageLoss> {
        let by_error = |a: &&StageLoss, b: &&StageLoss| a.alone.error.total_cmp(&b.alone.error);
        self.stages.iter().max_by(by_error).filter(|worst| worst.alone.error > self.double.error)
    }

    /// The stage that leaves the smallest error if it alone is in double precision.
    pub fn best_mended(&self) -> Option<&StageLoss> {
        self.stages.iter().min_by(|a, b| a.mended.error.total_cmp(&b.mended.error))
    }
}

impl TextbookSolver {
    fn check(self, lcp: &Lcp, is_definite: bool) -> Result<()> {
        let is_half_line = |i: usize| lcp.lo()[i] == 0.0 && lcp.hi()[i] == f64::INFINITY;
        let reason = match self {
            TextbookSolver::Dantzig | TextbookSolver::Newton if !is_definite => {
                "is singular: the textbook's dantzig and newton need a positive definite A; use pgs"
            }
            TextbookSolver::InteriorPoint if !(0..lcp.len()).all(is_half_line) => {
                "has other bounds than 0 and ∞, which the textbook's interior-point method needs"
            }
            _ => return Ok(()),
        };
        Err(Error::invalid("problem", "A", reason))
    }
}

/// Checks what every method needs.
fn check(lcp: &Lcp) -> Result<()> {
    let n = lcp.len();
    let reason = if n == 0 {
        "has no rows".into()
    } else if n > Demand::EXACT_ROWS {
        format!("has {n} rows, must have at most {}", Demand::EXACT_ROWS)
    } else if let Some(i) = (0..n).find(|&i| lcp.matrix().entry(i, i) <= 0.0) {
        format!("[{i}][{i}] must be positive")
    } else if !lcp.matrix().is_symmetric() {
        "must be symmetric: motion errors are measured in its norm".into()
    } else {
        return Ok(());
    };
    Err(Error::invalid("problem", "A", reason))
}

/// The problem with the A and b of its masses and rows in full precision: those of a file may
/// already be rounded.
fn assembled(lcp: &Lcp, motion: &Motion) -> Result<Lcp> {
    let (a, b) = motion.assembled::<f64>();
    let a = Entries::dense(lcp.len(), a.as_slice()); // symmetric: columns are rows
    lcp.with_matrix(a)?.with_b(b.as_slice().to_vec())
}

/// The problem with its friction limits frozen at a solution, this solution, and whether it is
/// proved.
fn reference(lcp: &Lcp) -> Result<(Lcp, Vector, bool)> {
    let question = Question::new(&Problem::new("", lcp.clone()), None, "problem")?;
    let x = first_answer(&question);
    let frozen = lcp.frozen_at(&x);
    let demand = Demand { prove_up_to: Demand::EXACT_ROWS, ..Demand::default() };
    let verdict = judge(&frozen, &x, &demand).verdict;
    if !verdict.is_solution() {
        let reason = format!("no solution is known ({verdict}), so errors have no reference");
        return Err(Error::invalid("problem", "x", reason));
    }
    let proof = prove(&frozen, &x).filter(|_| matches!(verdict, Verdict::Proved { .. }));
    let is_proved = proof.is_some();
    let x = proof.map_or(x, |own| own.x.iter().map(|x| x.to_f64().value()).collect());
    Ok((frozen, Vector::from_vec(x), is_proved))
}

/// The smallest eigenvalue of A with its rows and columns scaled to the diagonal 1.
fn least_scaled_eigenvalue(lcp: &Lcp) -> f64 {
    let a = lcp.matrix().to_dense();
    let size = a.diagonal().map(f64::sqrt);
    let scaled = a.map_with_location(|i, j, a| a / (size[i] * size[j]));
    scaled.symmetric_eigenvalues().min()
}

/// The exact solution, with which runs are compared.
struct Exact {
    lcp: Lcp,
    x: Vector,
    u: Option<Vector>,
    effect: f64,
}

impl Exact {
    fn new(pipeline: &Pipeline, lcp: Lcp, x: Vector) -> Self {
        let u = pipeline.motion.as_ref().map(|motion| motion.velocity::<f64>(&x));
        let effect = match (&pipeline.motion, &u) {
            (Some(motion), Some(u)) => {
                let effect = length(&motion.mass, &(u - &motion.target));
                if effect > 0.0 { effect } else { length(&motion.mass, u) }
            }
            _ => length(&pipeline.a, &x),
        };
        Exact { lcp, x, u, effect }
    }

    fn loss(&self, pipeline: &Pipeline, single: &[Stage]) -> Loss {
        let Some((x, u)) = pipeline.run(single) else {
            let none = f64::INFINITY;
            return Loss {
                error: none,
                relative: none,
                largest_entry: none,
                scaled_residual: none,
            };
        };
        let (error, largest_entry) = match (&pipeline.motion, &u, &self.u) {
            (Some(motion), Some(u), Some(exact)) => {
                let change = u - exact;
                (length(&motion.mass, &change), change.amax())
            }
            _ => {
                let change = &x - &self.x;
                (length(&pipeline.a, &change), (&pipeline.a * &change).amax())
            }
        };
        let relative = self.relative(error);
        let demand = Demand { prove_up_to: 0, ..Demand::default() };
        let scaled_residual = judge(&self.lcp, x.as_slice(), &demand).scaled_residual;
        Loss { error, relative, largest_entry, scaled_residual }
    }

    /// The predicted relative error; `None` for interior-point methods.
    fn predicted(&self, pipeline: &Pipeline) -> Option<f64> {
        if pipeline.solver == TextbookSolver::InteriorPoint {
            return None;
        }
        let is_free = |&i: &usize| self.lcp.lo()[i] < self.x[i] && self.x[i] < self.lcp.hi()[i];
        let free: Vec<usize> = (0..self.x.len()).filter(is_free).collect();
        let Pipeline { solver, a, b, .. } = pipeline;
        let from_forces = prediction::from_forces(*solver, a, b, &free, &self.x);
        let from_velocities = match (&pipeline.motion, &self.u) {
            (Some(motion), Some(u)) => prediction::from_velocities(&motion.mass, &motion.target, u),
            _ => 0.0,
        };
        Some(self.relative(from_forces.hypot(from_velocities)))
    }

    fn relative(&self, error: f64) -> f64 {
        if error == 0.0 { 0.0 } else { error / self.effect }
    }
}

/// √(vᵀA v); ∞ if it overflows.
fn length(a: &Matrix, v: &Vector) -> f64 {
    let square = v.dot(&(a * v));
    if square.is_nan() { f64::INFINITY } else { square.max(0.0).sqrt() }
}
