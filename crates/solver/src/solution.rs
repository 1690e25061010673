//! The answer of a solver: x, the corresponding w, and the solver's status.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::Settings;
use lcplab_lcp::memory::Memory;
use lcplab_lcp::number::{Filed, counted, readable};
use lcplab_lcp::{Complementarity, Lcp};

/// A solver's answer. It contains no time, so it does not depend on the machine's speed.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Fallback, Solution, Status};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let solution = Solution::new(&lcp, vec![0.5], Status::Solved, 3);
/// assert_eq!((solution.w[0], solution.status.word()), (0.0, "solved"));
/// let solution = solution.with_fallback(Some(Fallback::Sweeps)).with_implied_claim(true);
/// assert!(solution.fallback == Some(Fallback::Sweeps) && solution.is_claim_implied);
///
/// // An x that overflowed is no answer.
/// let diverged = Solution::new(&lcp, vec![f64::INFINITY], Status::Diverged, 3);
/// assert_eq!((diverged.x[0], diverged.status), (0.0, Status::NotFinite));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The unknowns, n entries; finite, unless a solver falsely claims otherwise.
    pub x: Vec<f64>,
    /// w = A x + b, recomputed from x when the solution was made.
    pub w: Vec<f64>,
    /// The solver's claim.
    pub status: Status,
    /// The number of sweeps, pivots or Newton steps.
    pub iterations: usize,
    /// The fallback that the method used, if any.
    pub fallback: Option<Fallback>,
    /// Whether *solved* is only implied: a plug-in or function returned x without a status. Such an
    /// x may be the last iterate of a solver that ran out of iterations.
    pub is_claim_implied: bool,
}

impl Solution {
    /// The solution with this x; w is recomputed. If x overflowed and the solver does not claim a
    /// solution, x becomes zero, projected onto the bounds, with the status [`Status::NotFinite`].
    /// A claim to have solved the problem is never changed, so that false claims can be detected.
    pub fn new(lcp: &Lcp, mut x: Vec<f64>, mut status: Status, iterations: usize) -> Self {
        if status != Status::Solved && !x.iter().all(|x| x.is_finite()) {
            x.fill(0.0);
            lcp.project_all(&mut x);
            status = Status::NotFinite;
        }
        Solution { w: lcp.w(&x), x, status, iterations, fallback: None, is_claim_implied: false }
    }

    /// The answer of a method that is not made for the problem and ended at x, which may be a
    /// solution all the same: `Solved` if its scaled residual is within the tolerance and it is
    /// closer to a solution than Π(0), otherwise this status.
    pub(crate) fn outside_class(
        problem: &impl Complementarity,
        x: Vec<f64>,
        status: Status,
        iterations: usize,
        settings: &Settings,
    ) -> Self {
        let is_solved = problem.is_within(&x, settings.tolerance, &mut 0)
            && problem.improves_on_zero(&x, settings.tolerance);
        let status = if is_solved { Status::Solved } else { status };
        Solution::new(problem.lcp(), x, status, iterations)
    }

    /// The same solution with this fallback.
    pub fn with_fallback(self, fallback: Option<Fallback>) -> Self {
        Solution { fallback, ..self }
    }

    /// The same solution, with this value of `is_claim_implied`.
    pub fn with_implied_claim(self, is_claim_implied: bool) -> Self {
        Solution { is_claim_implied, ..self }
    }
}

/// The status, the iterations and x.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// assert_eq!(lcplab_solver::solve(&lcp).to_string(), "solved after 1 iteration: x = (0.5, 0)");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
impl fmt::Display for Solution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let x: Vec<String> = self.x.iter().take(PRINTED).map(|&x| readable(x, 6)).collect();
        let more = if self.x.len() > PRINTED { ", …" } else { "" };
        let iterations = counted(self.iterations, "iteration");
        write!(f, "{} after {iterations}: x = ({}{more})", self.status, x.join(", "))
    }
}

