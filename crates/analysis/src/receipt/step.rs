//! One step as an engine reports it, in the units of the engine.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Col, Mat, Side};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::friction::Model;
use lcplab_lcp::{Gauss, Level};

/// What the key `source` of a problem file says about the engine and its step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Source {
    /// The engine.
    pub engine: String,
    /// Its version; may be empty.
    pub version: String,
    /// The kind of its solver: `direct`, `newton`, `cg` or `pgs`.
    pub method: String,
    /// The bits of its numbers: 32 or 64.
    pub bits: u32,
    /// The iterations of its solver; 0 if unknown.
    pub iterations: usize,
    /// Whether the solver ended before its iteration limit.
    pub has_converged: bool,
    /// The time of the step (s).
    #[serde(with = "crate::number::always")]
    pub time: f64,
    /// The engine's own tolerance as an error in the norm of M; 0 if it states none.
    #[serde(with = "crate::number::always")]
    pub own_tolerance: f64,
    /// The change of the motion by gravity in the step, in the norm of M; 0 if unknown.
    #[serde(with = "crate::number::always")]
    pub gravity: f64,
    /// The scene; may be empty.
    pub name: String,
    /// The engine's settings, for files only.
    #[serde(skip_serializing_if = "Value::is_null")]
    pub settings: Value,
}

impl Default for Source {
    fn default() -> Self {
        Source {
            engine: "engine".into(),
            version: String::new(),
            method: "direct".into(),
            bits: 64,
            iterations: 0,
            has_converged: true,
            time: 0.0,
            own_tolerance: 0.0,
            gravity: 0.0,
            name: String::new(),
            settings: Value::Null,
        }
    }
}

/// The names of a row.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RowNames {
    /// The label.
    pub label: String,
    /// The kind, such as `normal`.
    pub kind: String,
    /// The bodies.
    pub bodies: Vec<String>,
}

/// The rows of friction of a step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrictionRows {
    /// The normal row of each row of friction, `None` for other rows; n entries.
    pub index: Vec<Option<usize>>,
    /// The coefficient of each row of friction; n entries.
    pub mu: Vec<f64>,
    /// The law: associated or Coulomb's cones, or `None` for the bounds ±μ x_k.
    pub model: Option<Model>,
}

/// The engine's answer.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EngineAnswer {
    /// x, n entries: N s at velocity level, N at acceleration level.
    pub forces: Vec<f64>,
    /// v, k entries.
    pub motion: Vec<f64>,
    /// The generalized forces of the constraints as the engine reports them, k entries.
    pub reported_push: Option<Vec<f64>>,
}

/// What model and state require, where an adapter computes it independently.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Expected {
    /// J, n rows of columns and values.
    pub jacobian: Option<Vec<Vec<(usize, f64)>>>,
    /// The bias, n entries.
    pub bias: Option<Vec<f64>>,
    /// The motion without constraints, k entries.
    pub target: Option<Vec<f64>>,
}

/// The problem that an engine posed in one step, and its answer: n rows, k degrees of freedom.
///
/// w = J v + bias + compliance · x is the velocity (m/s) or acceleration (m/s²) that remains in a
/// row, and v = target + M⁻¹Jᵀx is the new motion.
#[derive(Debug, Clone, Default)]
pub struct EngineStep {
    /// The engine, its solver and its scene.
    pub source: Source,
    /// The problem; its level is set.
    pub gauss: Gauss,
    /// The rows of friction.
    pub friction: FrictionRows,
    /// The answer.
    pub answer: EngineAnswer,
    /// Independently computed parts of the problem.
    pub expected: Expected,
    /// The names of the rows; may be shorter than n.
    pub rows: Vec<RowNames>,
    /// The body of each degree of freedom; may be shorter than k.
    pub dof_bodies: Vec<String>,
    /// Parts that the engine does not report.
    pub not_checked: Vec<String>,
    /// Why the motion has no bound, although its law of friction allows one.
    pub no_bound: Option<String>,
    /// Whether the motion is not the engine's, but computed from its forces.
    pub has_computed_motion: bool,
}

