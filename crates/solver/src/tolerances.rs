//! Every numerical tolerance of the solvers: one name, one value, one reason.
//!
//! All are relative, so that they depend on no unit. For comparison, one rounding of `f64` is up to
//! 1.1e-16 of a number. The parameters of steps, such as a relaxation, are here
//! too; limits of counts and of memory are where they are used.

/// Default of [`Settings::tolerance`](crate::Settings), a scaled residual: far above rounding, so
/// that well-conditioned problems reach it, and far below the accuracy of contact data.
pub(crate) const DEFAULT_TOLERANCE: f64 = 1e-8;

// Rounding in sums.

/// A sum below this fraction of its terms counts as zero, a pivot relative to its diagonal entry
/// included: about a thousand roundings, because values that were updated many times are added.
pub(crate) const RELATIVE_ZERO: f64 = 1e-13;
/// The scaled residual below which a row is satisfied up to rounding: x comes from a factorization,
/// which loses some digits.
pub(crate) const RESIDUAL_ROUNDING: f64 = 1e-12;
/// The scaled residual that iterative refinement aims at: w is then summed with twice the digits,
/// and only x is rounded.
pub(crate) const REFINED_RESIDUAL: f64 = 1e-14;

// Dantzig's method; sizes of d are Σ √a_jj |d_j|.

/// s = dᵀA d below this fraction of the squared size of d counts as zero, as does Δw_j relative to
/// the product of two sizes: rounding of A and its factor, about ten units in the last place, can
/// be this large.
pub(crate) const SCHUR_ROUNDING: f64 = 2e-15;
/// s below minus this fraction of the squared size of d is not rounding, so A is not semidefinite:
/// far above [`SCHUR_ROUNDING`], because an ill-conditioned factor amplifies rounding.
pub(crate) const NEGATIVE_SCHUR: f64 = 1e-7;
/// An entry of a null direction below this fraction of the largest is rounding: a null direction
/// comes from an ill-conditioned factor, and loses more digits than a sum.
pub(crate) const NULL_DIRECTION_ROUNDING: f64 = 1e-11;
/// dᵀw along a null direction counts as zero below this fraction of its terms: w is recomputed
/// there, so that only the rounding of one sum is left.
pub(crate) const SLOPE_ROUNDING: f64 = 1e-14;
/// A row whose pivot is below this fraction of its diagonal entry depends on those before; pivots
/// are chosen in descending order, so that they lose fewer digits than those in a given order.
pub(crate) const INDEPENDENT_PIVOT: f64 = 1e-14;
/// Gauss-Seidel sweeps clean up x only below this scaled residual: a larger one is not rounding,
/// even with mass ratios of 10⁶.
pub(crate) const CLEANUP_LIMIT: f64 = 1e-3;

// Lemke's method.

/// Moves whose lengths differ by less than this fraction end together: lengths are quotients of
/// values that each pivot has updated.
pub(crate) const LENGTH_TIE: f64 = 1e-10;
/// Two ratios of the lexicographic test that differ by less than this fraction are tied: ten times
/// [`RELATIVE_ZERO`], because a ratio is a quotient of two sums.
pub(crate) const RATIO_TIE: f64 = 1e-12;
/// A principal pivot s is accepted above this fraction of the squared size of its direction; it
/// then has about five correct digits.
pub(crate) const MIN_PIVOT: f64 = 1e-11;
/// An s of a row without bounds below this fraction of the squared size of its direction is only
/// rounding, so that the row depends on others; between this and [`MIN_PIVOT`] it is unreliable.
pub(crate) const REDUNDANT_PIVOT: f64 = 1e-14;
/// A pivot of the tableau below this fraction of its row may be rounding: the row has only the
/// digits that earlier pivots have left.
pub(crate) const UNCERTAIN_PIVOT: f64 = 1e-10;
/// A constant of the tableau below this fraction of the largest terms it ever had counts as zero in
/// a block exchange and on a second path: it may have cancelled over many pivots, not in one sum.
pub(crate) const CANCELLATION_TOLERANCE: f64 = 1e-11;
/// An entry of the tableau below this fraction of its largest value during a block exchange has
/// lost its digits and is no pivot.
pub(crate) const CANCELLED_ENTRY: f64 = 1e-12;
/// If units of w differ by more than this factor, the covering vector consists of the units: ones
/// would make large units swamp small ones.
pub(crate) const UNITS_FAR_APART: f64 = 1024.0;

// Proximal steps and dependent rows.

/// Dependent rows whose scaled residual is above this contradict each other; a smaller one may be
/// due to drift and rounding of redundant joints.
pub(crate) const CONTRADICTION: f64 = 1e-3;
/// A solution by proximal steps must be nearer to a solution than Π(0) by this factor: if rows
/// contradict each other, x diverges, and only the residual relative to x becomes small.
pub(crate) const NEARER_THAN_ZERO: f64 = 1e-3;
/// A residual below this fraction of the least so far is an improvement of a proximal step; at
/// rounding level it changes by less.
pub(crate) const IMPROVEMENT: f64 = 0.9;
/// With a unit diagonal, an eigenvalue less than n times this below zero is rounding: A itself may
/// be assembled from rounded products.
pub(crate) const NEGATIVE_EIGENVALUE: f64 = 1e-10;

// Rays and curvatures of first-order methods.

