mod file;
mod matrix;
mod merit;
mod problem;
