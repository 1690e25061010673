//! Rigid-body mechanics, from scenes to complementarity problems: bodies and constraints make up a
//! [`scene`], whose rows at an instant are an [`assembly`], from which a [`formulation`] derives
//! the complementarity problem of a step; a [`simulation`] takes many steps.

pub mod assembly;
pub mod formulation;
pub mod scene;
pub mod simulation;

pub use lcplab_bodies::{body, constraint};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
