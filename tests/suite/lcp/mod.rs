mod exchange;
mod file;
mod friction;
mod library;
mod matrix;
mod merit;
mod painleve;
mod problem;
