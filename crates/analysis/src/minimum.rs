//! Whether an answer is a minimum of the objective that a problem declares.
//!
//! If a file has the key `objective`, its rows are the optimality conditions of min ½ xᵀP x + qᵀx
//! under bounds and linear constraints. Maxima and saddles can satisfy them, too. At a
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

use lcplab_lcp::file::{Problem, number};
use lcplab_lcp::{Lcp, Question};
use lcplab_page::number::readable;

/// Larger programs are not examined.
const MAX_COLUMNS: usize = 200;
/// Maximum number of constraints whose combinations are tried.
const MAX_RELEASED: usize = 8;
/// Relative size below which a value is rounding.
const ROUNDING: f64 = 1e-12;
/// Relative size above which a gap or a force of an accepted answer is surely not 0.
const CLEAR: f64 = 1e-6;
/// Relative size below which a direction keeps a constraint, and a curvature is 0.
const FLAT: f64 = 1e-9;
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
    /// use lcplab_lcp::{Lcp, Question};
    /// use lcplab_lcp::file::Problem;
    /// use lcplab_analysis::minimum::Descent;
    ///
    /// // x²/2 + 3 x y + y²/2 on a square has a saddle at 0 and minima at two corners.
    /// let text = r#"{"A": {"dense": [[1, 3], [3, 1]]}, "b": [0, 0], "lo": [-1, -1], "hi": [1, 1],
    ///                "objective": true}"#;
    /// let question = Question::new(&Problem::parse(text, "saddle.json")?, None, "saddle.json")?;
    /// let found = Descent::of(&question, &[0.0, 0.0]).unwrap();
    /// assert_eq!(found.direction[0], -found.direction[1]);
    /// assert!((found.curvature + 4.0).abs() < 1e-12);
    /// assert_eq!(Descent::of(&question, &[1.0, -1.0]), None);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
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

/// Whether a bound or a constraint is active at x. x is seldom exact: what is not clear counts as
/// active with a force, which allows the fewest directions.
struct Activity<'a> {
    lcp: &'a Lcp,
    x: &'a [f64],
    w: Vec<f64>,
    /// Σ_j |a_ij x_j| + |b_i|: the size of w_i's terms.
    terms: Vec<f64>,
}

impl<'a> Activity<'a> {
    fn of(lcp: &'a Lcp, x: &'a [f64]) -> Self {
        let terms = |i: usize| {
            let terms = lcp.matrix().row(i).iter().map(|(j, a)| (a * x[j]).abs());
            terms.sum::<f64>() + lcp.b()[i].abs()
        };
        Activity { lcp, x, w: lcp.w(x), terms: (0..lcp.len()).map(terms).collect() }
    }

    /// The restriction of an unknown between its bounds; `size` is the size of its terms, and
    /// `force` that of the force at its bound, relative to the terms of the forces there.
    fn between_bounds(&self, i: usize, size: f64, force: f64) -> Option<Restriction> {
        let [below, above] = [self.x[i] - self.lcp.lo()[i], self.lcp.hi()[i] - self.x[i]];
        let gap = below.min(above);
        if force <= CLEAR && gap > CLEAR * size && gap > 0.0 {
            return None;
        }
        let is_fixed = self.lcp.lo()[i] == self.lcp.hi()[i];
        let side = if below <= above { 1.0 } else { -1.0 };
        Some(if is_fixed || force > ROUNDING { Restriction::Zero } else { Restriction::Side(side) })
    }

    /// The restriction of a column of the program; the force at its bound is w.
    fn column(&self, i: usize) -> Option<Restriction> {
        let row = self.lcp.matrix().row(i);
        let largest = row.iter().map(|(_, a)| a.abs()).fold(0.0, f64::max);
        let scale = match self.lcp.matrix().diagonal(i).abs() {
            0.0 if largest > 0.0 => largest,
            0.0 => 1.0,
            own => own,
        };
        self.between_bounds(i, self.terms[i] / scale, part(self.w[i], self.terms[i]))
    }

    /// The restriction of the constraint with multiplier k, whose unknown aᵀx is `value` if it has
    /// two limits.
    fn constraint(&self, k: usize, value: Option<usize>, columns: &[usize]) -> Option<Restriction> {
        let pull = |&j: &usize| part(self.lcp.matrix().entry(j, k) * self.x[k], self.terms[j]);
        let force = columns.iter().map(pull).fold(0.0, f64::max);
        if let Some(s) = value {
            return self.between_bounds(s, self.terms[k], force);
        }
        let (lo, hi) = (self.lcp.lo()[k], self.lcp.hi()[k]);
        if lo.is_infinite() && hi.is_infinite() {
            return Some(Restriction::Zero);
        }
        let side = if lo == 0.0 { 1.0 } else { -1.0 };
        if force <= CLEAR && part(side * self.w[k], self.terms[k]) > CLEAR {
            return None;
        }
        Some(if force > ROUNDING { Restriction::Zero } else { Restriction::Side(side) })
    }
}

/// A value relative to the size of its terms; 0 if both are.
fn part(value: f64, terms: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.abs() / terms }
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
        let activity = Activity::of(lcp, x);
        let unit = |place: usize| DVector::from_fn(n, |k, _| f64::from(k == place));
        let bounds = columns
            .iter()
            .enumerate()
            .filter_map(|(place, &i)| Some((unit(place), activity.column(i)?)));
        let constraints = (0..lcp.len()).filter(|k| kind(*k) == Some("multiplier"));
        let constraints = constraints.filter_map(|k| {
            // The unknown s = aᵀx of a row with two limits.
            let value =
                (0..lcp.len()).find(|&s| kind(s) == Some("row") && lcp.matrix().entry(k, s) != 0.0);
            let gradient = DVector::from_fn(n, |j, _| lcp.matrix().entry(k, columns[j]));
            Some((gradient, activity.constraint(k, value, &columns)?))
        });
        Some(Program { p, active: bounds.chain(constraints).collect() })
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
            .filter(|&k| eigen.eigenvalues[k] <= FLAT)
            .map(|k| eigen.eigenvectors.column(k).into_owned())
            .collect();
        (!columns.is_empty()).then(|| DMatrix::from_columns(&columns))
    }

    /// The direction, if it keeps the constraints and the objective decreases along it.
    fn checked(&self, direction: DVector<f64>, size: f64) -> Option<Descent> {
        let direction = &direction / direction.amax();
        let is_kept = |(gradient, own): &(DVector<f64>, Restriction)| {
            let change = gradient.dot(&direction);
            let slack = FLAT * gradient.amax();
            match own {
                Restriction::Zero => change.abs() <= slack,
                Restriction::Side(sign) => sign * change >= -slack,
            }
        };
        let curvature = direction.dot(&(&self.p * &direction));
        let is_descent = curvature < -FLAT * size && self.active.iter().all(is_kept);
        is_descent.then(|| Descent { direction: direction.iter().copied().collect(), curvature })
    }
}
