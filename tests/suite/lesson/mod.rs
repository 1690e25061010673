//! Lessons and exercises: what is committed is current, and checks tell right answers from wrong ones.

mod exercise;
mod handout;
mod kernel;
mod notebook;
mod problem;
mod sentences;
