//! Bodies, constraints, scenes and motion, held against closed forms.

mod assembly;
mod body;
mod constraint;
mod formulation;
mod piles;
mod scene;
mod simulation;
