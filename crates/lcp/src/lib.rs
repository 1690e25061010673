//! The boxed linear complementarity problem (LCP), its friction models and its file format.
//!
//! ```text
//! w = A x + b,   lo ≤ x ≤ hi,   w_i > 0 ⇒ x_i = lo_i,   w_i < 0 ⇒ x_i = hi_i
//! ```
//!
//! (K&M (1) with its sign errors corrected, E01.) A row with bounds 0 and ∞ is a contact; a row
//! with bounds −∞ and ∞ is an equation w_i = 0; lo = hi fixes x_i and leaves w_i free. A row can be
//! *coupled* to another row ([`Coupling`]): its bounds are then ±μ times that row's x. This is dry
//! friction in one of the four models of [`friction`].

pub mod accurate;
mod complementarity;
mod coupled;
pub mod disk;
mod edit_distance;
pub mod error;
pub mod exact;
#[cfg(feature = "json")]
pub mod file;
pub mod friction;
mod gauss;
mod hypot;
#[cfg(feature = "json")]
pub mod json;
mod lcp;
#[cfg(feature = "library")]
pub mod library;
mod matrix;
pub mod memory;
pub mod merit;
pub mod number;
#[cfg(feature = "json")]
mod question;
mod rolling;
pub mod xml;

pub use complementarity::Complementarity;
pub use coupled::Coupling;
pub use friction::Contact;
pub use gauss::{Gauss, Level};
pub use hypot::hypot;
pub use lcp::Lcp;
pub use matrix::{Dense, Matrix, Row, Sparse, dot};
#[cfg(feature = "json")]
pub use question::Question;
pub use rolling::rolling_friction;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
