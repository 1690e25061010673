mod file;
mod library;
mod friction;
mod matrix;
mod merit;
mod problem;
