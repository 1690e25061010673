//! The problem, its files in JSON, its friction and its known solutions.

mod equations;
mod file;
mod friction;
mod hypot;
mod library;
mod matrix;
mod merit;
mod painleve;
mod problem;
mod solution_set;
