//! The causes of failures listed by K&M under "Debugging", each with a message.

use std::fmt;

use lcplab_page::document::notation::plain;
use lcplab_page::number::{count, counted, readable};

/// Significant digits of a factor near 1 and of a number of sweeps.
const DIGITS: usize = 6;

/// A reason why a problem does not have one good answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// A constraint has no defined direction: coincident points, parallel axes.
    NoDirection {
        /// The constraint and its defect.
        constraint: String,
    },
    /// A row acts on nothing that can move: a_ii = 0, by which a sweep divides.
    ZeroRow {
        /// The row.
        row: String,
    },
    /// A row whose diagonal entry of A is so small that hardly any impulse moves it.
    ImmovableRow {
        /// The row.
        row: String,
        /// a_ii, the inverse effective mass.
        diagonal: f64,
        /// The impulse that the row alone would need; ∞ if it overflows.
        impulse: f64,
    },
    /// Rows that no forces satisfy together.
    Impossible {
        /// The rows; empty if all rows are needed.
        rows: Vec<String>,
        /// How this is known.
        proof: Proof,
    },
    /// Rows that depend on each other and are consistent: over-constrained.
    Redundant {
        /// The rows.
        rows: Vec<String>,
        /// The number of rows that could be removed.
        spare: usize,
    },
    /// The bodies violate an equation or overlap: drift, or a bad initial state.
    Apart {
        /// The row.
        row: String,
        /// c, with its unit.
        error: String,
    },
    /// The rows are independent, but nearly dependent: large mass ratios, long chains, near
    /// redundancy.
    IllConditioned {
        /// The condition number of the scaled A.
        condition: f64,
    },
    /// Sweeps would converge slowly although nothing else is wrong: tall stacks, long chains.
    Slow {
        /// The factor by which a Gauss-Seidel sweep reduces the error while no bound is active.
        radius: f64,
        /// The number of sweeps for eight digits.
        sweeps: f64,
    },
    /// The problem has more than one answer, found in exact arithmetic, and not because of
    /// redundant rows: the answer that is given is one of them.
    Several {
        /// The number of vertices of the set of answers.
        answers: usize,
    },
    /// A is not symmetric.
    Unsymmetric,
    /// A is symmetric and has a negative eigenvalue.
    Indefinite {
        /// The least eigenvalue of A scaled to a unit diagonal.
        eigenvalue: f64,
    },
    /// An earlier step could not be computed.
    Failed {
        /// What happened.
        reason: String,
    },
}

/// How it is known that rows cannot be satisfied together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proof {
    /// By a vector that was checked in exact arithmetic.
    Vector,
    /// By such a vector, but only for the numbers as they are written: rows that are meant to agree
    /// differ in their last digits.
    LastDigits,
    /// By trying all pieces of the problem in exact arithmetic.
    CaseSplit {
        /// The number of pieces.
        pieces: usize,
    },
    /// Not proved: true as far as rounding allows to decide.
    Rounding,
}

impl Cause {
    /// Whether it prevents a correct step; other causes are remarks.
    pub fn is_fatal(&self) -> bool {
        match self {
            Cause::Impossible { proof, .. } => *proof != Proof::Rounding,
            Cause::NoDirection { .. } | Cause::Failed { .. } => true,
            Cause::ZeroRow { .. }
            | Cause::ImmovableRow { .. }
            | Cause::Indefinite { .. }
            | Cause::Redundant { .. }
            | Cause::Slow { .. }
            | Cause::Apart { .. }
            | Cause::IllConditioned { .. }
            | Cause::Several { .. }
            | Cause::Unsymmetric => false,
        }
    }

    /// The rows that it refers to, if any.
    pub fn rows(&self) -> &[String] {
        match self {
            Cause::Impossible { rows, .. } | Cause::Redundant { rows, .. } => rows,
            Cause::ZeroRow { row } | Cause::ImmovableRow { row, .. } | Cause::Apart { row, .. } => {
                std::slice::from_ref(row)
            }
            Cause::NoDirection { .. }
            | Cause::IllConditioned { .. }
            | Cause::Slow { .. }
            | Cause::Several { .. }
            | Cause::Unsymmetric
            | Cause::Indefinite { .. }
            | Cause::Failed { .. } => &[],
        }
    }

