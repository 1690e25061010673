//! The distance between the motion from an answer and the exact motion, for problems that state
//! their masses and rows.
//!
//! A relative residual is not a physical tolerance. If the file has the key `motion`, [Gauss's
//! principle](Gauss) bounds the error of the motion itself: |u(x) − û|_M, u(x) = u* + M⁻¹Jᵀx, in
//! the norm whose half square is an energy (for velocities). It is compared with the effect of the
//! constraints, |û − u*|_M. If rows are coupled, û is the motion with the friction limits from x
//! itself. Under associated cones, whose rows all have compliance, the [duality
//! gap](lcplab_judge::gap_bound) bounds it; Coulomb's law has no bound, as it minimizes nothing.

use serde_json::{Value, json};

use lcplab_judge::gap_bound::{EllipticCone, answer_bound};
use lcplab_judge::motion_bound::{MotionBound, Unproved, inconsistent_row, motion_bound};
use lcplab_judge::{printed_up, upper_bound};
use lcplab_lcp::file::number;
use lcplab_lcp::friction::{Contact, FrictionProblem, Model};
use lcplab_lcp::{Gauss, Lcp, Level, Question};
use lcplab_page::number::readable;

/// A smaller fraction is not printed as a percentage.
const LEAST_PERCENTAGE: f64 = 1e-3;

/// A bound on the error of the motion.
///
/// ```
/// use lcplab_analysis::motion_error::MotionError;
/// use lcplab_lcp::Question;
/// use lcplab_lcp::file::Problem;
///
/// // 2 kg fall at 3 m/s on one contact: A = 1/2, x = 6 N s stops them.
/// let text = r#"{"A": {"dense": [[0.5]]}, "b": [-3],
///                "motion": {"mass": [[0, 0, 2]], "jacobian": [[0, 0, 1]], "bias": [0],
///                           "compliance": [0], "target": [-3], "level": "velocity"}}"#;
/// let question = Question::new(&Problem::parse(text, "fall.json")?, None, "fall.json")?;
/// let exact = MotionError::of(&question, &[6.0]).unwrap().unwrap();
/// assert!(exact.relative() < 1e-15); // rounding of the bound
/// // 6.2 N s are 0.1 m/s too much, of the 3 m/s that the contact changes.
/// let wrong = MotionError::of(&question, &[6.2]).unwrap().unwrap();
/// assert!(wrong.bound >= 0.1 * 2f64.sqrt() && wrong.relative() >= 0.1 / 3.1);
/// assert!(MotionError::text(&question, &[6.2]).starts_with("  motion error"));
/// assert_eq!(MotionError::json(&question, &[6.2])[0].1["unit"], "√J");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MotionError {
    /// |u(x) − û|_M is at most this.
    pub bound: f64,
    /// |û − u*|_M, the effect of the constraints, is at least this; 0 if x is too inaccurate to
    /// tell.
    pub effect: f64,
    /// No entry of u(x) − û is larger.
    pub largest_entry: f64,
    /// Whether u is a velocity or an acceleration, if the file states it.
    pub level: Option<Level>,
    /// Whether friction limits are those that follow from x.
    pub is_frozen: bool,
}

impl MotionError {
    fn new(gauss: &Gauss, bound: &MotionBound) -> Self {
        MotionError {
            bound: bound.energy_norm,
            // The motion of x is at most the bound away from the exact one.
            effect: (length(gauss, &bound.motion) - bound.energy_norm).max(0.0),
            largest_entry: bound.largest_entry,
            level: gauss.level,
            is_frozen: false,
        }
    }

    /// The bound for an answer, or why there is none; `None` if the problem does not state its
    /// masses and rows.
    pub fn of(question: &Question, x: &[f64]) -> Option<Result<MotionError, String>> {
        let gauss = question.problem().motion.as_ref()?;
        let error = match (question.boxed(), question.friction()) {
            (Some(lcp), _) => of_box(gauss, lcp, x),
            (None, Some(friction)) if question.model() == Some(Model::AssociatedCone) => {
                of_cones(gauss, friction, x)
            }
            _ => {
                let model = question.model().map(|model| model.to_string()).unwrap_or_default();
                return Some(Err(format!("no bound is available for {model}")));
            }
        };
        Some(error.map_err(|why| why.to_string()))
    }

    /// The line of text that commands print; empty if the problem does not state its masses and
    /// rows.
    pub fn text(question: &Question, x: &[f64]) -> String {
        let (value, meaning) = match MotionError::of(question, x) {
            None => return String::new(),
            Some(Ok(error)) => (format!("≤ {}", upper_bound(error.bound)), error.meaning()),
            Some(Err(why)) => ("–".into(), why),
        };
        let mut text = format!("  motion error     {value:>10}  {meaning}\n");
        if let Some((row, difference)) = inconsistency(question, x) {
            text += &format!(
                "  motion data      {:>10}  A x + b is not J u(x) + bias + γ x, relative to the terms of row {row}: \
                 A and b were not computed from these masses and rows\n",
                readable(difference, 2)
            );
        }
        text
    }

