//! Derivatives of a solution with respect to the data of its problem, with a certificate.
//!
//! At an exact solution x* each row is free (lo < x < hi, w = 0), at a bound with w ≠ 0, or *weak*:
//! at a bound with w = 0.
//!
//! - Without weak rows, and with a regular matrix of the free rows, x is differentiable, and its
//!   derivative solves the equations of the active set in rational numbers (implicit function
//!   theorem).
//! - At a weak row x has a *kink*: two one-sided derivatives.
//! - If the equations are singular, also up to rounding, x is not unique. If the problem states
//!   masses and rows, the derivative of the motion u = u* + M⁻¹Jᵀx exists.
//!
//! ```
//! use lcplab_analysis::gradient::{Direction, Gradient, Status};
//! use lcplab_lcp::file::Problem;
//! use lcplab_lcp::{Lcp, Matrix};
//!
//! // One contact, w = 2 x + b: x = max(0, −b/2), so dx/db = −1/2 at b = −1.
//! let contact = |b: f64| -> lcplab_lcp::error::Result<Problem> {
//!     let lcp = Lcp::new(Matrix::from([[2.0]]), vec![b], vec![0.0], vec![f64::INFINITY])?;
//!     Ok(Problem::new("contact", lcp))
//! };
//! let gradient = Gradient::of(&contact(-1.0)?, &[0.5])?;
//! assert_eq!(gradient.status(), &Status::Differentiable);
//! assert_eq!(gradient.pullback(&[1.0], None)?.b[0].to_string(), "-1/2");
//!
//! // At b = 0 it begins to lift off: −1/2 for smaller b, 0 for larger ones.
//! let kink = Gradient::of(&contact(0.0)?, &[0.0])?;
//! assert_eq!(kink.status(), &Status::Kink(vec![0]));
//! let [right, left] = kink.directional(&Direction { b: vec![1.0], ..Direction::default() })?;
//! assert_eq!((right.x.unwrap()[0].to_string(), left.x.unwrap()[0].to_string()), ("0".into(), "-1/2".into()));
//! assert!(kink.pullback(&[1.0], None).is_err()); // there is no gradient
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod active;
mod direction;
mod interior;
mod kink;
mod linear;
mod mistakes;
mod motion;
mod pullback;
mod show;
mod theirs;

use dashu_ratio::RBig;

pub use active::RowState;
pub use direction::{Derivative, Direction};
pub use motion::MotionPullback;
pub use pullback::Pullback;
pub use theirs::{Comparison, Theirs};

use active::Rows;
use interior::has_null_vector;
use kink::Kink;
use lcplab_judge::exact::prove;
use lcplab_judge::{Demand, Verdict, judge};
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::exact::dyadic::{dyadic, rational};
use lcplab_lcp::file::Problem;
use lcplab_lcp::{Lcp, Question};
use linear::{independent_rows, solve};
use motion::Motion;

/// What derivative a solution has.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// x is differentiable.
    Differentiable,
    /// These rows are at a bound with w = 0: x has one-sided derivatives.
    Kink(Vec<usize>),
    /// x is not unique, or some arbitrarily small change of the data, or of their rounding, has
    /// several solutions or none.
    NotUnique,
    /// The reason why the derivative was not examined.
    NotExamined(String),
}

