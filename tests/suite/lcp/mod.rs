mod matrix;
mod problem;
