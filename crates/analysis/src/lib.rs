//! What is found out about solvers, problems and scenes.
//!
//! [`trial`] solves, judges and counts. With it, [`families`] and [`profiles`] compare the solvers
//! on problems, [`regression`] with a recorded run, `comparison` on scenes, and [`hunt`] searches
//! for false claims. [`answer`] and [`friction`] put one answer and its verdict into words and
//! JSON, [`explain`] derives it line by line, [`diagnosis`] says why there is none. [`receipt`]
//! checks the steps of physics engines, and [`ci`] writes the results of both for continuous
//! integration. What needs scenes is behind the feature `mechanics`. [`methods`] are the solvers
//! of the registry, with the feature `clarabel` the reference beside them.

pub mod answer;
pub mod aside;
pub mod card;
pub mod ci;
#[cfg(feature = "clarabel")]
pub mod clarabel;
#[cfg(feature = "mechanics")]
pub mod comparison;
pub mod diagnosis;
pub mod explain;
pub mod families;
pub mod friction;
pub mod hunt;
pub mod loads;
pub mod methods;
pub mod minimum;
pub mod motion_error;
pub mod number;
pub mod profiles;
pub mod receipt;
pub mod regression;
pub mod tally;
pub mod tasks;
pub mod trial;
