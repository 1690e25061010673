//! Bodies, constraints, scenes and motion, held against closed forms.

mod assembly;
mod constraint;
mod formulation;
mod piles;
mod rows;
mod scene;
mod simulation;
