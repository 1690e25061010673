//! The tests, one binary. The modules mirror `src`.

mod architecture;
mod certificate;
mod cli;
mod common;
mod constraint;
mod lcp;
mod page;
mod plot;
mod reference;
mod solver;
