//! The tests, one binary. The modules mirror `src`.

mod certificate;
mod common;
mod constraint;
mod lcp;
mod reference;
mod solver;
