//! Gauss's principle of least constraint: the primal quadratic program of the same motion.
//!
//! ```text
//! min over u, s   ½ (u − u*)ᵀ M (u − u*) + ½ Σ γ_i s_i² + Σ σ_i(−(J u + bias + γ s)_i)
//! σ_i(t) = max { x t : lo_i ≤ x ≤ hi_i }
//! ```
//!
//! Its optimal value is minus that of the LCP's quadratic program with A = J M⁻¹ Jᵀ + diag(γ) and b
//! = J u* + bias, and u = u* + M⁻¹ Jᵀ x. It never forms A, so it checks the assembly of A as well
//! as the solver.

use std::fmt;

/// What the motion u is; this decides the units of every reported number.
///
/// ```
/// use lcplab_lcp::Level;
///
/// assert_eq!((Level::Velocity.name(), Level::Velocity.units()), ("velocity", "m/s or rad/s"));
/// assert_eq!(Level::Velocity.norm_unit(), "√J"); // ½ uᵀM u is an energy
/// assert_eq!(Level::Acceleration.norm_unit(), "√J/s");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// m/s and rad/s; x are impulses.
    Velocity,
    /// m/s² and rad/s²; x are forces.
    Acceleration,
}

impl Level {
    /// All levels.
    pub const ALL: [Level; 2] = [Level::Velocity, Level::Acceleration];

    /// The word used in problem files.
    pub fn name(self) -> &'static str {
        match self {
            Level::Velocity => "velocity",
            Level::Acceleration => "acceleration",
        }
    }

    /// The units of the entries of u.
    pub fn units(self) -> &'static str {
        match self {
            Level::Velocity => "m/s or rad/s",
            Level::Acceleration => "m/s² or rad/s²",
        }
    }

    /// The unit of √(uᵀM u): the square root of an energy, or the same per second.
    pub fn norm_unit(self) -> &'static str {
        match self {
            Level::Velocity => "√J",
            Level::Acceleration => "√J/s",
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The data of the primal program; u has k entries, and there are n rows.
#[derive(Debug, Clone, Default)]
pub struct Gauss {
    /// The upper triangle (row ≤ column) of M (k × k), each entry once, positive definite;
    /// immovable bodies are left out.
    pub mass: Vec<(usize, usize, f64)>,
    /// The n rows of J, each as entries (column, value), each column once.
    pub jacobian: Vec<Vec<(usize, f64)>>,
    /// The n offsets added to J u.
    pub bias: Vec<f64>,
    /// The n compliances γ ≥ 0 on the diagonal of A (CFM).
    pub compliance: Vec<f64>,
    /// The k unconstrained velocities or accelerations u*.
    pub target: Vec<f64>,
    /// The n lower bounds on x.
    pub lo: Vec<f64>,
    /// The n upper bounds on x.
    pub hi: Vec<f64>,
    /// What u is, if known.
    pub level: Option<Level>,
}