impl EngineStep {
    /// Checks the lengths of all vectors, the signs of compliance and μ, the order of bounds, and
    /// the normal rows of friction.
    ///
    /// # Errors
    /// If a vector has another length than rows or degrees of freedom, a compliance or a
    /// coefficient of friction is negative, lo is above hi, or a row of friction names itself or a
    /// row that does not exist.
    pub fn check(&self, input: &str) -> Result<()> {
        let (n, k) = (self.len(), self.gauss.target.len());
        let EngineAnswer { forces, motion, reported_push } = &self.answer;
        let mut vectors = vec![
            ("compliance", self.gauss.compliance.len(), n),
            ("lo", self.gauss.lo.len(), n),
            ("hi", self.gauss.hi.len(), n),
            ("friction_index", self.friction.index.len(), n),
            ("mu", self.friction.mu.len(), n),
            ("x", forces.len(), n),
            ("motion", motion.len(), k),
        ];
        let optional = [
            ("reported_push", reported_push, k),
            ("expected_bias", &self.expected.bias, n),
            ("expected_target", &self.expected.target, k),
        ];
        vectors.extend(optional.iter().filter_map(|(name, values, size)| {
            values.as_ref().map(|values| (*name, values.len(), *size))
        }));
        vectors
            .extend(self.expected.jacobian.iter().map(|rows| ("expected_jacobian", rows.len(), n)));
        for (name, length, size) in vectors {
            if length != size {
                let reason = format!("has {length} entries, must have {size}");
                return Err(Error::invalid(input, name, reason));
            }
        }
        let Gauss { compliance, lo, hi, .. } = &self.gauss;
        let is_negative = |values: &[f64]| values.iter().position(|&value| value < 0.0);
        for (name, values) in [("compliance", compliance), ("mu", &self.friction.mu)] {
            if let Some(row) = is_negative(values) {
                let reason = format!("is {} in row {row}, must not be negative", values[row]);
                return Err(Error::invalid(input, name, reason));
            }
        }
        if let Some(row) = (0..n).find(|&row| lo[row] > hi[row]) {
            let reason = format!("is {} in row {row}, above hi, {}", lo[row], hi[row]);
            return Err(Error::invalid(input, "lo", reason));
        }
        for (row, normal) in self.friction.index.iter().enumerate() {
            if normal.is_some_and(|normal| normal >= n || normal == row) {
                let normal = normal.unwrap_or_default();
                let reason = format!("row {row} names {normal}, which is no other row");
                return Err(Error::invalid(input, "friction_index", reason));
            }
        }
        Ok(())
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.gauss.bias.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The same step with the motion that its forces cause instead of the engine's, which is then
    /// not checked.
    pub(crate) fn with_motion_of_forces(mut self) -> Self {
        self.answer.motion = self.motion_of(&self.answer.forces);
        self.has_computed_motion = true;
        self.not_checked
            .push("write-back: the motion, which the engine does not report".to_string());
        self
    }

    /// J v, n entries.
    pub(crate) fn along(&self, motion: &[f64]) -> Vec<f64> {
        let row = |row: &Vec<(usize, f64)>| row.iter().map(|&(j, value)| value * motion[j]).sum();
        self.gauss.jacobian.iter().map(row).collect()
    }

    /// The sum of the absolute values of the terms of J v, n entries.
    pub(crate) fn size_along(&self, motion: &[f64]) -> Vec<f64> {
        let row =
            |row: &Vec<(usize, f64)>| row.iter().map(|&(j, value)| (value * motion[j]).abs()).sum();
        self.gauss.jacobian.iter().map(row).collect()
    }

    /// Jᵀx, k entries.
    pub(crate) fn push(&self, forces: &[f64]) -> Vec<f64> {
        let mut push = vec![0.0; self.gauss.target.len()];
        for (row, x) in self.gauss.jacobian.iter().zip(forces) {
            row.iter().for_each(|&(j, value)| push[j] += value * x);
        }
        push
    }

    /// M v, k entries.
    pub(crate) fn times_mass(&self, motion: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; motion.len()];
        for &(i, j, value) in &self.gauss.mass {
            product[i] += value * motion[j];
            if i != j {
                product[j] += value * motion[i];
            }
        }
        product
    }

    /// M⁻¹ f, k entries; not finite if M is singular.
    pub(crate) fn divided_by_mass(&self, f: &[f64]) -> Vec<f64> {
        MassFactor::of(&self.gauss.mass, f.len()).solve(f)
    }

    /// u* + M⁻¹Jᵀx, k entries.
    pub(crate) fn motion_of(&self, forces: &[f64]) -> Vec<f64> {
        let change = self.divided_by_mass(&self.push(forces));
        self.gauss.target.iter().zip(change).map(|(target, change)| target + change).collect()
    }

    /// √(vᵀM v): the root of twice a kinetic energy, if v is a velocity. It is NaN where v or M
    /// is.
    pub fn norm(&self, motion: &[f64]) -> f64 {
        let square: f64 =
            self.times_mass(motion).iter().zip(motion).map(|(product, v)| product * v).sum();
        if square < 0.0 { 0.0 } else { square.sqrt() }
    }

