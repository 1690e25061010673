mod file;
mod friction;
mod matrix;
mod merit;
mod problem;
