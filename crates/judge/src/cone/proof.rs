//! Searches for an exact solution of a cone problem near x.
//!
//! The state of each contact is read off from x. If no contact slides, the equations are linear,
//! and their solution is a rational point ([`definition`]). The friction of a sliding contact is in
//! general irrational: a box is proved to contain it ([`Enclosure`]). If an inequality fails at the
//! zero of the equations, the states that it contradicts are changed.

use super::redundant::Dependence;
use super::state::{RowState, candidates, repaired, without_small_slip};
use super::system::{Numbers, System};
use super::{Enclosure, definition, inside, newton, redundant};
use crate::exact::is_within;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic};
use lcplab_lcp::exact::{Exact, Point, Side};
use lcplab_lcp::friction::ConeProblem;
use lcplab_lcp::{Gauss, Lcp};

/// For this number of zeros that are no solutions the repaired states are tried.
const MOST_REPAIRS: usize = 8;

/// The bias of redundant rows may be inconsistent by this part of the largest |b|.
const MOST_BIAS_CHANGE: f64 = 1e-10;

/// An exact solution of a cone problem.
#[derive(Debug, Clone)]
pub enum ConeProof {
    /// A rational solution.
    Point(Point),
    /// A box that contains one.
    Enclosure(Enclosure),
}

impl ConeProof {
    /// The largest possible distance max |x_i − x*_i| of the solution x*, rounded up.
    pub fn distance(&self, x: &[f64]) -> f64 {
        match self {
            ConeProof::Point(point) => point.distance(x),
            ConeProof::Enclosure(enclosure) => enclosure.distance(x),
        }
    }

    /// Checks the proof against the problem.
    ///
    /// # Errors
    /// Why it proves nothing.
    pub fn check(&self, problem: &ConeProblem) -> Result<(), String> {
        match self {
            ConeProof::Enclosure(enclosure) => enclosure.check(problem),
            ConeProof::Point(point) => {
                let exact = Exact::new(problem.friction().lcp());
                let holds = definition::is_solved_by(problem, &exact, point);
                holds.then_some(()).ok_or_else(|| "the point is not a solution".into())
            }
        }
    }

    fn is_within(&self, x: &[f64], bounds: &[f64]) -> bool {
        match self {
            ConeProof::Point(point) => is_within(x, &point.entries(), bounds),
            ConeProof::Enclosure(enclosure) => enclosure.is_within(x, bounds),
        }
    }
}

/// An exact solution with the states of a finite x. `bounds`, if given, limits the distance of each
/// entry.
///
/// `None` does not show that x is wrong: redundant contacts make the equations of a state singular,
/// and a contact on the boundary between two states satisfies no strict inequality.
///
/// ```
/// use lcplab_judge::{ConeProof, cone_proof};
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A unit mass pressed with 2 N s and pushed with 3 N s along both tangents, μ = ½: it slides.
/// let a = Matrix::dense(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
/// let (lo, hi) = (vec![0.0, -f64::INFINITY, -f64::INFINITY], vec![f64::INFINITY; 3]);
/// let lcp = Lcp::new(a, vec![-2.0, -3.0, -3.0], lo, hi)?;
/// let friction = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let problem = ConeProblem::new(friction, Law::Coulomb);
/// let x = [2.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()];
/// let proof = cone_proof(&problem, &x, None).expect("a solution near x");
/// assert!(matches!(proof, ConeProof::Enclosure(_)));
/// assert!(proof.distance(&x) < 1e-16);
/// assert_eq!(proof.check(&problem), Ok(()));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn cone_proof(problem: &ConeProblem, x: &[f64], bounds: Option<&[f64]>) -> Option<ConeProof> {
    let boxed = problem.friction().coupled_box();
    let (exact, numbers) = (Exact::new(&boxed), Numbers::of(problem));
    let search = Search { problem, x, bounds, boxed, exact, numbers };
    let own = Point::new(x.iter().map(|&x| dyadic(x)).collect(), dyadic(1.0));
    if definition::is_solved_by(problem, &search.exact, &own) {
        return Some(ConeProof::Point(own));
    }
    let mut sets = candidates(problem, x);
    let (mut next, mut repairs, mut is_first) = (0, MOST_REPAIRS, true);
    while let Some(states) = sets.get(next).cloned() {
        next += 1;
        let Ok(system) = System::new(problem, &search.numbers, states) else { continue };
        // An exact linear solve is slow: the first one may fail, later ones only if Newton's method
        // finds a zero near x.
        let is_linear = !is_curved(&system);
        if is_linear && !is_first && newton::center(&system, x, bounds).is_none() {
            continue;
        }
        is_first &= !is_linear;
        let zero = match search.zero(&system, is_linear) {
            Some(Outcome::Proved(proof)) => return Some(proof),
            Some(Outcome::Zero(zero)) => zero,
            None => continue,
        };
        let one = dyadic(1.0);
        let states = repaired(&system, &system.at(&zero, &one));
        if repairs > 0 && !sets.contains(&states) {
            repairs -= 1;
            sets.insert(next, states);
        }
    }
    None
}

