//! Lessons and exercises: what is committed is current, and checks tell right answers from wrong ones.

mod exercise;
mod handout;
mod notebook;
mod problem;
mod sentences;