    /// Two or three words for the start of a line.
    pub fn name(&self) -> &'static str {
        match self {
            Cause::NoDirection { .. } => "no direction",
            Cause::ZeroRow { .. } => "zero row",
            Cause::ImmovableRow { .. } => "immovable row",
            Cause::Impossible { .. } => "impossible",
            Cause::Redundant { .. } => "over-constrained",
            Cause::Apart { .. } => "drift",
            Cause::IllConditioned { .. } => "ill-conditioned",
            Cause::Slow { .. } => "slow",
            Cause::Several { .. } => "several solutions",
            Cause::Unsymmetric => "not symmetric",
            Cause::Indefinite { .. } => "indefinite",
            Cause::Failed { .. } => "failed",
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::NoDirection { constraint } => {
                write!(f, "{constraint}; such a row would divide by zero. Place the bodies apart.")
            }
            Cause::ZeroRow { row } => write!(
                f,
                "row {row} of A is zero, as if its bodies could not move: no force changes its w, and a \
                 sweep would divide by its diagonal entry. Remove the row, or let one of its bodies move."
            ),
            Cause::ImmovableRow { row, diagonal, impulse } => {
                let needed = if impulse.is_finite() {
                    format!("an impulse of about {}", readable(*impulse, 2))
                } else {
                    "an impulse larger than any 64-bit number, which no solver can return".into()
                };
                write!(
                    f,
                    "row {row} has the diagonal entry {} in A, its inverse effective mass. It hardly responds to \
                     impulses: without other rows it would need {needed}. Check the masses, the units and the \
                     Jacobian of this row, or remove the row.",
                    readable(*diagonal, 2)
                )
            }
            Cause::Impossible { rows, proof: Proof::Vector } if rows.len() == 1 => write!(
                f,
                "no forces satisfy row {}; this is proved in exact arithmetic. Remove the row, or make it \
                 compliant with a spring.",
                rows[0]
            ),
            Cause::Impossible { rows, proof: Proof::Vector } => write!(
                f,
                "no forces satisfy rows {} together; this is proved in exact arithmetic. Sweeps would increase \
                 the forces without limit. Remove one of the rows, or make it compliant with a spring.",
                and_listed(rows)
            ),
            Cause::Impossible { rows, proof: Proof::LastDigits } => write!(
                f,
                "these rows contradict each other only in the last digits of their numbers: {}. As the \
                 numbers are written, no forces satisfy all of them, which was proved in exact arithmetic; \
                 without rounding they would be redundant. Remove one of the rows, or compute both from \
                 the same numbers.",
                listed(rows)
            ),
            Cause::Impossible { proof: Proof::CaseSplit { pieces }, .. } => write!(
                f,
                "no forces satisfy all rows together; this is proved in exact arithmetic by trying {} of rows at a bound. \
                 Remove a row or, if friction couples the rows, reduce its coefficient.",
                counted(*pieces, "choice")
            ),
            Cause::Impossible { rows, proof: Proof::Rounding } => write!(
                f,
                "these rows seem to contradict each other, up to rounding, which is not a proof: {}. If a \
                 solver increases the forces without limit, remove one of the rows, or make it compliant with a \
                 spring.",
                listed(rows)
            ),
            Cause::Redundant { rows, spare } => write!(
                f,
                "{} depend on each other: {}. Up to rounding, {spare} of them {} redundant. The \
                 distribution of the load among them need not be unique; with friction, the motion need not be \
                 unique either.",
                counted(rows.len(), "row"),
                listed(rows),
                if *spare == 1 { "is" } else { "are" }
            ),
            Cause::Apart { row, error } => write!(
                f,
                "row {row} has a position error of {error}, and feedback of such an error adds energy. \
                 Start with a position error of 0, or correct positions separately from velocities (split-impulse, \
                 gauss-seidel)."
            ),
            Cause::IllConditioned { condition } => write!(
                f,
                "the condition number is {}, so sweeps converge slowly. Look for heavy bodies on light \
                 ones, long chains and nearly dependent rows, or use a pivoting solver.",
                plain(*condition)
            ),
            Cause::Slow { radius, sweeps } => write!(
                f,
                "while all rows are active, each sweep of Gauss-Seidel multiplies the error by {}, \
                 so reducing the error by a factor of 1e8 takes {} sweeps. Start from the forces of the \
                 previous step, or use a pivoting solver.",
                readable(*radius, DIGITS),
                whole(*sweeps)
            ),
            Cause::Several { answers } => write!(
                f,
                "{answers} different solutions were found in exact arithmetic; the answer depends on the solver \
                 and on its start."
            ),
            Cause::Unsymmetric => write!(
                f,
                "A is not symmetric. With sliding friction this is expected, and requires Lemke's method or \
                 enumeration; without sliding friction, look for a transposed block."
            ),
            Cause::Indefinite { eigenvalue } => write!(
                f,
                "A has the eigenvalue {} after scaling, but J M⁻¹ Jᵀ has no negative eigenvalue. Look for \
                 a wrong sign, a block that belongs to another body, or a negative mass.",
                plain(*eigenvalue)
            ),
            Cause::Failed { reason } => write!(f, "{reason}."),
        }
    }
}

/// A number of sweeps with all digits; a very large one in powers of ten.
fn whole(sweeps: f64) -> String {
    const COUNTABLE: f64 = 1e12;
    let sweeps = sweeps.round();
    if sweeps < COUNTABLE { count(sweeps as usize) } else { readable(sweeps, DIGITS) }
}

/// Row names in a sentence; a long list is shortened.
fn and_listed(rows: &[String]) -> String {
    match rows {
        [first @ .., last] if !first.is_empty() && rows.len() <= FEW => {
            format!("{} and {last}", first.join(", "))
        }
        _ => listed(rows),
    }
}

/// The number of row names in a sentence.
const FEW: usize = 4;

/// Row names as text; a long list is shortened.
fn listed(rows: &[String]) -> String {
    let mut list = rows.iter().take(FEW).cloned().collect::<Vec<_>>().join(", ");
    if rows.len() > FEW {
        list += &format!(" and {} more", rows.len() - FEW);
    }
    list
}
