//! The tests, one binary. The modules mirror `src`.

mod architecture;
mod assembly;
mod body;
mod certificate;
mod chapter;
mod cli;
mod common;
mod constraint;
mod diagnosis;
mod explain;
mod formulation;
mod lcp;
mod lesson;
mod messages;
mod plot;
mod reference;
mod report;
mod scene;
mod simulation;
mod solver;
mod storage;
mod trial;
