//! The causes of trouble that K&M list under "Debugging", each with a message.

use std::fmt;

use crate::document::notation::plain;

/// Something that keeps a problem from having one good answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// A constraint has no direction to push in: points that coincide, parallel axes.
    NoDirection {
        /// The constraint and what is wrong with it.
        constraint: String,
    },
    /// A row acts on nothing that can move: a_ii = 0, by which a sweep divides.
    ZeroRow {
        /// The row.
        row: String,
    },
    /// Rows that no forces satisfy together.
    Impossible {
        /// The rows.
        rows: Vec<String>,
        /// Whether this was shown in exact arithmetic, or holds as far as rounding lets one see.
        is_proved: bool,
    },
    /// Rows that depend on each other and agree: over-constrained.
    Redundant {
        /// The rows.
        rows: Vec<String>,
        /// How many of them could be left out.
        spare: usize,
    },
    /// The bodies do not stand where an equation wants them, or overlap: drift, or a bad start.
    Apart {
        /// The row.
        row: String,
        /// c, with its unit.
        error: String,
    },
    /// The rows are independent, but only just: large mass ratios, long chains, near redundancy.
    IllConditioned {
        /// The condition number of the scaled A.
        condition: f64,
    },
    /// A is not symmetric.
    Unsymmetric,
    /// A is symmetric and has a negative eigenvalue.
    Indefinite {
        /// The least one, of A scaled to a unit diagonal.
        eigenvalue: f64,
    },
    /// A step before this one could not be taken.
    Failed {
        /// What happened.
        reason: String,
    },
}

impl Cause {
    /// Whether it keeps the step from being taken as it should be; the others are remarks.
    pub fn is_fatal(&self) -> bool {
        match self {
            Cause::NoDirection { .. }
            | Cause::ZeroRow { .. }
            | Cause::Impossible { .. }
            | Cause::Indefinite { .. }
            | Cause::Failed { .. } => true,
            Cause::Redundant { .. }
            | Cause::Apart { .. }
            | Cause::IllConditioned { .. }
            | Cause::Unsymmetric => false,
        }
    }

    /// The rows that it is about, if it is about some.
    pub fn rows(&self) -> &[String] {
        match self {
            Cause::Impossible { rows, .. } | Cause::Redundant { rows, .. } => rows,
            Cause::ZeroRow { row } | Cause::Apart { row, .. } => std::slice::from_ref(row),
            Cause::NoDirection { .. }
            | Cause::IllConditioned { .. }
            | Cause::Unsymmetric
            | Cause::Indefinite { .. }
            | Cause::Failed { .. } => &[],
        }
    }

    /// Two or three words for the head of a line.
    pub fn name(&self) -> &'static str {
        match self {
            Cause::NoDirection { .. } => "no direction",
            Cause::ZeroRow { .. } => "zero row",
            Cause::Impossible { .. } => "impossible",
            Cause::Redundant { .. } => "over-constrained",
            Cause::Apart { .. } => "drift",
            Cause::IllConditioned { .. } => "ill-conditioned",
            Cause::Unsymmetric => "not symmetric",
            Cause::Indefinite { .. } => "indefinite",
            Cause::Failed { .. } => "failed",
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::NoDirection { constraint } => write!(
                f,
                "{constraint}; such a row would divide by zero, so place the bodies apart."
            ),
            Cause::ZeroRow { row } => write!(
                f,
                "row {row} acts on nothing that can move, so that a sweep would divide by a zero on the \
                 diagonal; take the row out, or let one of its bodies move."
            ),
            Cause::Impossible { rows, is_proved } => write!(
                f,
                "no forces satisfy these rows together, {}, so that sweeps would raise the forces for ever: \
                 {}; take one of them out, or let it yield by a spring.",
                if *is_proved { "proved in exact arithmetic" } else { "as far as rounding shows" },
                listed(rows)
            ),
            Cause::Redundant { rows, spare } => write!(
                f,
                "{spare} of the rows {} could be left out, as they depend on each other; the motion is unique, \
                 but how they share the load is not.",
                listed(rows)
            ),
            Cause::Apart { row, error } => write!(
                f,
                "row {row} is off by {error}, and feedback of such an error puts energy in; start where c = 0, \
                 or correct positions apart from velocities (split-impulse, gauss-seidel)."
            ),
            Cause::IllConditioned { condition } => write!(
                f,
                "the condition number is {}, so that sweeps will be slow; look for heavy bodies carried by \
                 light ones, long chains and rows that all but repeat each other, or use a pivoting solver.",
                plain(*condition)
            ),
            Cause::Unsymmetric => write!(
                f,
                "A is not symmetric; with sliding friction it should not be, and needs Lemke's method or \
                 enumeration, but without it look for a transposed block."
            ),
            Cause::Indefinite { eigenvalue } => write!(
                f,
                "A has the eigenvalue {} after scaling, where no J M⁻¹ Jᵀ has a negative one; look for a wrong \
                 sign, a block of another body, or a negative mass.",
                plain(*eigenvalue)
            ),
            Cause::Failed { reason } => write!(f, "{reason}."),
        }
    }
}

/// Names of rows, of which a few are enough.
fn listed(rows: &[String]) -> String {
    const FEW: usize = 12;
    let mut list = rows.iter().take(FEW).cloned().collect::<Vec<_>>().join(", ");
    if rows.len() > FEW {
        list += &format!(" and {} more", rows.len() - FEW);
    }
    list
}