/// Whether a contact slides with friction, so that the equations are not linear.
fn is_curved(system: &System<'_>) -> bool {
    let slides = |i: usize| system.states()[i] == RowState::Slides && system.given(i).is_none();
    system.contacts().iter().any(|contact| slides(contact.rows[1]))
}

/// A box around a solution for the exact numbers of the bodies, near a finite x: A = J M⁻¹Jᵀ +
/// diag(γ) and b = J u* + bias. Its entries after those of x are the motion u. Unlike the rounded A
/// of a problem, these numbers keep redundant contacts consistent; where the rounding of the bias
/// does not, the box is about a bias that differs in the last digits.
///
/// `None` does not show that x is wrong, as in [`cone_proof`].
///
/// ```
/// use lcplab_judge::cone_body_proof;
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Gauss, Lcp, Matrix};
///
/// // A block of 2 kg that falls at 1 m/s on two equal contacts: A is singular, and 2 N s in any
/// // shares stop it.
/// let (free, a) = (f64::INFINITY, |i: usize, j: usize| if i % 3 == j % 3 { 0.5 } else { 0.0 });
/// let a: Vec<f64> = (0..36).map(|k| a(k / 6, k % 6)).collect();
/// let b = vec![-1.0, 0.0, 0.0, -1.0, 0.0, 0.0];
/// let lo = vec![0.0, -free, -free, 0.0, -free, -free];
/// let lcp = Lcp::new(Matrix::dense(6, &a), b, lo.clone(), vec![free; 6])?;
/// let contacts = [0, 3].map(|n| Contact { rows: [n, n + 1, n + 2], mu: 0.5 });
/// let friction = FrictionProblem::new(lcp, contacts.to_vec())?;
/// let problem = ConeProblem::new(friction, Law::Coulomb);
/// let bodies = Gauss {
///     mass: (0..3).map(|i| (i, i, 2.0)).collect(),
///     jacobian: (0..6).map(|i| vec![(i % 3, 1.0)]).collect(),
///     bias: vec![0.0; 6],
///     compliance: vec![0.0; 6],
///     target: vec![-1.0, 0.0, 0.0],
///     lo,
///     hi: vec![free; 6],
///     level: None,
/// };
/// let x = [0.5, 0.0, 0.0, 1.5, 0.0, 0.0];
/// let enclosure = cone_body_proof(&problem, &bodies, &x).expect("a solution near x");
/// assert!(enclosure.distance(&x) < 1e-50);
/// assert_eq!(enclosure.redundant.len(), 3);
/// assert_eq!(enclosure.check_bodies(&problem, &bodies), Ok(()));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn cone_body_proof(problem: &ConeProblem, bodies: &Gauss, x: &[f64]) -> Option<Enclosure> {
    let numbers = Numbers::of_bodies(problem, bodies);
    let fastest = problem.friction().lcp().b().iter().fold(0.0, |most, b| f64::max(most, b.abs()));
    let most = MOST_BIAS_CHANGE * fastest;
    let n = x.len();
    let start: Vec<f64> = x.iter().chain(&bodies.target).copied().collect();
    let mut sets = candidates(problem, x);
    let without_slip = without_small_slip(problem, x);
    if !sets.contains(&without_slip) {
        sets.push(without_slip);
    }
    let (mut next, mut repairs) = (0, MOST_REPAIRS);
    while let Some(states) = sets.get(next).cloned() {
        next += 1;
        let with_motion =
            states.iter().copied().chain(bodies.target.iter().map(|_| RowState::Free));
        let Ok(system) = System::new(problem, &numbers, with_motion.collect()) else { continue };
        let (system, redundant) = reduced(system, most);
        let found = enclosed(&system, &redundant, &start, None);
        let Some((enclosure, zero)) = found else { continue };
        if enclosure.is_some() {
            return enclosure;
        }
        for inside in inside::moved(&system, &redundant, &start) {
            let found = enclosed(&system, &redundant, &inside, None);
            if let Some((Some(enclosure), _)) = found {
                return Some(enclosure);
            }
        }
        let states = repaired(&system, &system.at(&zero, &dyadic(1.0)))[..n].to_vec();
        if repairs > 0 && !sets.contains(&states) {
            repairs -= 1;
            sets.insert(next, states);
        }
    }
    None
}

