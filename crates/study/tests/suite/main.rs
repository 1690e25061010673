//! The judge beside the solvers it does not know, derivations, diagnoses and trials.

mod certificate;
mod diagnosis;
mod explain;
mod extremes;
mod outputs;
mod range;
mod reference;
mod trial;
mod worked_examples;
