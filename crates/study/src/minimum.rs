//! Whether an answer is a minimum of the objective that a problem declares.
//!
//! If a file has the key `objective`, its rows are the optimality conditions of min ½ xᵀP x + qᵀx
//! under bounds and linear constraints. Maxima and saddles satisfy these conditions too. At a
//! minimum no direction d that keeps all constraints has dᵀP d < 0 while the objective does not
//! rise at first order (the *second-order condition*):
//!
//! ```text
//! d_i = 0                    where a bound is active and w_i ≠ 0
//! d_i ≥ 0 or d_i ≤ 0         where a bound is active and w_i = 0
//! a_kᵀ d = 0                 where y_k ≠ 0, and for equations
//! a_kᵀ d ≥ 0 or a_kᵀ d ≤ 0   where a constraint is active and y_k = 0
//! ```
//!
//! A direction with dᵀP d < 0 is searched by the eigenvectors of P on the faces of this cone. What
//! is found is checked; if nothing is found, nothing is claimed.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde_json::{Value, json};

use lcplab_page::number::readable;
use lcplab_problem::Question;
use lcplab_problem::file::{Problem, number};

/// Larger programs are not examined.
const MAX_COLUMNS: usize = 200;
/// Maximum number of constraints whose combinations are tried.
const MAX_RELEASED: usize = 8;
/// Relative size below which a value is rounding.
const ROUNDING: f64 = 1e-9;
/// Maximum number of entries of a direction that are printed.
const PRINTED: usize = 12;

/// A direction in which the objective decreases, although x satisfies the optimality conditions.
#[derive(Debug, Clone, PartialEq)]
pub struct Descent {
    /// The direction d in the columns of the program; its largest entry is ±1.
    pub direction: Vec<f64>,
    /// dᵀP d < 0: the objective changes by half of it times the square of the distance.
    pub curvature: f64,
}

impl Descent {
    /// A direction of descent from x, if the problem declares an objective and one is found. x
    /// must satisfy the optimality conditions.
    ///
    /// ```
    /// use lcplab_problem::Question;
    /// use lcplab_problem::file::Problem;
    /// use lcplab_study::minimum::Descent;
    ///
    /// // x²/2 + 3 x y + y²/2 on a square has a saddle at 0 and minima at two corners.
    /// let text = r#"{"A": {"dense": [[1, 3], [3, 1]]}, "b": [0, 0], "lo": [-1, -1], "hi": [1, 1],
    ///                "objective": true}"#;
    /// let question = Question::new(&Problem::parse(text, "saddle.json")?, None, "saddle.json")?;
    /// let found = Descent::of(&question, &[0.0, 0.0]).unwrap();
    /// assert_eq!(found.direction[0], -found.direction[1]);
    /// assert!((found.curvature + 4.0).abs() < 1e-12);
    /// assert_eq!(Descent::of(&question, &[1.0, -1.0]), None);
    /// # Ok::<(), lcplab_problem::error::Error>(())
    /// ```
    pub fn of(question: &Question, x: &[f64]) -> Option<Descent> {
        let problem = question.problem();
        let is_declared = problem.extra.get("objective").and_then(Value::as_bool) == Some(true);
        if !is_declared || question.boxed()?.coupling().is_some() {
            return None;
        }
        Program::of(problem, x)?.descent()
    }

    /// The key `minimum` of an answer.
    pub fn json(question: &Question, x: &[f64]) -> Option<(String, Value)> {
        let Descent { direction, curvature } = Descent::of(question, x)?;
        let direction: Value = direction.iter().map(|&d| number(d)).collect();
        let object = json!({
            "is_minimum": false, "direction": direction, "curvature": number(curvature),
        });
        Some(("minimum".into(), object))
    }

    /// The line that commands print; empty if no direction is found.
    pub fn text(question: &Question, x: &[f64]) -> String {
        let Some(Descent { direction, curvature }) = Descent::of(question, x) else {
            return String::new();
        };
        let shown: Vec<String> = direction.iter().take(PRINTED).map(|&d| readable(d, 3)).collect();
        let more = if direction.len() > PRINTED { ", …" } else { "" };
        format!(
            "  no minimum: x satisfies the optimality conditions, but the objective decreases along \
             ({}{more}), with the second derivative {}\n",
            shown.join(", "),
            readable(curvature, 3)
        )
    }
}

/// How d is restricted along a constraint's gradient.
#[derive(Clone, Copy, PartialEq)]
enum Restriction {
    /// gᵀd = 0.
    Zero,
    /// sign · gᵀd ≥ 0.
    Side(f64),
}

/// P, and the constraints that are active at x.
struct Program {
    p: DMatrix<f64>,
    active: Vec<(DVector<f64>, Restriction)>,
}