/// The derivative of a solution.
///
/// ```
/// use lcplab_analysis::gradient::{Gradient, RowState};
/// use lcplab_lcp::file::Problem;
///
/// // Two supports share the weight of a mass of 1: u does not depend on who carries it.
/// let text = r#"{"A": {"dense": [[1, 1], [1, 1]]}, "b": [-1, -1],
///                "motion": {"mass": [[0, 0, 1]], "jacobian": [[0, 0, 1], [1, 0, 1]], "bias": [0, 0],
///                           "compliance": [0, 0], "target": [-1]}}"#;
/// let gradient = Gradient::of(&Problem::parse(text, "supports.json")?, &[0.5, 0.5])?;
/// assert_eq!(gradient.x()[0].to_string(), "1/2");
/// assert_eq!(gradient.states(), [RowState::Free; 2]);
/// assert!(!gradient.states()[0].is_weak() && gradient.states()[0].name() == "free");
/// assert!(gradient.near_kink().is_empty() && gradient.is_known() && gradient.is_of_motion());
/// assert_eq!((gradient.word(), gradient.motion_len()), ("not_unique", 1));
/// assert!(gradient.dx_db().is_err());
/// let motion = gradient.pullback(&[0.0; 2], Some(&[1.0]))?.motion.unwrap();
/// assert_eq!(motion.target[0].to_string(), "0"); // it stays at rest
/// assert!(gradient.certificate().starts_with("x is not unique: derivatives are those of the motion"));
/// assert!(gradient.text().starts_with("derivative x is not unique"));
/// assert_eq!(gradient.json()["of_motion"], true);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Gradient {
    lcp: Lcp,
    /// The time step, if the problem states it.
    dt: Option<f64>,
    rows: Rows,
    status: Status,
    kink: Option<Kink>,
    /// The masses and rows, or why they are not used.
    motion: std::result::Result<Motion, String>,
    /// If x is not unique: the rows that can press at the same time as free ones, and those of them
    /// that determine the motion.
    basis: Option<(Rows, Vec<usize>)>,
}

impl Gradient {
    /// The derivative at the exact solution next to x.
    ///
    /// # Errors
    /// If the problem has more than 150 rows or friction cones, or x is not proved: then there is
    /// no exact solution whose derivative could be computed.
    pub fn of(problem: &Problem, x: &[f64]) -> Result<Self> {
        let question = Question::new(problem, None, "problem")?;
        let lcp = question.require_boxed("derivatives are", "problem")?;
        if lcp.len() > Demand::EXACT_ROWS {
            let reason = format!("has {} rows; derivatives are exact up to 150 rows", lcp.len());
            return Err(Error::invalid("problem", "A", reason));
        }
        if let Some(i) = x.iter().position(|x| !x.is_finite()) {
            let reason = format!("is {}, must be a finite number", x[i]);
            return Err(Error::invalid("answer", format!("x[{i}]"), reason));
        }
        let demand = Demand { prove_up_to: Demand::EXACT_ROWS, ..Demand::default() };
        let verdict = judge(lcp, x, &demand).verdict;
        let proof = prove(lcp, x).filter(|_| matches!(verdict, Verdict::Proved { .. }));
        let proof = proof.ok_or_else(|| {
            let reason = format!(
                "no exact solution is known next to it ({verdict}), so it has no derivative"
            );
            Error::invalid("answer", "x", reason)
        })?;
        let motion = problem.motion.as_ref().map(|gauss| Motion::new(gauss, lcp, &proof.x));
        let motion = motion.unwrap_or_else(|| Err("the problem has no key motion".into()));
        let dt = problem.extra.get("dt").and_then(serde_json::Value::as_f64);
        Ok(Gradient::at(lcp.clone(), dt, proof.x, motion))
    }

    fn at(
        lcp: Lcp,
        dt: Option<f64>,
        x: Vec<RBig>,
        motion: std::result::Result<Motion, String>,
    ) -> Self {
        let rows = Rows::new(&lcp, x);
        let free = rows.free();
        let is_loose = |i: &usize| {
            rows.states[*i] == RowState::Free || rows.states[*i].is_weak() || rows.near.contains(i)
        };
        let together: Vec<usize> = (0..rows.len()).filter(is_loose).collect();
        let loose = rows.with_states(loosened(&rows, &together));
        let equations = loose.matrix(&together, &together);
        let independent = independent_rows(&equations);
        let is_regular =
            || solve(&rows.matrix(&free, &free), &[vec![RBig::ZERO; free.len()]]).is_some();
        let weak = rows.weak();
        let (status, kink) = match weak.is_empty() {
            _ if independent.len() < together.len() => (Status::NotUnique, None),
            true if is_regular() => (Status::Differentiable, None),
            true => (Status::NotUnique, None),
            false => match Kink::new(&rows) {
                Ok(kink) => (Status::Kink(weak), Some(kink)),
                Err(status) => (status, None),
            },
        };
        let inward = |&i: &usize| match rows.states[i] {
            _ if rows.normal[i].is_some() => 0.0,
            RowState::WeakLower | RowState::Lower => 1.0,
            RowState::WeakUpper | RowState::Upper => -1.0,
            _ => 0.0,
        };
        let signs: Vec<f64> = together.iter().map(inward).collect();
        let is_of_motion = status == Status::NotUnique
            && motion.is_ok()
            && !loose.has_sliding()
            && has_null_vector(&equations, &signs);
        let basis = independent.iter().map(|&r| together[r]).collect();
        let basis = is_of_motion.then_some((loose, basis));
        Gradient { lcp, dt, rows, status, kink, motion, basis }
    }

