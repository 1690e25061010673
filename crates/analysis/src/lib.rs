//! What is found out about solvers, problems and scenes.
//!
//! [`trial`] solves, judges and counts. With it, [`families`] and [`profiles`] compare the solvers
//! on problems, `comparison` on scenes, and [`hunt`] searches for false claims. [`friction`] solves
//! and judges one problem, [`explain`] derives an answer line by line, [`gradient`] differentiates
//! it, [`precision`] finds what single precision loses, [`diagnosis`] says why there is no answer.
//! [`receipt`] checks the steps of physics engines. What needs scenes is behind the feature
//! `mechanics`. [`methods`] are the solvers of the registry, with the feature `clarabel` also the
//! reference.

// The hidden modules are parts of the program `lcplab`, another crate. They are no promise.

#[doc(hidden)]
pub mod answer;
#[doc(hidden)]
pub mod aside;
pub mod card;
#[doc(hidden)]
pub mod ci;
#[cfg(feature = "clarabel")]
pub mod clarabel;
#[cfg(feature = "mechanics")]
pub mod comparison;
pub mod diagnosis;
pub mod explain;
pub mod families;
pub mod friction;
pub mod gradient;
pub mod hunt;
pub mod loads;
pub mod methods;
#[doc(hidden)]
pub mod minimum;
pub mod motion_error;
#[doc(hidden)]
pub mod number;
pub mod precision;
pub mod profiles;
pub mod receipt;
#[doc(hidden)]
pub mod regression;
#[doc(hidden)]
pub mod tally;
#[doc(hidden)]
pub mod tasks;
pub mod trial;