    /// The change of the motion by the constraints, |v − u*|_M, but at least the change by gravity
    /// and 10⁻⁶ |u*|_M. Errors of the motion are relative to it.
    pub fn effect(&self) -> f64 {
        self.effect_and_cause().0
    }

    /// Which of the three changes is the largest, with its article.
    pub(crate) fn cause_of_effect(&self) -> &'static str {
        self.effect_and_cause().1
    }

    fn effect_and_cause(&self) -> (f64, &'static str) {
        let change = self.norm(&difference(&self.answer.motion, &self.gauss.target));
        // NaN compares as larger than nothing, and the receipt has to report it.
        let mut largest = (change, "the change by the constraints");
        let gravity = (self.source.gravity, "the change by gravity");
        let free =
            (1e-6 * self.norm(&self.gauss.target), "a millionth of the motion without constraints");
        for other in [gravity, free] {
            if other.0 > largest.0 {
                largest = other;
            }
        }
        largest
    }

    /// An error in the norm of M, relative to the effect.
    pub(crate) fn relative(&self, error: f64) -> f64 {
        let effect = self.effect();
        match error {
            0.0 => 0.0,
            _ if effect > 0.0 => error / effect,
            _ => f64::INFINITY,
        }
    }

    /// Whether all rows of friction have the law of an associated cone.
    pub(crate) fn is_associated(&self) -> bool {
        self.friction.model == Some(Model::AssociatedCone)
            || self.friction.index.iter().all(Option::is_none)
    }

    /// The step with an associated law that its answer satisfies if and only if it satisfies the
    /// law of the step. Coupled boxes get the constant limits ±μ x_k of the answer. Coulomb's cones
    /// become associated ones: the normal row of w gets μ |w_t| of the answer in addition (De Saxcé
    /// & Feng 1998). `None` for other laws.
    pub(crate) fn frozen(&self) -> Option<EngineStep> {
        let mut frozen = self.clone();
        let rows = self.friction.index.iter().zip(&self.friction.mu).enumerate();
        let rows = rows.filter_map(|(i, (normal, mu))| normal.map(|k| (i, k, *mu)));
        match self.friction.model {
            None | Some(Model::CoupledBox) => {
                for (i, k, mu) in rows {
                    let limit = mu * self.answer.forces[k].max(0.0);
                    (frozen.gauss.lo[i], frozen.gauss.hi[i]) = (-limit, limit);
                }
                frozen.friction.index.fill(None);
            }
            Some(Model::CoulombCone) => {
                let w = self.remaining();
                let mut squares = vec![0.0; self.len()];
                rows.for_each(|(i, k, mu)| squares[k] += (mu * w[i]).powi(2));
                frozen.gauss.bias.iter_mut().zip(squares).for_each(|(b, s)| *b += s.sqrt());
            }
            Some(_) => return None,
        }
        frozen.friction.model = Some(Model::AssociatedCone);
        Some(frozen)
    }

    /// w = J v + bias + compliance · x of the answer, n entries.
    pub(crate) fn remaining(&self) -> Vec<f64> {
        let Gauss { bias, compliance, .. } = &self.gauss;
        let speeds = self.along(&self.answer.motion);
        (0..self.len())
            .map(|i| speeds[i] + bias[i] + compliance[i] * self.answer.forces[i])
            .collect()
    }

    /// The unit of [`norm`](EngineStep::norm).
    pub fn unit(&self) -> &'static str {
        self.gauss.level.unwrap_or(Level::Velocity).norm_unit()
    }

    /// The bodies of a row; empty if unknown.
    pub(crate) fn bodies_of(&self, row: Option<usize>) -> Vec<String> {
        row.and_then(|row| self.rows.get(row)).map(|row| row.bodies.clone()).unwrap_or_default()
    }

    /// M as a dense matrix.
    pub(crate) fn dense_mass(&self) -> Mat<f64> {
        let k = self.gauss.target.len();
        let mut mass = Mat::zeros(k, k);
        for &(i, j, value) in &self.gauss.mass {
            (mass[(i, j)], mass[(j, i)]) = (value, value);
        }
        mass
    }
}

/// A step without its arrays, as JSON passes it.
///
/// ```
/// use lcplab_analysis::receipt::{EngineStep, StepFacts};
/// use lcplab_lcp::Level;
/// use serde_json::json;
///
/// let problem = json!({"b": [-3], "motion": {"mass": [[0, 0, 2]], "jacobian": [[0, 0, 1]],
///     "bias": [0], "compliance": [0.5], "target": [-3]}});
/// let answer = json!({"x": [3], "motion": [-1.5]});
/// let facts = StepFacts::of(&EngineStep::read(&problem, &answer, "fall.json")?);
/// assert_eq!(facts.level()?, Level::Velocity);
/// assert_eq!(facts.model()?, None); // no friction
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepFacts {
    /// The engine, its solver and its scene.
    pub source: Source,
    level: String,
    model: Option<String>,
    /// The names of the rows.
    pub rows: Vec<RowNames>,
    /// The body of each degree of freedom.
    pub dof_bodies: Vec<String>,
    /// Parts that the engine does not report.
    pub not_checked: Vec<String>,
    /// Why the motion has no bound, although its law of friction allows one.
    pub no_bound: Option<String>,
    /// Whether the motion is not the engine's, but computed from its forces.
    pub has_computed_motion: bool,
}