    /// What derivative x has.
    pub fn status(&self) -> &Status {
        &self.status
    }

    /// The exact solution.
    pub fn x(&self) -> &[RBig] {
        &self.rows.x
    }

    /// The state of each row.
    pub fn states(&self) -> &[RowState] {
        &self.rows.states
    }

    /// Rows within rounding of a kink: x has the derivative that is computed, but a change of the
    /// data by rounding can put it on the other side.
    pub fn near_kink(&self) -> &[usize] {
        &self.rows.near
    }

    /// Whether x is not unique and the motion has a derivative with respect to u* and the masses.
    pub fn is_of_motion(&self) -> bool {
        self.basis.is_some()
    }

    /// Whether x or the motion has a derivative, also a one-sided one.
    pub fn is_known(&self) -> bool {
        self.is_of_motion() || matches!(self.status, Status::Differentiable | Status::Kink(_))
    }

    /// The number of entries of the motion; 0 if the problem has no valid key `motion`.
    pub fn motion_len(&self) -> usize {
        self.motion.as_ref().map_or(0, Motion::len)
    }

    /// Why there is no gradient.
    fn refusal(&self) -> String {
        match &self.status {
            Status::Kink(rows) => {
                format!("x has a kink at {}: it has one-sided derivatives only", listed(rows))
            }
            Status::NotUnique => "x is not unique, so it has no derivative".into(),
            Status::NotExamined(why) => format!("not examined: {why}"),
            Status::Differentiable => "the equations are singular".into(),
        }
    }
}

/// The states with these rows free.
fn loosened(rows: &Rows, free: &[usize]) -> Vec<RowState> {
    let state = |i: usize| if free.contains(&i) { RowState::Free } else { rows.states[i] };
    (0..rows.len()).map(state).collect()
}

fn exact(x: f64) -> RBig {
    rational(&dyadic(x))
}

/// A vector of n finite numbers.
fn numbers(name: &str, given: &[f64], n: usize) -> Result<Vec<RBig>> {
    let invalid = |reason: String| Err(Error::invalid("direction", name, reason));
    match given.iter().find(|value| !value.is_finite()) {
        _ if given.len() != n => invalid(format!("has {} entries, must have {n}", given.len())),
        Some(value) => invalid(format!("must be finite, has {value}")),
        None => Ok(given.iter().map(|&value| exact(value)).collect()),
    }
}

/// The finite value of an entry of a matrix with this number of rows and columns.
fn entry(name: &str, (i, j, value): (usize, usize, f64), size: (usize, usize)) -> Result<RBig> {
    if i >= size.0 || j >= size.1 || !value.is_finite() {
        let reason =
            format!("has {value} at ({i}, {j}), must be finite and within {} × {}", size.0, size.1);
        return Err(Error::invalid("direction", name, reason));
    }
    Ok(exact(value))
}

fn failure(reason: String) -> Error {
    Error::invalid("gradient", "x", reason)
}

/// Rows as words.
fn listed(rows: &[usize]) -> String {
    let all: Vec<String> = rows.iter().map(ToString::to_string).collect();
    format!("{} {}", if rows.len() == 1 { "row" } else { "rows" }, all.join(", "))
}
