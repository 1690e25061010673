//! Bodies, constraints, scenes and motion, compared with closed forms.

mod assembly;
mod constraint;
mod formulation;
mod piles;
mod rows;
mod scene;
mod simulation;
