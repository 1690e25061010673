//! The list of known mistakes: what a solver computes instead of the solution, and what to check.

/// A mistake that [`find_mistakes`](super::find_mistakes) knows.
///
/// ```
/// use lcplab_analysis::diagnosis::MistakeKind;
///
/// let kind = MistakeKind::SignOfB;
/// assert_eq!(kind.name(), "sign of b");
/// assert_eq!(kind.computes(), "the solution with −b, or sweeps toward it");
/// assert_eq!(kind.check(), "The convention is w = A x + b; others use A x − b.");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MistakeKind {
    /// x is the start.
    NothingDone,
    /// Gauss-Seidel was stopped before it converged.
    StoppedSweeps,
    /// Sweeps started from 0 although the answer to the previous step was known.
    MissingWarmStart,
    /// Sweeps started from a multiple of the last answer.
    ScaledWarmStart,
    /// Sweeps started from the last answers of other rows.
    MisplacedWarmStart,
    /// All rows were updated from the old x.
    Jacobi,
    /// The change of x_i was clamped instead of x_i.
    ClampedIncrements,
    /// The bounds were applied after the sweep.
    LateClamp,
    /// The bounds were applied once, at the end.
    ClampAtEnd,
    /// Gauss-Seidel in 32-bit numbers.
    SinglePrecision,
    /// −b instead of b.
    SignOfB,
    /// b times a positive factor.
    FactorOfB,
    /// x times a positive factor.
    FactorOfX,
    /// −x instead of x.
    SignOfX,
    /// Aᵀ instead of A.
    Transposed,
    /// Bounds −hi and −lo.
    SignOfBounds,
    /// All lower or all upper bounds were ignored.
    MissingBound,
    /// One row without its bounds.
    UnboundedRow,
    /// One contact has x = 0.
    ContactLeftOut,
    /// The rows are in another order.
    OtherRows,
    /// A + ε I instead of A.
    Compliance,
    /// A − ε I instead of A.
    ComplianceLeftOut,
    /// Friction rows are 0.
    FrictionLeftOut,
    /// Friction rows have no bounds.
    UnlimitedFriction,
    /// Friction bounds from normal forces that were computed without friction.
    FrictionlessNormals,
    /// Friction bounds from the normal forces of the previous step.
    LastNormals,
    /// Friction bounds from the normal forces after the first sweep.
    FirstFriction,
    /// Friction bounds from the normal forces before the sweep.
    LateFriction,
    /// Friction bounds from the next contact.
    OtherNormals,
    /// Another μ.
    FactorOfMu,
    /// Another friction law.
    OtherLaw,
    /// Tangents swapped or reversed.
    Tangents,
    /// The equations of another active set.
    WrongActiveSet,
}

/// How a mistake is described.
struct Description {
    name: &'static str,
    computes: &'static str,
    check: &'static str,
}

impl MistakeKind {
    /// All known mistakes.
    pub const ALL: [MistakeKind; 33] = [
        MistakeKind::NothingDone,
        MistakeKind::StoppedSweeps,
        MistakeKind::MissingWarmStart,
        MistakeKind::ScaledWarmStart,
        MistakeKind::MisplacedWarmStart,
        MistakeKind::Jacobi,
        MistakeKind::ClampedIncrements,
        MistakeKind::LateClamp,
        MistakeKind::ClampAtEnd,
        MistakeKind::SinglePrecision,
        MistakeKind::SignOfB,
        MistakeKind::FactorOfB,
        MistakeKind::FactorOfX,
        MistakeKind::SignOfX,
        MistakeKind::Transposed,
        MistakeKind::SignOfBounds,
        MistakeKind::MissingBound,
        MistakeKind::UnboundedRow,
        MistakeKind::ContactLeftOut,
        MistakeKind::OtherRows,
        MistakeKind::Compliance,
        MistakeKind::ComplianceLeftOut,
        MistakeKind::FrictionLeftOut,
        MistakeKind::UnlimitedFriction,
        MistakeKind::FrictionlessNormals,
        MistakeKind::LastNormals,
        MistakeKind::FirstFriction,
        MistakeKind::LateFriction,
        MistakeKind::OtherNormals,
        MistakeKind::FactorOfMu,
        MistakeKind::OtherLaw,
        MistakeKind::Tangents,
        MistakeKind::WrongActiveSet,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        self.description().name
    }