/// The keys that `lcplab solve --json` prints for a solution, with the status as one
/// [word](Status::word) and a message.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Solution, solve};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let text = serde_json::to_string(&solve(&lcp)).unwrap();
/// let expected =
///     r#"{"status":"solved","x":[0.5],"w":[0.0],"iterations":1,"message":"solved"}"#;
/// assert_eq!(text, expected);
/// let back: Solution = serde_json::from_str(&text).unwrap();
/// assert_eq!(back, solve(&lcp));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
impl Serialize for Solution {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let vector = |v: &[f64]| v.iter().map(|&v| Filed(v)).collect::<Vec<_>>();
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("status", self.status.word())?;
        map.serialize_entry("x", &vector(&self.x))?;
        map.serialize_entry("w", &vector(&self.w))?;
        map.serialize_entry("iterations", &self.iterations)?;
        map.serialize_entry("message", &self.status.to_string())?;
        if let Some(fallback) = self.fallback {
            map.serialize_entry("fallback", &fallback.to_string())?;
        }
        map.end()
    }
}

/// Reads the same keys, and ignores others. The four words are fewer than the statuses:
/// `iteration_limit` is read as [`Status::IterationLimit`], `infeasible` as
/// [`Status::NoSolution`], and `failed` as [`Status::NoAnswer`] with the message as its reason. The
/// status is a claim, as that of any solver; the judge checks x.
impl<'de> Deserialize<'de> for Solution {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let filed = FiledSolution::deserialize(deserializer)?;
        let reason = || {
            let message = filed.message.strip_prefix(NO_ANSWER).unwrap_or(&filed.message);
            message.to_string()
        };
        let status = match filed.status.as_str() {
            "solved" => Status::Solved,
            "iteration_limit" => Status::IterationLimit,
            "infeasible" => Status::NoSolution,
            "failed" => Status::NoAnswer { reason: reason() },
            other => return Err(D::Error::custom(format!("there is no status {other:?}"))),
        };
        let fallback = match filed.fallback {
            None => None,
            Some(name) => {
                let known = Fallback::ALL.into_iter().find(|known| known.to_string() == name);
                let unknown = || D::Error::custom(format!("there is no fallback {name:?}"));
                Some(known.ok_or_else(unknown)?)
            }
        };
        let [x, w] = [filed.x, filed.w].map(|v| v.into_iter().map(|v| v.0).collect::<Vec<_>>());
        if x.len() != w.len() {
            return Err(D::Error::custom(format!("x has length {}, w {}", x.len(), w.len())));
        }
        let iterations = filed.iterations;
        Ok(Solution { x, w, status, iterations, fallback, is_claim_implied: false })
    }
}

#[derive(serde::Deserialize)]
struct FiledSolution {
    status: String,
    x: Vec<Filed>,
    w: Vec<Filed>,
    iterations: usize,
    #[serde(default)]
    message: String,
    fallback: Option<String>,
}

/// The number of entries of x that are printed.
const PRINTED: usize = 10;

/// What a method does when it cannot continue by itself. This list is complete: no solver
/// transforms a problem first (presolve) or passes it to another solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fallback {
    /// Block pivoting made no progress and exchanged single rows by Murty's rule.
    LeastIndex,
    /// The method solved a sequence of regular problems because block pivoting met a singular block
    /// or made no progress, or because rows in Dantzig's or Lemke's method were too nearly
    /// dependent. The fixed point of the sequence solves the original problem; no row became
    /// compliant.
    Proximal,
    /// Lemke's path did not end at a solution and was repeated with fresh tableaux.
    SecondPath,
    /// Sweeps of projected Gauss-Seidel removed the rounding error of Dantzig's method.
    Sweeps,
    /// In a simulation with friction polygons at redundant contacts: the answer was computed with
    /// rows whose compliance is at most 1e-9 of A's diagonal, and also solves the rigid problem
    /// within the tolerance.
    Softened,
}

impl Fallback {
    /// All of them.
    const ALL: [Fallback; 5] = [
        Fallback::LeastIndex,
        Fallback::Proximal,
        Fallback::SecondPath,
        Fallback::Sweeps,
        Fallback::Softened,
    ];
}

impl fmt::Display for Fallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Fallback::LeastIndex => "least-index rule",
            Fallback::Proximal => "proximal steps",
            Fallback::SecondPath => "second path",
            Fallback::Sweeps => "Gauss-Seidel sweeps",
            Fallback::Softened => "softened rows",
        })
    }
}