    /// The key `motion_error` of an answer, and `motion_data` if A and b were not computed from the
    /// masses and rows; no key if the problem does not state these.
    pub fn json(question: &Question, x: &[f64]) -> Vec<(String, Value)> {
        let Some(found) = MotionError::of(question, x) else { return Vec::new() };
        let error = match found {
            Ok(error) => json!({
                "bound": number(printed_up(error.bound)),
                "unit": error.level.map(Level::norm_unit),
                "effect": number(error.effect),
                "relative": number(printed_up(error.relative())),
                "largest_entry": number(printed_up(error.largest_entry)),
                "level": error.level.map(Level::name),
                "frozen": error.is_frozen,
            }),
            Err(why) => json!({ "unproved": why }),
        };
        let data = inconsistency(question, x)
            .map(|(row, difference)| json!({ "row": row, "relative": number(difference) }));
        let keys = [("motion_error", Some(error)), ("motion_data", data)];
        keys.into_iter().filter_map(|(key, value)| Some((key.into(), value?))).collect()
    }

    /// Whether the motion error of an answer is proved to be at most this part of the effect of the
    /// constraints. False if the problem does not state its masses and rows, or if A and b were not
    /// computed from them.
    ///
    /// ```
    /// use lcplab_analysis::motion_error::MotionError;
    /// use lcplab_lcp::Question;
    /// use lcplab_lcp::file::Problem;
    ///
    /// // 2 kg fall at 3 m/s on one contact; 6.2 N s instead of 6 are 0.1 m/s too much.
    /// let text = r#"{"A": {"dense": [[0.5]]}, "b": [-3],
    ///                "motion": {"mass": [[0, 0, 2]], "jacobian": [[0, 0, 1]], "bias": [0],
    ///                           "compliance": [0], "target": [-3], "level": "velocity"}}"#;
    /// let question = Question::new(&Problem::parse(text, "fall.json")?, None, "fall.json")?;
    /// assert!(MotionError::is_within(&question, &[6.2], 0.1));
    /// assert!(!MotionError::is_within(&question, &[6.2], 0.01));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn is_within(question: &Question, x: &[f64], limit: f64) -> bool {
        let error = MotionError::of(question, x).and_then(Result::ok);
        error.is_some_and(|error| error.relative() <= limit) && inconsistency(question, x).is_none()
    }

    /// The bound relative to the effect of the constraints; ∞ if x is too inaccurate to tell.
    pub fn relative(&self) -> f64 {
        if self.bound == 0.0 { 0.0 } else { self.bound / self.effect }
    }

    /// The meaning of the bound, as the end of a line.
    fn meaning(&self) -> String {
        let unit = self.level.map(Level::norm_unit).unwrap_or("in the norm √(uᵀM u)");
        let of_what = match self.relative() {
            relative if relative < 1.0 => {
                let part = match relative < LEAST_PERCENTAGE {
                    true => readable(relative, 2) + " of",
                    false => readable(100.0 * relative, 2) + " % of",
                };
                let effect = readable(self.effect, 3);
                format!("≤ {part} the constraints' effect (≥ {effect} {unit})")
            }
            _ => "possibly more than the constraints' effect".into(),
        };
        let frozen = if self.is_frozen { "; friction limits fixed at those of x" } else { "" };
        let entries = self.level.map(|level| {
            let (name, units) = (level.name(), level.units());
            format!("; no {name} off by more than {} {units}", upper_bound(self.largest_entry))
        });
        format!("{unit}, {of_what}{frozen}{}", entries.unwrap_or_default())
    }
}

/// The row in which A and b are not those of the masses and rows, and by how much.
fn inconsistency(question: &Question, x: &[f64]) -> Option<(usize, f64)> {
    let problem = question.problem();
    inconsistent_row(problem.motion.as_ref()?, &problem.lcp, x)
}

/// The bound for a box, with the limits of coupled rows that follow from x.
fn of_box(gauss: &Gauss, lcp: &Lcp, x: &[f64]) -> Result<MotionError, Unproved> {
    let (lo, hi) = (0..x.len()).map(|i| lcp.bounds(i, x)).unzip();
    let gauss = Gauss { lo, hi, ..gauss.clone() };
    let bound = motion_bound(&gauss, x)?;
    Ok(MotionError { is_frozen: lcp.has_coupled_rows(), ..MotionError::new(&gauss, &bound) })
}

/// The bound under associated cones.
fn of_cones(gauss: &Gauss, friction: &FrictionProblem, x: &[f64]) -> Result<MotionError, Unproved> {
    let cone = |contact: &Contact| {
        let [normal, t1, t2] = contact.rows;
        EllipticCone { normal, friction: vec![(t1, contact.mu), (t2, contact.mu)] }
    };
    let cones: Vec<EllipticCone> = friction.contacts().iter().map(cone).collect();
    answer_bound(gauss, &cones, x).map(|bound| MotionError::new(gauss, &bound))
}

/// |v|_M of the change v = u − u*.
fn length(gauss: &Gauss, u: &[f64]) -> f64 {
    let change: Vec<f64> = u.iter().zip(&gauss.target).map(|(u, target)| u - target).collect();
    // The squares of large changes overflow; a power of two changes no digit.
    let largest = change.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let exponent = if largest > 0.0 { libm::ilogb(largest) } else { 0 };
    let change: Vec<f64> = change.iter().map(|v| libm::ldexp(*v, -exponent)).collect();
    let term = |&(i, j, m): &(usize, usize, f64)| {
        let product = m * change[i] * change[j];
        if i == j { product } else { 2.0 * product }
    };
    libm::ldexp(gauss.mass.iter().map(term).sum::<f64>().max(0.0).sqrt(), exponent)
}