impl Program {
    /// `None` if the program is too large, or if P is not symmetric.
    fn of(problem: &Problem, x: &[f64]) -> Option<Self> {
        let lcp = &problem.lcp;
        let kind = |i: usize| problem.extra.get("rows")?.get(i)?.get("kind")?.as_str();
        let is_column = |&i: &usize| !matches!(kind(i), Some("multiplier" | "row"));
        let columns: Vec<usize> = (0..lcp.len()).filter(is_column).collect();
        let n = columns.len();
        if n == 0 || n > MAX_COLUMNS {
            return None;
        }
        let entry = |i: usize, j: usize| lcp.matrix().entry(columns[i], columns[j]);
        let p = DMatrix::from_fn(n, n, entry);
        if p != p.transpose() {
            return None;
        }
        let w = lcp.w(x);
        let side = |i: usize| {
            let near = |bound: f64| {
                bound.is_finite() && (x[i] - bound).abs() <= ROUNDING * bound.abs().max(1.0)
            };
            match (near(lcp.lo()[i]), near(lcp.hi()[i])) {
                (false, false) => None,
                (true, true) => Some(Restriction::Zero),
                (at_lo, _) => Some(Restriction::Side(if at_lo { 1.0 } else { -1.0 })),
            }
        };
        let terms = |i: usize| {
            let terms = lcp.matrix().row(i).iter().map(|(j, a)| (a * x[j]).abs());
            terms.sum::<f64>() + lcp.b()[i].abs()
        };
        let is_zero = |i: usize| w[i].abs() <= ROUNDING * terms(i);
        let mut active = Vec::new();
        for (place, &i) in columns.iter().enumerate() {
            let unit = || DVector::from_fn(n, |k, _| f64::from(k == place));
            match side(i) {
                None => {}
                Some(_) if !is_zero(i) => active.push((unit(), Restriction::Zero)),
                Some(own) => active.push((unit(), own)),
            }
        }
        for k in (0..lcp.len()).filter(|k| kind(*k) == Some("multiplier")) {
            let gradient = DVector::from_fn(n, |j, _| lcp.matrix().entry(k, columns[j]));
            // The unknown s = aᵀx of a row with two limits.
            let value =
                (0..lcp.len()).find(|&s| kind(s) == Some("row") && lcp.matrix().entry(k, s) != 0.0);
            let has_force = x[k].abs() > ROUNDING;
            let own = match value {
                Some(s) => side(s).map(|own| if has_force { Restriction::Zero } else { own }),
                None if lcp.lo()[k].is_infinite() && lcp.hi()[k].is_infinite() => {
                    Some(Restriction::Zero)
                }
                None if has_force => Some(Restriction::Zero),
                None if !is_zero(k) => None,
                None => Some(Restriction::Side(if lcp.lo()[k] == 0.0 { 1.0 } else { -1.0 })),
            };
            active.extend(own.map(|own| (gradient, own)));
        }
        Some(Program { p, active })
    }

    /// Searches the faces of the cone: some of the one-sided constraints are released, the others
    /// hold as equations.
    fn descent(&self) -> Option<Descent> {
        let size = self.p.amax();
        let sided: Vec<usize> = (0..self.active.len())
            .filter(|&k| matches!(self.active[k].1, Restriction::Side(_)))
            .take(MAX_RELEASED)
            .collect();
        (0..1usize << sided.len()).find_map(|chosen| {
            let is_released =
                |k: usize| sided.iter().position(|&s| s == k).is_some_and(|p| chosen >> p & 1 == 1);
            let equations = (0..self.active.len()).filter(|&k| !is_released(k));
            let basis = self.basis(equations)?;
            let reduced = SymmetricEigen::new(basis.transpose() * &self.p * &basis);
            let (least, _) = reduced.eigenvalues.argmin();
            let direction = &basis * reduced.eigenvectors.column(least);
            [1.0, -1.0].into_iter().find_map(|sign| self.checked(sign * &direction, size))
        })
    }

    /// An orthonormal basis of the directions in which these constraints do not change; `None` if
    /// there is no such direction.
    fn basis(&self, equations: impl Iterator<Item = usize>) -> Option<DMatrix<f64>> {
        let n = self.p.nrows();
        let mut gram = DMatrix::zeros(n, n);
        for k in equations {
            if let Some(unit) = self.active[k].0.try_normalize(0.0) {
                gram += &unit * unit.transpose();
            }
        }
        let eigen = SymmetricEigen::new(gram);
        let columns: Vec<DVector<f64>> = (0..n)
            .filter(|&k| eigen.eigenvalues[k] <= ROUNDING)
            .map(|k| eigen.eigenvectors.column(k).into_owned())
            .collect();
        (!columns.is_empty()).then(|| DMatrix::from_columns(&columns))
    }

    /// The direction, if it keeps the constraints and the objective decreases along it.
    fn checked(&self, direction: DVector<f64>, size: f64) -> Option<Descent> {
        let direction = &direction / direction.amax();
        let is_kept = |(gradient, own): &(DVector<f64>, Restriction)| {
            let change = gradient.dot(&direction);
            let slack = ROUNDING * gradient.amax();
            match own {
                Restriction::Zero => change.abs() <= slack,
                Restriction::Side(sign) => sign * change >= -slack,
            }
        };
        let curvature = direction.dot(&(&self.p * &direction));
        let is_descent = curvature < -ROUNDING * size && self.active.iter().all(is_kept);
        is_descent.then(|| Descent { direction: direction.iter().copied().collect(), curvature })
    }
}
