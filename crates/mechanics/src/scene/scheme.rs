//! The time-stepping schemes, and the settings of each.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::settings::{not_negative, positive};
use lcplab_lcp::error::Defects;

/// The time-stepping scheme.
///
/// ```
/// use lcplab_mechanics::scene::{Integrator, Scheme};
///
/// let velocity = Scheme::by_name("velocity").unwrap();
/// assert_eq!((velocity, velocity.name()), (Scheme::Velocity, "velocity"));
/// assert!(velocity.solves_lcps() && velocity.poses_friction());
/// assert!(velocity.takes_impacts_early() && !velocity.spreads_impacts());
/// assert!(Scheme::Xpbd.spreads_impacts() && !Scheme::Xpbd.solves_lcps());
/// assert_eq!(Integrator::Rk4.name(), "rk4");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// An LCP: the unknowns are impulses (N s), w is the velocity of a row after the step.
    #[default]
    Velocity,
    /// An LCP: the unknowns are forces (N), w is the acceleration of a row; impacts are handled by
    /// impulses before each step.
    Acceleration,
    /// The velocity level without feedback of errors, then a second LCP that corrects positions
    /// without changing velocities.
    SplitImpulse,
    /// The velocity level without feedback, then positions corrected row by row (NGS).
    GaussSeidel,
    /// Positions corrected row by row in small steps, velocities from positions.
    Xpbd,
    /// Every row is a spring of a given frequency: one sweep per substep, and relaxation sweeps.
    Soft,
    /// Springs and dampers instead of constraints, integrated explicitly in substeps.
    Penalty,
    /// The velocity level by impulses on the bodies, row by row, without a matrix.
    SequentialImpulses,
}

impl Scheme {
    /// The two levels whose step is one LCP; solvers are compared on these.
    pub const LEVELS: [Scheme; 2] = [Scheme::Velocity, Scheme::Acceleration];

    /// All schemes, in the order of tables.
    pub const ALL: [Scheme; 8] = [
        Scheme::Velocity,
        Scheme::Acceleration,
        Scheme::SplitImpulse,
        Scheme::GaussSeidel,
        Scheme::Xpbd,
        Scheme::Soft,
        Scheme::Penalty,
        Scheme::SequentialImpulses,
    ];

    /// The name in scene files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Scheme::Velocity => "velocity",
            Scheme::Acceleration => "acceleration",
            Scheme::SplitImpulse => "split-impulse",
            Scheme::GaussSeidel => "gauss-seidel",
            Scheme::Xpbd => "xpbd",
            Scheme::Soft => "soft",
            Scheme::Penalty => "penalty",
            Scheme::SequentialImpulses => "sequential-impulses",
        }
    }

    /// The scheme with this name.
    pub fn by_name(name: &str) -> Option<Scheme> {
        Scheme::ALL.into_iter().find(|scheme| scheme.name() == name)
    }

    /// Whether it solves LCPs, so that the choice of a solver matters.
    pub fn solves_lcps(self) -> bool {
        use Scheme::{Acceleration, GaussSeidel, SplitImpulse, Velocity};
        matches!(self, Velocity | Acceleration | SplitImpulse | GaussSeidel)
    }

    /// Whether it takes an impact at the beginning of a step, across a gap that closes within it.
    pub fn takes_impacts_early(self) -> bool {
        use Scheme::{GaussSeidel, SequentialImpulses, SplitImpulse, Velocity};
        matches!(self, Velocity | SplitImpulse | GaussSeidel | SequentialImpulses)
    }

    /// Whether it may spread an impact over several steps, or takes it without impulses at fixed
    /// poses.
    pub fn spreads_impacts(self) -> bool {
        matches!(self, Scheme::Xpbd | Scheme::Soft | Scheme::Penalty)
    }
}

