//! The tests, one binary. The modules mirror `src`.

mod assembly;
mod certificate;
mod common;
mod constraint;
mod formulation;
mod lcp;
mod reference;
mod scene;
mod simulation;
mod solver;
