//! What is found out about solvers, problems and scenes.
//!
//! [`answer`] and [`friction`] put one answer and its verdict into words and JSON, [`explain`] derives it
//! line by line, [`diagnosis`] says why there is none, and [`trial`] asks whether the solvers are honest.
//! [`methods`] are the solvers of the registry with clarabel as the reference beside them.

pub mod answer;
pub mod aside;
pub mod clarabel;
pub mod diagnosis;
pub mod explain;
pub mod friction;
pub mod methods;
pub mod tasks;
pub mod trial;