/// dᵀA d below this fraction of λ dᵀD d counts as zero, where λ is the largest eigenvalue; it
/// counts as negative below minus the square root, because d itself is rounded.
pub(crate) const FLAT_CURVATURE: f64 = 1e-14;
/// dᵀA d along a ray counts as zero below this fraction of the sum of its absolute terms, about the
/// rounding of that sum.
pub(crate) const RAY_CURVATURE: f64 = 1e-14;
/// bᵀd along a ray counts as zero below this fraction of its terms: where dᵀA d is only rounding, d
/// is a null vector only up to its square root, about 1e-7.
pub(crate) const RAY_SLOPE: f64 = 1e-6;
/// Entries of a direction below this fraction of the largest are not part of a ray, for the same
/// reason.
pub(crate) const RAY_ENTRY: f64 = 1e-7;
/// The fraction of the predicted decrease that a step must achieve (Armijo's constant in textbooks:
/// small, so that full steps are accepted near a solution).
pub(crate) const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Anderson's differences are dropped from the first that has less than this fraction of its square
/// outside the span of newer ones: the least-squares problem would lose half of its digits.
pub(crate) const DEPENDENT_DIFFERENCE: f64 = 1e-12;
/// If the solution of a frozen problem of APGD does not solve the original one, its tolerance
/// becomes this fraction of the residual, so that each round gains a digit.
pub(crate) const INNER_TOLERANCE: f64 = 0.1;
/// The over-relaxation of ADMM, in the range 1.5 to 1.8 that its authors recommend.
pub(crate) const OVER_RELAXATION: f64 = 1.6;
/// The factor on ADMM's weight for rows without bounds, whose x no projection moves.
pub(crate) const WEIGHT_WITHOUT_BOUNDS: f64 = 1e-3;
/// The tolerance of the small problems of block PGS: rounding level, because their errors would
/// limit the whole sweep.
pub(crate) const BLOCK_TOLERANCE: f64 = 1e-14;

// Newton's method and interior points.

/// Values of |H|² that differ by less than this fraction are equal up to rounding: |H|² is a sum of
/// squares of small differences.
pub(crate) const LEVEL_MERIT: f64 = 1e-9;
/// The damping ν of a least-squares step if |H|² is that of x = 0 without bounds, and smaller in
/// proportion to |H|²: it affects only the flattest directions.
pub(crate) const DAMPING: f64 = 1e-10;
/// The minimum of ν, whose square root is still above rounding and keeps the least-squares problem
/// solvable if J is singular.
pub(crate) const MIN_DAMPING: f64 = 1e-28;
/// The fraction of the distance to the nearest bound that an interior step may use; at 1 the next
/// step would start on the bound.
pub(crate) const STAY_INSIDE: f64 = 0.995;
/// Interior steps shorter than this count as no progress: x no longer changes relative to the
/// distance to the solution.
pub(crate) const SHORTEST_STEP: f64 = 1e-10;
/// A slack below this fraction of √(e / a_ii) counts as zero: if multiplier and slack both vanish
/// at the solution, x approaches its bound only as √μ, which is never small relative to the terms
/// of the row.
pub(crate) const VANISHED_SLACK: f64 = 1e-12;
/// The minimum of the diagonal that an interior point method adds to A, relative to a_ii: it
/// compensates for the rounding of a singular A.
pub(crate) const MIN_ADDED: f64 = 1e-12;
/// The minimum of the diagonal that an interior point method adds to a monotone A that is not
/// symmetric, relative to the size of the row: it makes dependent equations solvable, and a few
/// corrections remove its effect.
pub(crate) const MONOTONE_ADDED_DIAGONAL: f64 = 1e-10;
/// The active set is guessed once the mean of slack times multiplier is below this fraction of its
/// start: before, most guesses are wrong.
pub(crate) const LATE: f64 = 1e-3;
/// Entries below this fraction of the largest |x| are rounding errors of 0: 64 units in the last
/// place.
pub(crate) const DUST: f64 = 64.0 * f64::EPSILON;
/// Newton's method for cones begins with this fraction ε of each row's scale added to the diagonal
/// of A: the solution of such a compliant problem is near the start x = 0.
pub(crate) const FIRST_ADDED_DIAGONAL: f64 = 0.1;
/// The factor on ε from one problem to the next: the solution of one is then a good start for the
/// next.
pub(crate) const ADDED_DIAGONAL_FACTOR: f64 = 0.25;
/// The last ε: below it, A with the added diagonal is A up to rounding.
pub(crate) const LAST_ADDED_DIAGONAL: f64 = 1e-12;
/// Newton's method for cones ends when its equations hold to this fraction of |b|, which is a few
/// hundred units of rounding.
pub(crate) const EQUATIONS_HOLD: f64 = 1e-13;
/// A step of Newton's method for cones is taken if the residual decreases by at least this fraction
/// of the predicted decrease.
pub(crate) const ENOUGH_DECREASE: f64 = 0.1;

// Theory.

/// An eigenvalue of an iteration matrix within this distance of 1 counts as 1: the error does not
/// change along its eigenvector.
pub(crate) const UNIT_EIGENVALUE: f64 = 1e-9;
/// An eigenvalue of A below this fraction of the largest counts as 0: above the rounding of a
/// decomposition of a few hundred rows.
pub(crate) const NULL_EIGENVALUE: f64 = 1e-11;
