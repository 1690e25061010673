//! The thresholds of the examination in one place, each with its reason. An *error* is a fraction
//! of the constraints' effect.

/// An error below this is negligible: it is far above rounding, and not seen in an animation.
pub const HEALTHY: f64 = 0.01;

/// The error of a good answer, up to which sweeps are counted: a tenth of the negligible error, so
/// that the count does not end at an answer that is barely negligible.
pub const GOOD: f64 = 1e-3;

/// An error above this fraction of the largest is a large part of it. Later steps inherit the error
/// of earlier ones, so the step to examine comes before the largest error.
pub(super) const LARGE_PART: f64 = 0.25;

/// The error of a part of a frame is hidden if it is larger than that of the whole by this factor;
/// below it, both show the same error.
pub(super) const HIDDEN: f64 = 1.1;

/// Without a cause of slow sweeps, half of them must suffice; smaller savings are no remedy.
pub(super) const FEWER_SWEEPS: f64 = 2.0;

/// A cause must also explain this part of the error: if sweeps become slow only near the end,
/// their error may have another cause.
pub(super) const EXPLAINS: f64 = 0.1;

/// A cause that explains half of the error explains most of it. Several causes may, because their
/// effects multiply; then the one that is easiest to remove comes first.
pub(super) const EXPLAINS_MOST: f64 = 0.5;

/// The factor on motor limits for testing strong motors: their effect is then a hundredth, which is
/// negligible ([`HEALTHY`]), and the motors still act in the same rows.
pub(super) const WEAK_MOTOR: f64 = 0.01;

/// A solver whose error is this many times that of plain Gauss-Seidel after the same number of
/// sweeps is suspected: below it, another order of the rows may explain the difference.
pub(super) const WORSE_THAN_PLAIN: f64 = 2.0;

/// A cause of wrong motion must explain half of the symptom: then no other explains more.
#[cfg(feature = "mechanics")]
pub(super) const CREDIBLE: f64 = 0.5;

/// Feedback is a cause if the error without it is below this fraction of that with it. Feedback
/// should reduce errors, so any clear increase is a fault.
#[cfg(feature = "mechanics")]
pub(super) const FEEDBACK_HELPS: f64 = 0.9;

/// Position errors are reported from this fraction of the thinnest body on, energies from the same
/// fraction of the work of all weights over its thickness: an overlap of that size is just visible.
#[cfg(feature = "mechanics")]
pub(super) const REPORTED_LENGTH: f64 = 0.01;

/// Compliance is examined from this part of [`REPORTED_LENGTH`] on, because the errors of several
/// compliant contacts in a stack add up.
#[cfg(feature = "mechanics")]
pub(super) const EXAMINED_COMPLIANCE: f64 = 0.1;

/// Friction is reported from this fraction of the distance moved on: a body that stops within 50
/// steps has an error of about this size from the step alone.
#[cfg(feature = "mechanics")]
pub(super) const REPORTED_SLIDE: f64 = 0.02;

/// Sinking is stated in a sentence from this depth (m) on: less is rounding of positions and
/// tolerances.
pub(super) const REPORTED_DEPTH: f64 = 1e-6;
