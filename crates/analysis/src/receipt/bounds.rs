//! The error of an engine's motion: a proved bound, or, where there is none, the violation of the
//! law of its rows.

use lcplab_judge::Demand;
use lcplab_judge::gap_bound::{GapBound, gap_bound};
use lcplab_judge::motion_bound::{Unproved, motion_bound};
use lcplab_lcp::file::Problem;
use lcplab_lcp::{Coupling, Gauss, Lcp, Matrix, Question};
use lcplab_solver::Options;

use crate::friction::solve_by_default;

use super::finite::first_not_finite;
use super::law::{self, Violation, cones};
use super::newton::Accurate;
use super::step::{EngineAnswer, EngineStep, MassFactor, difference};

/// Why steps with other laws of friction have no bound.
const NO_LAW: &str = "which exists only for boxes and cones";
/// The largest number of rows for which lcplab solves the problem itself.
const MOST_ROWS: usize = 600;
/// The largest number of rows, and of degrees of freedom, of a step whose bounds are tightened
/// although they are below the limit: for more, that would take most of a receipt's time.
const SMALL: usize = 30;
/// Bounds below this fraction of the limit are not tightened.
const NEGLIGIBLE: f64 = 1e-3;
/// The sum of two bounds in floating point may be this much too small, relatively.
const SLACK: f64 = 1.0 + 1e-12;

/// What is known of the error of a step's motion and forces.
#[derive(Debug, Clone)]
pub(crate) enum MotionError {
    /// It has these bounds.
    Bounded(GapBound),
    /// It has no bound, for this reason; the law of a row is violated by at most this.
    Unbounded(String, Option<Violation>),
    /// The problem is not known completely, for this reason; forces leave their bounds and cones by
    /// at most this.
    Unknown(String, Option<Violation>),
}

impl MotionError {
    /// That of a step with an associated law and finite numbers.
    pub(crate) fn of(step: &EngineStep) -> Self {
        let unknown = |why: String| MotionError::Unknown(why, law::of_bounds(step));
        if let Some(why) = &step.no_bound {
            return unknown(why.clone());
        }
        if !step.is_associated() {
            return MotionError::Unknown(NO_LAW.into(), None);
        }
        match by_gap(step) {
            Ok(bounds) => MotionError::Bounded(bounds),
            Err(Unproved::Mass) => unknown(format!("because {}", Unproved::Mass)),
            Err(why) => MotionError::Unbounded(reason(step, why), law::of_law(step)),
        }
    }
}

/// Why there is no bound, in words.
fn reason(step: &EngineStep, why: Unproved) -> String {
    let in_cone =
        |row: usize| step.friction.index[row].is_some() || step.friction.index.contains(&Some(row));
    match why {
        Unproved::NoRoom { row } if in_cone(row) && step.gauss.compliance[row] == 0.0 => {
            format!("because row {row} of a friction cone has no compliance")
        }
        Unproved::NoRoom { row } => format!(
            "because no motion was found that verifiably satisfies row {row} and all others"
        ),
        why => format!("because {why}"),
    }
}

/// By the duality gap; for boxes without compliance by a motion that satisfies all rows.
fn by_gap(step: &EngineStep) -> Result<GapBound, Unproved> {
    let EngineStep { gauss, answer: EngineAnswer { forces, motion, .. }, .. } = step;
    let cones = cones(step);
    gap_bound(gauss, &cones, forces, motion).or_else(|why| {
        if !cones.is_empty() || matches!(why, Unproved::NotFinite | Unproved::Mass) {
            return Err(why);
        }
        let bound = motion_bound(gauss, forces)?.energy_norm;
        let closure = closure(gauss, forces, motion)?;
        let motion = (bound + closure).next_up();
        Ok(GapBound { motion, answer: bound, closure, row: None })
    })
}

/// |v − u(x)|_M, which no bound on any row enters.
fn closure(gauss: &Gauss, forces: &[f64], motion: &[f64]) -> Result<f64, Unproved> {
    let free = Gauss {
        lo: forces.to_vec(),
        hi: forces.to_vec(),
        compliance: vec![1.0; forces.len()],
        ..gauss.clone()
    };
    gap_bound(&free, &[], forces, motion).map(|bound| bound.closure)
}

