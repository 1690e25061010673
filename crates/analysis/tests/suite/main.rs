//! The judge with solvers it does not know, derivations, diagnoses and the hunt.

mod certificate;
mod comparison;
mod diagnosis;
mod explain;
mod extremes;
mod gradient;
mod healthy;
mod hunt;
mod hunting;
mod loads;
mod minimum;
mod mistakes;
mod outputs;
mod precision;
mod proofs;
mod range;
mod receipt;
mod reference;
mod search;
mod suspects;
mod unsupported;
mod worked_examples;
