//! Rigid bodies down to numbers: [`body`] and [`constraint`] make up a [`scene`], whose rows at an instant
//! are an [`assembly`], from which a [`formulation`] poses the complementarity problem of a step; a
//! [`simulation`] takes many steps.

pub mod assembly;
pub mod body;
pub mod constraint;
pub mod formulation;
pub mod scene;
pub mod simulation;
