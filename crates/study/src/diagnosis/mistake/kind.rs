//! The list of known mistakes: what a solver computes instead of the solution, and what to check.

/// A mistake that [`find_mistakes`](super::find_mistakes) knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MistakeKind {
    /// x is the start.
    NothingDone,
    /// Gauss-Seidel was stopped before it converged.
    StoppedSweeps,
    /// Sweeps started from 0 although the answer of the previous frame was known.
    MissingWarmStart,
    /// All rows were updated from the old x.
    Jacobi,
    /// The bounds were applied after the sweep.
    LateClamp,
    /// Gauss-Seidel in 32-bit numbers.
    SinglePrecision,
    /// −b instead of b.
    SignOfB,
    /// b times a positive factor.
    FactorOfB,
    /// Aᵀ instead of A.
    Transposed,
    /// Bounds −hi and −lo.
    SignOfBounds,
    /// One row without its bounds.
    UnboundedRow,
    /// A + ε I instead of A.
    Compliance,
    /// Friction rows are 0.
    FrictionLeftOut,
    /// Friction rows have no bounds.
    UnlimitedFriction,
    /// Friction bounds from normal forces that were computed without friction.
    FrictionlessNormals,
    /// Friction bounds from the normal forces of the previous frame.
    LastNormals,
}

impl MistakeKind {
    /// All known mistakes.
    pub const ALL: [MistakeKind; 16] = [
        MistakeKind::NothingDone,
        MistakeKind::StoppedSweeps,
        MistakeKind::MissingWarmStart,
        MistakeKind::Jacobi,
        MistakeKind::LateClamp,
        MistakeKind::SinglePrecision,
        MistakeKind::SignOfB,
        MistakeKind::FactorOfB,
        MistakeKind::Transposed,
        MistakeKind::SignOfBounds,
        MistakeKind::UnboundedRow,
        MistakeKind::Compliance,
        MistakeKind::FrictionLeftOut,
        MistakeKind::UnlimitedFriction,
        MistakeKind::FrictionlessNormals,
        MistakeKind::LastNormals,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            MistakeKind::NothingDone => "x not updated",
            MistakeKind::StoppedSweeps => "sweeps stopped too early",
            MistakeKind::MissingWarmStart => "missing warm start",
            MistakeKind::Jacobi => "Jacobi instead of Gauss-Seidel",
            MistakeKind::LateClamp => "clamp after the sweep",
            MistakeKind::SinglePrecision => "single precision",
            MistakeKind::SignOfB => "sign of b",
            MistakeKind::FactorOfB => "factor of b",
            MistakeKind::Transposed => "transposed A",
            MistakeKind::SignOfBounds => "sign of the bounds",
            MistakeKind::UnboundedRow => "row without bounds",
            MistakeKind::Compliance => "compliance",
            MistakeKind::FrictionLeftOut => "friction left out",
            MistakeKind::UnlimitedFriction => "friction without a limit",
            MistakeKind::FrictionlessNormals => "friction limit from a frictionless solve",
            MistakeKind::LastNormals => "friction limit of the previous frame",
        }
    }

    /// What is computed instead of the solution.
    pub fn computes(self) -> &'static str {
        match self {
            MistakeKind::NothingDone => {
                "the start: 0 moved into the bounds, or the answer of the previous frame"
            }
            MistakeKind::StoppedSweeps => {
                "projected Gauss-Seidel, stopped after k sweeps: rows in order, in reverse order, forward and \
                 backward, or color by color"
            }
            MistakeKind::MissingWarmStart => {
                "sweeps that start from 0 although the answer of the previous frame is known"
            }
            MistakeKind::Jacobi => "k sweeps in which all rows are updated from the old x",
            MistakeKind::LateClamp => {
                "k sweeps of Gauss-Seidel; x is moved into its bounds after each sweep instead of after each row"
            }
            MistakeKind::SinglePrecision => "k sweeps of projected Gauss-Seidel in 32-bit numbers",
            MistakeKind::SignOfB => "the solution with −b, or sweeps toward it",
            MistakeKind::FactorOfB => {
                "the solution with b times a positive factor; only if all bounds are 0, ∞ or friction limits"
            }
            MistakeKind::Transposed => {
                "the solution with the transpose of A, or sweeps toward it; only if A is not symmetric"
            }
            MistakeKind::SignOfBounds => {
                "the solution with the bounds −hi and −lo, or sweeps toward it; only without friction"
            }
            MistakeKind::UnboundedRow => {
                "the solution with one row as an equation w_i = 0, or sweeps toward it; only up to 60 rows"
            }
            MistakeKind::Compliance => "the solution with A + ε I for some ε > 0",
            MistakeKind::FrictionLeftOut => "the solution with all friction 0, or sweeps toward it",
            MistakeKind::UnlimitedFriction => {
                "the solution with friction rows as equations w_i = 0, or sweeps toward it"
            }
            MistakeKind::FrictionlessNormals => {
                "the solution with friction limited by the normal forces of a solve without friction, or sweeps \
                 toward it"
            }
            MistakeKind::LastNormals => {
                "the solution with friction limited by the normal forces of the previous frame, or sweeps toward \
                 it"
            }
        }
    }

    /// What to check first.
    pub fn check(self) -> &'static str {
        match self {
            MistakeKind::NothingDone => "Does the solver run, and is its result copied back?",
            MistakeKind::StoppedSweeps => {
                "Allow more sweeps, start from the last answer, or use a pivoting solver."
            }
            MistakeKind::MissingWarmStart => {
                "Is the last answer kept, and are its rows matched with the rows of this frame?"
            }
            MistakeKind::Jacobi => "Write each x_i back before the next row is computed.",
            MistakeKind::LateClamp => "Clamp x_i inside the sweep, right after its update.",
            MistakeKind::SinglePrecision => {
                "Compute in double precision, or judge the motion error instead of the residual."
            }
            MistakeKind::SignOfB => "The convention is w = A x + b; others use A x − b.",
            MistakeKind::FactorOfB => "Is b a velocity or an acceleration? Compare units and dt.",
            MistakeKind::Transposed => {
                "Are rows and columns of A swapped, or is A stored column by column?"
            }
            MistakeKind::SignOfBounds => "Contacts push: lo = 0 and hi = ∞, not −∞ and 0.",
            MistakeKind::UnboundedRow => "Are the bounds of that row applied at all?",
            MistakeKind::Compliance => "Does the solver add CFM or regularization to A?",
            MistakeKind::FrictionLeftOut => "Are μ and friction_index passed on?",
            MistakeKind::UnlimitedFriction => "Are friction rows clamped to ±μ x_n?",
            MistakeKind::FrictionlessNormals => "Update the limits ±μ x_n together with x_n.",
            MistakeKind::LastNormals => "Update the limits ±μ x_n in every frame.",
        }
    }
}
