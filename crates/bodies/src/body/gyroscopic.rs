//! Integration of a body's rotation with the gyroscopic torque −ω × I ω, which the chapter omits.
//!
//! A torque-free body conserves its angular momentum L = I ω in the world, and ω changes as I
//! rotates with the body. In the body's frame, with Π = Rᵀ L, the implicit midpoint rule conserves
//! both L and the energy for any step k:
//!
//! ```text
//! I ω̄ + ½ k ω̄ × I ω̄ = Π,     q⁺ = q ⊗ (1, ½ k ω̄) normalized,     ω⁺ = I(q⁺)⁻¹ L
//! ```
//!
//! (1, ½ k ω̄) is Cayley's rotation, by the angle 2 atan(½ k |ω̄|). It maps Π to
//! Π⁺ = I ω̄ − ½ k ω̄ × I ω̄; so |Π⁺| = |Π|, and Π⁺·I⁻¹Π⁺ = Π·I⁻¹Π because the rule conserves
//! quadratic invariants (Hairer, Lubich & Wanner, IV.2). With k = h the angle would be too small by
//! (h |ω̄|)³/12: a body that turns by a radian in a step would lag by 0.07 rad in each. So k solves
//!
//! ```text
//! k = 2 tan(½ h |ω̄|)/|ω̄|
//! ```
//!
//! and the body turns by h ω̄, which is exact if ω is constant.
//!
//! The other variants add a torque to F and turn the body by h ω⁺. Evaluated at the old velocity,
//! the torque adds energy to a spinning body without bound; at the new velocity the step is
//! unconditionally stable and loses energy (Catto, *Numerical Methods*, GDC 2015):
//!
//! ```text
//! I ω⁺ + h ω⁺ × I ω⁺ = I ω
//! ```
//!
//! Newton's method solves both equations, f' = I + h ([ω⁺]× I − [I ω⁺]×), in the body's axes at the
//! start of the step, where I is constant.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Mass, Pose, State};

/// The largest number of substeps, for bodies that rotate by more than a radian in a step.
const PARTS: usize = 64;

/// Limit on Newton steps. The method converges quadratically from ω; a body that rotates by less
/// than a radian per step needs four.
const NEWTON_STEPS: usize = 20;

/// A correction of this relative size is a rounding error.
const ROUNDING: f64 = 1e-15;

/// Limit on repetitions for k. For up to a radian per step, each leaves a tenth of the error or
/// less.
const REPETITIONS: usize = 20;

/// The largest angle (rad) of a substep to which k is adapted; tan(½ h |ω̄|) has a pole at π.
const LARGEST_ANGLE: f64 = 2.0;

/// The treatment of the gyroscopic torque.
///
/// ```
/// use lcplab_bodies::body::{Gyroscopic, Mass, State};
/// use nalgebra::Vector3;
///
/// // A disk that does not spin about its axis: I ω = (1, 0, 2), −ω × I ω = (0, 1, 0) N m.
/// let disk = Mass::Rigid { mass: 1.0, moments: Vector3::new(1.0, 1.0, 2.0) };
/// let state = State { omega: Vector3::new(1.0, 0.0, 1.0), ..State::WORLD };
/// assert_eq!(Gyroscopic::Explicit.torque(&disk, &state, 0.1), Vector3::y());
/// assert_eq!(Gyroscopic::Omitted.torque(&disk, &state, 0.1), Vector3::zeros());
///
/// // In free flight angular momentum and energy stay.
/// let after = Gyroscopic::Conserving.advanced(&disk, &state, 0.1);
/// let momentum = |state: &State| disk.angular_momentum(state);
/// assert!((momentum(&after) - momentum(&state)).norm() < 1e-14);
/// assert!((disk.kinetic_energy(&after) - disk.kinetic_energy(&state)).abs() < 1e-14);
/// assert!((after.omega - state.omega).norm() > 0.09); // but ω turns, by about 0.1 rad/s
///
/// // On a hinge the body turns by h ω about the hinge's axis.
/// let turned = Gyroscopic::Conserving.turned(&disk, &state, 0.1);
/// assert_eq!(turned.pose, state.advanced(0.1).pose);
/// // A body that arrives with its mean velocity ω̄ has turned half a step further: ω⁺ ≠ ω̄.
/// let arrived = Gyroscopic::Conserving.arrived(&disk, &state, 0.1);
/// assert!((arrived.omega - state.omega).norm() > 0.04);
/// assert_eq!(Gyroscopic::Omitted.arrived(&disk, &state, 0.1), state);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Gyroscopic {
    /// Omitted, as in the chapter: a free body keeps ω, not its angular momentum.
    Omitted,
    /// Evaluated at the velocity before the step; gains energy.
    Explicit,
    /// Evaluated at the velocity after the step; loses energy, never diverges.
    Implicit,
    /// The midpoint rule rotates the body and conserves its angular momentum: a free body also
    /// conserves its energy, and turns by the exact angle if its ω is constant, up to 64 radians
    /// per step.
    #[default]
    Conserving,
}

impl Gyroscopic {
    /// The torque (N m, world) that acts on a body during a step of h (s).
    pub fn torque(self, mass: &Mass, state: &State, h: f64) -> Vector3<f64> {
        let Mass::Rigid { moments, .. } = mass else { return Vector3::zeros() };
        let (q, omega) = (state.pose.q, state.pose.q.inverse() * state.omega);
        let inertia = Matrix3::from_diagonal(moments);
        match self {
            Gyroscopic::Omitted | Gyroscopic::Conserving => Vector3::zeros(),
            Gyroscopic::Explicit => q * -omega.cross(&(inertia * omega)),
            Gyroscopic::Implicit => {
                q * (inertia * (implicit_spin(&inertia, &omega, h) - omega) / h)
            }
        }
    }