/// How accelerations become motion; acceleration level only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// s⁺ = s + dt S u, u⁺ = u + dt u': first order, gains energy.
    ExplicitEuler,
    /// u⁺ = u + dt u', s⁺ = s + dt S u⁺: first order, bounded energy error.
    #[default]
    SemiImplicitEuler,
    /// The classical Runge-Kutta method: fourth order.
    Rk4,
    /// y⁺ = y + dt f((y + y⁺)/2): second order, time-reversible.
    ImplicitMidpoint,
}

impl Integrator {
    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Integrator::ExplicitEuler => "explicit-euler",
            Integrator::SemiImplicitEuler => "semi-implicit-euler",
            Integrator::Rk4 => "rk4",
            Integrator::ImplicitMidpoint => "implicit-midpoint",
        }
    }
}

/// How the position error c enters the velocity of a row (Baumgarte; K&M (25)).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Feedback {
    /// J u = −(β/dt) c: c is multiplied by 1 − β per step.
    #[default]
    Corrected,
    /// J u = −β c, with β as a rate (1/s): c is multiplied by only 1 − β dt (erratum E34).
    Unscaled,
    /// J u = +β c, the chapter's Code 7 with its (34): c is multiplied by 1 + β dt (errata E34,
    /// E35).
    Printed,
}

/// Settings of the soft step: each row is a spring of this frequency for its effective mass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Soft {
    /// The frequency of joints (Hz).
    pub joint_hertz: f64,
    /// The damping ratio ζ of joints; 1 is critical.
    pub joint_damping: f64,
    /// The frequency of contacts and limits (Hz).
    pub contact_hertz: f64,
    /// The damping ratio ζ of contacts and limits.
    pub contact_damping: f64,
    /// Maximum frequency as a fraction of the substep rate; above it a single sweep cannot keep up.
    pub rate_limit: f64,
    /// The maximum speed (m/s) at which overlapping bodies are pushed apart.
    pub push_speed: f64,
    /// Sweeps without feedback after each substep; 0 for none.
    pub relax: usize,
}

impl Default for Soft {
    fn default() -> Self {
        Soft {
            joint_hertz: 60.0,
            joint_damping: 2.0,
            contact_hertz: 30.0,
            contact_damping: 10.0,
            rate_limit: 0.125,
            push_speed: 4.0,
            relax: 1,
        }
    }
}

/// Settings of XPBD: positions corrected row by row in substeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Xpbd {
    /// The compliance of every row without its own spring (m/N, for angles rad/(N m)); 0 is rigid.
    pub compliance: f64,
    /// Sweeps over the rows per substep.
    pub sweeps: usize,
}

impl Default for Xpbd {
    fn default() -> Self {
        Xpbd { compliance: 0.0, sweeps: 20 }
    }
}

/// Settings of the penalty method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Penalty {
    /// The stiffness k (N/m, for angles N m/rad) of every row without its own spring.
    pub stiffness: f64,
    /// The damping d (N s/m, for angles N m s/rad) of the same rows; also used for friction and
    /// motors, up to their bounds.
    pub damping: f64,
}

impl Default for Penalty {
    fn default() -> Self {
        Penalty { stiffness: 1e4, damping: 10.0 }
    }
}

impl Soft {
    pub(super) fn check(&self, defects: &mut Defects) {
        positive(defects, "step.soft.joint_hertz", self.joint_hertz);
        positive(defects, "step.soft.contact_hertz", self.contact_hertz);
        positive(defects, "step.soft.rate_limit", self.rate_limit);
        not_negative(defects, "step.soft.joint_damping", self.joint_damping);
        not_negative(defects, "step.soft.contact_damping", self.contact_damping);
        not_negative(defects, "step.soft.push_speed", self.push_speed);
    }
}

impl Xpbd {
    pub(super) fn check(&self, defects: &mut Defects) {
        not_negative(defects, "step.xpbd.compliance", self.compliance);
    }
}

impl Penalty {
    pub(super) fn check(&self, defects: &mut Defects) {
        not_negative(defects, "step.penalty.stiffness", self.stiffness);
        not_negative(defects, "step.penalty.damping", self.damping);
    }
}