/// Tighter bounds by way of an accurate motion w, if there is one: |v − û| ≤ |v − w| + a bound on
/// |w − û|.
///
/// A rigid row's motion has a bound only with forces that solve the problem: those of lcplab's own
/// answer.
pub(crate) fn sharpened(
    step: &EngineStep,
    bounds: GapBound,
    accurate: Option<&Accurate>,
) -> GapBound {
    let exact = match accurate {
        Some(Accurate { motion, .. }) => {
            let answer = EngineAnswer { motion: motion.clone(), ..step.answer.clone() };
            Some(EngineStep { answer, ..step.clone() })
        }
        None => own_answer(step),
    };
    let Some(exact) = exact else { return bounds };
    let forces = step.answer.forces.clone();
    let beside = EngineAnswer { forces, ..exact.answer.clone() };
    let beside = EngineStep { answer: beside, ..exact.clone() };
    let (Ok(accurate), Ok(beside)) = (by_gap(&exact), by_gap(&beside)) else {
        return bounds;
    };
    let slack = SLACK * step.norm(&difference(&step.answer.motion, &exact.answer.motion));
    let motion = bounds.motion.min((slack + accurate.motion).next_up());
    let answer = bounds.answer.min((beside.closure + accurate.motion).next_up());
    GapBound { motion, answer, ..bounds }
}

/// The step with lcplab's answer and the motion that it causes; `None` if lcplab finds none.
pub(crate) fn own_answer(step: &EngineStep) -> Option<EngineStep> {
    let n = step.len();
    if n > MOST_ROWS || n == 0 || step.no_bound.is_some() || first_not_finite(step).is_some() {
        return None;
    }
    let gauss = &step.gauss;
    let is_friction = |i: usize| step.friction.index[i].is_some();
    let bound = |values: &[f64], infinity: f64| -> Vec<f64> {
        (0..n).map(|i| if is_friction(i) { infinity } else { values[i] }).collect()
    };
    let lo = bound(&gauss.lo, f64::NEG_INFINITY);
    let hi = bound(&gauss.hi, f64::INFINITY);
    let free = step.along(&gauss.target);
    let b = free.iter().zip(&gauss.bias).map(|(free, bias)| free + bias).collect();
    let mut lcp = Lcp::new(matrix(step), b, lo, hi).ok()?;
    let has_friction = (0..n).any(is_friction);
    if has_friction {
        let coupling = Coupling::new(step.friction.index.clone(), step.friction.mu.clone()).ok()?;
        lcp = lcp.with_coupling(coupling).ok()?;
    }
    let model = step.friction.model.filter(|_| has_friction);
    let problem = Problem { model, ..Problem::new("step", lcp) };
    let question = Question::new(&problem, None, "step").ok()?;
    let demand = Demand { prove_up_to: 0, ..Demand::default() };
    let (answered, judged) = solve_by_default(&question, &Options::default(), &demand, &mut ());
    // A solver may stop before it claims a solution that the judge accepts.
    if !judged.certificate.verdict.is_solution() {
        return None;
    }
    let forces = answered.solution.x;
    let motion = step.motion_of(&forces);
    let answer = EngineAnswer { forces, motion, ..step.answer.clone() };
    Some(EngineStep { answer, ..step.clone() })
}

/// A = J M⁻¹Jᵀ + compliance.
pub(super) fn matrix(step: &EngineStep) -> Matrix {
    let n = step.len();
    let factor = MassFactor::of(&step.gauss.mass, step.gauss.target.len());
    let mut a = vec![0.0; n * n];
    for j in 0..n {
        let mut unit = vec![0.0; n];
        unit[j] = 1.0;
        let column = step.along(&factor.solve(&step.push(&unit)));
        for (i, value) in column.into_iter().enumerate().skip(j) {
            (a[i * n + j], a[j * n + i]) = (value, value);
        }
        a[j * n + j] += step.gauss.compliance[j];
    }
    Matrix::dense(n, &a)
}

/// Whether both bounds need not be tightened: they are below the limit, and the step is large or
/// they are far below it.
pub(super) fn is_sharp(step: &EngineStep, bounds: &GapBound, limit: f64) -> bool {
    let is_large = step.len().max(step.gauss.target.len()) > SMALL;
    is_within(step, bounds, if is_large { limit } else { NEGLIGIBLE * limit })
}

/// Whether both bounds are at most the limit.
pub(super) fn is_within(step: &EngineStep, bounds: &GapBound, limit: f64) -> bool {
    step.relative(bounds.motion.max(bounds.answer)) <= limit
}
