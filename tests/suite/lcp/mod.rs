mod file;
mod matrix;
mod problem;
