//! The states of contacts and rows, read off from x.

use lcplab_lcp::friction::{ConeProblem, Contact, Law};

use super::system::{AtPoint, System};
use crate::exact::sides;
use crate::neighbor;
use crate::residual::{Rows, Wide, cone};
use lcplab_lcp::exact::Side;
use lcplab_lcp::exact::dyadic::Dyadic;

/// The state of a row; the three rows of a contact have the same one.
///
/// ```text
/// Lower    x = lo               w ≥ 0             Open     x_n = x_t = 0
/// Free     w = 0                lo ≤ x ≤ hi       Sticks   w_n = w_t = 0
/// Upper    x = hi               w ≤ 0             Slides   |x_t| = μ x_n, x_t opposite to w_t; w_n = 0, or w_n = μ |w_t|
/// ```
///
/// Without friction (μ = 0) a closed contact slides: w_n = 0 and x_t = 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowState {
    /// A row without friction at its lower bound.
    Lower,
    /// A row without friction between its bounds.
    Free,
    /// A row without friction at its upper bound.
    Upper,
    /// A row of a contact without force.
    Open,
    /// A row of a contact that does not move.
    Sticks,
    /// A row of a contact that slides.
    Slides,
}

impl RowState {
    /// All states with their names in proof files.
    pub const NAMES: [(RowState, &'static str); 6] = [
        (RowState::Lower, "lo"),
        (RowState::Free, "free"),
        (RowState::Upper, "hi"),
        (RowState::Open, "open"),
        (RowState::Sticks, "sticks"),
        (RowState::Slides, "slides"),
    ];
}

impl From<Side> for RowState {
    fn from(side: Side) -> Self {
        match side {
            Side::Lower => RowState::Lower,
            Side::Free => RowState::Free,
            Side::Upper => RowState::Upper,
        }
    }
}

/// x counts as being on a boundary within these fractions of its size: rounding, a good solver, and
/// the tolerance of a solver.
const ON_BOUNDARY: [f64; 3] = [64.0 * f64::EPSILON, 1e-9, 1e-6];

/// A slip below this fraction of its terms may be 0.
const SMALL_SLIP: f64 = 1e-9;

/// The states that x may have: those of a projected step, and those of x itself.
pub(super) fn candidates(problem: &ConeProblem, x: &[f64]) -> Vec<Vec<RowState>> {
    let at = Rows::at(problem.friction().lcp(), x);
    let stepped = sides(&at);
    let contacts = problem.friction().contacts();
    let sizes = neighbor::sizes(at.lcp, contacts, x);
    let with = |mut states: Vec<RowState>, of: &dyn Fn(&Contact) -> RowState| {
        for contact in contacts {
            let state = of(contact);
            contact.rows.iter().for_each(|&i| states[i] = state);
        }
        states
    };
    let from_sides = |sides: &[Side]| sides.iter().map(|&side| side.into()).collect();
    let first = with(from_sides(&stepped), &|contact| after_step(&at, problem.law(), contact));
    let mut all = vec![first];
    for part in ON_BOUNDARY {
        let side = |i: usize| match (at.lcp.lo()[i], at.lcp.hi()[i]) {
            (lo, _) if x[i] - lo <= part * sizes[i] => RowState::Lower,
            (_, hi) if hi - x[i] <= part * sizes[i] => RowState::Upper,
            _ => RowState::Free,
        };
        // Within this fraction of the largest entry x may be off by as much as it says: then the
        // step decides.
        let of = |contact: &Contact| {
            let [n, t1, t2] = contact.of(x);
            let (limit, length) = (contact.mu * n, lcplab_lcp::hypot(t1, t2));
            let (error, after) =
                (part * sizes[contact.rows[0]], after_step(&at, problem.law(), contact));
            let is_open = n <= 0.0 || n <= error && after == RowState::Open;
            let is_inside = length < (1.0 - part) * limit;
            let sticks = is_inside && (length < limit - error || after == RowState::Sticks);
            state_of(contact, is_open, sticks)
        };
        let own = with((0..x.len()).map(side).collect(), &of);
        // Bounds from x, or from the step: near 0 a w tells more than x does.
        for states in [own.clone(), with(from_sides(&stepped), &of)] {
            if !all.contains(&states) {
                all.push(states);
            }
        }
    }
    all
}

/// The states after a projected step, but contacts stick whose slip is below what rounding and a
/// solver's tolerance leave of it.
pub(super) fn without_small_slip(problem: &ConeProblem, x: &[f64]) -> Vec<RowState> {
    let at = Rows::at(problem.friction().lcp(), x);
    let mut states: Vec<RowState> = sides(&at).into_iter().map(RowState::from).collect();
    for contact in problem.friction().contacts() {
        let tangents = [contact.rows[1], contact.rows[2]];
        let is_small =
            |i: usize| at.rows[i].w.value().abs() <= SMALL_SLIP * at.rows[i].terms.value();
        let state = match after_step(&at, problem.law(), contact) {
            RowState::Slides if tangents.into_iter().all(is_small) => {
                state_of(contact, false, true)
            }
            state => state,
        };
        contact.rows.iter().for_each(|&i| states[i] = state);
    }
    states
}

fn state_of(contact: &Contact, is_open: bool, sticks: bool) -> RowState {
    match (is_open, sticks && contact.mu > 0.0) {
        (true, _) => RowState::Open,
        (false, true) => RowState::Sticks,
        (false, false) => RowState::Slides,
    }
}

/// The state of a contact after a projected step.
fn after_step(at: &Rows<'_>, law: Law, contact: &Contact) -> RowState {
    let rows = contact.rows.map(|i| at.rows[i]);
    let of_tangents = cone::tangential_scale(at.lcp, contact).unwrap_or(1.0.into());
    let scales = match law {
        Law::Coulomb => [rows[0].scale, of_tangents, of_tangents],
        Law::Associated => [rows[0].scale.max(of_tangents); 3],
    };
    let target = |k: usize| Wide::from(at.x[contact.rows[k]]) - rows[k].w / scales[k];
    let (mu, n, t) = (Wide::from(contact.mu), target(0), target(1).hypot(target(2)));
    let limit = match law {
        Law::Coulomb => mu * at.x[contact.rows[0]].into(),
        Law::Associated => mu * n,
    };
    let is_open = match law {
        Law::Coulomb => n <= Wide::ZERO,
        // The sum is the difference of two large numbers if the slip is large.
        Law::Associated => {
            let rounding = Wide::from(ON_BOUNDARY[0]) * mu * t;
            at.x[contact.rows[0]] <= 0.0 && n + mu * t <= rounding || n + mu * t < -rounding
        }
    };
    state_of(contact, is_open, t < limit)
}

/// The states with those changed whose inequalities fail at a point: a contact that pulls opens, an
/// open one that would penetrate closes, friction beyond the cone slides, friction along the slip
/// sticks.
pub(super) fn repaired(system: &System<'_>, at: &AtPoint<'_>) -> Vec<RowState> {
    let zero = Dyadic::ZERO;
    let mut states = system.states().to_vec();
    for (i, state) in states.iter_mut().enumerate() {
        *state = match *state {
            RowState::Lower if at.w[i] < zero && !system.is_fixed(i) => RowState::Free,
            RowState::Upper if at.w[i] > zero && !system.is_fixed(i) => RowState::Free,
            RowState::Free if system.lo(i).is_some_and(|lo| at.x[i] < lo * at.d) => RowState::Lower,
            RowState::Free if system.hi(i).is_some_and(|hi| at.x[i] > hi * at.d) => RowState::Upper,
            state => state,
        };
    }
    for contact in system.contacts() {
        let [n, t1, t2] = contact.rows;
        let state = match states[n] {
            RowState::Open if system.is_pressed(contact, at) => state_of(contact, false, true),
            RowState::Sticks | RowState::Slides if at.x[n] < zero => RowState::Open,
            RowState::Sticks if system.is_outside(contact, at) => RowState::Slides,
            RowState::Slides if &at.x[t1] * &at.w[t1] + &at.x[t2] * &at.w[t2] > zero => {
                state_of(contact, false, true)
            }
            state => state,
        };
        contact.rows.iter().for_each(|&i| states[i] = state);
    }
    states
}
