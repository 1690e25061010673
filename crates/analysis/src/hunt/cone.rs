//! One contact with a friction cone and a closed-form solution, with very different scales.
//!
//! With A = diag(a_n, a_t, a_t) normal and tangents are coupled only by the friction law:
//!
//! ```text
//! x_n = max(−b_n / a_n, 0),   x_t = −b_t / a_t, shortened to length μ x_n
//! ```
//!
//! is Coulomb's law: the contact sticks if the disk contains the impulse that stops it, otherwise
//! it slides along b_t. The scales a_n, a_t and the loads range over 10⁻⁸ … 10⁸ each, so solvers
//! must resolve a light load next to a heavy one, and a slip next to a large force.

use super::numbers::Random;
use super::{Record, Tally};
use crate::trial::Trial;
use lcplab_judge::{Demand, judge_cone};
use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law, ProblemForm};
use lcplab_lcp::number::readable;
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{ConeEntry, Method, Options, Registry, Settings, Status};

/// The allowed distance of an answer from the exact one, relative to its largest entry.
const NEAR: f64 = 1e-6;

/// A contact and its solution under Coulomb's law.
#[derive(Debug, Clone)]
pub struct ConeTruth {
    /// The problem.
    pub problem: ConeProblem,
    /// The unique solution x, rounded.
    pub x: [f64; 3],
    /// Whether it slides: |b_t| / a_t > μ x_n > 0.
    pub slides: bool,
}

/// Contact number k of a seed.
///
/// ```
/// use lcplab_judge::{Demand, judge_cone};
/// use lcplab_analysis::hunt::cone::contact;
///
/// let truth = contact(1, 5);
/// assert!(judge_cone(&truth.problem, &truth.x, &Demand::default()).verdict.is_solution());
/// ```
pub fn contact(seed: u64, k: usize) -> ConeTruth {
    let random = &mut Random::new(seed, k);
    let scale = |random: &mut Random| 10f64.powi(random.whole(-8, 8) as i32);
    let (a_n, a_t, load, push) = (scale(random), scale(random), scale(random), scale(random));
    let mu = random.one_of(&[0.0, 0.125, 0.5, 1.0, 3.0]);
    let b = [load * random.number(3), push * random.number(3), push * random.number(3)];
    let normal = f64::max(-b[0] / a_n, 0.0);
    let (wanted, limit) = ([-b[1] / a_t, -b[2] / a_t], mu * normal);
    let length = wanted[0].hypot(wanted[1]);
    let tangents = match length > limit {
        true => wanted.map(|x| limit * (x / length)),
        false => wanted,
    };
    let matrix = Matrix::dense(3, &[a_n, 0.0, 0.0, 0.0, a_t, 0.0, 0.0, 0.0, a_t]);
    let lo = vec![0.0, f64::NEG_INFINITY, f64::NEG_INFINITY];
    let lcp = Lcp::new(matrix, b.to_vec(), lo, vec![f64::INFINITY; 3]).expect("finite numbers");
    let contact = Contact { rows: [0, 1, 2], mu };
    let friction = FrictionProblem::new(lcp, vec![contact]).expect("a contact");
    ConeTruth {
        problem: ConeProblem::new(friction, Law::Coulomb),
        x: [normal, tangents[0], tangents[1]],
        slides: length > limit && limit > 0.0,
    }
}

/// The claims of the cone solvers on contact k of a seed, and whether they are true.
pub(super) fn record(seed: u64, k: usize, settings: &Settings) -> Record {
    let truth = contact(seed, k);
    let entries = Registry::standard().cone_entries();
    let tallies = entries.map(|entry| tally(entry, &truth, k, settings)).collect();
    Record { problems: 1, tallies, ..Record::default() }
}

/// A claim is false if the judge rejects it, or if it differs from the closed form; a verdict is
/// false if the judge rejects the closed form.
fn tally(entry: &ConeEntry, truth: &ConeTruth, number: usize, settings: &Settings) -> Tally {
    let options = Options::default().with_settings(settings.clone());
    let posed = ProblemForm::Cone(truth.problem.clone());
    let solution = Trial::run(&Method::Cone(entry.clone()), &posed, &options, &mut ()).solution;
    let accepts =
        |x: &[f64]| judge_cone(&truth.problem, x, &Demand::default()).verdict.is_solution();
    let size = truth.x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let distance = solution.x.iter().zip(truth.x).map(|(x, exact)| (x - exact).abs());
    let distance = distance.fold(0.0, f64::max);
    let is_claim = solution.status == Status::Solved;
    let wrong = match () {
        _ if !accepts(&truth.x) => Some("the judge rejects the closed form".to_string()),
        _ if is_claim && !accepts(&solution.x) => Some("solved, but rejected by the judge".into()),
        _ if is_claim && !(distance <= NEAR * size) => {
            let [distance, size] = [distance, size].map(|length| readable(length, 2));
            Some(format!(
                "solved, but at the distance {distance} from the closed form, which has the length \
             {size}"
            ))
        }
        _ => None,
    };
    Tally {
        solver: entry.name.to_string(),
        within: usize::from(is_claim && wrong.is_none()),
        unsolved: usize::from(!is_claim && wrong.is_none()),
        false_claim_count: usize::from(wrong.is_some()),
        false_claims: wrong.into_iter().map(|what| (number, "cone", what)).collect(),
        ..Tally::default()
    }
}
