//! Exercises: checks a student's answer against an independent one.
//!
//! An exercise is a small file with a gap or a bug (`notebooks/exercises`), and a check here that
//! calls the student's function. It reports the input on which the function fails, the law it
//! violates or the property that a number should have, but not how to fix it. A check does not use
//! the separate solution (`notebooks/solutions`); it compares with a closed form, exact arithmetic
//! or a law.
// The type of an answer is part of its exercise's statement, so it is written out in place.
#![allow(clippy::type_complexity)]

mod list;

pub mod complementarity;
pub mod drift;
pub mod evidence;
pub mod friction;
pub mod impacts;
pub mod jacobians;
pub mod newton;
pub mod own_constraint;
pub mod pivoting;
pub mod sparsity;
pub mod stack;
pub mod sweeping;

pub use list::exercises;

use std::panic::{AssertUnwindSafe, catch_unwind};

/// The result of a check: success, or what is wrong.
pub type Verdict = std::result::Result<(), String>;

/// A student's answer, ready to be checked.
#[derive(Debug, Clone, Copy)]
pub struct Exercise {
    /// Lesson and number, or b for a bug: `3.2`, `3.b`.
    pub id: &'static str,
    /// The task, in a line.
    pub title: &'static str,
    /// The file with the gap or the bug.
    pub file: &'static str,
    /// Runs the check on the answer that was compiled in.
    pub check: fn() -> Verdict,
}

impl Exercise {
    /// Checks the answer; an unfilled gap, or any other panic, is reported as text.
    pub fn verdict(&self) -> Verdict {
        let quiet = std::panic::take_hook();
        std::panic::set_hook(Box::new(|_| ()));
        let checked = catch_unwind(AssertUnwindSafe(self.check));
        std::panic::set_hook(quiet);
        checked.unwrap_or_else(|cause| {
            let words = cause.downcast_ref::<String>().map(String::as_str);
            let words = words.or_else(|| cause.downcast_ref::<&str>().copied());
            Err(match words.unwrap_or("it panicked") {
                words if words.starts_with("not yet implemented") => {
                    format!("the gap is not filled in yet: open {}", self.file)
                }
                words => format!("the answer panicked: {words}"),
            })
        })
    }
}