/// The system without its redundant rows, and their dependences, whose b may contradict each other
/// by `most`.
fn reduced(system: System<'_>, most: f64) -> (System<'_>, Vec<Dependence>) {
    let redundant = redundant::find(&system, most);
    let rows: Vec<usize> = redundant.iter().map(|dependence| dependence.row).collect();
    (system.without(&rows), redundant)
}

/// The zero of a reduced system near x, and a box around it if the inequalities of its states hold
/// there.
fn enclosed(
    system: &System<'_>,
    redundant: &[Dependence],
    x: &[f64],
    bounds: Option<&[f64]>,
) -> Option<(Option<Enclosure>, Vec<Dyadic>)> {
    let center = newton::center(system, x, bounds)?;
    let (zero, one) = (center.x.clone(), dyadic(1.0));
    let nothing = vec![Dyadic::ZERO; zero.len()];
    if system.check_inequalities(&system.at(&zero, &one), &nothing).is_err() {
        return Some((None, zero));
    }
    let enclosure = center.enclosure(system, redundant.to_vec())?;
    let holds = system.check_inequalities(&system.at(&zero, &one), &enclosure.radius).is_ok();
    Some((holds.then_some(enclosure), zero))
}

/// The result for one choice of states.
enum Outcome {
    Proved(ConeProof),
    /// A zero of the equations that is not a solution, or too far away.
    Zero(Vec<Dyadic>),
}

struct Search<'a> {
    problem: &'a ConeProblem,
    x: &'a [f64],
    bounds: Option<&'a [f64]>,
    /// The rows with boxes instead of cones: open and sticking contacts have the same equations.
    boxed: Lcp,
    exact: Exact,
    numbers: Numbers,
}

impl Search<'_> {
    fn zero(&self, system: &System<'_>, is_linear: bool) -> Option<Outcome> {
        let (proof, zero) = if !is_linear {
            // A verdict, which states bounds, proves no redundant contacts: the second judge in
            // Python, which confirms every verdict, cannot solve their singular equations.
            let (system, redundant) = match self.bounds {
                Some(_) => (system.clone(), Vec::new()),
                None => reduced(system.clone(), 0.0),
            };
            let (enclosure, zero) = enclosed(&system, &redundant, self.x, self.bounds)?;
            (enclosure.map(ConeProof::Enclosure), zero)
        } else {
            let point = self.linear(system)?;
            let zero: Vec<f64> = point.entries().iter().map(|x| x.to_f64().value()).collect();
            if !zero.iter().all(|x| x.is_finite()) {
                return None;
            }
            let holds = definition::is_solved_by(self.problem, &self.exact, &point);
            (holds.then_some(ConeProof::Point(point)), zero.into_iter().map(dyadic).collect())
        };
        let is_near =
            |proof: &ConeProof| self.bounds.is_none_or(|bounds| proof.is_within(self.x, bounds));
        Some(proof.filter(is_near).map_or(Outcome::Zero(zero), Outcome::Proved))
    }

    /// The exact solution of linear equations; unknowns that they leave open keep their value in x.
    fn linear(&self, system: &System<'_>) -> Option<Point> {
        let mut sides: Vec<Side> = (0..self.x.len())
            .map(|i| match system.states()[i] {
                RowState::Upper => Side::Upper,
                RowState::Free | RowState::Sticks => Side::Free,
                RowState::Lower | RowState::Open | RowState::Slides => Side::Lower,
            })
            .collect();
        system.unknowns().iter().for_each(|&i| sides[i] = Side::Free);
        let inside = |i: usize| self.boxed.project(i, self.x[i], self.x);
        let inside: Vec<f64> = (0..self.x.len()).map(inside).collect();
        Some(self.exact.point(&sides, &inside)?.0)
    }
}
