//! Problems in numbers alone: the boxed linear complementarity problem.
//!
//! ```text
//! w = A x + b,   lo ≤ x ≤ hi,   w_i > 0 ⇒ x_i = lo_i,   w_i < 0 ⇒ x_i = hi_i
//! ```
//!
//! (K&M (1) with the signs settled, E01.) A row with bounds 0 and ∞ is a contact, one with −∞ and ∞
//! an equation w_i = 0, one with lo = hi pins x_i and leaves w_i free. A row may be *coupled* to
//! another one ([`Coupling`]): its bounds are then ±μ times that row's x, which is dry friction in
//! one of the four models of [`friction`].

pub mod accurate;
mod complementarity;
mod coupled;
pub mod disk;
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

pub use complementarity::Complementarity;
pub use coupled::Coupling;
pub use friction::Contact;
pub use gauss::{Gauss, Level};
pub use hypot::hypot;
pub use lcp::Lcp;
pub use matrix::{Dense, Matrix, Row, Sparse, dot};
#[cfg(feature = "json")]
pub use question::Question;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
