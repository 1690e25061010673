mod file;
mod library;
mod matrix;
mod merit;
mod problem;
