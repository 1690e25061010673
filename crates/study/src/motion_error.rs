//! How far the motion that an answer leads to is from the exact motion, for problems that state
//! their masses and rows.
//!
//! A relative residual is no physical tolerance. Where the file has the key `motion`, [Gauss's
//! principle](Gauss) bounds the error of the motion itself: |u(x) − û|_M, u(x) = u* + M⁻¹Jᵀx, in
//! the norm whose half square is an energy (of velocities). Beside it stands what the constraints
//! change, |û − u*|_M. Where rows are coupled, û is the motion with the friction limits that x
//! itself gives.

use serde_json::{Value, json};

use lcplab_judge::motion_bound::{MotionBound, motion_bound};
use lcplab_judge::{printed_up, upper_bound};
use lcplab_page::number::readable;
use lcplab_problem::file::number;
use lcplab_problem::{Gauss, Question};

/// A bound on the error of the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionError {
    /// |u(x) − û|_M is at most this, in the root of the unit of energy where u is a velocity.
    pub bound: f64,
    /// |û − u*|_M, to within the bound: what the constraints change.
    pub effect: f64,
    /// Whether friction limits are those that x gives.
    pub is_frozen: bool,
}

impl MotionError {
    /// The bound for an answer; none where the problem does not state its masses and rows, else why
    /// there is no bound.
    pub fn of(question: &Question, x: &[f64]) -> Option<Result<MotionError, String>> {
        let gauss = question.problem().motion.as_ref()?;
        let Some(lcp) = question.boxed() else {
            let model = question.model().map(|model| model.to_string()).unwrap_or_default();
            return Some(Err(format!("no bound is available for {model}")));
        };
        let (lo, hi) = (0..x.len()).map(|i| lcp.bounds(i, x)).unzip();
        let gauss = Gauss { lo, hi, ..gauss.clone() };
        let error = |MotionBound { energy_norm, motion, .. }| MotionError {
            bound: energy_norm,
            effect: distance(&gauss, &motion),
            is_frozen: lcp.has_coupled_rows(),
        };
        Some(motion_bound(&gauss, x).map(error).map_err(|why| why.to_string()))
    }

    /// The line of text that `solve` and `judge` print; nothing where the problem does not state
    /// its masses and rows.
    pub fn text(question: &Question, x: &[f64]) -> String {
        let (value, meaning) = match MotionError::of(question, x) {
            None => return String::new(),
            Some(Ok(error)) => (upper_bound(error.bound), error.meaning()),
            Some(Err(why)) => ("–".into(), why),
        };
        format!("  motion error     {value:>10}  {meaning}\n")
    }

    /// The key `motion_error` of an answer.
    pub fn json(question: &Question, x: &[f64]) -> Option<(String, Value)> {
        let value = match MotionError::of(question, x)? {
            Ok(MotionError { bound, effect, is_frozen }) => json!({
                "bound": number(printed_up(bound)), "effect": number(effect), "frozen": is_frozen,
            }),
            Err(why) => json!({ "unproved": why }),
        };
        Some(("motion_error".into(), value))
    }

    /// What the bound means, as the end of a line.
    fn meaning(&self) -> String {
        let part = readable(self.bound / self.effect, 2);
        let of_what = match self.effect {
            0.0 => "the constraints change nothing".to_string(),
            effect => format!("{part} of what the constraints change ({})", readable(effect, 3)),
        };
        let frozen = if self.is_frozen { ", with the friction limits of x" } else { "" };
        format!("bound on |u(x) − û|_M: {of_what}{frozen}")
    }
}

/// |u − u*|_M.
fn distance(gauss: &Gauss, u: &[f64]) -> f64 {
    let change: Vec<f64> = u.iter().zip(&gauss.target).map(|(u, target)| u - target).collect();
    let term = |&(i, j, m): &(usize, usize, f64)| {
        let product = m * change[i] * change[j];
        if i == j { product } else { 2.0 * product }
    };
    gauss.mass.iter().map(term).sum::<f64>().max(0.0).sqrt()
}