/// The status that a solver reports. Only [`Status::Solved`] claims that x is a solution.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Status {
    /// The scaled residual of x is at most the tolerance.
    Solved,
    /// The method finished, but the residual of x is above the tolerance; x is the best it found.
    Inaccurate,
    /// The iteration limit was reached; x is the last iterate.
    IterationLimit,
    /// No further progress; x is the last iterate.
    Stalled,
    /// The observer asked to stop; x is the last iterate.
    Stopped,
    /// The iterates grow without bound; x is the last finite iterate.
    Diverged,
    /// An iterate overflowed (beyond 1.8e308); x is the last finite iterate, or zero projected onto
    /// the bounds if the method keeps none.
    NotFinite,
    /// Row `row` has a_ii ≤ 0, by which the method divides; x is the last iterate before this.
    ZeroDiagonal {
        /// The row.
        row: usize,
    },
    /// The equations of the active set that contains `row` could not be solved.
    Singular {
        /// The row.
        row: usize,
    },
    /// x can move along `direction` without limit and without moving w_`row` towards 0: as far as
    /// the solver can tell, no solution exists. x is the point where the ray starts.
    Ray {
        /// The row that could not be satisfied.
        row: usize,
        /// The ray, n entries.
        direction: Vec<f64>,
    },
    /// All active sets were tried in exact arithmetic and none gives a solution; x is the start.
    NoSolution,
    /// The iteration limit was reached before all active sets were tried; x is the start.
    SetsLeft {
        /// The number of sets that were tried.
        tried: usize,
        /// The number of sets.
        count: usize,
    },
    /// The method would need more memory than the limit; x is the start.
    TooLarge {
        /// The memory needed.
        needs: Memory,
        /// The memory limit.
        limit: Memory,
    },
    /// The method is not made for this problem; x is the start.
    OutsideClass {
        /// The property that the problem lacks.
        reason: &'static str,
    },
    /// An external solver gave no answer; x is the start.
    NoAnswer {
        /// The reason.
        reason: String,
    },
}

/// How the message of [`Status::NoAnswer`] begins.
const NO_ANSWER: &str = "no answer: ";

impl Status {
    /// The status as one of the words `solved`, `iteration_limit` and `failed`, as in JSON. A claim
    /// that there is no solution is a failure as long as nothing proves it.
    pub fn word(&self) -> &'static str {
        match self {
            Status::Solved => "solved",
            Status::Inaccurate
            | Status::IterationLimit
            | Status::SetsLeft { .. }
            | Status::Stalled
            | Status::Stopped => "iteration_limit",
            Status::NoSolution
            | Status::Ray { .. }
            | Status::Diverged
            | Status::NotFinite
            | Status::ZeroDiagonal { .. }
            | Status::Singular { .. }
            | Status::TooLarge { .. }
            | Status::OutsideClass { .. }
            | Status::NoAnswer { .. } => "failed",
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Status::Solved => write!(f, "solved"),
            Status::Inaccurate => write!(f, "ended above the tolerance"),
            Status::IterationLimit => write!(f, "iteration limit"),
            Status::Stalled => write!(f, "no more progress"),
            Status::Stopped => write!(f, "stopped by the observer"),
            Status::Diverged => write!(f, "diverged"),
            Status::NotFinite => write!(f, "an iterate was not finite; x is not an answer"),
            Status::ZeroDiagonal { row } => write!(f, "the diagonal of row {row} is not positive"),
            Status::Singular { row } => write!(f, "singular at row {row}"),
            Status::Ray { row, .. } => {
                write!(
                    f,
                    "ended on a ray: row {row} is not satisfied (this is not a proof that no solution exists)"
                )
            }
            Status::NoSolution => {
                write!(f, "all active sets were tried, and none gives a solution")
            }
            Status::SetsLeft { tried, count } => {
                write!(f, "iteration limit: {tried} of {count} active sets were tried")
            }
            Status::TooLarge { needs, limit } => {
                write!(f, "needs {needs}; the limit is {limit}")
            }
            Status::OutsideClass { reason } => write!(f, "outside the solver's class: {reason}"),
            Status::NoAnswer { reason } => write!(f, "{NO_ANSWER}{reason}"),
        }
    }
}
