//! Derives a time step, or a problem file, line by line with its own numbers.
//!
//! The derivation is written as in a calculation by hand: states and forces, each row's c, J and
//! J'u, the four steps that lead from Newton's law to the LCP (K&M Figure 4), A and b, and then the
//! solver at work, row by row, pivot by pivot, or tableau by tableau, as it reports its step
//! details to an observer ([`StepDetail`](lcplab_solver::StepDetail)). Friction with polygons or
//! cones is shown in its own formulation, and for a problem without solution the proof is given.
//! All numbers are those of the simulation.
//!
//! ```
//! use lcplab_page::document::Format;
//! use lcplab_analysis::explain::{Method, step};
//! use lcplab_mechanics::scene::Scene;
//!
//! let document = step(&Scene::load("fig6")?, &Method::named("pgs")?, 1)?;
//! let text = document.written(Format::Text)?;
//! assert!(text.contains("x₀ = 2 N s")); // the ground's impulse on the body that lands
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod answer;
mod dantzig;
#[cfg(feature = "mechanics")]
mod derivation;
mod friction;
mod lemke;
mod method;
mod problem;
mod refutation;
#[cfg(feature = "mechanics")]
mod setup;
#[cfg(feature = "mechanics")]
mod single;
mod solve;
mod statement;
#[cfg(feature = "mechanics")]
mod step;
#[cfg(feature = "mechanics")]
mod step_units;
mod sweeps;
mod units;

pub use method::Method;
pub use problem::problem;
#[cfg(feature = "mechanics")]
pub use step::{step, steps};