impl StepFacts {
    /// Those of a step.
    pub fn of(step: &EngineStep) -> Self {
        StepFacts {
            source: step.source.clone(),
            level: step.gauss.level.unwrap_or(Level::Velocity).name().into(),
            model: step.friction.model.map(|model| model.to_string()),
            rows: step.rows.clone(),
            dof_bodies: step.dof_bodies.clone(),
            not_checked: step.not_checked.clone(),
            no_bound: step.no_bound.clone(),
            has_computed_motion: step.has_computed_motion,
        }
    }

    /// Whether motions are velocities or accelerations.
    ///
    /// # Errors
    /// If the word is neither.
    pub fn level(&self) -> Result<Level> {
        let level = Level::ALL.into_iter().find(|level| level.name() == self.level);
        level.ok_or_else(|| {
            let reason = format!("is {:?}, must be velocity or acceleration", self.level);
            Error::invalid("step", "level", reason)
        })
    }

    /// The law of friction; `None` for the bounds ±μ x_k.
    ///
    /// # Errors
    /// If there is no law of this name.
    pub fn model(&self) -> Result<Option<Model>> {
        self.model.as_ref().map(|name| name.parse()).transpose()
    }
}

/// a − b.
pub(crate) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// M factored in its independent diagonal blocks.
pub(crate) struct MassFactor {
    /// The first column of each block, and its factors.
    blocks: Vec<(usize, PartialPivLu<f64>)>,
}

impl MassFactor {
    /// From the entries of the upper triangle of a k × k matrix.
    pub(crate) fn of(upper: &[(usize, usize, f64)], k: usize) -> Self {
        let blocks = blocks(upper, k).into_iter();
        let factored = |(first, block): (usize, Mat<f64>)| (first, block.partial_piv_lu());
        MassFactor { blocks: blocks.map(factored).collect() }
    }

    /// The first column of the first block that has no Cholesky factor, with M scaled to a diagonal
    /// of ones, which must be positive.
    pub(crate) fn first_not_definite(upper: &[(usize, usize, f64)], k: usize) -> Option<usize> {
        let mut blocks = blocks(upper, k).into_iter();
        blocks.find_map(|(first, block)| {
            let root = |i: usize| block[(i, i)].sqrt();
            let size = block.nrows();
            let scaled = Mat::from_fn(size, size, |i, j| block[(i, j)] / (root(i) * root(j)));
            scaled.llt(Side::Lower).is_err().then_some(first)
        })
    }

    /// M⁻¹ f.
    pub(crate) fn solve(&self, f: &[f64]) -> Vec<f64> {
        let mut solved = f.to_vec();
        let ends = self.blocks.iter().skip(1).map(|block| block.0).chain([f.len()]);
        for ((first, factor), end) in self.blocks.iter().zip(ends) {
            let part = Col::from_fn(end - first, |i| f[first + i]);
            let part = factor.solve(&part);
            (*first..end).for_each(|j| solved[j] = part[j - first]);
        }
        solved
    }
}

/// The independent diagonal blocks of a k × k matrix with these entries of its upper triangle, each
/// with its first column.
fn blocks(upper: &[(usize, usize, f64)], k: usize) -> Vec<(usize, Mat<f64>)> {
    // The last column that shares a block with each column.
    let mut last: Vec<usize> = (0..k).collect();
    upper.iter().for_each(|&(i, j, _)| last[i] = last[i].max(j));
    let (mut blocks, mut first, mut end) = (Vec::new(), 0, 0);
    let mut block_of = vec![0; k];
    for column in 0..k {
        end = last[column].max(end);
        block_of[column] = blocks.len();
        if column == end {
            blocks.push((first, Mat::<f64>::zeros(column + 1 - first, column + 1 - first)));
            (first, end) = (column + 1, column + 1);
        }
    }
    for &(i, j, value) in upper {
        let (first, block) = &mut blocks[block_of[i]];
        let (i, j) = (i - *first, j - *first);
        (block[(i, j)], block[(j, i)]) = (value, value);
    }
    blocks
}