    /// The state after h (s) without forces, at constant velocity; if angular momentum is
    /// conserved, ω follows from it in the new pose. A body that rotates by more than a radian
    /// takes up to 64 substeps.
    pub fn advanced(self, mass: &Mass, state: &State, h: f64) -> State {
        let Some(inertia) = tumbling(self, mass) else { return state.advanced(h) };
        let momentum = mass.spin_momentum(state);
        let start = Pose { p: state.pose.p + h * state.v, ..state.pose };
        let (mut moved, mut done) = (State { pose: start, ..*state }, 0);
        while done < PARTS {
            let parts = ((PARTS - done) as f64 * (h / PARTS as f64) * moved.omega.norm()).abs();
            let next = ((PARTS - done) as f64 / parts.ceil().max(1.0)).ceil() as usize;
            let h = h * (next as f64 / PARTS as f64);
            let omega = moved.pose.q.inverse() * moved.omega;
            let q = moved.pose.q.into_inner() * midpoint_turn(&inertia, &omega, h);
            let q = UnitQuaternion::new_normalize(q);
            let pose = Pose { q, ..moved.pose };
            moved = State { pose, omega: spin(&inertia, &pose, &momentum), ..moved };
            done += next;
        }
        moved
    }

    /// [`advanced`](Self::advanced) for a body whose joint prevents rotation about some axes: it
    /// turns by h ω, and so about the axis that the joint leaves free. If its moments of inertia
    /// differ, the midpoint rule would rotate it about another axis and pull the joint apart step
    /// by step. If angular momentum is conserved, it is conserved here too; the joint's reaction
    /// changes it.
    pub fn turned(self, mass: &Mass, state: &State, h: f64) -> State {
        let moved = state.advanced(h);
        match tumbling(self, mass) {
            None => moved,
            Some(inertia) => {
                State { omega: spin(&inertia, &moved.pose, &mass.spin_momentum(state)), ..moved }
            }
        }
    }

    /// The state at the end of a step of h (s) in which the body rotated with its present velocity:
    /// if angular momentum is conserved, that velocity was ω̄, and ω⁺ = I⁻¹(I ω̄ − ½ k ω̄ × I ω̄).
    pub fn arrived(self, mass: &Mass, state: &State, h: f64) -> State {
        match tumbling(self, mass) {
            None => *state,
            Some(inertia) => {
                let mean = state.pose.q.inverse() * state.omega;
                let k = adapted(h, mean.norm());
                let momentum = inertia * mean - 0.5 * k * mean.cross(&(inertia * mean));
                State { omega: spin(&inertia, &state.pose, &(state.pose.q * momentum)), ..*state }
            }
        }
    }
}

/// I in the body's axes, if ω changes while L is constant: not for a ball or a cube.
fn tumbling(gyroscopic: Gyroscopic, mass: &Mass) -> Option<Matrix3<f64>> {
    match mass {
        Mass::Rigid { moments, .. } if gyroscopic == Gyroscopic::Conserving => {
            (moments.min() < moments.max()).then(|| Matrix3::from_diagonal(moments))
        }
        _ => None,
    }
}

/// The rotation of a free body in a step of h by the midpoint rule with the adapted step k, in the
/// body's axes at the start; not normalized.
fn midpoint_turn(inertia: &Matrix3<f64>, omega: &Vector3<f64>, h: f64) -> Quaternion<f64> {
    let mut k = adapted(h, omega.norm());
    let mut mean = implicit_spin(inertia, omega, 0.5 * k);
    for _ in 0..REPETITIONS {
        let next = adapted(h, mean.norm());
        if (next - k).abs() <= ROUNDING * k.abs() {
            break;
        }
        k = next;
        mean = implicit_spin(inertia, omega, 0.5 * k);
    }
    Quaternion::from_parts(1.0, 0.5 * k * mean)
}

/// k = 2 tan(½ h |ω̄|)/|ω̄| (s), for which Cayley's rotation turns by h |ω̄|; h beyond the largest
/// angle.
fn adapted(h: f64, speed: f64) -> f64 {
    let angle = (h * speed).abs();
    if angle > 0.0 && angle <= LARGEST_ANGLE {
        h * libm::tan(0.5 * angle) / (0.5 * angle)
    } else {
        h
    }
}

/// I⁻¹ L (rad/s, world), computed in the body's axes.
fn spin(inertia: &Matrix3<f64>, pose: &Pose, momentum: &Vector3<f64>) -> Vector3<f64> {
    pose.q * (pose.q.inverse() * momentum).component_div(&inertia.diagonal())
}

/// ω⁺ with I ω⁺ + h ω⁺ × I ω⁺ = I ω, in the body's frame.
fn implicit_spin(inertia: &Matrix3<f64>, omega: &Vector3<f64>, h: f64) -> Vector3<f64> {
    let mut next = *omega;
    for _ in 0..NEWTON_STEPS {
        let spin = inertia * next;
        let f = inertia * (next - omega) + h * next.cross(&spin);
        let slope = inertia + h * (next.cross_matrix() * inertia - spin.cross_matrix());
        let Some(correction) = slope.lu().solve(&f) else { break };
        next -= correction;
        if correction.norm() <= ROUNDING * next.norm() {
            break;
        }
    }
    next
}