    /// What is computed instead of the solution.
    pub fn computes(self) -> &'static str {
        self.description().computes
    }

    /// What to check first.
    pub fn check(self) -> &'static str {
        self.description().check
    }

    fn description(self) -> Description {
        match self {
            MistakeKind::NothingDone => Description {
                name: "x not updated",
                computes: "the start: 0 clamped to the bounds, or the answer to the \
                          previous step",
                check: "Does the solver run, and is its result copied back?",
            },
            MistakeKind::StoppedSweeps => Description {
                name: "sweeps stopped too early",
                computes: "projected Gauss-Seidel, stopped after k sweeps: rows in order, \
                          in reverse order, forward and backward, or color by color",
                check: "Allow more sweeps, start from the last answer, or use a pivoting \
                       solver.",
            },
            MistakeKind::MissingWarmStart => Description {
                name: "missing warm start",
                computes: "sweeps that start from 0 although the answer to the previous \
                          step is known",
                check: "Is the last answer kept, and are its rows matched with the rows \
                       of this step?",
            },
            MistakeKind::ScaledWarmStart => Description {
                name: "scaled warm start",
                computes: "k sweeps from the answer to the previous step times a factor",
                check: "Is the last answer scaled twice, or for another time step?",
            },
            MistakeKind::MisplacedWarmStart => Description {
                name: "warm start of other rows",
                computes: "k sweeps from the answer to the previous step with its rows, \
                          or its contacts, shifted by one",
                check: "Are last answers stored by contact, or by position in a list?",
            },
            MistakeKind::Jacobi => Description {
                name: "Jacobi instead of Gauss-Seidel",
                computes: "k sweeps in which all rows are updated from the old x",
                check: "Write each x_i back before the next row is computed.",
            },
            MistakeKind::ClampedIncrements => Description {
                name: "clamped increments",
                computes: "k sweeps in which each change of x_i is clamped to the bounds \
                          of x_i",
                check: "Clamp the accumulated x_i, not its change.",
            },
            MistakeKind::LateClamp => Description {
                name: "clamp after the sweep",
                computes: "k sweeps of Gauss-Seidel; x is clamped to its bounds after \
                          each sweep instead of after each row",
                check: "Clamp x_i inside the sweep, right after its update.",
            },
            MistakeKind::ClampAtEnd => Description {
                name: "clamp at the end",
                computes: "the solution without bounds, or k sweeps toward it, then clamped \
                          to the bounds",
                check: "Clamp x_i inside the sweep; clamping the solution of the \
                       equations does not solve the problem.",
            },
            MistakeKind::SinglePrecision => Description {
                name: "single precision",
                computes: "k sweeps of projected Gauss-Seidel in 32-bit numbers",
                check: "Compute in double precision, or judge the motion error instead of \
                       the residual.",
            },
            MistakeKind::SignOfB => Description {
                name: "sign of b",
                computes: "the solution with −b, or sweeps toward it",
                check: "The convention is w = A x + b; others use A x − b.",
            },
            MistakeKind::FactorOfB => Description {
                name: "factor of b",
                computes: "the solution with b times a positive factor; only if all \
                          bounds are 0, ∞ or friction limits",
                check: "Is b a velocity or an acceleration? Compare units and dt.",
            },
            MistakeKind::FactorOfX => Description {
                name: "factor of x",
                computes: "the solution times a factor; only if some bound is finite and not \
                          0 (otherwise this is the same as a factor of b)",
                check: "Is x an impulse or a force? Compare units and dt.",
            },
            MistakeKind::SignOfX => Description {
                name: "sign of x",
                computes: "the solution with the opposite sign of every x",
                check: "Which body does a positive x push? If w is the velocity of separation, \
                       x ≥ 0 pushes the bodies apart.",
            },
            MistakeKind::Transposed => Description {
                name: "transposed A",
                computes: "the solution with the transpose of A, or sweeps toward it; \
                          only if A is not symmetric",
                check: "Are rows and columns of A swapped, or is A stored column by column?",
            },
            MistakeKind::SignOfBounds => Description {
                name: "sign of the bounds",
                computes: "the solution with the bounds −hi and −lo, or sweeps toward it; \
                          only without friction",
                check: "Contacts push: lo = 0 and hi = ∞, not −∞ and 0.",
            },
            MistakeKind::MissingBound => Description {
                name: "bounds on one side not applied",
                computes: "the solution without lower bounds or without upper bounds, or \
                          sweeps toward it",
                check: "Is x clamped to lo and to hi, and is neither overwritten?",
            },
            MistakeKind::UnboundedRow => Description {
                name: "row without bounds",
                computes: "the solution with one row as an equation w_i = 0, or sweeps \
                          toward it; only up to 60 rows",
                check: "Are the bounds of that row applied at all?",
            },
            MistakeKind::ContactLeftOut => Description {
                name: "contact left out",
                computes: "the solution with the rows of one contact, or with one row whose \
                          lower bound is 0, set to 0; the other rows are solved either \
                          with or without it; only up to 60 contacts",
                check: "Is every contact solved, written back and read?",
            },
            MistakeKind::OtherRows => Description {
                name: "rows in another order",
                computes: "the solution with its rows, or its contacts, shifted by one, \
                          reversed or otherwise reordered",
                check: "Are results written back to the rows that they belong to?",
            },
            MistakeKind::Compliance => Description {
                name: "compliance",
                computes: "the solution with A + ε I for some ε > 0",
                check: "Does the solver add CFM or regularization to A?",
            },
            MistakeKind::ComplianceLeftOut => Description {
                name: "compliance left out",
                computes: "the solution with A − ε I for some ε > 0",
                check: "Does A contain CFM or regularization that the solver leaves out?",
            },
            MistakeKind::FrictionLeftOut => Description {
                name: "friction left out",
                computes: "the solution with all friction 0, or sweeps toward it",
                check: "Are μ and friction_index passed on?",
            },
            MistakeKind::UnlimitedFriction => Description {
                name: "friction without a limit",
                computes: "the solution with friction rows as equations w_i = 0, or \
                          sweeps toward it",
                check: "Are friction rows clamped to ±μ x_n?",
            },
            MistakeKind::FrictionlessNormals => Description {
                name: "friction limit from a frictionless solve",
                computes: "the solution with friction limited by the normal forces of a \
                          solve without friction, or sweeps toward it",
                check: "Update the limits ±μ x_n together with x_n.",
            },
            MistakeKind::LastNormals => Description {
                name: "friction limit of the previous step",
                computes: "the solution with friction limited by the normal forces of the \
                          previous step, or sweeps toward it",
                check: "Update the limits ±μ x_n in every step.",
            },
            MistakeKind::FirstFriction => Description {
                name: "friction limit of the first sweep",
                computes: "k sweeps in which the limits ±μ x_n of the first sweep are kept",
                check: "Update the limits ±μ x_n in every sweep.",
            },
            MistakeKind::LateFriction => Description {
                name: "friction limit one sweep late",
                computes: "k sweeps in which friction is limited by the normal forces of \
                          the sweep before",
                check: "Update the limits ±μ x_n inside the sweep, after each x_n.",
            },
            MistakeKind::OtherNormals => Description {
                name: "friction limit of another contact",
                computes: "the solution with the normal force of the next or previous \
                          contact in the friction limit, or sweeps toward it",
                check: "Does friction_index count from the right row?",
            },
            MistakeKind::FactorOfMu => Description {
                name: "wrong μ",
                computes: "the solution with μ², or with every μ times one factor, or \
                          sweeps toward it",
                check: "Is μ combined, squared or scaled twice?",
            },
            MistakeKind::OtherLaw => Description {
                name: "another friction law",
                computes: "the solution under another friction law: box, polygon with 4 \
                          or 8 sides, associated cone, Coulomb cone",
                check: "Which friction law does the solver implement?",
            },
            MistakeKind::Tangents => Description {
                name: "tangents swapped or reversed",
                computes: "the solution with t1 and t2 swapped, or with the opposite sign \
                          of one or both",
                check: "Do t1 and t2 have the same order and sign in J, b and x?",
            },
            MistakeKind::WrongActiveSet => Description {
                name: "wrong active set",
                computes: "an exact solution of the equations of the active set of x, \
                          although a bound or the sign of a w_i forbids it; only if no \
                          other mistake gives x",
                check: "Check every row after the last pivot: lo ≤ x ≤ hi, and w_i has \
                       the sign that its bound allows.",
            },
        }
    }
}
