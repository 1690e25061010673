//! A verification and teaching toolkit for rigid-body contact solvers.

pub mod error;

pub mod body;

pub mod constraint;

pub mod scene;

pub mod lcp;

pub mod solver;

pub mod reference;

pub mod certificate;

pub mod assembly;

pub mod formulation;

pub mod simulation;

pub mod trace;

pub mod plot;

pub mod report;
